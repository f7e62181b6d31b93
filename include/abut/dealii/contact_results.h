// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_RESULTS_H
#define ABUT_DEALII_CONTACT_RESULTS_H

/** @file
 * Results of contact, as numbers, as fields and by pair.
 */

#include <abut/dealii/communication_report.h>
#include <abut/dealii/contact_pair.h>
#include <abut/dealii/detection_report.h>
#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/solver_parameters.h>

#include <deal.II/base/index_set.h>

#include <vector>

namespace abut
{
  /** Measures of all rows, on all ranks. */
  struct ContactMeasures
  {
    dealii::types::global_dof_index n_rows = 0; ///< of all ranks
    /** Number of rows on this rank: it owns their secondary nodes. */
    unsigned int n_own_rows = 0;
    /** Number of rows in contact: in the present active set, or for interior
     * methods those with pressure / stiffness > gap. */
    dealii::types::global_dof_index n_active = 0;
    /** Membrane: the contact force on the lower obstacle minus that on the
     * upper. Pairs: the sum of the magnitudes of the normal forces of all rows
     * that are not ties; see ContactResults::pairs() for vectors. */
    double force = 0.;
    /** Largest penetration max(0, -g), length. */
    double penetration = 0.;
    /** How deep the law itself lets the present pressures press the bodies into
     * each other, length >= 0: the largest p / eps of laws with a penalty, and
     * the penetration allowed. 0 for exact and interior laws, and for
     * multipliers that an outer iteration has brought to their end. */
    double allowed_penetration = 0.;
    /** sum w |p g| / sum w |p|: mean gap under pressure, length. */
    double complementarity = 0.;
    /** Estimate, in the norm of the strain energy, of what the law leaves open:
     * (sum w s r^2)^(1/2) with the local stiffness s of a row (pressure per
     * length) and the natural residual r = min(g, p / s) of 0 <= p _|_ g >= 0
     * (ties: g, stick: the slip). Penetration of penalties, pressure across
     * gaps of barriers; 0 for exact multipliers, and before the first solve().
     */
    double complementarity_error = 0.;
  };

  /** Which forces of contact at which unknowns. */
  enum class ForcePart
  {
    /** sum w p B: those of all rows at free unknowns. In equilibrium they are
     * the residual R there. Not for nitsche. */
    at_free,
    /** Forces at unknowns that are prescribed, hanging nodes by their parents:
     * the rest of a support's reaction balances all other loads on the body.
     * Nothing for membranes; for nitsche that of its pressures. */
    at_prescribed,
    /** Forces of pressures at all unknowns, without friction; the rest as
     * before. */
    of_pressures
  };

  /** Number of searches for points between surfaces on this mesh. */
  struct PointCount
  {
    unsigned int finds = 0; /**< by detect(), or by points that move */
    /** Number of these that kept the points of the previous one: nothing they
     * depend on had changed, or, with updated kinematics, surfaces had moved
     * against each other by less than a hundredth of a facet. */
    unsigned int kept = 0;
  };

  /** Cost of contact. */
  struct ContactEffort
  {
    LinearReport linear; /**< all linear solves since the last reinit() */
    /** Search for surfaces that may touch, so far, and changes of contact
     * elements since the last commit(). */
    DetectionReport detection;
    PointCount points; /**< since the last reinit() */
    /** Data about the surfaces of pairs that this rank has sent since
     * construction, and that it has now. */
    CommunicationReport communication;
  };

  /** Results of the present rows, see ContactAssembler::results(). Fields have
   * no ghosts. All functions are collective. */
  template <int dim> class ContactResults
  {
  public:
    virtual ~ContactResults() = default;

    /** Numbers of rows, forces and penetrations. */
    virtual ContactMeasures measures() const = 0;

    /** Forces, moments and extremes on each pair; empty without pairs. */
    virtual std::vector<PairResult<dim>> pairs() const = 0;

    /** The same, with moments at the places of @p displacement as those of the
     * last examine(). */
    virtual std::vector<PairResult<dim>>
    pairs(const la::VectorView &displacement) const = 0;

    /** Membrane: nodal pressure, positive on the lower obstacle, negative on
     * the upper, 0 where there is no row (hanging nodes: distribute your
     * hanging-node constraints).
     *
     * Pairs: the vector p n at the nodes of the secondary surface, and -p n is
     * the force of a node by its area, the integral of its shape function; for
     * ties likewise with the shear. So the integral of -p n over the secondary
     * surface is the force on it, also where the other side ends within facets:
     * nodes at that rim have a share of the pressure beside it, as large as the
     * part of their area that is covered. Hanging nodes have the value of their
     * parents, nodes between corners the mean of these where multipliers have
     * degree 1. It can be interpolated to another mesh. */
    virtual la::Vector pressure() const = 0;

    /** Nodal gap to the nearer obstacle, 0 where there is no row. Pairs: in
     * each of the first dim components; between corners as pressure(). */
    virtual la::Vector gap() const = 0;

    /** Pairs with friction: how far what is in contact has come along the other
     * side since the last commit(), as a vector at the nodes of the secondary
     * surface, 0 elsewhere; hanging nodes as in pressure(). */
    virtual la::Vector slip() const = 0;

    /** 1 on the lower, 2 on the upper obstacle, 0 open, -1 without a row.
     * Pairs: 1 in contact, in each of the first dim components. */
    virtual la::Vector status() const = 0;

    /** Add the present contact forces. */
    virtual void add_forces(const la::MutableVectorView &forces,
                            ForcePart part = ForcePart::at_free) const = 0;

    /** The unknowns of this rank that may take part in contact: those of all
     * rows of the last detect(), in contact or not, on both sides; hanging
     * nodes by their parents. Whoever moves mass away from contact nodes must
     * do it there. */
    virtual dealii::IndexSet candidate_nodes() const = 0;

    /** Cost of search, points, messages and linear systems. */
    virtual ContactEffort effort() const = 0;
  };
} // namespace abut

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_CHECKS_H
#define ABUT_DEALII_CONTACT_CHECKS_H

/** @file
 * Checks of a contact problem and of its answer.
 */

#include <abut/dealii/contact_examination.h>
#include <abut/dealii/contact_pair.h>
#include <abut/dealii/detection_report.h>
#include <abut/dealii/host_operator.h>
#include <abut/dealii/linear_algebra.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace abut
{
  /** See ContactAssembler::checks(). All functions are collective. */
  template <int dim> class ContactChecks
  {
  public:
    virtual ~ContactChecks() = default;

    /** Findings of detect() on each pair; empty without pairs. */
    virtual std::vector<PairCheck> pairs() const = 0;

    /** Look for rigid motions that neither @p tangent nor any row resists, be
     * it open or closed: then there is no answer, however small the load steps.
     * With the @p residual at displacement 0, internal minus external forces,
     * only those along which loads do work; after an iteration also those that
     * its closed points hardly resist, with the number of these points among
     * the numbers of the message. Throws SolverFailure, which names body and
     * motion. Call after detect(); one pass over a matrix, or one
     * product of a host and one for each rigid motion. Does nothing for
     * membranes. */
    virtual void supports(const Tangent &tangent,
                          const la::VectorView &residual = {}) const = 0;

    /** Search the bodies displaced by @p displacement, without regard to
     * rows, for points of secondary surfaces that are inside the other body (or
     * obstacle) by more than @p tolerance, length > 0, although they have no
     * row: nodes of the secondary, and facets of it without rows that hold a
     * node of the primary; with updated kinematics also what has come through
     * the other side since the last commit(), on straight ways, and is outside
     * of it again. To be called after convergence; if something is found, call
     * detect() with this displacement, whose reach follows the motion, and
     * solve on. Nodes of the primary between rows are no misses: no search
     * helps against them, see PairResult::between_rows. The same list on all
     * ranks; empty without pairs. As costly as detect(). */
    virtual std::vector<Penetration<dim>>
    penetrations(const la::VectorView &displacement,
                 double tolerance) const = 0;

    /** Look at the answer at @p displacement for what the iteration cannot see:
     * strains that are not small (a warning from 5 %, an error from 50 %, or
     * from a third in the mean of a body, unless @p allow_large_strain),
     * surfaces that slide by more than a facet, obstacles that pass between
     * nodes, are narrower than facets or in the inside of bodies, penetrations
     * compared with the deformation of bodies, and, if
     * @p residual is given (of the host, at @p displacement), forces out of
     * balance, as after a residual of wrong sign. So it does of residuals that
     * were given to solve(): those that do not change as the tangent does, and
     * those without the forces of prescribed displacements. Whatever
     * contradicts itself by more than a tenth is an error. Measures go into
     * ContactResults::pairs(), too. To be called after convergence and
     * penetrations(), once per load step; distances of obstacles are evaluated
     * at points of the facets near them, of a membrane in all its cells. Throws
     * ObstacleError for formulas without a value there. Where nothing can touch
     * it only looks at strains and rotations. */
    virtual ContactExamination
    examine(const la::VectorView &displacement,
            const la::VectorView &residual = {},
            bool allow_large_strain = false) const = 0;

    /** How deep obstacles are in what has no contact, by active cell of this
     * rank: the depth at facets without contact, or of a membrane in cells
     * without; and where there is contact, the depth of an obstacle that no
     * node sees, if that is more than a tenth of the deformation of bodies.
     * Error estimates that only look at nodes do not see it. 0 elsewhere.
     * Resizes @p depth; returns the largest on all ranks. See examine(). */
    virtual double missed_depth(const la::VectorView &displacement,
                                dealii::Vector<float> &depth) const = 0;

    /** By pair: which part of the force of a uniform pressure the rows hand to
     * wrong nodes of the primary surface, in [0, 1]. Round-off for mortar; for
     * node to segment and quadrature points an error of the contact pressure
     * that refinement does not lower. 0 against obstacles. To be called after
     * detect(), which it costs as much as. */
    virtual std::vector<double>
    transfer_errors(const la::VectorView &displacement) const = 0;

    /** With updated kinematics: how far closed rows go in the step to
     * @p displacement, by pair. A host halves steps in which surfaces slide by
     * more than half a facet, or rotate by more than 5 degrees: points are
     * those of its beginning. To be called after the solve and before commit().
     * Where partners stay: how far they have slid in all. */
    virtual std::vector<StepMotion>
    step_motion(const la::VectorView &displacement) const = 0;

    /** Changes of partners that ContactAssembler::evaluate() has found since
     * the last linearise(). */
    virtual PartnerChanges partner_changes() const = 0;

    /** Forces out of balance after a step, as a part of the contact forces: the
     * norm of @p residual (internal minus external forces) minus the contact
     * forces of the present pressures, by the norm of the latter or @p least,
     * whichever is more. Not small: a linear solver has failed its promise. Not
     * for nitsche with theta other than 0, which is no balance of forces. */
    virtual double imbalance(const la::VectorView &residual,
                             double least) const = 0;

    /** The same as a part of the load of the last iteration, or of the contact
     * forces if these are more; 0 where there is no such balance, or no more
     * than round-off is left; 1 where there is neither load nor contact. About
     * 2 where the residual has the wrong sign. */
    virtual double imbalance(const la::VectorView &residual) const = 0;

    /** Size of the products of the entries of @p tangent with @p displacement
     * one by one, before they cancel: no solver lowers residuals beyond the
     * round-off of it. Where points move, with a thousandth of the coordinates,
     * for the round-off of positions. 0 without a matrix. */
    virtual ForceSize
    size_of_forces(const Tangent &tangent,
                   const la::VectorView &displacement) const = 0;
  };
} // namespace abut

#endif

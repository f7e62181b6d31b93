// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ELASTICITY_H
#define ABUT_APP_ELASTICITY_H

#include "app/input/boundary_expressions.h"
#include "cell_degrees.h"
#include "discrete_problem.h"
#include "material.h"
#include "shim/by_element.h"
#include "volume_force.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::app
{
  template <int dim> class StiffnessCache;
  template <int dim>
  using StiffnessCaches = shim::ByElement<StiffnessCache<dim>>;

  /** Data of elastic bodies; functions must outlive it, and have the time of
   * the present load step. */
  template <int dim> struct ElasticData
  {
    using Conditions =
        std::map<dealii::types::boundary_id, BoundaryCondition<dim>>;

    Materials<dim> materials; ///< by material id
    Conditions supports;      ///< displacements
    Conditions tractions;     ///< force per area
    Conditions pressures;     ///< into the body
    /** By material id; others have none. */
    std::map<dealii::types::material_id, const VolumeForce<dim> *> body_force;
    /** Name of a boundary in messages. */
    std::function<std::string(dealii::types::boundary_id)> name;
  };

  /** Elastic bodies without contact: unknowns, constraints, tangent, loads. Of
   * linear materials the tangent is made once for each mesh. */
  template <int dim> class Elasticity : public DiscreteProblem<dim>
  {
  public:
    /** @param middles of curved edges of triangles and tetrahedra; null: all
     * are straight */
    Elasticity(dealii::Triangulation<dim> &triangulation,
               const CellDegrees &degrees,
               std::shared_ptr<const EdgeMiddles<dim>> middles = nullptr);
    ~Elasticity() override;

    /** Number unknowns, build constraints and the matrix's pattern for the
     * present mesh. Throws InputError when two supports prescribe different
     * values at a node. Collective. */
    void setup(const ElasticData<dim> &data);

    /** Constraints with the supports' values of the present time. Collective.
     */
    void set_supports(const ElasticData<dim> &data);

    /** Compute the tangent of the undeformed bodies on the present mesh.
     * Collective. */
    void assemble_stiffness();

    /** That tangent, whatever was asked of tangent() since. */
    const la::Matrix &undeformed_stiffness() const
    {
      return is_linear() ? this->stiffness : undeformed;
    }

    /** Of linear materials for @p u with the prescribed values of the present
     * time, of others for @p u as it is: these may be on their way. */
    void residual(const la::Vector &u, la::Vector &result) const override;
    const la::Matrix &tangent(const la::Vector &u) override;

    const Materials<dim> &all_materials() const
    {
      return *materials;
    }

    NodalForces nodal_forces(const la::Vector &u) const override;

    /** Whether all materials are. */
    bool is_linear() const override;

    /** Compute the load of the present time, with what prescribed
     * displacements add. Collective. */
    void assemble_load(const ElasticData<dim> &data);

    /** Difference between the forces of the formulas of tractions, pressures
     * and body forces on each facet and cell and those that its points add to
     * the load, summed, over the sum of the former, by 2 to 64 points in each
     * direction, many where few are loaded; none where all are constant.
     * Collective. */
    std::optional<double> load_error(const ElasticData<dim> &data) const;

    /** The same of prescribed displacements, see nodal_error(). */
    std::optional<double> support_error(const ElasticData<dim> &data) const;

    /** Internal minus external forces of a displacement (owned) at all
     * unknowns but hanging ones, supported ones included: what supports and
     * contact have to hold. Needs assemble_load(). Collective. */
    la::Vector unbalanced_forces(const la::Vector &u) const;

    la::Vector stiffness_times(const la::Vector &u) const override;
    la::Vector internal_forces(const la::Vector &u) const override;
    double stored_energy(const la::Vector &u) const override;

    /** Stored energy minus the work of external forces, supports included.
     * Collective. */
    double energy(const la::Vector &u) const override;

  private:
    using Values = std::map<dealii::types::global_dof_index, double>;

    Values support_values(const ElasticData<dim> &data) const;
    void prescribe(const ElasticData<dim> &data,
                   dealii::AffineConstraints<double> &constraints) const;
    void add_forces(const ElasticData<dim> &data, la::Vector &load,
                    la::Vector &all) const;
    void add_support_forces(la::Vector &load) const;
    /** Internal forces by rules of hanging nodes alone, or of supports, too,
     * cell by cell. */
    la::Vector forces_by(const la::Vector &u,
                         const dealii::AffineConstraints<double> &rules) const;
    /** Those of the first kind, with the present prescribed values. */
    la::Vector all_internal_forces(const la::Vector &u) const;
    void assemble_tangent(const la::Vector &u);
    la::Matrix undeformed; ///< of nonlinear materials
    std::unique_ptr<Materials<dim>> materials;
    std::unique_ptr<StiffnessCaches<dim>> cache;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DISCRETE_PROBLEM_H
#define ABUT_APP_DISCRETE_PROBLEM_H

#include "middle_nodes.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/vertex_origin.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/hp/fe_collection.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace abut::app
{
  /** Functions by boundary id. */
  template <int dim>
  using BoundaryFunctions =
      std::map<dealii::types::boundary_id, const dealii::Function<dim> *>;

  /** Forces at all unknowns, supported ones included; hanging ones by their
   * parents. */
  struct NodalForces
  {
    la::Vector internal, external;
  };

  /** A problem on a mesh: unknowns, constraints, tangent and load vector. What
   * its forces are is the matter of derived classes. */
  template <int dim> class DiscreteProblem
  {
  public:
    /** Adds prescribed values to constraints that hold hanging nodes. */
    using Prescribe = std::function<void(dealii::AffineConstraints<double> &)>;

    /** @param elements one, or one for each kind of cells
     * @param middles of triangles and tetrahedra with curved edges; null: all
     * are straight */
    DiscreteProblem(dealii::Triangulation<dim> &triangulation,
                    const dealii::hp::FECollection<dim> &elements,
                    std::shared_ptr<const EdgeMiddles<dim>> middles = nullptr);

    virtual ~DiscreteProblem() = default;

    /** Internal minus external forces at u, 0 at constrained unknowns.
     * Collective. */
    virtual void residual(const la::Vector &u, la::Vector &result) const = 0;

    /** What the residual consists of, supported unknowns included, for the
     * loads last assembled. Collective. */
    virtual NodalForces nodal_forces(const la::Vector &u) const = 0;

    /** Its derivative by u, as it is until the next call. Collective. */
    virtual const la::Matrix &tangent(const la::Vector &u) = 0;

    /** Energy at u, which the residual is the derivative of. Collective. */
    virtual double energy(const la::Vector &u) const = 0;

    /** Whether the tangent is the same for all u, and the residual costs no
     * more than a product with it. */
    virtual bool is_linear() const = 0;

    /** K u over all unknowns but hanging ones, whatever is prescribed now: of
     * displacements at any time, velocities, motions. Linear problems only.
     * Collective. */
    virtual la::Vector stiffness_times(const la::Vector &u) const = 0;

    /** Internal forces of @p u at all unknowns but hanging ones, whatever is
     * prescribed now: K u of linear problems. Collective. */
    virtual la::Vector internal_forces(const la::Vector &u) const
    {
      return stiffness_times(u);
    }

    /** The energy that they are the derivative of, nan where a material has
     * none; u as above. Collective. */
    virtual double stored_energy(const la::Vector &u) const;

    /** (d K d)^(1/2) with the present tangent of a difference (owned) of two
     * solutions, which have the same values where these are prescribed. */
    double energy_norm(const la::Vector &difference) const;

    /** Copy with the ghosts of this rank's cells, constraints applied. */
    la::Vector ghosted(const la::Vector &owned) const;

    /** The same for fields without prescribed values (pressure, gap): only
     * hanging nodes are interpolated. */
    la::Vector ghosted_field(const la::Vector &owned) const;

    la::Vector vector() const;

    /** Of all elements. */
    unsigned int n_components() const
    {
      return elements.n_components();
    }

  private:
    la::Vector ghosted(const la::Vector &owned,
                       const dealii::AffineConstraints<double> &rules) const;

  public:
    const dealii::hp::FECollection<dim> elements;

  private:
    const std::unique_ptr<const dealii::Mapping<dim>> own_mapping;

  public:
    const dealii::Mapping<dim> &mapping;
    dealii::DoFHandler<dim> dof_handler;
    dealii::AffineConstraints<double> constraints;
    dealii::AffineConstraints<double> hanging;
    dealii::IndexSet relevant;
    la::Matrix stiffness; ///< the present tangent
    la::Vector load;      ///< external forces, constraints put in
    /** Those at all unknowns but hanging ones, of what moves or may be
     * nonlinear. */
    la::Vector external;

    /** See ContactAssembler::set_vertex_origins(). */
    std::vector<VertexOrigin> vertex_origins;

    /** Number the unknowns of each rank by Cuthill and McKee's method. Takes
     * effect with the next mesh. */
    bool renumber = false;

    /** The entries of a vector at prescribed unknowns, 0 at all others. */
    la::Vector at_supports(const la::Vector &values) const;

  protected:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    /** Writes the product of the stiffness of a cell with values there. */
    using CellStiffness =
        std::function<void(const Cell &, dealii::Vector<double> &product,
                           const dealii::Vector<double> &values)>;

    /** Number unknowns, build constraints and the matrix's pattern for the
     * present mesh. Collective. */
    void distribute(const Prescribe &prescribe);

    /** Build the constraints again, with other prescribed values for the same
     * unknowns. Collective. */
    void set_constraints(const Prescribe &prescribe);

    /** The residual where it is linear: that of `stiffness` and `load`. */
    void linear_residual(const la::Vector &u, la::Vector &result) const;

    /** Cells of this rank with unknowns that are prescribed, or hang on such:
     * only there the matrix does not say what forces are. Found once for each
     * mesh; collective then. */
    const std::vector<Cell> &support_cells() const;

    /** What the cells at supports add to the product of the matrix with the
     * free part of @p u: forces of prescribed values at free unknowns, and all
     * forces at prescribed ones. Collective. */
    la::Vector support_forces(const la::Vector &u,
                              const CellStiffness &cell_stiffness) const;

    /** The product of the matrix with the free part of @p u (owned). */
    la::Vector free_forces(const la::Vector &u) const;

    /** A load vector that takes contributions to unknowns of other ranks. */
    la::Vector open_load() const;

    /** Sum the contributions of all ranks. Collective. */
    la::Vector close_load(la::Vector &open) const;

    const MPI_Comm communicator;

  private:
    std::vector<Cell> find_support_cells() const;

    mutable std::optional<std::vector<Cell>> known_support_cells;
  };

  /** K u = f: forces of small strain, gradients of a membrane. */
  template <int dim> class LinearProblem : public DiscreteProblem<dim>
  {
  public:
    using DiscreteProblem<dim>::DiscreteProblem;

    void residual(const la::Vector &u, la::Vector &result) const override
    {
      this->linear_residual(u, result);
    }

    const la::Matrix &tangent(const la::Vector &) override
    {
      return this->stiffness;
    }

    bool is_linear() const override
    {
      return true;
    }
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MEMBRANE_H
#define ABUT_APP_MEMBRANE_H

#include <abut/dealii/linear_algebra.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>

#include <map>

namespace abut::app
{
  /** Functions by boundary id. */
  template <int dim>
  using BoundaryFunctions =
      std::map<dealii::types::boundary_id, const dealii::Function<dim> *>;

  /** Data of a membrane; functions must outlive it. */
  template <int dim> struct MembraneData
  {
    const dealii::Function<dim> *conductivity; ///< k
    const dealii::Function<dim> *load;         ///< f
    bool constant_conductivity;                ///< k is the same everywhere
    bool constant_load;                        ///< f is the same everywhere
    BoundaryFunctions<dim> dirichlet;
    BoundaryFunctions<dim> neumann;
  };

  /** The discrete membrane -div(k grad u) = f without obstacle: unknowns,
   * constraints, stiffness matrix, load vector. */
  template <int dim> class Membrane
  {
  public:
    Membrane(dealii::parallel::distributed::Triangulation<dim> &triangulation,
             unsigned int degree);

    /** Number unknowns, build constraints and the matrix's pattern for the
     * present mesh. Collective. */
    void setup(const MembraneData<dim> &data);

    /** Compute stiffness and load. Throws InputError for values of k and f
     * that are not legal. Collective. */
    void assemble(const MembraneData<dim> &data);

    /** Residual K u - f, 0 at constrained unknowns. */
    void residual(const la::Vector &u, la::Vector &result) const;

    /** Copy with the ghosts of this rank's cells, constraints applied. */
    la::Vector ghosted(const la::Vector &owned) const;

    /** The same for fields without prescribed values (pressure, gap): only
     * hanging nodes are interpolated. */
    la::Vector ghosted_field(const la::Vector &owned) const;

    la::Vector vector() const;

    dealii::FE_Q<dim> fe;
    dealii::MappingQ<dim> mapping;
    dealii::DoFHandler<dim> dof_handler;
    dealii::AffineConstraints<double> constraints;
    dealii::AffineConstraints<double> hanging;
    dealii::IndexSet relevant;
    la::Matrix stiffness;
    la::Vector load;

  private:
    void assemble_cells(const MembraneData<dim> &data);
    void assemble_neumann(const MembraneData<dim> &data);
    la::Vector ghosted(const la::Vector &owned,
                       const dealii::AffineConstraints<double> &rules) const;

    MPI_Comm communicator;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_TWO_BLOCKS_H
#define ABUT_TESTS_TWO_BLOCKS_H

#include "row_laws.h"
#include "shim/handles.h"
#include "solve/make_row_solver.h"

#include <abut/coupling.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

namespace abut::tests
{
  /** Two elastic unit cubes (squares), one on top of the other. */
  struct TwoBlocksOptions
  {
    unsigned int n_lower = 2; /**< cells along an edge before refinement */
    unsigned int n_upper = 3; /**< the upper block is the secondary */
    unsigned int refinements = 0;
    double young_ratio = 1.; /**< Young's modulus of lower by upper block */
    double poisson = 0.3;
    double angle = 0.; /**< of rotation about the y axis (2D: z axis), radian */
    enum class Support
    {
      both,  /**< outer faces clamped */
      slide, /**< lower clamped; upper held sideways at two faces, free to move
                  up and down */
      free   /**< lower clamped; nothing holds the upper block */
    } support = Support::both;
    abut_discretisation discretisation = ABUT_DISCRETISATION_DUAL_MORTAR;
    /** One row per facet of the secondary instead, of its quadrature points:
     * constant pressures. In serial. */
    bool constants = false;
  };

  /** The linearised contact problem of two blocks with all rows that the core
   * couples them by: matrix, forces and rows for the solvers. */
  template <int dim> class TwoBlocks : public RowLaws
  {
  public:
    TwoBlocks(MPI_Comm communicator, const TwoBlocksOptions &options);

    /** Law of row @p i of this rank: a constraint, a spring of @p kappa times
     * the row's stiffness, or open. */
    void set_constraint(int i);
    void set_spring(int i, double kappa);
    void set_open(int i);

    /** |K du - w p B^T + R| / |R| and the largest |a dp + b dg + c| / (|b| max
     * |dg| + |c|) after a solve: both 0 for the exact solution. Collective. */
    std::pair<double, double> errors(const la::Vector &increment) const;

    dealii::types::global_dof_index n_dofs() const
    {
      return dof_handler.n_dofs();
    }

    MPI_Comm communicator;
    la::Matrix stiffness;
    la::Vector residual;
    solve::NearNullSpace space;
    abut_points_view rows = {};     ///< nodes are unknowns
    solve::PointOperator operation; ///< of the rows
    std::vector<double> row_stiffness;

  private:
    void make_mesh();
    void set_supports();
    void assemble();
    void couple();

    TwoBlocksOptions options;
    dealii::parallel::distributed::Triangulation<dim> triangulation;
    dealii::DoFHandler<dim> dof_handler;
    dealii::AffineConstraints<double> constraints;
    shim::Handle<abut_context> context = shim::create_context();
    shim::Handle<abut_points> row_set = shim::create_points(context.get(), 1);
  };
} // namespace abut::tests

#endif

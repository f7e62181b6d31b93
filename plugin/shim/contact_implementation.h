// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_IMPLEMENTATION_H
#define ABUT_SHIM_CONTACT_IMPLEMENTATION_H

#include "handles.h"
#include "nodal_candidates.h"
#include "solve/row_solver.h"

#include <abut/dealii/contact_assembler.h>

namespace abut
{
  namespace shim
  {
    /** Row numbers: two per unknown, so that numbers are unique over ranks
     * and sorted by unknown. */
    inline constexpr std::int64_t upper_bit = 1;

    inline std::int64_t row_id(const dealii::types::global_dof_index dof,
                               const bool upper)
    {
      return 2 * static_cast<std::int64_t>(dof) + (upper ? upper_bit : 0);
    }
  } // namespace shim

  /** The inside of a ContactAssembler: rows, start and strategy of one solve.
   */
  template <int dim> struct ContactAssembler<dim>::Implementation
  {
    explicit Implementation(const MPI_Comm communicator)
        : communicator(communicator)
    {
    }

    void check(const abut_status status) const;
    void check_obstacles(const std::vector<double> &lower,
                         const std::vector<double> &upper) const;
    void check_prescribed_values() const;
    void find_rows();
    void append_rows(const std::vector<double> &lower,
                     const std::vector<double> &upper);
    void compute_gap(const la::Vector &displacement);
    void set_scales(const la::Matrix &matrix, const la::Vector &residual);
    double length_scale() const;
    void begin(const la::Matrix &matrix, const la::Vector &residual);
    void prepare_solver(const la::Matrix &matrix);
    void push_inside(la::Vector &displacement);
    void relax(const la::Matrix &matrix, const la::Vector &residual,
               unsigned int n_sweeps, la::Vector &displacement);
    void next();
    double row_pressure(int row) const;
    /** Local number of the unknown of a row. */
    int unknown(int row) const;
    bool is_upper(int row) const;
    la::Vector nodal_vector() const;

    const MPI_Comm communicator;
    Obstacle<dim> obstacle;
    MethodParameters method;
    SolverParameters solver_parameters;
    bool constant_matrix = false;

    const dealii::DoFHandler<dim> *dof_handler = nullptr;
    const dealii::AffineConstraints<double> *constraints = nullptr;
    shim::NodalCandidates<dim> candidates;
    std::set<dealii::types::boundary_id> candidates_of;
    bool candidates_are_known = false;
    const dealii::Mapping<dim> *mapping = nullptr;

    shim::Handle<abut_context> context = shim::create_context();
    shim::Handle<abut_rows> rows = shim::create_rows(context.get());
    shim::Handle<abut_strategy> strategy;
    abut_rows_view view = {};
    dealii::types::global_dof_index n_rows = 0;
    dealii::types::global_dof_index first_unknown =
        0; ///< owned ones are consecutive

    /** [owned] signed nodal pressure to start from; empty: 0. */
    std::vector<double> start_pressure;
    std::vector<std::uint8_t> start_state; ///< [rows]; empty: from p and g
    la::Vector start_displacement;
    std::vector<double> gap; ///< [rows] at the present displacement
    double smallest_residual = 0.;

    std::unique_ptr<solve::RowSolver> solver;
    bool solver_is_ready = false;
    bool is_started = false;
    bool was_added = false; ///< by add(): the host solves
    abut_request request = {};
    LinearReport report;
  };
} // namespace abut

#endif

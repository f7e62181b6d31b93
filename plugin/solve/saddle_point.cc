// SPDX-License-Identifier: LGPL-2.1-or-later
#include "saddle_point.h"

#include <deal.II/base/timer.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

namespace abut::solve
{
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** C^T and C of the constraints on this rank, over owned unknowns. */
    struct Coupling
    {
      std::vector<int> start = {0};
      std::vector<int> unknown;
      std::vector<double> value;

      int size() const
      {
        return static_cast<int>(start.size()) - 1;
      }

      double times(const int k, const double *u) const
      {
        double sum = 0.;
        for (int e = start[k]; e < start[k + 1]; ++e)
          sum += value[e] * u[unknown[e]];
        return sum;
      }

      void add_transposed(const int k, const double factor, double *u) const
      {
        for (int e = start[k]; e < start[k + 1]; ++e)
          u[unknown[e]] += factor * value[e];
      }
    };
  } // namespace

  struct SaddlePoint::System
  {
    Coupling coupling;
    std::vector<int> row; ///< number of each constraint's row
    /** Multiplies the second equation, so that its residual is a force. */
    std::vector<double> scale;
    /** gamma s / w: augmentation is C^T diag(augmentation) C. */
    std::vector<double> augmentation;
    std::vector<double> schur; ///< w / ((1 + gamma) s)
    std::vector<double> right; ///< h
    Mask added;                ///< D
    Mask augmented;            ///< D and the diagonal of the augmentation
    la::Vector force;          ///< f
    dealii::types::global_dof_index n_constraints = 0;
    dealii::types::global_dof_index first_constraint = 0;
  };

  namespace
  {
    dealii::types::global_dof_index
    sum_of_lower_ranks(const dealii::types::global_dof_index mine,
                       const MPI_Comm communicator)
    {
      unsigned long long value = mine, sum = 0;
      MPI_Exscan(&value, &sum, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM,
                 communicator);
      return MPI::this_mpi_process(communicator) == 0 ? 0 : sum;
    }

    /** The augmented system with its second equation scaled. */
    template <typename System> class AugmentedOperator
    {
    public:
      AugmentedOperator(const la::Matrix &stiffness, const System &system)
          : stiffness_(stiffness), system_(system)
      {
      }

      void vmult(BlockVector &dst, const BlockVector &src) const
      {
        stiffness_.vmult(dst.block(0), src.block(0));
        double *force = la::data(dst.block(0));
        double *gap = la::data(dst.block(1));
        const double *u = la::data(src.block(0));
        const double *p = la::data(src.block(1));
        for (std::size_t i = 0; i < system_.added.diagonal.size(); ++i)
          force[i] += system_.added.diagonal[i] * u[i];
        for (int k = 0; k < system_.coupling.size(); ++k)
        {
          const double cu = system_.coupling.times(k, u);
          gap[k] = -system_.scale[k] * cu;
          system_.coupling.add_transposed(
              k, system_.augmentation[k] * cu - p[k], force);
        }
      }

    private:
      const la::Matrix &stiffness_;
      const System &system_;
    };

    /** Upper block-triangular preconditioner. */
    template <typename System> class TriangularPreconditioner
    {
    public:
      TriangularPreconditioner(const ScaledPreconditioner &leading,
                               const System &system, const la::Vector &model)
          : leading_(leading), system_(system), force_(model)
      {
      }

      void vmult(BlockVector &dst, const BlockVector &src) const
      {
        const double *gap = la::data(src.block(1));
        double *p = la::data(dst.block(1));
        force_ = src.block(0);
        double *force = la::data(force_);
        for (int k = 0; k < system_.coupling.size(); ++k)
        {
          p[k] = -gap[k] / (system_.scale[k] * system_.schur[k]);
          system_.coupling.add_transposed(k, p[k], force);
        }
        leading_.vmult(dst.block(0), force_);
      }

    private:
      const ScaledPreconditioner &leading_;
      const System &system_;
      mutable la::Vector force_;
    };
  } // namespace

  SaddlePoint::SaddlePoint(const SolverParameters &parameters)
      : parameters_(parameters), leading_(parameters)
  {
  }

  void SaddlePoint::reinit(const la::Matrix &stiffness,
                           const abut_rows_view &rows)
  {
    stiffness_ = &stiffness;
    rows_ = rows;
    leading_.reinit(stiffness);
    row_stiffness_ = row_stiffness(stiffness, rows);
  }

  SaddlePoint::System SaddlePoint::assemble(const la::Vector &residual,
                                            const abut_request &request) const
  {
    System system;
    system.force = residual;
    system.force *= -1.;
    double *force = la::data(system.force);
    const std::size_t n = leading_.diagonal().size();
    system.added.held.assign(n, 0);
    system.augmented.held.assign(n, 0);
    system.added.diagonal.assign(n, 0.);
    system.augmented.diagonal.assign(n, 0.);

    const dealii::IndexSet owned = stiffness_->locally_owned_range_indices();
    for (int i = 0; i < rows_.n_rows; ++i)
    {
      const double w = rows_.weight[i];
      const double a = request.d_pressure[i];
      const double b = request.d_gap[i];
      const double c = request.residual[i];
      const bool is_constraint = a == 0.;
      const double factor =
          is_constraint ? parameters_.augmentation * row_stiffness_[i] : b / a;
      for (auto e = rows_.row_start[i]; e < rows_.row_start[i + 1]; ++e)
      {
        const int j = owned.index_within_set(rows_.column[e]);
        const double slope = rows_.coefficient[e];
        system.augmented.diagonal[j] += w * slope * slope * factor;
        if (is_constraint)
        {
          system.coupling.unknown.push_back(j);
          system.coupling.value.push_back(w * slope);
          force[j] += w * slope * (request.pressure[i] - factor * c / b);
        }
        else
        {
          AssertThrow(b == 0.
                          || rows_.row_start[i + 1] - rows_.row_start[i] == 1,
                      dealii::ExcMessage("Rows over several unknowns cannot "
                                         "be condensed into the diagonal."));
          system.added.diagonal[j] += w * slope * slope * factor;
          force[j] += w * slope * (request.pressure[i] - c / a);
        }
      }
      if (is_constraint)
      {
        system.coupling.start.push_back(system.coupling.unknown.size());
        system.row.push_back(i);
        system.right.push_back(w * c / b);
        system.scale.push_back(row_stiffness_[i]);
        system.augmentation.push_back(factor / w);
        system.schur.push_back(
            w / ((1. + parameters_.augmentation) * row_stiffness_[i]));
      }
    }
    const MPI_Comm communicator = stiffness_->get_mpi_communicator();
    system.n_constraints = system.row.size();
    system.first_constraint =
        sum_of_lower_ranks(system.n_constraints, communicator);
    system.n_constraints = MPI::sum(system.n_constraints, communicator);
    return system;
  }

  unsigned int
  SaddlePoint::solve_iteratively(const System &system, const double tolerance,
                                 la::Vector &increment,
                                 std::vector<double> &multiplier) const
  {
    dealii::IndexSet constraints(system.n_constraints);
    constraints.add_range(system.first_constraint,
                          system.first_constraint + system.row.size());
    const MPI_Comm communicator = stiffness_->get_mpi_communicator();
    BlockVector right({stiffness_->locally_owned_range_indices(), constraints},
                      communicator);
    right.block(0) = system.force;
    for (std::size_t k = 0; k < system.row.size(); ++k)
      la::data(right.block(1))[k] = system.scale[k] * system.right[k];
    BlockVector solution(right);
    solution = 0.;

    const ScaledPreconditioner leading =
        leading_.preconditioner(system.augmented, increment);
    const AugmentedOperator<System> matrix(*stiffness_, system);
    const TriangularPreconditioner<System> preconditioner(leading, system,
                                                          increment);
    dealii::SolverControl control(parameters_.max_iterations,
                                  std::max(tolerance, 1e-14 * right.l2_norm()),
                                  false, false);
    dealii::SolverFGMRES<BlockVector> fgmres(
        control, dealii::SolverFGMRES<BlockVector>::AdditionalData(60));
    if (right.l2_norm() > tolerance)
      try
      {
        fgmres.solve(matrix, solution, right, preconditioner);
      }
      catch (const dealii::SolverControl::NoConvergence &failure)
      {
        throw_failure("FGMRES on the saddle-point system", failure, tolerance);
      }
    increment = solution.block(0);
    const double *p = la::data(solution.block(1));
    multiplier.assign(p, p + system.row.size());
    return control.last_step() == dealii::numbers::invalid_unsigned_int
               ? 0
               : control.last_step();
  }

  void SaddlePoint::solve_directly(const System &system, la::Vector &increment,
                                   std::vector<double> &multiplier) const
  {
    const MPI_Comm communicator = stiffness_->get_mpi_communicator();
    const dealii::IndexSet unknowns = stiffness_->locally_owned_range_indices();
    const auto n = unknowns.size();
    dealii::IndexSet owned(n + system.n_constraints);
    owned.add_indices(unknowns);
    owned.add_range(n + system.first_constraint,
                    n + system.first_constraint + system.row.size());

    // Entries of this rank's rows, in the numbering (unknowns, constraints).
    dealii::DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
    const la::LocalRows rows = la::local_rows(*stiffness_);
    const auto for_each_entry = [&](const auto &visit)
    {
      for (int i = 0; i < rows.n_rows; ++i)
        for (int e = rows.start[i]; e < rows.start[i + 1]; ++e)
          visit(unknowns.nth_index_in_set(i),
                la::global_column(*stiffness_, rows.column[e]),
                rows.value[e]
                    + (rows.column[e] == i ? system.added.diagonal[i] : 0.));
      for (int k = 0; k < system.coupling.size(); ++k)
      {
        const auto row = n + system.first_constraint + k;
        visit(row, row, 0.);
        for (int e = system.coupling.start[k]; e < system.coupling.start[k + 1];
             ++e)
        {
          const auto column =
              unknowns.nth_index_in_set(system.coupling.unknown[e]);
          visit(row, column, -system.coupling.value[e]);
          visit(column, row, -system.coupling.value[e]);
        }
      }
    };
    for_each_entry([&](const auto i, const auto j, double)
                   { pattern.add(i, j); });
    la::Matrix matrix;
    matrix.reinit(owned, owned, pattern, communicator);
    for_each_entry([&](const auto i, const auto j, const double value)
                   { matrix.add(i, j, value); });
    matrix.compress(dealii::VectorOperation::add);

    // Without augmentation here: a factorisation has no use for it.
    la::Vector right(owned, communicator), solution(owned, communicator);
    const int n_unknowns = la::n_owned(increment);
    std::copy(system.force.begin(), system.force.end(), la::data(right));
    for (std::size_t k = 0; k < system.row.size(); ++k)
    {
      system.coupling.add_transposed(
          k, system.augmentation[k] * system.right[k], la::data(right));
      la::data(right)[n_unknowns + k] = system.right[k];
    }

    DirectSolver(matrix).solve(solution, right);
    const double *values = la::data(solution);
    std::copy(values, values + n_unknowns, la::data(increment));
    multiplier.assign(values + n_unknowns,
                      values + n_unknowns + system.row.size());
  }

  void SaddlePoint::recover(const abut_request &request, const System &system,
                            const std::vector<double> &multiplier,
                            const la::Vector &increment) const
  {
    const dealii::IndexSet owned = stiffness_->locally_owned_range_indices();
    const double *du = la::data(increment);
    for (int i = 0; i < rows_.n_rows; ++i)
    {
      request.gap_change[i] = 0.;
      for (auto e = rows_.row_start[i]; e < rows_.row_start[i + 1]; ++e)
        request.gap_change[i] +=
            rows_.coefficient[e] * du[owned.index_within_set(rows_.column[e])];
      if (request.d_pressure[i] != 0.)
        request.pressure_change[i] =
            -(request.residual[i] + request.d_gap[i] * request.gap_change[i])
            / request.d_pressure[i];
    }
    for (std::size_t k = 0; k < system.row.size(); ++k)
      request.pressure_change[system.row[k]] = multiplier[k];
  }

  LinearReport SaddlePoint::solve(const la::Vector &residual,
                                  const abut_request &request,
                                  const double smallest_residual,
                                  la::Vector &increment)
  {
    System system = assemble(residual, request);
    std::vector<double> multiplier;
    LinearReport report;
    const dealii::Timer timer;
    if (leading_.is_direct() && system.n_constraints > 0)
    {
      solve_directly(system, increment, multiplier);
      report.n_setups = 1;
      report.setup_seconds = timer.wall_time();
    }
    else
    {
      double tolerance =
          request.linear_tolerance * leading_.load(system.added, system.force);
      tolerance = std::max(tolerance, smallest_residual);
      if (system.n_constraints > 0)
      {
        report = leading_.prepare(system.augmented);
        report.n_iterations =
            solve_iteratively(system, tolerance, increment, multiplier);
        report.n_matvecs = report.n_iterations;
      }
      else
      {
        increment = 0.;
        report = leading_.solve(system.added, system.force, tolerance,
                                increment, true);
      }
      report.solve_seconds = timer.wall_time() - report.setup_seconds;
    }
    recover(request, system, multiplier, increment);
    return report;
  }
} // namespace abut::solve

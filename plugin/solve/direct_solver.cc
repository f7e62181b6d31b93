// SPDX-License-Identifier: LGPL-2.1-or-later
#include "direct_solver.h"

#include <abut/dealii/coded.h>

namespace abut::solve
{
  namespace
  {
    /** MUMPS: room beyond its estimate, in percent of it, tried one after the
     * other. The estimate does not include pivoting. */
    constexpr int extra_room[] = {100, 1000, 10000};

    void check(const std::string &failure)
    {
      if (!failure.empty())
        throw SolverFailure(
            coded(ABUT_FAILURE_LINEAR_SOLVER,
                  "The direct solver failed (" + failure
                      + "): too little memory, or a singular matrix, such as "
                        "of a body without supports. Try Solver/Linear solver "
                        "= iterative."));
    }
  } // namespace

  bool takes_mumps(const la::Matrix &matrix)
  {
    // For displacements in space both take as long then, in the plane later.
    constexpr dealii::types::global_dof_index small = 3000;
    return has_mumps()
           && (matrix.m() > small
               || dealii::Utilities::MPI::n_mpi_processes(
                      matrix.get_mpi_communicator())
                      > 1);
  }

  std::string DirectSolver::name(const la::Matrix &matrix)
  {
    return takes_mumps(matrix) ? "direct (MUMPS)" : "direct (KLU)";
  }

  DirectSolver::DirectSolver(const la::Matrix &matrix)
      : factors_(make_factors(matrix)), takes_mumps_(takes_mumps(matrix))
  {
    factorise();
  }

  void DirectSolver::factorise()
  {
    std::string failure;
    for (const int room : extra_room)
    {
      failure = factors_->factorise(room);
      if (failure.empty() || !takes_mumps_)
        break;
    }
    check(failure);
  }

  void DirectSolver::renew()
  {
    if (!factors_->refactorise().empty())
      factorise();
  }

  void FactorisedMatrix::factorise()
  {
    // Without factors if the matrix fails.
    std::unique_ptr<DirectSolver> factors = std::move(factors_);
    if (factors != nullptr && pattern_ == matrix.pattern())
      factors->renew();
    else
    {
      factors.reset();
      factors = std::make_unique<DirectSolver>(matrix.matrix());
      pattern_ = matrix.pattern();
    }
    factors_ = std::move(factors);
  }

  void DirectSolver::solve(la::Vector &x, const la::Vector &b) const
  {
    check(factors_->solve(x, b));
  }
} // namespace abut::solve

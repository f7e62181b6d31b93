// SPDX-License-Identifier: LGPL-2.1-or-later
#include "direct_solver.h"

#include <abut/dealii/coded.h>

#include <Amesos.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

namespace abut::solve
{
  namespace
  {
    /** MUMPS: room beyond its estimate, in percent of it, tried one after the
     * other. The estimate knows nothing of pivoting. */
    constexpr int extra_room[] = {100, 1000, 10000};

    [[noreturn]] void throw_failure(const int status)
    {
      throw SolverFailure(coded(
          ABUT_FAILURE_LINEAR_SOLVER,
          "The direct solver failed (Amesos status " + std::to_string(status)
              + "): there is too little memory, or the matrix is singular, as "
                "where nothing holds a body. Try Solver/Linear solver = "
                "iterative."));
    }
  } // namespace

  std::string DirectSolver::name()
  {
    return Amesos().Query("Amesos_Mumps") ? "direct (MUMPS)" : "direct (KLU)";
  }

  DirectSolver::DirectSolver(const la::Matrix &matrix)
      : stand_in_(std::make_unique<Epetra_CrsMatrix>(
          Copy, Epetra_Map(0, 0, matrix.trilinos_matrix().Comm()), 0)),
        problem_(std::make_unique<Epetra_LinearProblem>())
  {
    // Amesos does not change the matrix, but has no const.
    problem_->SetOperator(
        const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
    Amesos factory;
    const bool mumps = factory.Query("Amesos_Mumps");
    solver_.reset(
        factory.Create(mumps ? "Amesos_Mumps" : "Amesos_Klu", *problem_));
    int status = solver_ == nullptr ? -1 : 0;
    for (const int room : extra_room)
    {
      if (solver_ == nullptr)
        break;
      Teuchos::ParameterList parameters;
      parameters.sublist("mumps").set("ICNTL(14)", room);
      solver_->SetParameters(parameters);
      status = solver_->SymbolicFactorization();
      if (status == 0)
        status = solver_->NumericFactorization();
      if (status == 0 || !mumps)
        break;
    }
    if (status != 0)
      throw_failure(status);
  }

  DirectSolver::~DirectSolver()
  {
    // The destructor of Amesos' MUMPS asks the matrix for its communicator.
    problem_->SetOperator(stand_in_.get());
  }

  void DirectSolver::solve(la::Vector &x, const la::Vector &b) const
  {
    problem_->SetLHS(&x.trilinos_vector());
    problem_->SetRHS(const_cast<Epetra_MultiVector *>(&b.trilinos_vector()));
    const int status = solver_->Solve();
    if (status != 0)
      throw_failure(status);
  }
} // namespace abut::solve

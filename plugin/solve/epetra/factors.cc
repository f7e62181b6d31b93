// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solve/factors.h"

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
    std::string reason(const int status)
    {
      return status == 0 ? std::string()
                         : "Amesos status " + std::to_string(status);
    }

    class AmesosFactors : public Factors
    {
    public:
      explicit AmesosFactors(const la::Matrix &matrix)
          : stand_in_(Copy, Epetra_Map(0, 0, matrix.trilinos_matrix().Comm()),
                      0)
      {
        // Amesos does not change the matrix, but has no const.
        problem_.SetOperator(
            const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
        solver_.reset(Amesos().Create(
            takes_mumps(matrix) ? "Amesos_Mumps" : "Amesos_Klu", problem_));
      }

      ~AmesosFactors() override
      {
        // The destructor of Amesos' MUMPS reads the communicator of the matrix.
        problem_.SetOperator(&stand_in_);
      }

      std::string factorise(const int room) override
      {
        if (solver_ == nullptr)
          return reason(-1);
        Teuchos::ParameterList parameters;
        parameters.sublist("mumps").set("ICNTL(14)", room);
        solver_->SetParameters(parameters);
        const int status = solver_->SymbolicFactorization();
        return reason(status == 0 ? solver_->NumericFactorization() : status);
      }

      std::string refactorise() override
      {
        return reason(solver_->NumericFactorization());
      }

      std::string solve(la::Vector &x, const la::Vector &b) override
      {
        problem_.SetLHS(&x.trilinos_vector());
        problem_.SetRHS(const_cast<Epetra_MultiVector *>(&b.trilinos_vector()));
        return reason(solver_->Solve());
      }

    private:
      Epetra_CrsMatrix stand_in_; ///< for the matrix when that may be gone
      Epetra_LinearProblem problem_;
      std::unique_ptr<Amesos_BaseSolver> solver_;
    };
  } // namespace

  bool has_mumps()
  {
    return Amesos().Query("Amesos_Mumps");
  }

  std::unique_ptr<Factors> make_factors(const la::Matrix &matrix)
  {
    return std::make_unique<AmesosFactors>(matrix);
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solve/factors.h"
#include "types.h"

DEAL_II_DISABLE_EXTRA_DIAGNOSTICS
#include <Amesos2.hpp>
DEAL_II_ENABLE_EXTRA_DIAGNOSTICS

#include <exception>

namespace abut::solve
{
  namespace
  {
    /** First line of what a package threw, by @p action; empty: nothing. */
    template <typename Action> std::string reason(const Action &action)
    {
      try
      {
        action();
        return {};
      }
      catch (const std::exception &failure)
      {
        const std::string text = failure.what();
        const auto begin = text.find("Error");
        return "Amesos2: "
               + text.substr(begin == std::string::npos ? 0 : begin, 200);
      }
    }

    class Amesos2Factors : public Factors
    {
    public:
      explicit Amesos2Factors(const la::Matrix &matrix)
          : solver_(Amesos2::create<tpetra::Matrix, tpetra::Vectors>(
              takes_mumps(matrix) ? "MUMPS" : "KLU2", matrix.trilinos_rcp())),
            takes_mumps_(takes_mumps(matrix))
      {
      }

      std::string factorise(const int room) override
      {
        return reason(
            [&]
            {
              const auto parameters =
                  Teuchos::rcp(new Teuchos::ParameterList("Amesos2"));
              if (takes_mumps_)
                parameters->sublist("MUMPS").set("ICNTL(14)", room);
              solver_->setParameters(parameters);
              solver_->symbolicFactorization();
              solver_->numericFactorization();
            });
      }

      std::string refactorise() override
      {
        return reason([&] { solver_->numericFactorization(); });
      }

      std::string solve(la::Vector &x, const la::Vector &b) override
      {
        return reason(
            [&]
            {
              solver_->setX(x.trilinos_rcp());
              solver_->setB(b.trilinos_rcp());
              solver_->solve();
            });
      }

    private:
      Teuchos::RCP<Amesos2::Solver<tpetra::Matrix, tpetra::Vectors>> solver_;
      bool takes_mumps_;
    };
  } // namespace

  bool has_mumps()
  {
    return Amesos2::query("MUMPS");
  }

  std::unique_ptr<Factors> make_factors(const la::Matrix &matrix)
  {
    return std::make_unique<Amesos2Factors>(matrix);
  }
} // namespace abut::solve

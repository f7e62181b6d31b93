// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solve/algebraic_multigrid.h"
#include "types.h"

DEAL_II_DISABLE_EXTRA_DIAGNOSTICS
#include <MueLu_CreateTpetraPreconditioner.hpp>
DEAL_II_ENABLE_EXTRA_DIAGNOSTICS
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace abut::solve
{
  namespace
  {
    using namespace tpetra;

    /** With the same sizes as ML's by deal.II. */
    Teuchos::ParameterList
    aggregation_parameters(const AggregationOptions &options)
    {
      Teuchos::ParameterList list;
      list.set("verbosity", "none");
      list.set("multigrid algorithm", "sa");
      list.set("aggregation: drop tol", options.threshold);
      list.set("smoother: type", "CHEBYSHEV");
      // With MueLu's ratio of 20 saddle points need a quarter more iterations.
      list.sublist("smoother: params")
          .set("chebyshev: degree", static_cast<int>(options.smoother_sweeps))
          .set("chebyshev: ratio eigenvalue", 10.);
      // Aggregates smaller than the near-null space have empty coarse rows.
      list.set("rap: fix zero diagonals", true);
      list.set("coarse: max size", 2000);
      list.set("coarse: type", "KLU2");
      if (options.keeps_aggregates)
        list.set("reuse: type", "tP");
      return list;
    }

    class MueLuMultigrid : public AlgebraicMultigrid
    {
    public:
      void build(const la::Matrix &matrix,
                 const AggregationOptions &options) override
      {
        // MueLu does not change the matrix, but has no const.
        matrix_ = Teuchos::rcp_const_cast<Matrix>(matrix.trilinos_rcp());
        Teuchos::ParameterList list = aggregation_parameters(options);
        if (options.n_modes > 0)
        {
          const auto modes = Teuchos::rcp(
              new Vectors(matrix_->getDomainMap(), options.n_modes));
          const std::size_t n = matrix_->getLocalNumRows();
          for (unsigned int mode = 0; mode < options.n_modes; ++mode)
            std::copy_n(options.modes.begin() + mode * n, n,
                        modes->getDataNonConst(mode).begin());
          list.sublist("user data").set("Nullspace", modes);
        }
        const Teuchos::RCP<Tpetra::Operator<Scalar, Local, Global, Node>>
            operation = matrix_;
        cycle_ = MueLu::CreateTpetraPreconditioner(operation, list);
      }

      void restrict() override
      {
        MueLu::ReuseTpetraPreconditioner(matrix_, *cycle_);
      }

      void vmult(la::Vector &dst, const la::Vector &src) const override
      {
        cycle_->apply(src.trilinos_vector(), dst.trilinos_vector());
      }

    private:
      Teuchos::RCP<Matrix> matrix_;
      Teuchos::RCP<MueLu::TpetraOperator<Scalar, Local, Global, Node>> cycle_;
    };
  } // namespace

  std::unique_ptr<AlgebraicMultigrid> make_algebraic_multigrid()
  {
    return std::make_unique<MueLuMultigrid>();
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solve/algebraic_multigrid.h"

#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

namespace abut::solve
{
  namespace
  {
    class Ml : public AlgebraicMultigrid
    {
    public:
      void build(const la::Matrix &matrix,
                 const AggregationOptions &options) override
      {
        dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
        data.elliptic = true;
        data.aggregation_threshold = options.threshold;
        data.smoother_sweeps = options.smoother_sweeps;
        Teuchos::ParameterList list;
        std::unique_ptr<Epetra_MultiVector> constants;
        data.set_parameters(list, constants, matrix);
        modes_ = options.modes;
        if (options.n_modes > 0)
        {
          list.set("null space: type", "pre-computed");
          list.set("null space: dimension", static_cast<int>(options.n_modes));
          list.set("null space: vectors", modes_.data());
        }
        if (options.keeps_aggregates)
          list.set("reuse: enable", true);
        amg_.initialize(matrix, list);
      }

      void restrict() override
      {
        amg_.reinit();
      }

      void vmult(la::Vector &dst, const la::Vector &src) const override
      {
        amg_.vmult(dst, src);
      }

    private:
      std::vector<double> modes_;
      dealii::TrilinosWrappers::PreconditionAMG amg_;
    };
  } // namespace

  std::unique_ptr<AlgebraicMultigrid> make_algebraic_multigrid()
  {
    return std::make_unique<Ml>();
  }
} // namespace abut::solve

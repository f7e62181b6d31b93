// SPDX-License-Identifier: LGPL-2.1-or-later
#include "multigrid.h"

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

namespace abut::solve
{
  using dealii::TrilinosWrappers::PreconditionAMG;

  std::unique_ptr<PreconditionAMG>
  make_multigrid(const la::Matrix &matrix, const SolverParameters &parameters,
                 const NearNullSpace &space)
  {
    PreconditionAMG::AdditionalData data;
    data.elliptic = true;
    data.aggregation_threshold = parameters.aggregation_threshold;
    data.smoother_sweeps = parameters.smoother_sweeps;
    auto multigrid = std::make_unique<PreconditionAMG>();
    if (space.n_components == 1)
    {
      multigrid->initialize(matrix, data);
      return multigrid;
    }

    // All components of neighbouring nodes are coupled about as strongly, and
    // aggregates of single unknowns need a third fewer iterations than those
    // of whole nodes.
    data.aggregation_threshold = 0.;
    const std::size_t n = space.component.size();
    data.constant_modes.assign(space.n_components, std::vector<bool>(n, false));
    for (std::size_t i = 0; i < n; ++i)
      data.constant_modes[space.component[i]][i] = true;
    Teuchos::ParameterList list;
    std::unique_ptr<Epetra_MultiVector> modes;
    data.set_parameters(list, modes, matrix);
    multigrid->initialize(matrix, list);
    return multigrid;
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "multigrid.h"

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

namespace abut::solve
{
  using dealii::TrilinosWrappers::PreconditionAMG;

  namespace
  {
    /** Whether the unknowns of this rank come node by node, with all
     * components of one node in order: ML can then aggregate nodes. */
    bool is_by_nodes(const NearNullSpace &space)
    {
      const std::size_t n = space.component.size();
      for (std::size_t i = 0; i < n; ++i)
        if (space.component[i] != i % space.n_components)
          return false;
      return n % space.n_components == 0;
    }
  } // namespace

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

    const std::size_t n = space.component.size();
    data.constant_modes.assign(space.n_components, std::vector<bool>(n, false));
    for (std::size_t i = 0; i < n; ++i)
      data.constant_modes[space.component[i]][i] = true;
    Teuchos::ParameterList list;
    std::unique_ptr<Epetra_MultiVector> modes;
    data.set_parameters(list, modes, matrix);
    if (dealii::Utilities::MPI::min(is_by_nodes(space) ? 1 : 0,
                                    matrix.get_mpi_communicator())
        == 1)
      list.set("PDE equations", static_cast<int>(space.n_components));
    multigrid->initialize(matrix, list);
    return multigrid;
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometric_multigrid.h"

namespace abut::solve
{
  GeometricMultigrid::GeometricMultigrid(const la::Matrix &matrix,
                                         const MeshHierarchy &meshes)
  {
    abut_context *context = nullptr;
    AssertThrow(abut_context_create(nullptr, &context) == ABUT_SUCCESS,
                dealii::ExcMessage("no memory for multigrid"));
    context_.reset(context);
    std::vector<abut_multigrid_mesh> all;
    for (const MeshHierarchy::Mesh &mesh : meshes.meshes)
      all.push_back({mesh.n_nodes, mesh.fixed.data(),
                     mesh.start.empty() ? nullptr : mesh.start.data(),
                     mesh.parent.data(), mesh.weight.data()});
    const abut_multigrid_hierarchy hierarchy = {
        sizeof(hierarchy), static_cast<std::int32_t>(meshes.n_components),
        static_cast<std::int32_t>(all.size()), all.data(),
        meshes.unknown.data()};
    abut_multigrid *made = nullptr;
    check(abut_multigrid_create(context, &hierarchy, &made));
    multigrid_.reset(made);
    const la::LocalRows rows = la::local_rows(matrix);
    const abut_multigrid_matrix copied = {sizeof(copied), rows.n_rows,
                                          rows.start, rows.column, rows.value};
    check(abut_multigrid_set_matrix(made, &copied));
  }

  void GeometricMultigrid::check(const abut_status status) const
  {
    AssertThrow(status == ABUT_SUCCESS,
                dealii::ExcMessage(abut_context_message(context_.get())));
  }

  void GeometricMultigrid::hold(const std::vector<std::uint8_t> &held,
                                const std::vector<double> &added)
  {
    check(abut_multigrid_hold(multigrid_.get(),
                              held.empty() ? nullptr : held.data(),
                              added.empty() ? nullptr : added.data()));
  }

  void GeometricMultigrid::vmult(la::Vector &dst, const la::Vector &src) const
  {
    check(abut_multigrid_cycle(multigrid_.get(), la::data(src), la::data(dst)));
  }

  std::string why_not_geometric(const la::Matrix &matrix,
                                const NearNullSpace &space)
  {
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(matrix.get_mpi_communicator());
    if (n_ranks > 1)
      return "it works on one rank, here are " + std::to_string(n_ranks);
    if (space.meshes == nullptr)
      return "the coarser meshes are not known";
    if (space.meshes->missing.empty()
        && space.meshes->unknown.size() != matrix.m())
      return "there are unknowns beside those of the mesh";
    return space.meshes->missing;
  }

  std::string multigrid_name(const SolverParameters &parameters,
                             const std::string &missing)
  {
    if (parameters.linear != SolverParameters::Linear::geometric)
      return "ML";
    return missing.empty() ? "geometric multigrid"
                           : "ML (no geometric multigrid: " + missing + ")";
  }
} // namespace abut::solve

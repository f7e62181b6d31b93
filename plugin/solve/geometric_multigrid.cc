// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometric_multigrid.h"

#include <algorithm>

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
    set_matrix(matrix);
  }

  void GeometricMultigrid::set_matrix(const la::Matrix &matrix)
  {
    const la::LocalRows rows = la::local_rows(matrix);
    const abut_multigrid_matrix copied = {sizeof(copied), rows.n_rows,
                                          rows.start, rows.column, rows.value};
    check(abut_multigrid_set_matrix(multigrid_.get(), &copied));
  }

  void GeometricMultigrid::set_terms(const LocalMatrix &terms)
  {
    const abut_multigrid_matrix copied = {
        sizeof(copied), static_cast<std::int32_t>(terms.start.size()) - 1,
        terms.start.data(), terms.column.data(), terms.value.data()};
    check(abut_multigrid_set_terms(multigrid_.get(),
                                   terms.column.empty() ? nullptr : &copied));
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

  namespace
  {
    /** Digits per iteration that are too few: ML takes two to three times as
     * long for a cycle. */
    constexpr double slow = 0.1;

    /** Why a system cannot have it, as the end of a sentence; empty: it can.
     * Collective. */
    std::string why_not_geometric(const la::Matrix &matrix,
                                  const NearNullSpace &space)
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(
          matrix.get_mpi_communicator());
      if (n_ranks > 1)
        return "it works on one rank, here are " + std::to_string(n_ranks);
      if (space.meshes == nullptr)
        return "the coarser meshes are not known";
      if (space.meshes->missing.empty()
          && space.meshes->unknown.size() != matrix.m())
        return "there are unknowns beside those of the mesh";
      return space.meshes->missing;
    }
  } // namespace

  bool wants_meshes(const SolverParameters &parameters,
                    const unsigned long long n_unknowns,
                    const unsigned int n_components)
  {
    using Linear = SolverParameters::Linear;
    return parameters.linear == Linear::geometric
           || (parameters.linear == Linear::automatic
               && !parameters.is_direct(n_unknowns, n_components));
  }

  void MultigridChoice::choose(const la::Matrix &matrix,
                               const NearNullSpace &space, const bool is_faster)
  {
    is_wanted_ =
        wants_meshes(parameters_, matrix.m(), space.n_components)
        && (is_faster
            || parameters_.linear == SolverParameters::Linear::geometric);
    if (is_wanted_ && !is_given_up_)
      missing_ = why_not_geometric(matrix, space);
  }

  unsigned int MultigridChoice::patience(const double digits) const
  {
    const double most = 20. + std::max(digits, 0.) / slow;
    return std::min<double>(parameters_.max_iterations, most);
  }

  void MultigridChoice::give_up(const unsigned int n_iterations)
  {
    is_given_up_ = true;
    missing_ = "no solution after " + std::to_string(n_iterations)
               + " iterations with it";
  }

  std::string MultigridChoice::name() const
  {
    if (is_geometric())
      return "geometric multigrid";
    const bool was_asked =
        parameters_.linear == SolverParameters::Linear::geometric;
    return was_asked || is_given_up_
               ? "ML (no geometric multigrid: " + missing_ + ")"
               : "ML";
  }
} // namespace abut::solve

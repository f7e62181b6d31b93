// SPDX-License-Identifier: LGPL-2.1-or-later
#include "geometric_multigrid.h"
#include "kept_parts.h"

#include <algorithm>
#include <cstring>

namespace abut::solve
{
  namespace
  {
    /** Communication for the core; user data are the shared meshes. */
    void add_copies(void *user, const std::int32_t mesh,
                    const std::int32_t n_values, float *values)
    {
      static_cast<const SharedMeshes *>(user)->copies(mesh).add(n_values,
                                                                values);
    }

    void reduce(void *user, const abut_reduction operation, double *values,
                const std::int32_t n)
    {
      MPI_Allreduce(MPI_IN_PLACE, values, n, MPI_DOUBLE,
                    operation == ABUT_REDUCTION_SUM ? MPI_SUM : MPI_MAX,
                    static_cast<const SharedMeshes *>(user)->communicator());
    }

    /** A number of the entries of a matrix, another one if any differs but for
     * one case in 2^64. Four sums, which do not wait for each other. */
    std::uint64_t signature_of(const la::LocalRows &rows)
    {
      constexpr int n_sums = 4;
      constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ull;
      std::uint64_t sum[n_sums] = {1, 2, 3, 4};
      const auto mix = [&](const int s, const std::uint64_t word)
      { sum[s] = ((sum[s] ^ word) * factor) ^ (sum[s] >> 29); };
      const int n = rows.n_rows > 0 ? rows.start[rows.n_rows] : 0;
      const auto mix_entry = [&](const int s, const int k)
      {
        std::uint64_t word = 0;
        std::memcpy(&word, rows.value + k, sizeof(word));
        mix(s, word + factor * static_cast<std::uint64_t>(rows.column[k]));
      };
      int k = 0;
      for (; k + n_sums <= n; k += n_sums)
        for (int s = 0; s < n_sums; ++s)
          mix_entry(s, k + s);
      for (; k < n; ++k)
        mix_entry(0, k);
      for (int s = 1; s < n_sums; ++s)
        mix(0, sum[s]);
      mix(0, static_cast<std::uint64_t>(n));
      return sum[0];
    }

    /** Columns that other ranks own, in their order. */
    std::vector<GeometricMultigrid::Index> ghosts_of(const la::Matrix &matrix)
    {
      const la::LocalRows rows = la::local_rows(matrix);
      std::vector<GeometricMultigrid::Index> result;
      for (int k = rows.n_rows; k < rows.n_columns; ++k)
        result.push_back(la::global_column(matrix, k));
      return result;
    }

    /** The owned ones and the others of @p touched. */
    std::vector<GeometricMultigrid::Index>
    with_touched(const dealii::IndexSet &owned,
                 const std::vector<GeometricMultigrid::Index> &ghosts,
                 std::vector<GeometricMultigrid::Index> touched)
    {
      std::vector<GeometricMultigrid::Index> known = ghosts, result = ghosts;
      std::sort(known.begin(), known.end());
      std::sort(touched.begin(), touched.end());
      touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
      for (const GeometricMultigrid::Index unknown : touched)
        if (!owned.is_element(unknown)
            && !std::binary_search(known.begin(), known.end(), unknown))
          result.push_back(unknown);
      return result;
    }
  } // namespace

  GeometricMultigrid::GeometricMultigrid(const la::Matrix &matrix,
                                         const MeshHierarchy &meshes,
                                         const std::vector<Index> &touched)
  {
    abut_context *context = nullptr;
    AssertThrow(abut_context_create(nullptr, &context) == ABUT_SUCCESS,
                dealii::ExcMessage("no memory for multigrid"));
    context_.reset(context);
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      create(meshes);
    else
    {
      const dealii::IndexSet owned = la::owned_rows(matrix);
      ghosts_ = ghosts_of(matrix);
      shared_ = std::make_unique<SharedMeshes>(
          meshes, owned, with_touched(owned, ghosts_, touched), communicator);
      create(shared_->local());
      shared_->forget_weights();
    }
    set_matrix(matrix);
  }

  void GeometricMultigrid::create(const MeshHierarchy &meshes)
  {
    std::vector<abut_multigrid_mesh> all;
    for (const MeshHierarchy::Mesh &mesh : meshes.meshes)
      all.push_back({mesh.n_nodes, mesh.fixed.data(),
                     mesh.start.empty() ? nullptr : mesh.start.data(),
                     mesh.parent.data(), mesh.weight.data()});
    std::vector<std::int32_t> first_own, n_own;
    for (int l = 0; shared_ != nullptr && l < shared_->n_meshes(); ++l)
    {
      first_own.push_back(shared_->copies(l).first_own());
      n_own.push_back(shared_->copies(l).n_own());
    }
    const abut_multigrid_ranks ranks = {first_own.data(), n_own.data(),
                                        add_copies, reduce, shared_.get()};
    const abut_multigrid_hierarchy hierarchy = {
        sizeof(hierarchy),
        static_cast<std::int32_t>(meshes.n_components),
        static_cast<std::int32_t>(all.size()),
        all.data(),
        meshes.unknown.data(),
        shared_ == nullptr ? nullptr : &ranks};
    abut_multigrid *made = nullptr;
    const abut_status status =
        abut_multigrid_create(context_.get(), &hierarchy, &made);
    multigrid_.reset(made);
    n_rows_ = static_cast<std::int32_t>(meshes.unknown.size());
    check(status);
  }

  bool GeometricMultigrid::knows(const la::Matrix &matrix,
                                 const std::vector<Index> &touched) const
  {
    return shared_ == nullptr
           || (ghosts_of(matrix) == ghosts_
               && std::all_of(touched.begin(), touched.end(),
                              [&](const Index unknown)
                              { return shared_->row(unknown) >= 0; }));
  }

  void GeometricMultigrid::set_matrix(const la::Matrix &matrix)
  {
    const la::LocalRows rows = la::local_rows(matrix);
    const abut_multigrid_matrix copied = {sizeof(copied), rows.n_rows,
                                          rows.start, rows.column, rows.value};
    signature_ = signature_of(rows);
    check(abut_multigrid_set_matrix(multigrid_.get(), &copied));
  }

  void GeometricMultigrid::renew_matrix(const la::Matrix &matrix)
  {
    const bool is_new = signature_of(la::local_rows(matrix)) != signature_;
    if (dealii::Utilities::MPI::logical_or(is_new,
                                           matrix.get_mpi_communicator()))
      set_matrix(matrix);
  }

  void GeometricMultigrid::set_terms(LocalMatrix &terms)
  {
    if (shared_ == nullptr)
      terms.close(n_rows_, [](const Index unknown) { return unknown; });
    else
      terms.close(n_rows_, [&](const Index unknown)
                  { return static_cast<Index>(shared_->row(unknown)); });
    const abut_multigrid_matrix copied = {
        sizeof(copied), n_rows_, terms.start.data(), terms.column.data(),
        terms.value.data()};
    check(abut_multigrid_set_terms(multigrid_.get(),
                                   terms.column.empty() ? nullptr : &copied));
  }

  void GeometricMultigrid::check(const abut_status status) const
  {
    const bool failed = status != ABUT_SUCCESS;
    const bool fails = shared_ == nullptr ? failed
                                          : dealii::Utilities::MPI::logical_or(
                                              failed, shared_->communicator());
    AssertThrow(!fails,
                dealii::ExcMessage(
                    failed ? abut_context_message(context_.get())
                           : "geometric multigrid failed on another rank"));
  }

  void
  GeometricMultigrid::set_constrained(const std::vector<std::uint8_t> &held,
                                      const std::vector<double> &added)
  {
    check(abut_multigrid_set_constrained(
        multigrid_.get(), held.empty() ? nullptr : held.data(),
        added.empty() ? nullptr : added.data()));
  }

  void GeometricMultigrid::vmult(la::Vector &dst, const la::Vector &src) const
  {
    const abut_status status =
        abut_multigrid_cycle(multigrid_.get(), la::data(src), la::data(dst));
    AssertThrow(status == ABUT_SUCCESS,
                dealii::ExcMessage(abut_context_message(context_.get())));
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
      if (space.meshes == nullptr)
        return "there are no coarser meshes";
      const bool has_others =
          space.meshes->missing.empty()
          && space.meshes->unknown.size() != matrix.local_size();
      if (dealii::Utilities::MPI::logical_or(has_others,
                                             matrix.get_mpi_communicator()))
        return "there are unknowns besides those of the mesh";
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

  void SolverChoice::choose(const la::Matrix &matrix,
                            const NearNullSpace &space, const bool is_faster)
  {
    n_unknowns_ = matrix.m();
    n_components_ = space.n_components;
    kept_ = space.kept;
    is_wanted_ =
        wants_meshes(parameters_, n_unknowns_, n_components_)
        && (is_faster
            || parameters_.linear == SolverParameters::Linear::geometric);
    if (is_wanted_ && !is_given_up_)
      missing_ = why_not_geometric(matrix, space);
  }

  bool SolverChoice::is_direct() const
  {
    return parameters_.is_direct(n_unknowns_, n_components_)
           || (kept_ != nullptr && kept_->useless_iterations > 0);
  }

  unsigned int SolverChoice::patience(const double digits) const
  {
    if (!is_geometric())
      return parameters_.max_iterations;
    const double most = 20. + std::max(digits, 0.) / slow;
    return std::min<double>(parameters_.max_iterations, most);
  }

  bool SolverChoice::may_give_up() const
  {
    // Times the number that `auto` factorises at once: slow, but an answer.
    constexpr unsigned long long more = 10;
    return is_geometric()
           || (parameters_.linear == SolverParameters::Linear::automatic
               && parameters_.is_direct(n_unknowns_ / more, n_components_));
  }

  void SolverChoice::give_up(const unsigned int n_iterations)
  {
    if (!is_geometric())
    {
      kept_->useless_iterations = n_iterations;
      return;
    }
    is_given_up_ = true;
    missing_ = "no solution after " + std::to_string(n_iterations)
               + " iterations with it";
  }

  std::string SolverChoice::preconditioner() const
  {
    if (is_geometric())
      return "geometric multigrid";
    const bool was_asked =
        parameters_.linear == SolverParameters::Linear::geometric;
    return was_asked || is_given_up_
               ? "algebraic multigrid (no geometric multigrid: " + missing_
                     + ")"
               : "algebraic multigrid";
  }

  std::string SolverChoice::direct(const std::string &name) const
  {
    const unsigned int n = kept_->useless_iterations;
    return n == 0 ? name
                  : name + " (no solution after " + std::to_string(n)
                        + " iterations)";
  }
} // namespace abut::solve

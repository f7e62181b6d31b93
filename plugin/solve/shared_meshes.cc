// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared_meshes.h"

#include <algorithm>
#include <numeric>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    using Index = SharedMeshes::Index;

    void make_unique(std::vector<std::int32_t> &numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    }

    /** Numbers of the own nodes, and the others. */
    std::vector<std::int32_t> own_and(const MeshHierarchy::Mesh &mesh,
                                      std::vector<std::int32_t> others)
    {
      make_unique(others);
      std::vector<std::int32_t> own(mesh.n_nodes), result;
      std::iota(own.begin(), own.end(), mesh.first);
      std::set_union(own.begin(), own.end(), others.begin(), others.end(),
                     std::back_inserter(result));
      return result;
    }

    std::vector<std::int32_t> all_of(const MeshHierarchy::Mesh &mesh)
    {
      std::vector<std::int32_t> result(mesh.n_all);
      std::iota(result.begin(), result.end(), 0);
      return result;
    }

    std::vector<std::int32_t> first_of_rank(const MeshHierarchy::Mesh &mesh,
                                            const MPI_Comm communicator)
    {
      std::vector<std::int32_t> result =
          MPI::all_gather(communicator, mesh.first);
      result.push_back(mesh.n_all);
      return result;
    }

    Index begin_of(const dealii::IndexSet &owned)
    {
      return owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    }
  } // namespace

  SharedMeshes::SharedMeshes(const MeshHierarchy &meshes,
                             const dealii::IndexSet &owned,
                             const std::vector<Index> &ghosts,
                             const MPI_Comm communicator)
      : owned_(owned), communicator_(communicator)
  {
    const int n_components = static_cast<int>(meshes.n_components);
    local_.n_components = meshes.n_components;
    const Words place_of_ghost = places_of(meshes, ghosts);
    std::vector<std::int32_t> others;
    for (const std::uint64_t place : place_of_ghost)
      others.push_back(static_cast<std::int32_t>(place / n_components));
    const int n_meshes = static_cast<int>(meshes.meshes.size());
    for (int l = 0; l < n_meshes; ++l)
    {
      const MeshHierarchy::Mesh &own = meshes.meshes[l];
      if (l > 0)
        others = local_.meshes[l - 1].parent;
      add_mesh(meshes, l,
               l + 1 == n_meshes ? all_of(own)
                                 : own_and(own, std::move(others)));
    }
    number_rows(meshes, ghosts, place_of_ghost);
  }

  Words SharedMeshes::places_of(const MeshHierarchy &meshes,
                                const std::vector<Index> &ghosts) const
  {
    const std::uint64_t n_components = meshes.n_components;
    const Index begin = begin_of(owned_);
    std::vector<std::uint64_t> place(meshes.unknown.size());
    for (std::size_t u = 0; u < place.size(); ++u)
      place[meshes.unknown[u] - begin] =
          meshes.meshes[0].first * n_components + u;
    std::vector<Index> ends =
        MPI::all_gather(communicator_, Index(owned_.n_elements()));
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<std::size_t> order(ghosts.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](const std::size_t a, const std::size_t b)
              { return ghosts[a] < ghosts[b]; });
    WordMail questions;
    for (const std::size_t k : order)
      questions[std::upper_bound(ends.begin(), ends.end(), ghosts[k])
                - ends.begin()]
          .push_back(ghosts[k]);
    Words result(ghosts.size());
    auto next = order.begin();
    for (const auto &[rank, words] :
         ask_ranks(communicator_, questions,
                   [&](const Words &question)
                   {
                     Words answer;
                     for (const std::uint64_t unknown : question)
                       answer.push_back(place[unknown - begin]);
                     return answer;
                   }))
      for (const std::uint64_t word : words)
        result[*next++] = word;
    return result;
  }

  void SharedMeshes::copy_weights(const MeshHierarchy::Mesh &own,
                                  MeshHierarchy::Mesh &mesh) const
  {
    const NodeCopies &copies = copies_.back();
    const int n_components = static_cast<int>(local_.n_components);
    const auto describe = [&](const std::int32_t i, Words &words)
    {
      for (int c = 0; c < n_components; ++c)
        words.push_back(own.fixed[i * n_components + c]);
      const bool has_parents = !own.start.empty();
      const std::int64_t first = has_parents ? own.start[i] : 0;
      const std::int64_t end = has_parents ? own.start[i + 1] : 0;
      words.push_back(end - first);
      for (std::int64_t e = first; e < end; ++e)
      {
        words.push_back(own.parent[e]);
        words.push_back(to_word(own.weight[e]));
      }
    };
    const Words of_copies = copies.of_copies(describe);
    auto next = of_copies.begin();
    Words here;
    if (!own.start.empty())
      mesh.start = {0};
    for (std::int32_t i = 0; i < mesh.n_nodes; ++i)
    {
      const bool is_own =
          i >= copies.first_own() && i < copies.first_own() + copies.n_own();
      here.clear();
      if (is_own)
        describe(i - copies.first_own(), here);
      auto word = is_own ? here.cbegin() : next;
      for (int c = 0; c < n_components; ++c)
        mesh.fixed.push_back(static_cast<std::uint8_t>(*word++));
      for (std::uint64_t n = *word++; n > 0; --n)
      {
        mesh.parent.push_back(static_cast<std::int32_t>(*word++));
        mesh.weight.push_back(to_value(*word++));
      }
      if (!own.start.empty())
        mesh.start.push_back(static_cast<std::int64_t>(mesh.parent.size()));
      if (!is_own)
        next = word;
    }
  }

  void SharedMeshes::add_mesh(const MeshHierarchy &meshes, const int l,
                              std::vector<std::int32_t> nodes)
  {
    const MeshHierarchy::Mesh &own = meshes.meshes[l];
    // Parents were numbers over all ranks so far.
    if (l > 0)
      for (std::int32_t &parent : local_.meshes[l - 1].parent)
        parent = static_cast<std::int32_t>(
            std::lower_bound(nodes.begin(), nodes.end(), parent)
            - nodes.begin());
    MeshHierarchy::Mesh mesh;
    mesh.n_nodes = static_cast<std::int32_t>(nodes.size());
    mesh.n_all = own.n_all;
    copies_.emplace_back(std::move(nodes), first_of_rank(own, communicator_),
                         communicator_);
    copy_weights(own, mesh);
    local_.meshes.push_back(std::move(mesh));
  }

  void SharedMeshes::number_rows(const MeshHierarchy &meshes,
                                 const std::vector<Index> &ghosts,
                                 const Words &place_of_ghost)
  {
    const int n_components = static_cast<int>(local_.n_components);
    const NodeCopies &nodes = copies_[0];
    local_.unknown.assign(nodes.nodes().size() * n_components, -1);
    const Index begin = begin_of(owned_);
    for (std::size_t u = 0; u < meshes.unknown.size(); ++u)
      local_.unknown[std::size_t(nodes.first_own()) * n_components + u] =
          static_cast<std::int32_t>(meshes.unknown[u] - begin);
    int row = static_cast<int>(owned_.n_elements());
    for (std::size_t k = 0; k < ghosts.size(); ++k, ++row)
    {
      const auto number =
          static_cast<std::int32_t>(place_of_ghost[k] / n_components);
      local_.unknown[nodes.place(number) * n_components
                     + place_of_ghost[k] % n_components] = row;
      row_of_ghost_[ghosts[k]] = row;
    }
    for (std::int32_t &unknown : local_.unknown)
      if (unknown < 0)
        unknown = row++;
  }

  int SharedMeshes::row(const Index unknown) const
  {
    if (owned_.is_element(unknown))
      return static_cast<int>(unknown - begin_of(owned_));
    const auto found = row_of_ghost_.find(unknown);
    return found == row_of_ghost_.end() ? -1 : found->second;
  }
} // namespace abut::solve

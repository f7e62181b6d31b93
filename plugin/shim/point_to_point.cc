// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_to_point.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  std::vector<char> Parcel::bytes() const
  {
    const std::uint64_t n_words = words_.size();
    std::vector<char> result(sizeof(n_words) + 8 * words_.size()
                             + 8 * values_.size());
    char *place = result.data();
    const auto append = [&](const void *data, const std::size_t n)
    {
      if (n > 0)
        std::memcpy(place, data, n);
      place += n;
    };
    append(&n_words, sizeof(n_words));
    append(words_.data(), 8 * words_.size());
    append(values_.data(), 8 * values_.size());
    return result;
  }

  Parcel Parcel::from_bytes(const std::vector<char> &bytes)
  {
    Parcel parcel;
    std::uint64_t n_words = 0;
    std::memcpy(&n_words, bytes.data(), sizeof(n_words));
    parcel.words_.resize(n_words);
    parcel.values_.resize((bytes.size() - sizeof(n_words)) / 8 - n_words);
    const char *place = bytes.data() + sizeof(n_words);
    if (n_words > 0)
      std::memcpy(parcel.words_.data(), place, 8 * n_words);
    if (!parcel.values_.empty())
      std::memcpy(parcel.values_.data(), place + 8 * n_words,
                  8 * parcel.values_.size());
    return parcel;
  }

  PointToPoint::PointToPoint(const MPI_Comm communicator)
      : communicator_(communicator)
  {
  }

  Mail PointToPoint::exchange(const Mail &mail)
  {
    const unsigned int me = MPI::this_mpi_process(communicator_);
    std::map<unsigned int, std::vector<char>> out;
    Mail result;
    for (const auto &[rank, parcel] : mail)
      if (rank == me)
        result[me] = parcel;
      else
      {
        const auto &sent = out[rank] = parcel.bytes();
        count(1, sent.size());
      }
    for (const auto &[rank, bytes] : MPI::some_to_some(communicator_, out))
      result[rank] = Parcel::from_bytes(bytes);
    return result;
  }

  std::vector<double> PointToPoint::concatenate(const std::vector<double> &mine,
                                                std::vector<std::size_t> &start)
  {
    const int n_ranks = static_cast<int>(MPI::n_mpi_processes(communicator_));
    const int n = static_cast<int>(mine.size());
    std::vector<int> counts(n_ranks), starts(n_ranks + 1, 0);
    MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator_);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    std::vector<double> all(starts[n_ranks]);
    MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, all.data(), counts.data(),
                   starts.data(), MPI_DOUBLE, communicator_);
    start.assign(starts.begin(), starts.end());
    sent_.gathered_bytes += sizeof(double) * (all.size() - mine.size());
    return all;
  }

  Owners::Owners(const dealii::IndexSet &owned, const MPI_Comm communicator)
  {
    const auto all = MPI::all_gather(
        communicator,
        owned.n_elements() > 0
            ? std::make_pair(owned.nth_index_in_set(0), owned.n_elements())
            : std::make_pair(global_dof_index(0), global_dof_index(0)));
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      if (all[rank].second > 0)
        begin_.emplace_back(all[rank].first, rank);
    std::sort(begin_.begin(), begin_.end());
  }

  unsigned int Owners::of(const global_dof_index index) const
  {
    const auto next =
        std::upper_bound(begin_.begin(), begin_.end(), index,
                         [](const global_dof_index i, const auto &entry)
                         { return i < entry.first; });
    return std::prev(next)->second;
  }

  SharedValues::SharedValues(const dealii::IndexSet &owned,
                             std::vector<Index> indices, PointToPoint &post)
  {
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    dealii::IndexSet ghosts(owned.size());
    ghosts.add_indices(indices.begin(), indices.end());
    ghosts.subtract_set(owned);
    ghosts.compress();
    partitioner_ = std::make_shared<const MPI::Partitioner>(
        owned, ghosts, post.communicator());
    owned_.assign(partitioner_->locally_owned_size(), 0.);
    ghosts_.assign(partitioner_->n_ghost_indices(), 0.);
    // Send to owners which of their nodes are wanted.
    post.count(partitioner_->ghost_targets().size(),
               sizeof(Index) * partitioner_->n_ghost_indices());
  }

  void SharedValues::clear()
  {
    std::fill(owned_.begin(), owned_.end(), 0.);
    std::fill(ghosts_.begin(), ghosts_.end(), 0.);
  }

  double &SharedValues::operator()(const Index index)
  {
    const unsigned int n = partitioner_->locally_owned_size();
    const unsigned int place = partitioner_->global_to_local(index);
    return place < n ? owned_[place] : ghosts_[place - n];
  }

  void SharedValues::fetch(const double *owned, PointToPoint &post)
  {
    if (owned != owned_.data())
      std::copy(owned, owned + owned_.size(), owned_.begin());
    std::vector<double> room(partitioner_->n_import_indices());
    std::vector<MPI_Request> requests;
    partitioner_->export_to_ghosted_array_start<double>(
        0, dealii::ArrayView<const double>(owned_.data(), owned_.size()),
        dealii::make_array_view(room), dealii::make_array_view(ghosts_),
        requests);
    partitioner_->export_to_ghosted_array_finish<double>(
        dealii::make_array_view(ghosts_), requests);
    post.count(partitioner_->import_targets().size(),
               sizeof(double) * partitioner_->n_import_indices());
  }

  void SharedValues::add_to_owners(PointToPoint &post)
  {
    std::vector<double> room(partitioner_->n_import_indices());
    std::vector<MPI_Request> requests;
    partitioner_->import_from_ghosted_array_start<double>(
        dealii::VectorOperation::add, 0, dealii::make_array_view(ghosts_),
        dealii::make_array_view(room), requests);
    partitioner_->import_from_ghosted_array_finish<double>(
        dealii::VectorOperation::add,
        dealii::ArrayView<const double>(room.data(), room.size()),
        dealii::make_array_view(owned_), dealii::make_array_view(ghosts_),
        requests);
    post.count(partitioner_->ghost_targets().size(),
               sizeof(double) * partitioner_->n_ghost_indices());
  }
} // namespace abut::shim

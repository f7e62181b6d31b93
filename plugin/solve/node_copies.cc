// SPDX-License-Identifier: LGPL-2.1-or-later
#include "node_copies.h"

#include <algorithm>

namespace abut::solve
{
  namespace
  {
    constexpr int copies_tag = 9917;
  }

  NodeCopies::NodeCopies(std::vector<std::int32_t> nodes,
                         std::vector<std::int32_t> first_of_rank,
                         const MPI_Comm communicator)
      : communicator_(communicator), nodes_(std::move(nodes))
  {
    namespace MPI = dealii::Utilities::MPI;
    const unsigned int rank = MPI::this_mpi_process(communicator);
    first_number_ = first_of_rank[rank];
    first_own_ = place(first_number_);
    n_own_ = first_of_rank[rank + 1] - first_of_rank[rank];
    are_all_ = !MPI::logical_or(static_cast<std::int32_t>(nodes_.size())
                                    < first_of_rank.back(),
                                communicator);
    find_owners(first_of_rank);
    find_borrowers();
  }

  std::int32_t NodeCopies::place(const std::int32_t number) const
  {
    return static_cast<std::int32_t>(
        std::lower_bound(nodes_.begin(), nodes_.end(), number)
        - nodes_.begin());
  }

  void NodeCopies::find_owners(const std::vector<std::int32_t> &first_of_rank)
  {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(nodes_.size()); ++i)
    {
      if (i >= first_own_ && i < first_own_ + n_own_)
        continue;
      const auto after = std::upper_bound(first_of_rank.begin(),
                                          first_of_rank.end(), nodes_[i]);
      const auto rank =
          static_cast<unsigned int>(after - first_of_rank.begin() - 1);
      if (owners_.empty() || owners_.back().rank != rank)
        owners_.push_back({rank, {}, {}});
      owners_.back().place.push_back(i);
    }
  }

  WordMail NodeCopies::questions() const
  {
    WordMail result;
    for (const Share &share : owners_)
      for (const std::int32_t i : share.place)
        result[share.rank].push_back(static_cast<std::uint64_t>(nodes_[i]));
    return result;
  }

  void NodeCopies::find_borrowers()
  {
    for (const auto &[rank, numbers] : exchange(communicator_, questions()))
    {
      borrowers_.push_back({rank, {}, {}});
      for (const std::uint64_t number : numbers)
        borrowers_.back().place.push_back(
            place(static_cast<std::int32_t>(number)));
    }
  }

  void NodeCopies::pack(const Share &share, const int n_values,
                        const float *const values)
  {
    float *to = share.values.data();
    for (const std::int32_t i : share.place)
      to = std::copy_n(values + std::ptrdiff_t(i) * n_values, n_values, to);
  }

  /** Send the values in shares to their ranks, and receive those of others. */
  void NodeCopies::transfer(const std::vector<Share> &from,
                            const std::vector<Share> &to,
                            const int n_values) const
  {
    requests_.clear();
    for (const Share &share : to)
    {
      share.values.resize(share.place.size() * n_values);
      requests_.emplace_back();
      MPI_Irecv(share.values.data(), static_cast<int>(share.values.size()),
                MPI_FLOAT, static_cast<int>(share.rank), copies_tag,
                communicator_, &requests_.back());
    }
    for (const Share &share : from)
    {
      requests_.emplace_back();
      MPI_Isend(share.values.data(), static_cast<int>(share.values.size()),
                MPI_FLOAT, static_cast<int>(share.rank), copies_tag,
                communicator_, &requests_.back());
    }
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(),
                MPI_STATUSES_IGNORE);
  }

  void NodeCopies::add(const int n_values, float *const values) const
  {
    if (are_all_)
    {
      MPI_Allreduce(MPI_IN_PLACE, values,
                    static_cast<int>(nodes_.size()) * n_values, MPI_FLOAT,
                    MPI_SUM, communicator_);
      return;
    }
    for (const Share &share : owners_)
    {
      share.values.resize(share.place.size() * n_values);
      pack(share, n_values, values);
    }
    transfer(owners_, borrowers_, n_values);
    for (const Share &share : borrowers_)
    {
      const float *from = share.values.data();
      for (const std::int32_t i : share.place)
        for (int c = 0; c < n_values; ++c)
          values[std::ptrdiff_t(i) * n_values + c] += *from++;
    }
    for (const Share &share : borrowers_)
      pack(share, n_values, values);
    transfer(borrowers_, owners_, n_values);
    for (const Share &share : owners_)
    {
      const float *from = share.values.data();
      for (const std::int32_t i : share.place)
      {
        std::copy_n(from, n_values, values + std::ptrdiff_t(i) * n_values);
        from += n_values;
      }
    }
  }
} // namespace abut::solve

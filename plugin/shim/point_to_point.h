// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_POINT_TO_POINT_H
#define ABUT_SHIM_POINT_TO_POINT_H

#include <abut/dealii/communication_report.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace abut::shim
{
  /** A message from one rank to another: whole numbers and values, written and
   * read in the same order. */
  class Parcel
  {
  public:
    void write(std::int64_t word)
    {
      words_.push_back(word);
    }

    void write_value(double value)
    {
      values_.push_back(value);
    }

    std::int64_t read()
    {
      return words_[word_++];
    }

    double read_value()
    {
      return values_[value_++];
    }

    /** Whether all words have been read. */
    bool at_end() const
    {
      return word_ == words_.size();
    }

    /** As bytes for a process of the same kind of machine, and back. */
    std::vector<char> bytes() const;
    static Parcel from_bytes(const std::vector<char> &bytes);

  private:
    std::vector<std::int64_t> words_;
    std::vector<double> values_;
    std::size_t word_ = 0, value_ = 0;
  };

  /** Parcels by rank. */
  using Mail = std::map<unsigned int, Parcel>;

  /** Sends parcels between the ranks that have data for each other, and counts
   * the data that this rank sends. */
  class PointToPoint
  {
  public:
    explicit PointToPoint(MPI_Comm communicator);

    /** Send each parcel to its rank; returns those received by sender. A parcel
     * to this rank itself is handed over without being counted. Collective. */
    Mail exchange(const Mail &mail);

    /** All ranks' values one after the other, @p start [ranks + 1]. For a few
     * numbers per rank. Collective. */
    std::vector<double> concatenate(const std::vector<double> &mine,
                                    std::vector<std::size_t> &start);

    MPI_Comm communicator() const
    {
      return communicator_;
    }

    /** Count messages that were sent by other means. */
    void count(std::uint64_t messages, std::uint64_t bytes)
    {
      sent_.messages += messages;
      sent_.bytes += bytes;
    }

    /** Data that this rank has sent so far. */
    const CommunicationReport &sent() const
    {
      return sent_;
    }

  private:
    MPI_Comm communicator_;
    CommunicationReport sent_;
  };

  /** Which rank has an index, where each rank has a contiguous range.
   * Collective to construct; O(number of ranks) memory. */
  class Owners
  {
  public:
    Owners(const dealii::IndexSet &owned, MPI_Comm communicator);

    unsigned int of(dealii::types::global_dof_index index) const;

  private:
    std::vector<std::pair<dealii::types::global_dof_index, unsigned int>>
        begin_; ///< first index and rank, ascending, of ranks that have any
  };

  /** Values at indices of other ranks. */
  class SharedValues
  {
  public:
    using Index = dealii::types::global_dof_index;

    SharedValues() = default;

    /** @p indices in any order, owned ones and repetitions allowed.
     * Collective. */
    SharedValues(const dealii::IndexSet &owned, std::vector<Index> indices,
                 PointToPoint &post);

    /** Fetch the values of @p owned [owned indices] by their owners.
     * Collective. */
    void fetch(const double *owned, PointToPoint &post);

    /** Value of an index, or a place to put one for add_to_owners(). */
    double &operator()(Index index);

    /** Owned values, with those of other ranks added by add_to_owners(). */
    std::vector<double> &owned()
    {
      return owned_;
    }

    void clear();

    /** Add the values of all ranks up at their owners. Collective. */
    void add_to_owners(PointToPoint &post);

  private:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner_;
    std::vector<double> owned_, ghosts_;
  };
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_NODE_COPIES_H
#define ABUT_SOLVE_NODE_COPIES_H

#include "ask_ranks.h"

namespace abut::solve
{
  /** Nodes of one mesh by their numbers: those that a rank owns, a contiguous
   * range, and copies of nodes of other ranks. */
  class NodeCopies
  {
  public:
    /** Take nodes of this rank, ascending, its own among them, and the
     * numbers at which those of each rank begin, with their number at the end.
     * Collective. */
    NodeCopies(std::vector<std::int32_t> nodes,
               std::vector<std::int32_t> first_of_rank, MPI_Comm communicator);

    /** Nodes on this rank, ascending. */
    const std::vector<std::int32_t> &nodes() const
    {
      return nodes_;
    }

    /** Which of them is the first own one. */
    std::int32_t first_own() const
    {
      return first_own_;
    }

    std::int32_t n_own() const
    {
      return n_own_;
    }

    /** Which of the nodes has a number; it must be one of them. */
    std::int32_t place(std::int32_t number) const;

    /** Descriptions of copies by their owners, in the order of the nodes: @p
     * describe(own node, words) appends those of node number `own node` of this
     * rank. Collective. */
    template <typename Describe> Words of_copies(const Describe &describe) const
    {
      const WordMail answers = ask_ranks(
          communicator_, questions(),
          [&](const Words &question)
          {
            Words answer;
            for (const std::uint64_t number : question)
              describe(static_cast<std::int32_t>(number) - first_number_,
                       answer);
            return answer;
          });
      Words result;
      for (const auto &[rank, words] : answers)
        result.insert(result.end(), words.begin(), words.end());
      return result;
    }

    /** Replace @p values [nodes * n_values] by the sums over all copies of
     * each node, the same to the last bit at each. Collective. */
    void add(int n_values, float *values) const;

  private:
    /** Nodes of this rank that another one has, too. */
    struct Share
    {
      unsigned int rank;
      std::vector<std::int32_t> place;
      mutable std::vector<float> values; ///< on their way
    };

    WordMail questions() const;
    void find_owners(const std::vector<std::int32_t> &first_of_rank);
    void find_borrowers();
    static void pack(const Share &share, int n_values, const float *values);
    void transfer(const std::vector<Share> &from, const std::vector<Share> &to,
                  int n_values) const;

    MPI_Comm communicator_;
    std::vector<std::int32_t> nodes_;
    std::int32_t first_own_ = 0, n_own_ = 0, first_number_ = 0;
    bool are_all_ = false;         ///< each rank has all nodes
    std::vector<Share> owners_;    ///< of copies here, by rank
    std::vector<Share> borrowers_; ///< of own nodes, by rank
    mutable std::vector<MPI_Request> requests_;
  };
} // namespace abut::solve

#endif

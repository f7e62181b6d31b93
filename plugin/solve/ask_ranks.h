// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_ASK_RANKS_H
#define ABUT_SOLVE_ASK_RANKS_H

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace abut::solve
{
  /** Whole numbers, and bits of others, on their way to other ranks. */
  using Words = std::vector<std::uint64_t>;

  /** Words by the rank that they go to or come from; this one is welcome. */
  using WordMail = std::map<unsigned int, Words>;

  inline std::uint64_t to_word(const double value)
  {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof(word));
    return word;
  }

  inline double to_value(const std::uint64_t word)
  {
    double value;
    std::memcpy(&value, &word, sizeof(value));
    return value;
  }

  /** Send mail; returns what comes in. Collective. */
  inline WordMail exchange(const MPI_Comm communicator, WordMail mail)
  {
    namespace MPI = dealii::Utilities::MPI;
    const unsigned int me = MPI::this_mpi_process(communicator);
    const auto own = mail.extract(me);
    WordMail result = MPI::some_to_some(communicator, mail);
    if (own)
      result[me] = own.mapped();
    return result;
  }

  /** Answers of the ranks: @p answer(question) makes the Words for each
   * question. Collective. */
  template <typename Answer>
  WordMail ask_ranks(const MPI_Comm communicator, const WordMail &questions,
                     const Answer &answer)
  {
    WordMail answers;
    for (const auto &[rank, question] : exchange(communicator, questions))
      answers[rank] = answer(question);
    return exchange(communicator, answers);
  }
} // namespace abut::solve

#endif

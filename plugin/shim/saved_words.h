// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SAVED_WORDS_H
#define ABUT_SHIM_SAVED_WORDS_H

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace abut::shim
{
  /** Write words of rank 0 with their number and a sum. Not collective: other
   * ranks write nothing. */
  void save_words(std::ostream &stream, MPI_Comm communicator,
                  const std::vector<std::uint64_t> &words);

  /** Read what save_words() wrote, for all ranks. Throws HistoryError on all of
   * them; its message begins with @p what. Collective. */
  std::vector<std::uint64_t> load_words(std::istream &stream,
                                        MPI_Comm communicator,
                                        const std::string &what);
} // namespace abut::shim

#endif

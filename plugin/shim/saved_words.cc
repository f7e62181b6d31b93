// SPDX-License-Identifier: LGPL-2.1-or-later
#include "saved_words.h"

#include "agree.h"
#include "fnv_hash.h"

#include <abut/dealii/contact_assembler.h>

#include <istream>
#include <ostream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  void save_words(std::ostream &stream, const MPI_Comm communicator,
                  const std::vector<std::uint64_t> &words)
  {
    if (MPI::this_mpi_process(communicator) != 0)
      return;
    FnvHash sum;
    const auto write = [&](const std::uint64_t word)
    {
      sum.mix(word);
      stream.write(reinterpret_cast<const char *>(&word), sizeof(word));
    };
    write(words.size());
    for (const std::uint64_t word : words)
      write(word);
    write(sum.value);
  }

  std::vector<std::uint64_t> load_words(std::istream &stream,
                                        const MPI_Comm communicator,
                                        const std::string &what)
  {
    std::vector<std::uint64_t> words;
    run_everywhere<HistoryError>(
        communicator,
        [&]
        {
          if (MPI::this_mpi_process(communicator) != 0)
            return;
          FnvHash sum;
          const auto read = [&]
          {
            std::uint64_t word = 0;
            stream.read(reinterpret_cast<char *>(&word), sizeof(word));
            if (!stream.good())
              throw HistoryError(what + " are cut off.");
            return word;
          };
          const std::uint64_t n = read();
          sum.mix(n);
          for (std::uint64_t i = 0; i < n; ++i)
          {
            words.push_back(read());
            sum.mix(words.back());
          }
          if (read() != sum.value)
            throw HistoryError(what + " are damaged.");
        });
    return MPI::broadcast(communicator, words);
  }
} // namespace abut::shim

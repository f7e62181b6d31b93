// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_elements.h"

#include "saved_words.h"

#include <map>
#include <utility>
#include <vector>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  void ContactElements::compare(const Table &now, DetectionReport &report,
                                const MPI_Comm communicator) const
  {
    report.gained = report.lost = report.exchanged = 0;
    if (!is_known_)
      return;
    // Elements that are lost may have been on any rank: what is left of all
    // that were there.
    std::uint64_t counts[3] = {now.size(), 0, 0};
    for (const auto &[number, nodes] : now)
      if (const auto old = before_.find(number); old != before_.end())
      {
        ++counts[1];
        counts[2] += old->second != nodes;
      }
    MPI::sum(counts, communicator, counts);
    report.gained = counts[0] - counts[1];
    report.lost = n_before_ - counts[1];
    report.exchanged = counts[2];
  }

  void ContactElements::commit(Table now, const MPI_Comm communicator)
  {
    is_known_ = true;
    before_ = std::move(now);
    n_before_ = MPI::sum(std::uint64_t(before_.size()), communicator);
  }

  void ContactElements::save(std::ostream &stream,
                             const MPI_Comm communicator) const
  {
    const std::map<std::int64_t, std::uint64_t> mine(before_.begin(),
                                                     before_.end());
    const auto all = MPI::gather(communicator, mine);
    if (MPI::this_mpi_process(communicator) != 0)
      return;
    std::map<std::int64_t, std::uint64_t> together;
    for (const auto &some : all)
      together.insert(some.begin(), some.end());
    std::vector<std::uint64_t> words;
    if (is_known_)
      words.push_back(together.size());
    for (const auto &[number, nodes] : together)
    {
      words.push_back(static_cast<std::uint64_t>(number));
      words.push_back(nodes);
    }
    save_words(stream, communicator, words);
  }

  void ContactElements::load(std::istream &stream, const MPI_Comm communicator)
  {
    const std::vector<std::uint64_t> words =
        load_words(stream, communicator, "The elements of contact");
    forget();
    is_known_ = !words.empty();
    for (std::size_t i = 1; i + 1 < words.size(); i += 2)
      before_.emplace(static_cast<std::int64_t>(words[i]), words[i + 1]);
    n_before_ = before_.size();
  }
} // namespace abut::shim

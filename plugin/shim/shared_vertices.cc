// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shared_vertices.h"

#include <algorithm>

namespace abut::shim
{
  namespace
  {

    /** The end of MurmurHash3: each bit depends on all. */
    std::uint64_t mixed(std::uint64_t word)
    {
      word = (word ^ (word >> 33)) * 0xff51afd7ed558ccdull;
      word = (word ^ (word >> 33)) * 0xc4ceb9fe1a85ec53ull;
      return word ^ (word >> 33);
    }

    /** Makes names from those of parents, of which the order is not known. */
    class KeyMaker
    {
    public:
      explicit KeyMaker(const std::vector<VertexParents> &middle)
          : middle_(middle), made_(middle.size(), false), keys_(middle.size())
      {
      }

      std::vector<VertexKey> make()
      {
        for (unsigned int v = 0; v < keys_.size(); ++v)
          key(v);
        return std::move(keys_);
      }

    private:
      VertexKey key(const unsigned int v)
      {
        if (made_[v])
          return keys_[v];
        const VertexParents &parents = middle_[v];
        std::array<VertexKey, 8> of;
        for (unsigned int k = 0; k < parents.n; ++k)
          of[k] = key(parents.vertex[k]);
        std::sort(of.begin(), of.begin() + parents.n);
        const std::uint64_t own = parents.n == 0 ? v + 1 : parents.cell;
        VertexKey result = {{mixed(8 * own + 1), mixed(8 * own + 5)}};
        for (unsigned int k = 0; k < parents.n; ++k)
          for (unsigned int w = 0; w < 2; ++w)
            result[w] = mixed(result[w] + of[k][w]) + of[k][1 - w];
        made_[v] = true;
        return keys_[v] = result;
      }

      const std::vector<VertexParents> &middle_;
      std::vector<bool> made_;
      std::vector<VertexKey> keys_;
    };

    /** Data that this rank keeps for all. */
    class Directory
    {
    public:
      Directory(const solve::WordMail &mail, const unsigned int n_words)
          : n_words_(n_words)
      {
        for (const auto &[rank, words] : mail)
          for (auto word = words.begin(); word != words.end(); word += n_words_)
          {
            const VertexKey key = {{*word, *(word + 1)}};
            word += 2;
            places_.emplace_back(key, words_.size());
            words_.insert(words_.end(), word, word + n_words_);
          }
        std::sort(places_.begin(), places_.end());
      }

      void append(const VertexKey &key, solve::Words &answer) const
      {
        const auto found =
            std::lower_bound(places_.begin(), places_.end(),
                             std::make_pair(key, std::size_t(0)));
        if (found == places_.end() || found->first != key)
          answer.insert(answer.end(), n_words_, unknown_vertex);
        else
          answer.insert(answer.end(), words_.begin() + found->second,
                        words_.begin() + found->second + n_words_);
      }

    private:
      unsigned int n_words_;
      std::vector<std::pair<VertexKey, std::size_t>> places_;
      solve::Words words_;
    };
  } // namespace

  std::vector<VertexKey> vertex_keys(const std::vector<VertexParents> &middle)
  {
    return KeyMaker(middle).make();
  }

  solve::Words find_vertices(const MPI_Comm communicator,
                             const std::vector<VertexKey> &known,
                             const solve::Words &words,
                             const unsigned int n_words,
                             const std::vector<VertexKey> &wanted)
  {
    const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(communicator);
    solve::WordMail mail, questions;
    for (std::size_t k = 0; k < known.size(); ++k)
    {
      solve::Words &to = mail[known[k][0] % n_ranks];
      to.insert(to.end(), known[k].begin(), known[k].end());
      to.insert(to.end(), words.begin() + k * n_words,
                words.begin() + (k + 1) * n_words);
    }
    const Directory directory(solve::exchange(communicator, std::move(mail)),
                              n_words);
    for (const VertexKey &key : wanted)
    {
      solve::Words &to = questions[key[0] % n_ranks];
      to.insert(to.end(), key.begin(), key.end());
    }
    const solve::WordMail answers = solve::ask_ranks(
        communicator, questions,
        [&](const solve::Words &question)
        {
          solve::Words answer;
          for (std::size_t w = 0; w < question.size(); w += 2)
            directory.append({{question[w], question[w + 1]}}, answer);
          return answer;
        });
    solve::Words result;
    std::map<unsigned int, std::size_t> next;
    for (const VertexKey &key : wanted)
    {
      const unsigned int rank = key[0] % n_ranks;
      const auto from = answers.at(rank).begin() + next[rank];
      result.insert(result.end(), from, from + n_words);
      next[rank] += n_words;
    }
    return result;
  }
} // namespace abut::shim

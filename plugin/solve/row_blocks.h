// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_ROW_BLOCKS_H
#define ABUT_SOLVE_ROW_BLOCKS_H

#include <abut/strategy.h>

#include <cstdint>
#include <vector>

namespace abut::solve
{
  /** Which rows belong to one point, and where the numbers of its blocks
   * stand: points with friction have a normal and its tangents, all others one
   * row. Empty without friction. */
  struct RowBlocks
  {
    std::vector<int> first;       ///< [blocks + 1] row
    std::vector<std::int64_t> at; ///< [blocks + 1] first number of the block

    RowBlocks() = default;

    /** Blocks of a request; empty if it has none. */
    explicit RowBlocks(const abut_request &request)
    {
      if (request.block_size == nullptr)
        return;
      first.push_back(0);
      at.push_back(0);
      for (int i = 0; i < request.n_blocks; ++i)
      {
        const int k = request.block_size[i];
        first.push_back(first.back() + k);
        at.push_back(at.back() + k * k);
      }
    }

    bool empty() const
    {
      return first.empty();
    }

    int n_blocks() const
    {
      return static_cast<int>(first.size()) - 1;
    }

    /** Rows of a block. */
    int size(const int block) const
    {
      return first[block + 1] - first[block];
    }

    /** Numbers of all blocks. */
    std::int64_t n_numbers() const
    {
      return at.back();
    }
  };
} // namespace abut::solve

#endif

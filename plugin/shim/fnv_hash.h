// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_FNV_HASH_H
#define ABUT_SHIM_FNV_HASH_H

#include <cstdint>

namespace abut::shim
{
  /** A number that distinguishes sequences of words, the same on all ranks and
   * in all runs (FNV-1a of Fowler, Noll and Vo). */
  struct FnvHash
  {
    std::uint64_t value = 14695981039346656037u;

    void mix(const std::uint64_t word)
    {
      value = (value ^ word) * 1099511628211u;
    }
  };
} // namespace abut::shim

#endif

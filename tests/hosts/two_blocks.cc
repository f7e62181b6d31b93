// SPDX-License-Identifier: LGPL-2.1-or-later
#include "two_blocks_members.h"

namespace abut::hosts
{
  template class TwoBlocks<2>;
  template class TwoBlocks<3>;
} // namespace abut::hosts

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "kept_parts.h"

namespace abut::solve
{
  std::shared_ptr<KeptParts> make_kept_parts()
  {
    return std::make_shared<KeptParts>();
  }

  void forget_factors(KeptParts &kept)
  {
    kept.condensed.reset();
    ++kept.step;
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "kept_parts.h"

namespace abut::solve
{
  std::shared_ptr<KeptParts> make_kept_parts()
  {
    return std::make_shared<KeptParts>();
  }
} // namespace abut::solve

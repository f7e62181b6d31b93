// SPDX-License-Identifier: LGPL-2.1-or-later
/* The part that knows Abut by its headers only. */
#include <abut/dealii/load_plugin.h>

void
load(const std::string &path, abut::Registry<2> &registry)
{
  abut::load_plugin(path, registry);
}

// SPDX-License-Identifier: LGPL-2.1-or-later
/* The one symbol of the module abut_plugin. */
#include <abut/dealii/plugin_stamp.h>
#include <abut/dealii/registry.h>

extern "C" ABUT_API const abut_plugin *abut_plugin_query(void);

namespace
{
  // Constant data, without any constructor: load_plugin() reads it from the
  // file.
  constexpr abut_plugin_stamp stamp = abut::plugin_stamp();

  template <int dim> void register_methods(void *registry)
  {
    abut::register_all(*static_cast<abut::Registry<dim> *>(registry));
  }

  constexpr abut_plugin plugin = {sizeof(abut_plugin), &stamp,
                                  &register_methods<2>, &register_methods<3>};
} // namespace

const abut_plugin *
abut_plugin_query()
{
  return &plugin;
}

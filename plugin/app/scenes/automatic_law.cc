// SPDX-License-Identifier: LGPL-2.1-or-later
#include "automatic_law.h"

namespace abut::app
{
  namespace
  {
    // An active set that starts far from the solution moves by a layer of
    // nodes in each step, while the interior point takes ten steps on all
    // meshes: from here on they are fewer and cost less in all.
    constexpr double many_layers = 300.;
  } // namespace

  void choose_law_of_bodies(MethodParameters &method, const bool tied,
                            const bool large_strain)
  {
    if (method.law_is_automatic && !tied && method.discretisation
        && discretisation_info(*method.discretisation).row_per_point)
      method.options.law =
          abut_law_find(large_strain ? "augmented lagrangian" : "nitsche");
  }

  void choose_law_of_membrane(MethodParameters &method, const bool cold,
                              const double nodes_across)
  {
    if (method.law_is_automatic && cold && nodes_across > many_layers
        && method.system != System::saddle_point)
      method.options.law = abut_law_find("interior point");
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_DIAGNOSIS_H
#define ABUT_SHIM_PAIR_DIAGNOSIS_H

#include "surface_side.h"

#include <abut/dealii/contact_pair.h>

#include <string>

namespace abut::shim
{
  /** Run @p function; the core's message gets the name of the pair. */
  template <typename Function>
  void run_named(const std::string &pair, const Function &function)
  {
    try
    {
      function();
    }
    catch (const ContactError &)
    {
      throw;
    }
    catch (const std::exception &error)
    {
      throw ContactError(about_pair(pair, error.what()));
    }
  }

  /** Why two surfaces have no part in contact range: too far apart, deeper in
   * each other than the reach, or turned the wrong way; in words, with what to
   * do. Only facets known here count: they must be those up to the least
   * distance of the surfaces. Collective. */
  template <int dim>
  Message why_no_rows(abut_context *context, const SurfaceSide<dim> &secondary,
                      const SurfaceSide<dim> &primary,
                      const SearchParameters &search, double reach,
                      MPI_Comm communicator);
} // namespace abut::shim

#endif

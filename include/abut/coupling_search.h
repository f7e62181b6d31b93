/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_COUPLING_SEARCH_H
#define ABUT_COUPLING_SEARCH_H

/** @file
 * The search of a coupling by itself: who may touch whom, before points are
 * made of it.
 *
 * Between surfaces a coupling has a search over the primary (node to segment:
 * a detection, abut/detect.h). With abut_coupling_options.search.skin its lists
 * serve again as long as nothing has moved further than the bound of
 * abut_search_facets(); the pairs, and so the points, are the same to the last
 * bit.
 */

#include <abut/coupling.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Search at the current positions. The next abut_coupling_build() with the
   * same positions and motion takes what was found; else it searches itself.
   * Does nothing against an obstacle.
   * @param motion as in abut_coupling_build() */
  ABUT_API abut_status abut_coupling_search(abut_coupling *coupling,
                                            double motion);

  /** The search inside, for its statistics; NULL against an obstacle. */
  ABUT_API const abut_search *
  abut_coupling_searcher(const abut_coupling *coupling);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_REUSE_H
#define ABUT_SEARCH_REUSE_H

/* Lists with skin, and when they may serve again. */

#include "search/search.h"

/* A list that is too long by skin, with the positions that it was made at. */
typedef struct abut_skin_list
{
  abut_list list;
  const abut_search *search; /* that made it; NULL: none */
  const abut_surface *secondary;
  uint64_t serial; /* of the search */
  double skin;
  abut_reach reach;              /* without skin */
  bool facets;                   /* queries were facets, not nodes */
  abut_array primary_position;   /* double */
  abut_array secondary_position; /* double */
} abut_skin_list;

void abut_skin_list_prepare(abut_skin_list *list);
void abut_skin_list_release(abut_context *context, abut_skin_list *list);

/* Whether the list holds all pairs at the current positions. */
bool abut_skin_list_serves(const abut_skin_list *list,
                           const abut_search *search,
                           const abut_surface *secondary, bool facets);

/* Make the list again at the current positions. */
abut_status abut_skin_list_make(abut_skin_list *list, abut_search *search,
                                const abut_surface *secondary, bool facets);

/* Query for the nodes or facets of a surface. */
abut_status abut_search_query_of(abut_search *search,
                                 const abut_surface *secondary, bool facets,
                                 abut_query *query);

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_HISTORY_HISTORY_H
#define ABUT_HISTORY_HISTORY_H

/* The inside of a history: two sets of entries, and one to merge in. */

#include "base/memory.h"

#include <abut/history.h>

/* Entries in ascending order of their numbers. */
typedef struct abut_entry_set
{
  int64_t n;
  abut_array id;       /* int64_t */
  abut_array pressure; /* double */
  abut_array state;    /* uint8_t */
  abut_array place;    /* 3 doubles; unless has_places: none */
  int has_places;      /* points of nodes are found without */
  abut_history_problem problem;
} abut_entry_set;

struct abut_history
{
  abut_context *context;
  abut_entry_set committed, trial, spare;
};

/* Make room for n entries, keeping those that are there. */
abut_status abut_entry_set_reserve(abut_context *context, abut_entry_set *set,
                                   int64_t n);

/* Make room for the places of n entries, which are (0, 0, 0) until then. */
abut_status abut_entry_set_reserve_places(abut_context *context,
                                          abut_entry_set *set, int64_t n);

/* Make b what a is. */
abut_status abut_entry_set_copy(abut_context *context, const abut_entry_set *a,
                                abut_entry_set *b);

/* Append an entry; without places its own is not kept. There must be room. */
void abut_entry_set_append(abut_entry_set *set, int64_t id, double pressure,
                           uint8_t state, const double *place);

/* Whether numbers ascend and values are finite. */
abut_status abut_entries_check(abut_context *context, const char *call,
                               const abut_history_entries *entries);

#endif

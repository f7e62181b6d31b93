/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_RUNS_H
#define ABUT_SEARCH_RUNS_H

/* Ranges of records that buckets hand to a query. */

#include <stdint.h>

typedef struct abut_run
{
  int32_t first;
  int32_t last; /* one past the end */
} abut_run;

/* The owner makes room for as many runs as there are buckets. */
typedef struct abut_runs
{
  abut_run *run;
  int32_t n;
} abut_runs;

/* Append a run, or lengthen the last one. */
static inline void
abut_runs_add(abut_runs *runs, int32_t first, int32_t last)
{
  if (runs->n > 0 && runs->run[runs->n - 1].last == first)
  {
    runs->run[runs->n - 1].last = last;
    return;
  }
  runs->run[runs->n].first = first;
  runs->run[runs->n].last = last;
  ++runs->n;
}

#endif

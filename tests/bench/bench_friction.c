/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Random dense problems with friction: how many linear systems they take, how
 * many need which cure, how many have which number of answers. Prints the
 * tables of doc/develop/friction.md. */
#include "frictional.h"

#include <stdio.h>

typedef struct set
{
  const char *name;
  int32_t dimension;
  frictional_ranges ranges;
} set;

enum
{
  n_problems = 200
};

static const set sets[] = {
    {"plane", 2, {{.05, 1}, {3, 100}}},
    {"space", 3, {{.05, 1}, {3, 100}}},
    {"plane, harsh", 2, {{1, 4}, {10, 1000}}},
    {"space, harsh", 3, {{1, 4}, {10, 1000}}},
};

static void
print_row(const set *of, int32_t starts)
{
  const frictional_count c =
      frictional_survey(of->dimension, &of->ranges, n_problems, starts, 1);
  printf("| %s | %d | %.2f / %d | %d | %d | %d | %d | %d | %.0e |", of->name,
         c.n_runs, c.mean_steps, c.most_steps, c.cured[0], c.cured[1],
         c.cured[2], c.cured[3], c.n_lost, c.worst_violation);
  for (int k = 0; k <= 3; ++k)
    printf(" %d |", c.answers[k]);
  printf("\n");
}

int
main(void)
{
  for (int32_t starts = 0; starts <= FRICTIONAL_STARTS;
       starts += FRICTIONAL_STARTS)
  {
    printf("\n| set | runs | linear systems, mean / most | no cure "
           "| bound | quarters | tresca | not found "
           "| violation | 0 answers | 1 | 2 | 3 |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof(sets) / sizeof(sets[0]); ++i)
      print_row(&sets[i], starts);
  }
  return 0;
}

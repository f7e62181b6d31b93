/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Terms that are added to the matrix in few rows, such as by unknowns that
 * contact eliminates. The matrix itself stays, and with it its coarse rows
 * elsewhere. */
#include "multigrid/multigrid.h"

#include <string.h>

static const char call[] = "abut_multigrid_set_terms";

/* The terms there were are gone: their rows are others at the next hold. */
static void
forget(abut_multigrid *mg)
{
  const abut_node_terms *terms = &mg->level[0].terms;
  for (int32_t q = 0; q < terms->n && terms->row != NULL; ++q)
    mg->moved[terms->row[q]] = 1;
  abut_pool_release(&mg->terms);
  for (int32_t l = 0; l < mg->n_levels; ++l)
    memset(&mg->level[l].terms, 0, sizeof(abut_node_terms));
}

/* Number the nodes that have terms. */
static void
number(abut_multigrid *mg, const abut_multigrid_matrix *a,
       abut_node_terms *terms)
{
  const int32_t n = mg->level[0].n, b = mg->block;
  terms->at = abut_pool_allocate(&mg->terms, n, sizeof(int32_t));
  if (terms->at == NULL)
    return;
  for (int32_t i = 0; i < n; ++i)
  {
    bool any = false;
    for (int32_t c = 0; c < b; ++c)
    {
      const int32_t row = mg->unknown[i * b + c];
      any |= row < a->n && a->start[row + 1] > a->start[row];
    }
    terms->at[i] = any ? terms->n++ : -1;
  }
  terms->row = abut_pool_allocate(&mg->terms, terms->n, sizeof(int32_t));
  terms->diagonal = abut_pool_allocate(&mg->terms, terms->n, sizeof(int64_t));
  terms->rows.start =
      abut_pool_allocate(&mg->terms, (int64_t)terms->n + 1, sizeof(int64_t));
  for (int32_t i = 0; i < n && !mg->terms.failed; ++i)
    if (terms->at[i] >= 0)
    {
      terms->row[terms->at[i]] = i;
      mg->moved[i] = 1;
    }
}

static void
fill_row(abut_multigrid *mg, const abut_multigrid_matrix *a,
         const abut_host_numbers *host, int32_t q)
{
  abut_node_terms *terms = &mg->level[0].terms;
  const int64_t first = terms->rows.start[q];
  terms->diagonal[q] = -1;
  for (int64_t e = first; e < terms->rows.start[q + 1]; ++e)
  {
    mg->place[terms->rows.node[e]] = (int32_t)(e - first);
    if (terms->rows.node[e] == terms->row[q])
      terms->diagonal[q] = e;
  }
  abut_multigrid_add_row(mg, a, host, terms->row[q],
                         terms->rows.weight + first * mg->block * mg->block);
}

/* Blocks of the finest level. */
static void
fill(abut_multigrid *mg, const abut_multigrid_matrix *a,
     const abut_host_numbers *host)
{
  abut_node_terms *terms = &mg->level[0].terms;
  abut_node_rows *rows = &terms->rows;
  number(mg, a, terms);
  if (mg->terms.failed)
    return;
  abut_multigrid_clear_places(mg, mg->level[0].n);
  for (int32_t q = 0; q < terms->n; ++q)
    rows->start[q + 1] =
        rows->start[q]
        + abut_multigrid_collect(mg, a, host, terms->row[q], NULL);
  const int64_t n = rows->start[terms->n];
  rows->node = abut_pool_allocate(&mg->terms, n, sizeof(int32_t));
  rows->weight = abut_pool_allocate(&mg->terms, n * mg->block * mg->block + 1,
                                    sizeof(float));
  if (mg->terms.failed)
    return;
  abut_multigrid_clear_places(mg, mg->level[0].n);
  for (int32_t q = 0; q < terms->n; ++q)
    abut_multigrid_collect(mg, a, host, terms->row[q],
                           rows->node + rows->start[q]);
  for (int32_t q = 0; q < terms->n; ++q)
    fill_row(mg, a, host, q);
}

abut_status
abut_multigrid_set_terms(abut_multigrid *mg, const abut_multigrid_matrix *terms)
{
  if (mg == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_multigrid_matrix taken = {sizeof(taken), 0, NULL, NULL, NULL};
  if (terms != NULL)
  {
    abut_status status =
        abut_copy_in(mg->context, call, &taken, sizeof(taken), terms);
    if (status == ABUT_SUCCESS)
      status = abut_multigrid_check(mg, &taken, call);
    if (status != ABUT_SUCCESS)
      return status;
  }
  forget(mg);
  if (terms == NULL)
    return ABUT_SUCCESS;
  abut_pool work = {mg->context, {NULL, 0, 0}, 0, false};
  abut_host_numbers host;
  const bool numbered = abut_multigrid_number(mg, &work, &host);
  if (numbered)
    fill(mg, &taken, &host);
  for (int32_t l = 0; l + 1 < mg->n_levels && numbered && !mg->terms.failed;
       ++l)
    abut_terms_pattern(mg, l);
  abut_pool_release(&work);
  if (numbered && !mg->terms.failed)
    return ABUT_SUCCESS;
  forget(mg);
  return abut_fail(mg->context, ABUT_OUT_OF_MEMORY, call, "no memory");
}

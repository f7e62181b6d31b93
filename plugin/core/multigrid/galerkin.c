/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Coarse matrices P^T A P without what is held, row by row, so that only rows
 * near a change are computed again. A row is summed up from nothing in the same
 * order each time: computing it again gives the same to the last bit as
 * computing all. First come the rows of all children over columns of the fine
 * mesh, then these columns go to their parents: each is met once for each
 * parent, not once for each parent and child. */
#include "multigrid/multigrid.h"

#include <string.h>

/* Rows of a level: those of its matrix, or what is added to it in some. */
typedef struct row_set
{
  const abut_node_rows *rows;
  const int32_t *at; /* number of a node's row, -1: none; NULL: all have one */
  const int64_t *upper; /* as that of a level */
} row_set;

static row_set
matrix_of(const abut_multigrid_level *level)
{
  return (row_set){&level->matrix, NULL, level->upper};
}

static row_set
terms_of(const abut_multigrid_level *level)
{
  return (row_set){&level->terms.rows, level->terms.at, NULL};
}

ABUT_INLINE int32_t
row_of(const row_set *set, int32_t node)
{
  return set->at == NULL ? node : set->at[node];
}

/* The child that stands where its parent k does; -1: there is none, or it is
 * fixed and its row has the diagonal only. */
static int64_t
find_same(const abut_multigrid_level *fine, int32_t b, int32_t k)
{
  for (int64_t f = fine->children.start[k]; f < fine->children.start[k + 1];
       ++f)
    if (fine->children.weight[f] == 1
        && !fine->fixed[(int64_t)fine->children.node[f] * b])
      return f;
  return -1;
}

/* Make the list of the fine columns of coarse row k, or of the child in its
 * place alone if there is one; returns how many. */
static int32_t
list_columns(abut_multigrid *mg, const abut_multigrid_level *fine,
             const row_set *set, int32_t k, bool alone)
{
  const int64_t same = alone ? find_same(fine, mg->block, k) : -1;
  const int64_t first = same < 0 ? fine->children.start[k] : same;
  const int64_t end = same < 0 ? fine->children.start[k + 1] : same + 1;
  int32_t n = 0;
  for (int64_t f = first; f < end; ++f)
  {
    const int32_t q = row_of(set, fine->children.node[f]);
    for (int64_t e = q < 0 ? 0 : set->rows->start[q];
         q >= 0 && e < set->rows->start[q + 1]; ++e)
    {
      const int32_t j = set->rows->node[e];
      if (mg->fine_place[j] >= 0)
        continue;
      mg->fine_place[j] = n;
      mg->list[n++] = j;
    }
  }
  for (int32_t p = 0; p < n; ++p)
    mg->fine_place[mg->list[p]] = -1;
  return n;
}

/* Append their parents to the columns, of which there are n. */
static abut_status
append_parents(abut_multigrid *mg, const abut_multigrid_level *fine, int32_t k,
               int32_t n_fine, abut_array *columns, int64_t *n)
{
  for (int32_t p = 0; p < n_fine; ++p)
  {
    const int32_t j = mg->list[p];
    const int64_t most = fine->parents.start[j + 1] - fine->parents.start[j];
    if (abut_array_reserve(mg->context, columns, *n, *n + most) != ABUT_SUCCESS)
      return ABUT_OUT_OF_MEMORY;
    int32_t *column = columns->data;
    for (int64_t g = fine->parents.start[j]; g < fine->parents.start[j + 1];
         ++g)
    {
      if (mg->place[fine->parents.node[g]] == k)
        continue;
      mg->place[fine->parents.node[g]] = k;
      column[(*n)++] = fine->parents.node[g];
    }
  }
  return ABUT_SUCCESS;
}

/* No more fine columns than that has the row of coarse node k. */
static int64_t
most_columns(const abut_multigrid_level *fine, const row_set *set, int32_t k)
{
  int64_t n = 0;
  for (int64_t f = fine->children.start[k]; f < fine->children.start[k + 1];
       ++f)
  {
    const int32_t q = row_of(set, fine->children.node[f]);
    n += q < 0 ? 0 : set->rows->start[q + 1] - set->rows->start[q];
  }
  return n < fine->n ? n : fine->n;
}

/* Pattern of n rows of level l + 1 with numbers `row`, NULL: all; where their
 * diagonal blocks stand; work for abut_galerkin_rows(). */
static void
make_pattern(abut_multigrid *mg, int32_t l, const row_set *set, int32_t n,
             const int32_t *row, abut_pool *pool, abut_node_rows *rows,
             int64_t *diagonal, float **sum, bool alone)
{
  const abut_multigrid_level *fine = &mg->level[l];
  const int32_t size = mg->block * mg->block;
  abut_array columns = {NULL, 0, sizeof(int32_t)};
  int64_t n_columns = 0;
  int64_t most = 0;
  abut_status status = pool->failed ? ABUT_OUT_OF_MEMORY : ABUT_SUCCESS;
  abut_multigrid_clear_places(mg, mg->level[l + 1].n);
  for (int32_t q = 0; q < n && status == ABUT_SUCCESS; ++q)
  {
    const int32_t k = row == NULL ? q : row[q];
    const int32_t n_fine = list_columns(mg, fine, set, k, alone);
    const int64_t room = most_columns(fine, set, k);
    most = most > room ? most : room;
    status = append_parents(mg, fine, k, n_fine, &columns, &n_columns);
    if (mg->block == 1 && status == ABUT_SUCCESS)
      abut_row_in_order((int32_t *)columns.data + rows->start[q],
                        n_columns - rows->start[q], k, mg->list);
    rows->start[q + 1] = n_columns;
    diagonal[q] = -1;
    for (int64_t e = rows->start[q]; e < n_columns; ++e)
      if (((const int32_t *)columns.data)[e] == k)
        diagonal[q] = e;
  }
  pool->failed |= status != ABUT_SUCCESS;
  rows->node = abut_pool_allocate(pool, n_columns, sizeof(int32_t));
  rows->weight = abut_pool_allocate(pool, n_columns * size + 1, sizeof(float));
  *sum = abut_pool_allocate(pool, most * size, sizeof(float));
  if (!pool->failed && n_columns > 0)
    memcpy(rows->node, columns.data, (size_t)n_columns * sizeof(int32_t));
  abut_array_release(mg->context, &columns);
}

/* Where nodes are in the middle of their parents and nothing hangs, the child
 * that stands where its parent does has all columns that all children have: a
 * ninth of the work in the plane. That is no more than likely, and so
 * abut_galerkin_rows() looks. */
static bool
are_middles(const abut_multigrid_level *fine)
{
  const abut_node_rows *parents = &fine->parents;
  bool same = true;
  for (int32_t i = 0; i < fine->n; ++i)
    for (int64_t e = parents->start[i] + 1; e < parents->start[i + 1]; ++e)
      same &= parents->weight[e] == parents->weight[e - 1];
  return same;
}

void
abut_galerkin_pattern(abut_multigrid *mg, int32_t l)
{
  abut_multigrid_level *coarse = &mg->level[l + 1];
  abut_pool *pool = &mg->matrices;
  coarse->matrix.start =
      abut_pool_allocate(pool, (int64_t)coarse->n + 1, sizeof(int64_t));
  coarse->diagonal = abut_pool_allocate(pool, coarse->n, sizeof(int64_t));
  /* Copies have parts of rows, which may have other columns. */
  const bool alone = mg->level[l].ranks == NULL && are_middles(&mg->level[l]);
  const row_set set = matrix_of(&mg->level[l]);
  make_pattern(mg, l, &set, coarse->n, NULL, pool, &coarse->matrix,
               coarse->diagonal, &coarse->sum, alone);
}

/* Number the coarse nodes with children that have terms. */
static void
number_terms(abut_multigrid *mg, const abut_multigrid_level *fine,
             abut_multigrid_level *coarse)
{
  abut_node_terms *terms = &coarse->terms;
  terms->at = abut_pool_allocate(&mg->terms, coarse->n, sizeof(int32_t));
  for (int32_t q = 0; q < fine->terms.n && terms->at != NULL; ++q)
  {
    const int32_t i = fine->terms.row[q];
    for (int64_t e = fine->parents.start[i]; e < fine->parents.start[i + 1];
         ++e)
      terms->at[fine->parents.node[e]] = 1;
  }
  terms->n = 0;
  for (int32_t k = 0; k < coarse->n && terms->at != NULL; ++k)
    terms->at[k] = terms->at[k] ? terms->n++ : -1;
  terms->row = abut_pool_allocate(&mg->terms, terms->n, sizeof(int32_t));
  terms->diagonal = abut_pool_allocate(&mg->terms, terms->n, sizeof(int64_t));
  terms->rows.start =
      abut_pool_allocate(&mg->terms, (int64_t)terms->n + 1, sizeof(int64_t));
  for (int32_t k = 0; k < coarse->n && !mg->terms.failed; ++k)
    if (terms->at[k] >= 0)
      terms->row[terms->at[k]] = k;
}

void
abut_terms_pattern(abut_multigrid *mg, int32_t l)
{
  const abut_multigrid_level *fine = &mg->level[l];
  abut_node_terms *terms = &mg->level[l + 1].terms;
  number_terms(mg, fine, &mg->level[l + 1]);
  const row_set set = terms_of(fine);
  make_pattern(mg, l, &set, terms->n, terms->row, &mg->terms, &terms->rows,
               terms->diagonal, &terms->sum, false);
}

/* Where the sum of fine column j stands, of which there are n. */
ABUT_INLINE float *
sum_of(abut_multigrid *mg, const int32_t b, int32_t j, int32_t *n, float *sum)
{
  int32_t p = mg->fine_place[j];
  if (p < 0)
  {
    p = mg->fine_place[j] = *n;
    mg->list[*n] = j;
    *n += 1;
    for (int32_t r = 0; r < b * b; ++r)
      sum[(int64_t)p * b * b + r] = 0;
  }
  return sum + (int64_t)p * b * b;
}

/* Block of row i in column j < i of half a matrix, turned: that of row j in
 * column i; NULL: there is none. */
ABUT_INLINE const float *
turned_block(const row_set *set, const int32_t b, int32_t i, int32_t j)
{
  const int64_t first = set->upper[j], n = set->upper[j + 1] - first;
  const int32_t *node = set->rows->node + set->rows->start[j];
  for (int64_t e = 0; e < n; ++e)
    if (node[e] == i)
      return set->rows->weight + (first + e) * b * b;
  return NULL;
}

/* Add the row of child i over fine columns, of which there are n; returns how
 * many there are now. Rows that are held are left out, and nodes of which
 * nothing is free not even looked at. */
ABUT_INLINE int32_t
add_child(abut_multigrid *mg, const abut_multigrid_level *fine,
          const row_set *set, const int32_t b, int32_t q, int32_t i,
          float weight, int32_t n, float *sum)
{
  const abut_node_rows *rows = set->rows;
  float factor[3];
  bool any = false;
  for (int32_t r = 0; r < b; ++r)
  {
    any |= !fine->held[(int64_t)i * b + r];
    factor[r] = fine->held[(int64_t)i * b + r] ? 0 : weight;
  }
  if (!any)
    return n;
  const int64_t *begins = set->upper != NULL ? set->upper : rows->start;
  const int64_t first = begins[q], n_here = begins[q + 1] - first;
  const int64_t n_all = rows->start[q + 1] - rows->start[q];
  const int32_t *node = rows->node + rows->start[q];
  for (int64_t e = 0; e < n_here; ++e)
  {
    float *to = sum_of(mg, b, node[e], &n, sum);
    const float *block = rows->weight + (first + e) * b * b;
    for (int32_t r = 0; r < b; ++r)
      for (int32_t c = 0; c < b; ++c)
        to[r * b + c] += factor[r] * block[r * b + c];
  }
  for (int64_t e = n_here; e < n_all; ++e)
  {
    const float *block = turned_block(set, b, i, node[e]);
    if (block == NULL)
      continue;
    float *to = sum_of(mg, b, node[e], &n, sum);
    for (int32_t r = 0; r < b; ++r)
      for (int32_t c = 0; c < b; ++c)
        to[r * b + c] += factor[r] * block[c * b + r];
  }
  return n;
}

/* Hand the fine columns on to their parents, without those that are held;
 * returns whether the row has all of these. */
ABUT_INLINE bool
add_to_parents(abut_multigrid *mg, const abut_multigrid_level *fine,
               const int32_t b, int32_t n, float *sum, float *row)
{
  bool has_all = true;
  for (int32_t p = 0; p < n; ++p)
  {
    const int32_t j = mg->list[p];
    float *from = sum + (int64_t)p * b * b;
    mg->fine_place[j] = -1;
    for (int32_t c = 0; c < b; ++c)
      for (int32_t r = 0; r < b && fine->held[(int64_t)j * b + c]; ++r)
        from[r * b + c] = 0;
    for (int64_t g = fine->parents.start[j]; g < fine->parents.start[j + 1];
         ++g)
    {
      const int32_t at = mg->place[fine->parents.node[g]];
      if (at < 0)
      {
        has_all = false;
        continue;
      }
      float *to = row + (int64_t)at * b * b;
      const float weight = fine->parents.weight[g];
      for (int32_t r = 0; r < b * b; ++r)
        to[r] += weight * from[r];
    }
  }
  return has_all;
}

/* Cut off what is fixed on the coarse level from the row of node k, number q
 * of `rows`. */
ABUT_INLINE void
cut_fixed(const abut_multigrid_level *coarse, const abut_node_rows *rows,
          const int32_t b, int32_t q, int32_t k)
{
  const uint8_t *own = coarse->fixed + (int64_t)k * b;
  for (int64_t e = rows->start[q]; e < rows->start[q + 1]; ++e)
  {
    const uint8_t *other = coarse->fixed + (int64_t)rows->node[e] * b;
    for (int32_t r = 0; r < b; ++r)
      for (int32_t c = 0; c < b; ++c)
        if (own[r] || other[c])
          rows->weight[(e * b + r) * b + c] = 0;
  }
}

/* Row number q of `rows`, that of coarse node k; false: it lacks columns.
 * mg->place is -1 before and after. */
ABUT_INLINE bool
make_row(abut_multigrid *mg, const int32_t b, int32_t l, const row_set *set,
         const abut_node_rows *rows, int32_t q, int32_t k, float *sum)
{
  const abut_multigrid_level *fine = &mg->level[l];
  int32_t n = 0;
  for (int64_t f = fine->children.start[k]; f < fine->children.start[k + 1];
       ++f)
  {
    const int32_t i = fine->children.node[f], from = row_of(set, i);
    if (from >= 0)
      n = add_child(mg, fine, set, b, from, i, fine->children.weight[f], n,
                    sum);
  }
  const int64_t first = rows->start[q], end = rows->start[q + 1];
  for (int64_t e = first; e < end; ++e)
    mg->place[rows->node[e]] = (int32_t)(e - first);
  float *row = rows->weight + first * b * b;
  memset(row, 0, (size_t)(end - first) * (size_t)(b * b) * sizeof(float));
  const bool has_all = add_to_parents(mg, fine, b, n, sum, row);
  cut_fixed(&mg->level[l + 1], rows, b, q, k);
  for (int64_t e = first; e < end; ++e)
    mg->place[rows->node[e]] = -1;
  return has_all;
}

ABUT_INLINE bool
make_rows(abut_multigrid *mg, const int32_t b, int32_t l)
{
  const row_set set = matrix_of(&mg->level[l]);
  const abut_multigrid_level *coarse = &mg->level[l + 1];
  bool has_all = true;
  for (int32_t k = 0; k < coarse->n && has_all; ++k)
    if (coarse->dirty[k])
    {
      has_all = make_row(mg, b, l, &set, &coarse->matrix, k, k, coarse->sum);
      mg->n_renewed += 1;
    }
  return has_all;
}

ABUT_INLINE void
make_terms(abut_multigrid *mg, const int32_t b, int32_t l)
{
  const row_set set = terms_of(&mg->level[l]);
  const abut_node_terms *terms = &mg->level[l + 1].terms;
  abut_multigrid_clear_places(mg, mg->level[l + 1].n);
  for (int32_t q = 0; q < terms->n; ++q)
    (void)make_row(mg, b, l, &set, &terms->rows, q, terms->row[q], terms->sum);
}

static bool
make_dirty_rows(abut_multigrid *mg, int32_t l)
{
  abut_multigrid_clear_places(mg, mg->level[l + 1].n);
  return mg->block == 1   ? make_rows(mg, 1, l)
         : mg->block == 2 ? make_rows(mg, 2, l)
                          : make_rows(mg, 3, l);
}

/* The child in the place of its parent was not enough. False: no memory, and
 * all is as before. */
static bool
complete_pattern(abut_multigrid *mg, int32_t l)
{
  abut_multigrid_level *coarse = &mg->level[l + 1];
  abut_pool *pool = &mg->matrices;
  abut_node_rows rows = {
      abut_pool_allocate(pool, (int64_t)coarse->n + 1, sizeof(int64_t)), NULL,
      NULL};
  int64_t *diagonal = abut_pool_allocate(pool, coarse->n, sizeof(int64_t));
  float *sum = NULL;
  const row_set set = matrix_of(&mg->level[l]);
  make_pattern(mg, l, &set, coarse->n, NULL, pool, &rows, diagonal, &sum,
               false);
  const bool failed = pool->failed;
  pool->failed = false;
  if (failed)
    return false;
  coarse->matrix = rows;
  coarse->diagonal = diagonal;
  coarse->sum = sum;
  return true;
}

abut_status
abut_galerkin_rows(abut_multigrid *mg, int32_t l)
{
  if (make_dirty_rows(mg, l))
    return ABUT_SUCCESS;
  if (!complete_pattern(mg, l))
    return ABUT_OUT_OF_MEMORY;
  memset(mg->level[l + 1].dirty, 1, (size_t)mg->level[l + 1].n);
  (void)make_dirty_rows(mg, l);
  return ABUT_SUCCESS;
}

void
abut_terms_rows(abut_multigrid *mg, int32_t l)
{
  if (mg->block == 1)
    make_terms(mg, 1, l);
  else if (mg->block == 2)
    make_terms(mg, 2, l);
  else
    make_terms(mg, 3, l);
}

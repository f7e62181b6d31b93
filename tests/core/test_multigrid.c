/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Geometric multigrid with held unknowns: convergence that depends neither on
 * the mesh nor on what is held, coarse matrices, symmetry. */
#include "grid.h"
#include "multigrid/multigrid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static abut_multigrid *
open_multigrid(abut_context *context, const grid *g)
{
  abut_multigrid *mg = NULL;
  assert_ok(abut_multigrid_create(context, &g->hierarchy, &mg));
  assert_ok(abut_multigrid_set_matrix(mg, &g->matrix));
  return mg;
}

/* What to hold: nothing; parts at random; a disc. Of fields with one unknown
 * anywhere, as an obstacle holds a membrane; of displacements the last
 * component on the last side, as a plane holds a body. */
typedef enum set
{
  NOTHING,
  FEW,
  MANY,
  DISC,
  ALL_SETS
} set;

static uint8_t *
make_set(const grid *g, set which, uint64_t seed)
{
  uint8_t *held = calloc((size_t)g->n, 1);
  const int32_t side = g->side[0], nodes = g->mesh[0].n_nodes;
  for (int32_t i = 0; i < g->n; ++i)
  {
    const int32_t node = i / g->block;
    const double x = (double)(node % side) / (side - 1) - 0.5;
    const double y = g->dim == 2 && g->block > 1
                         ? 0
                         : (double)(node / side % side) / (side - 1) - 0.4;
    const double chance = fixture_random(&seed);
    if (g->block > 1
        && (i % g->block != g->block - 1 || node < nodes - nodes / side))
      continue;
    held[i] = (which == FEW && chance < 0.05) || (which == MANY && chance < 0.3)
              || (which == DISC && x * x + y * y < 0.04);
  }
  return held;
}

static int32_t
iterations(int32_t degree, int32_t dim, int32_t block, int32_t level, set which)
{
  grid g;
  if (degree == 1)
    grid_open(&g, dim, block, level, 1);
  else
    grid_open_quadratic(&g, dim, block, level, 1);
  abut_context *context = fixture_context();
  abut_multigrid *mg = open_multigrid(context, &g);
  uint8_t *held = make_set(&g, which, 3);
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  const int32_t result = grid_iterations(&g, mg, held, 1e-10);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_context_destroy(&context));
  free(held);
  grid_close(&g);
  return result;
}

/* No more iterations than `most` on any mesh with any set. */
static void
expect_flat(int32_t degree, int32_t dim, int32_t block, int32_t first,
            int32_t last, int32_t most)
{
  for (int which = NOTHING; which < ALL_SETS; ++which)
    for (int32_t level = first; level <= last; ++level)
    {
      const int32_t n = iterations(degree, dim, block, level, (set)which);
      if (n > most)
        fail_msg("%d iterations at level %d with set %d", n, level, which);
    }
}

static void
test_poisson_is_flat(void **state)
{
  (void)state;
  expect_flat(1, 2, 1, 4, 6, 9);
}

static void
test_elasticity_is_flat(void **state)
{
  (void)state;
  expect_flat(1, 2, 2, 3, 5, 14);
  expect_flat(1, 3, 3, 2, 3, 13);
}

static void
test_quadratic_elements_are_flat(void **state)
{
  (void)state;
  expect_flat(2, 2, 1, 3, 5, 10);
  expect_flat(2, 2, 2, 2, 4, 15);
  expect_flat(2, 3, 3, 1, 2, 15);
}

static void
test_cycle_is_symmetric_and_leaves_held(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 2, 2, 4, 1);
  abut_context *context = fixture_context();
  abut_multigrid *mg = open_multigrid(context, &g);
  uint8_t *held = make_set(&g, FEW, 5);
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  const size_t n = (size_t)g.n;
  double *a = calloc(4 * n, sizeof(double));
  double *b = a + n, *ma = b + n, *mb = ma + n;
  uint64_t seed = 11;
  for (int32_t i = 0; i < g.n; ++i)
  {
    a[i] = fixture_random(&seed) - 0.5;
    b[i] = fixture_random(&seed) - 0.5;
  }
  assert_ok(abut_multigrid_cycle(mg, a, ma));
  assert_ok(abut_multigrid_cycle(mg, b, mb));
  double left = 0, right = 0, own = 0;
  for (int32_t i = 0; i < g.n; ++i)
  {
    left += a[i] * mb[i];
    right += b[i] * ma[i];
    own += a[i] * ma[i];
    if (grid_is_out(&g, held, i))
      assert_true(ma[i] == 0 && mb[i] == 0);
  }
  assert_true(own > 0);
  assert_close(left / own, right / own, 1e-5);
  free(a);
  free(held);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_context_destroy(&context));
  grid_close(&g);
}

/* sum_ij w_i A_ij w_j of two coarse functions over what is free. */
static double
coarse_product(const grid *g, const uint8_t *held, int32_t k, int32_t l)
{
  double *left = calloc(3 * (size_t)g->n, sizeof(double));
  double *right = left + g->n, *image = right + g->n;
  for (int32_t i = 0; i < g->n; ++i)
    for (int64_t e = g->mesh[0].start[i]; e < g->mesh[0].start[i + 1]; ++e)
    {
      left[i] += g->mesh[0].parent[e] == k ? g->mesh[0].weight[e] : 0;
      right[i] += g->mesh[0].parent[e] == l ? g->mesh[0].weight[e] : 0;
    }
  grid_times(g, held, right, image);
  double sum = 0;
  for (int32_t i = 0; i < g->n; ++i)
    sum += left[i] * image[i];
  free(left);
  return g->mesh[1].fixed[k] || g->mesh[1].fixed[l] ? 0 : sum;
}

static void
test_coarse_matrix_is_that_of_galerkin(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 2, 1, 4, 3);
  /* Times 6 all entries are whole numbers and exact in single precision. */
  for (int32_t e = 0; e < g.start[g.n]; ++e)
    g.value[e] = nearbyint(6 * g.value[e]);
  abut_context *context = fixture_context();
  abut_multigrid *mg = open_multigrid(context, &g);
  uint8_t *held = make_set(&g, MANY, 17);
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  const abut_node_rows *rows = &mg->level[1].matrix;
  int32_t n_nonzero = 0;
  for (int32_t k = 0; k < g.mesh[1].n_nodes; ++k)
    for (int32_t l = 0; l < g.mesh[1].n_nodes; ++l)
    {
      double found = 0;
      for (int64_t e = rows->start[k]; e < rows->start[k + 1]; ++e)
        found += rows->node[e] == l ? (double)rows->weight[e] : 0;
      assert_close(found, coarse_product(&g, held, k, l), 1e-14);
      n_nonzero += found != 0;
    }
  assert_true(n_nonzero > 200);
  free(held);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_context_destroy(&context));
  grid_close(&g);
}

static void
assert_same_levels(const abut_multigrid *a, const abut_multigrid *b)
{
  for (int32_t l = 1; l < a->n_levels; ++l)
  {
    const abut_multigrid_level *x = &a->level[l], *y = &b->level[l];
    const size_t n =
        (size_t)x->matrix.start[x->n] * (size_t)(a->block * a->block);
    assert_memory_equal(x->matrix.weight, y->matrix.weight, n * sizeof(float));
    assert_memory_equal(x->held, y->held, (size_t)(x->n * a->block));
  }
}

static void
test_what_changed_is_made_anew_and_no_more(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 2, 2, 5, 1);
  abut_context *context = fixture_context();
  abut_multigrid *mg = open_multigrid(context, &g);
  uint8_t *held = make_set(&g, FEW, 23);
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  abut_multigrid_report report = {sizeof(report), 0, 0, 0, 0, {0}};
  assert_ok(abut_multigrid_describe_sized(mg, &report));
  const int64_t all = report.n_renewed;
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  assert_ok(abut_multigrid_describe_sized(mg, &report));
  assert_int_equal(report.n_renewed, 0);

  const int32_t middle = g.n / 2 + 2;
  held[middle] = !held[middle];
  double *added = calloc((size_t)g.n, sizeof(double));
  added[g.n / 3] = 2.5;
  assert_ok(abut_multigrid_set_constrained(mg, held, added));
  assert_ok(abut_multigrid_describe_sized(mg, &report));
  assert_in_range(report.n_renewed, 2, all / 4);
  abut_multigrid *fresh = open_multigrid(context, &g);
  assert_ok(abut_multigrid_set_constrained(fresh, held, added));
  assert_same_levels(mg, fresh);

  free(added);
  free(held);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_multigrid_destroy(&fresh));
  assert_ok(abut_context_destroy(&context));
  grid_close(&g);
}

/* The matrix of a grid and a coupling of nodes p and q, with its own part of
 * their diagonals. */
static void
couple(const grid *g, int32_t p, int32_t q, grid *result)
{
  *result = *g;
  const size_t m = (size_t)g->start[g->n] + 2;
  result->start = calloc((size_t)g->n + 1, sizeof(int32_t));
  result->column = calloc(m, sizeof(int32_t));
  result->value = calloc(m, sizeof(double));
  int32_t n = 0;
  for (int32_t i = 0; i < g->n; ++i)
  {
    for (int32_t e = g->start[i]; e < g->start[i + 1]; ++e)
    {
      const bool own = g->column[e] == i && (i == p || i == q);
      result->column[n] = g->column[e];
      result->value[n++] = g->value[e] + (own ? 0.5 : 0);
    }
    if (i == p || i == q)
    {
      result->column[n] = i == p ? q : p;
      result->value[n++] = -0.5;
    }
    result->start[i + 1] = n;
  }
  result->matrix =
      (abut_multigrid_matrix){sizeof(result->matrix), g->n, result->start,
                              result->column, result->value};
}

/* Entry (k, j) of P^T A P of the second mesh, where nothing is held. */
static double
galerkin_entry(const grid *g, int32_t k, int32_t j)
{
  const abut_multigrid_mesh *mesh = &g->mesh[0];
  double sum = 0;
  for (int32_t i = 0; i < g->n; ++i)
    for (int64_t f = mesh->start[i]; f < mesh->start[i + 1]; ++f)
      for (int32_t e = g->start[i]; mesh->parent[f] == k && e < g->start[i + 1];
           ++e)
      {
        const int32_t c = g->column[e];
        for (int64_t h = mesh->start[c]; h < mesh->start[c + 1]; ++h)
          if (mesh->parent[h] == j)
            sum += mesh->weight[f] * mesh->weight[h] * g->value[e];
      }
  return sum;
}

static void
assert_galerkin(const grid *g, const abut_multigrid *mg)
{
  const abut_multigrid_level *coarse = &mg->level[1];
  double *row = calloc((size_t)coarse->n, sizeof(double));
  for (int32_t k = 0; k < coarse->n; ++k)
  {
    memset(row, 0, (size_t)coarse->n * sizeof(double));
    for (int64_t e = coarse->matrix.start[k]; e < coarse->matrix.start[k + 1];
         ++e)
      row[coarse->matrix.node[e]] += (double)coarse->matrix.weight[e];
    for (int32_t j = 0; j < coarse->n; ++j)
      if (!coarse->fixed[k] && !coarse->fixed[j])
        assert_true(fabs(row[j] - galerkin_entry(g, k, j)) < 1e-5);
  }
  free(row);
}

/* Nodes that no node of the coarse mesh touches may be coupled: the rows of the
 * children that stand where coarse nodes do say nothing of that. */
static void
test_coarse_rows_have_all_columns(void **state)
{
  (void)state;
  grid g, coupled;
  grid_open(&g, 2, 1, 4, 1);
  abut_context *context = fixture_context();
  const int32_t side = g.side[0], p = 3 * side + 3, q = 11 * side + 13;
  couple(&g, p, q, &coupled);
  abut_multigrid *plain = open_multigrid(context, &g);
  abut_multigrid *mg = open_multigrid(context, &coupled);
  assert_ok(abut_multigrid_set_constrained(plain, NULL, NULL));
  assert_galerkin(&g, plain);
  /* While one of them is held nothing is missing. */
  uint8_t *held = calloc((size_t)g.n, 1);
  held[p] = 1;
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  assert_in_range(grid_iterations(&coupled, mg, held, 1e-10), 5, 12);
  assert_ok(abut_multigrid_set_constrained(mg, NULL, NULL));
  assert_galerkin(&coupled, mg);
  assert_in_range(grid_iterations(&coupled, mg, NULL, 1e-10), 5, 12);

  free(held);
  free(coupled.start);
  free(coupled.column);
  free(coupled.value);
  assert_ok(abut_multigrid_destroy(&plain));
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_context_destroy(&context));
  grid_close(&g);
}

/* A matrix in two parts: of couplings between some of the nodes a part is in
 * `more`, all else in `less`. */
typedef struct halves
{
  grid less;
  int32_t *start, *column;
  double *value, *rest;
  abut_multigrid_matrix more;
} halves;

static void
halves_open(halves *h, const grid *g, double part)
{
  const size_t m = (size_t)g->start[g->n];
  h->less = *g;
  h->start = calloc((size_t)g->n + 1, sizeof(int32_t));
  h->column = calloc(m, sizeof(int32_t));
  h->value = calloc(m, sizeof(double));
  h->rest = calloc(m, sizeof(double));
  for (int32_t i = 0; i < g->n; ++i)
  {
    h->start[i + 1] = h->start[i];
    for (int32_t e = g->start[i]; e < g->start[i + 1]; ++e)
    {
      const int32_t j = g->column[e];
      h->rest[e] = g->value[e];
      if (i / g->block % 7 > 2 || j / g->block % 7 > 2)
        continue;
      h->rest[e] -= part * g->value[e];
      h->column[h->start[i + 1]] = j;
      h->value[h->start[i + 1]++] = part * g->value[e];
    }
  }
  h->less.matrix.value = h->rest;
  h->more = (abut_multigrid_matrix){sizeof(h->more), g->n, h->start, h->column,
                                    h->value};
}

static void
halves_close(halves *h)
{
  free(h->start);
  free(h->column);
  free(h->value);
  free(h->rest);
}

static void
assert_same_cycle(const grid *g, abut_multigrid *a, abut_multigrid *b)
{
  double *r = calloc(3 * (size_t)g->n, sizeof(double));
  uint64_t seed = 31;
  for (int32_t i = 0; i < g->n; ++i)
    r[i] = fixture_random(&seed) - 0.5;
  assert_ok(abut_multigrid_cycle(a, r, r + g->n));
  assert_ok(abut_multigrid_cycle(b, r, r + 2 * g->n));
  double size = 0, difference = 0;
  for (int32_t i = 0; i < g->n; ++i)
  {
    size = fmax(size, fabs(r[g->n + i]));
    difference = fmax(difference, fabs(r[g->n + i] - r[2 * g->n + i]));
  }
  assert_true(difference < 1e-4 * size);
  free(r);
}

/* What is added is as good as in the matrix, whatever is held, and goes without
 * a trace. */
static void
test_terms_are_part_of_the_matrix(void **state)
{
  (void)state;
  for (int32_t dim = 2; dim < 4; ++dim)
  {
    grid g;
    grid_open(&g, dim, dim, dim == 2 ? 5 : 3, 1);
    halves h;
    halves_open(&h, &g, 0.4);
    abut_context *context = fixture_context();
    abut_multigrid *whole = open_multigrid(context, &g);
    abut_multigrid *parts = open_multigrid(context, &h.less);
    assert_ok(abut_multigrid_set_terms(parts, &h.more));
    assert_ok(abut_multigrid_set_constrained(whole, NULL, NULL));
    assert_ok(abut_multigrid_set_constrained(parts, NULL, NULL));
    assert_same_cycle(&g, whole, parts);

    uint8_t *held = make_set(&g, MANY, 41);
    assert_ok(abut_multigrid_set_constrained(parts, held, NULL));
    assert_in_range(grid_iterations(&g, parts, held, 1e-10), 5, 14);
    abut_multigrid *fresh = open_multigrid(context, &h.less);
    assert_ok(abut_multigrid_set_terms(fresh, &h.more));
    assert_ok(abut_multigrid_set_constrained(fresh, held, NULL));
    assert_same_levels(parts, fresh);
    assert_same_cycle(&g, parts, fresh);

    assert_ok(abut_multigrid_set_terms(parts, NULL));
    assert_ok(abut_multigrid_set_constrained(parts, held, NULL));
    abut_multigrid *less = open_multigrid(context, &h.less);
    assert_ok(abut_multigrid_set_constrained(less, held, NULL));
    assert_same_levels(parts, less);
    assert_same_cycle(&g, parts, less);
    assert_ok(abut_multigrid_set_matrix(parts, &g.matrix));
    assert_ok(abut_multigrid_set_constrained(parts, NULL, NULL));
    assert_same_levels(parts, whole);

    free(held);
    assert_ok(abut_multigrid_destroy(&whole));
    assert_ok(abut_multigrid_destroy(&parts));
    assert_ok(abut_multigrid_destroy(&fresh));
    assert_ok(abut_multigrid_destroy(&less));
    assert_ok(abut_context_destroy(&context));
    halves_close(&h);
    grid_close(&g);
  }
}

static void
add_no_copies(void *user, int32_t mesh, int32_t n_values, float *values)
{
  (void)mesh;
  (void)n_values;
  (void)values;
  *(int32_t *)user += 1;
}

static void
reduce_alone(void *user, abut_reduction op, double *values, int32_t n)
{
  (void)op;
  (void)values;
  (void)n;
  *(int32_t *)user += 1;
}

/* A rank of which there is only one makes the same cycles as no ranks, with
 * terms and sets that change. */
static void
test_one_rank_is_none(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 2, 2, 4, 1);
  halves h;
  halves_open(&h, &g, 0.4);
  abut_context *context = fixture_context();
  int32_t first[GRID_LEVELS] = {0}, n[GRID_LEVELS], n_calls = 0;
  for (int32_t l = 0; l < g.n_meshes; ++l)
    n[l] = g.mesh[l].n_nodes;
  abut_multigrid_ranks ranks = {first, n, add_no_copies, reduce_alone,
                                &n_calls};
  abut_multigrid *alone = open_multigrid(context, &h.less), *ranked = NULL;
  abut_multigrid_hierarchy hierarchy = g.hierarchy;
  hierarchy.ranks = &ranks;
  assert_ok(abut_multigrid_create(context, &hierarchy, &ranked));
  assert_ok(abut_multigrid_set_matrix(ranked, &h.less.matrix));
  for (int which = NOTHING; which < ALL_SETS; ++which)
  {
    uint8_t *held = make_set(&g, (set)which, 43);
    abut_multigrid *both[2] = {alone, ranked};
    for (int k = 0; k < 2; ++k)
    {
      assert_ok(
          abut_multigrid_set_terms(both[k], which == FEW ? NULL : &h.more));
      assert_ok(abut_multigrid_set_constrained(both[k], held, NULL));
    }
    assert_same_cycle(&g, alone, ranked);
    free(held);
  }
  assert_true(n_calls > 0);
  assert_ok(abut_multigrid_destroy(&ranked));
  n[1] += 1;
  assert_int_equal(abut_multigrid_create(context, &hierarchy, &ranked),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_multigrid_destroy(&alone));
  assert_ok(abut_context_destroy(&context));
  halves_close(&h);
  grid_close(&g);
}

static void
test_one_mesh_is_solved(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 3, 3, 2, 2);
  abut_context *context = fixture_context();
  abut_multigrid *mg = open_multigrid(context, &g);
  uint8_t *held = make_set(&g, DISC, 1);
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  assert_true(grid_iterations(&g, mg, held, 1e-5) < 3);
  /* All held: nothing to do. */
  memset(held, 1, (size_t)g.n);
  assert_ok(abut_multigrid_set_constrained(mg, held, NULL));
  double *x = calloc(2 * (size_t)g.n, sizeof(double));
  x[0] = x[g.n - 1] = 1;
  assert_ok(abut_multigrid_cycle(mg, x, x + g.n));
  for (int32_t i = 0; i < g.n; ++i)
    assert_true(x[g.n + i] == 0);
  free(x);
  free(held);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_context_destroy(&context));
  grid_close(&g);
}

static void
test_unknowns_in_any_order(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 2, 1, 3, 1);
  /* The same matrix with its rows in reversed order. */
  int32_t *unknown = calloc((size_t)g.n, sizeof(int32_t));
  int32_t *start = calloc((size_t)g.n + 1, sizeof(int32_t));
  int32_t *column = calloc((size_t)g.start[g.n], sizeof(int32_t));
  double *value = calloc((size_t)g.start[g.n], sizeof(double));
  double *r = calloc(4 * (size_t)g.n, sizeof(double));
  for (int32_t i = 0; i < g.n; ++i)
  {
    const int32_t from = unknown[i] = g.n - 1 - i;
    start[i + 1] = start[i];
    for (int32_t e = g.start[from]; e < g.start[from + 1]; ++e)
    {
      column[start[i + 1]] = g.n - 1 - g.column[e];
      value[start[i + 1]++] = g.value[e];
    }
    r[i] = r[2 * g.n + from] = i % 7;
  }
  abut_context *context = fixture_context();
  abut_multigrid *mg = open_multigrid(context, &g);
  grid reversed = g;
  reversed.hierarchy.unknown = unknown;
  reversed.matrix.start = start;
  reversed.matrix.column = column;
  reversed.matrix.value = value;
  abut_multigrid *other = open_multigrid(context, &reversed);
  assert_ok(abut_multigrid_set_constrained(mg, NULL, NULL));
  assert_ok(abut_multigrid_set_constrained(other, NULL, NULL));
  assert_ok(abut_multigrid_cycle(mg, r, r + g.n));
  assert_ok(abut_multigrid_cycle(other, r + 2 * g.n, r + 3 * g.n));
  for (int32_t i = 0; i < g.n; ++i)
    assert_close(r[3 * g.n + g.n - 1 - i], r[g.n + i], 1e-5);
  unknown[3] = unknown[4];
  abut_multigrid *none = NULL;
  assert_int_equal(abut_multigrid_create(context, &reversed.hierarchy, &none),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_multigrid_destroy(&other));
  assert_ok(abut_context_destroy(&context));
  free(unknown);
  free(start);
  free(column);
  free(value);
  free(r);
  grid_close(&g);
}

static void
test_mistakes_are_told(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 2, 1, 2, 1);
  abut_context *context = fixture_context();
  abut_multigrid *mg = NULL;
  abut_multigrid_hierarchy wrong = g.hierarchy;
  wrong.block = 4;
  assert_int_equal(abut_multigrid_create(context, &wrong, &mg),
                   ABUT_INVALID_ARGUMENT);
  abut_multigrid_mesh few[2] = {g.mesh[0], g.mesh[1]};
  few[1].n_nodes -= 1;
  wrong = g.hierarchy;
  wrong.mesh = few;
  assert_int_equal(abut_multigrid_create(context, &wrong, &mg),
                   ABUT_INVALID_ARGUMENT);
  assert_null(mg);

  assert_ok(abut_multigrid_create(context, &g.hierarchy, &mg));
  double *x = calloc((size_t)g.n, sizeof(double));
  assert_int_equal(abut_multigrid_set_constrained(mg, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_multigrid_cycle(mg, x, x), ABUT_INVALID_ARGUMENT);
  g.matrix.n -= 1;
  assert_int_equal(abut_multigrid_set_matrix(mg, &g.matrix),
                   ABUT_INVALID_ARGUMENT);
  g.matrix.n += 1;
  g.value[3] = NAN;
  assert_int_equal(abut_multigrid_set_matrix(mg, &g.matrix), ABUT_NOT_FINITE);
  g.value[3] = 1;
  assert_ok(abut_multigrid_set_matrix(mg, &g.matrix));
  x[2] = -1;
  assert_int_equal(abut_multigrid_set_constrained(mg, NULL, x),
                   ABUT_INVALID_ARGUMENT);
  free(x);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_context_destroy(&context));
  grid_close(&g);
}

static void
test_too_many_unknowns_to_factorise(void **state)
{
  (void)state;
  grid g;
  grid_open(&g, 2, 1, 6, 6);
  abut_context *context = fixture_context();
  abut_multigrid *mg = open_multigrid(context, &g);
  assert_int_equal(abut_multigrid_set_constrained(mg, NULL, NULL),
                   ABUT_UNSUPPORTED);
  assert_ok(abut_multigrid_destroy(&mg));
  assert_ok(abut_context_destroy(&context));
  grid_close(&g);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_poisson_is_flat),
      cmocka_unit_test(test_elasticity_is_flat),
      cmocka_unit_test(test_quadratic_elements_are_flat),
      cmocka_unit_test(test_cycle_is_symmetric_and_leaves_held),
      cmocka_unit_test(test_coarse_matrix_is_that_of_galerkin),
      cmocka_unit_test(test_what_changed_is_made_anew_and_no_more),
      cmocka_unit_test(test_coarse_rows_have_all_columns),
      cmocka_unit_test(test_terms_are_part_of_the_matrix),
      cmocka_unit_test(test_one_rank_is_none),
      cmocka_unit_test(test_one_mesh_is_solved),
      cmocka_unit_test(test_unknowns_in_any_order),
      cmocka_unit_test(test_mistakes_are_told),
      cmocka_unit_test(test_too_many_unknowns_to_factorise),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

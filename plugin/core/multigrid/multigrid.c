/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Creation, what changes with the set, and the cycle. */
#include "multigrid/multigrid.h"

#include <math.h>
#include <string.h>

enum
{
  POWER_STEPS = 6
};

static const char create_call[] = "abut_multigrid_create";
static const char hold_call[] = "abut_multigrid_set_constrained";

static const char *
wrong_mesh(const abut_multigrid_hierarchy *h, int32_t l)
{
  const abut_multigrid_mesh *mesh = &h->mesh[l];
  if (mesh->n_nodes < 0 || mesh->n_nodes > INT32_MAX / h->block)
    return "a mesh has no number of nodes";
  if (l + 1 == h->n_meshes)
    return NULL;
  if (mesh->start == NULL || mesh->start[0] != 0
      || (mesh->start[mesh->n_nodes] > 0
          && (mesh->parent == NULL || mesh->weight == NULL)))
    return "a mesh lacks the weights of the next coarser one";
  double probe = 0;
  for (int32_t i = 0; i < mesh->n_nodes; ++i)
  {
    if (mesh->start[i + 1] < mesh->start[i])
      return "a node has a negative number of weights";
    for (int64_t e = mesh->start[i]; e < mesh->start[i + 1]; ++e)
    {
      if (mesh->parent[e] < 0 || mesh->parent[e] >= mesh[1].n_nodes)
        return "a parent is not a node of the next coarser mesh";
      probe += 0.0 * mesh->weight[e];
    }
  }
  return probe == 0 ? NULL : "a weight is not finite";
}

static const char *
wrong_ranks(const abut_multigrid_hierarchy *h)
{
  const abut_multigrid_ranks *ranks = h->ranks;
  if (ranks == NULL)
    return NULL;
  if (ranks->first_own == NULL || ranks->n_own == NULL
      || ranks->add_copies == NULL || ranks->reduce == NULL)
    return "the exchange between ranks is incomplete";
  for (int32_t l = 0; l < h->n_meshes; ++l)
    if (ranks->first_own[l] < 0 || ranks->n_own[l] < 0
        || ranks->n_own[l] > h->mesh[l].n_nodes - ranks->first_own[l])
      return "a rank owns nodes that it does not have";
  return NULL;
}

static const char *
wrong_hierarchy(const abut_multigrid_hierarchy *h)
{
  if (h->block < 1 || h->block > 3)
    return "a node has 1 to 3 unknowns";
  if (h->n_meshes < 1 || h->n_meshes > ABUT_MULTIGRID_MESHES || h->mesh == NULL)
    return "there are 1 to 32 meshes";
  for (int32_t l = 0; l < h->n_meshes; ++l)
  {
    const char *what = wrong_mesh(h, l);
    if (what != NULL)
      return what;
  }
  return wrong_ranks(h);
}

static void
take_parents(abut_pool *pool, const abut_multigrid_mesh *mesh,
             abut_node_rows *rows)
{
  const int64_t n = mesh->n_nodes, m = mesh->start[n];
  rows->start = abut_pool_allocate(pool, n + 1, sizeof(int64_t));
  rows->node = abut_pool_allocate(pool, m, sizeof(int32_t));
  rows->weight = abut_pool_allocate(pool, m, sizeof(float));
  if (pool->failed)
    return;
  memcpy(rows->start, mesh->start, (size_t)(n + 1) * sizeof(int64_t));
  for (int64_t e = 0; e < m; ++e)
  {
    rows->node[e] = mesh->parent[e];
    rows->weight[e] = (float)mesh->weight[e];
  }
}

/* The same by parents: their children, in the order of their numbers. */
static void
transpose(abut_pool *pool, const abut_node_rows *rows, int32_t n, int32_t n_new,
          abut_node_rows *result)
{
  const int64_t m = rows->start[n];
  result->start = abut_pool_allocate(pool, (int64_t)n_new + 2, sizeof(int64_t));
  result->node = abut_pool_allocate(pool, m, sizeof(int32_t));
  result->weight = abut_pool_allocate(pool, m, sizeof(float));
  if (pool->failed)
    return;
  /* Counted two places ahead, so that filling leaves the right beginnings. */
  int64_t *next = result->start + 1;
  for (int64_t e = 0; e < m; ++e)
    if (rows->node[e] + 1 < n_new)
      next[rows->node[e] + 1] += 1;
  for (int32_t k = 1; k < n_new; ++k)
    next[k] += next[k - 1];
  for (int32_t i = 0; i < n; ++i)
    for (int64_t e = rows->start[i]; e < rows->start[i + 1]; ++e)
    {
      const int64_t at = next[rows->node[e]]++;
      result->node[at] = i;
      result->weight[at] = rows->weight[e];
    }
}

/* Set the nodes of a level that this rank owns. */
static void
take_own(abut_multigrid *mg, const abut_multigrid_ranks *ranks, int32_t l)
{
  abut_multigrid_level *level = &mg->level[l];
  level->number = l;
  level->first_own = 0;
  level->end_own = level->n;
  if (ranks == NULL)
    return;
  level->ranks = &mg->ranks;
  level->first_own = ranks->first_own[l];
  level->end_own = level->first_own + ranks->n_own[l];
  level->product = abut_pool_allocate(
      &mg->structure, (int64_t)level->n * mg->block, sizeof(float));
}

static void
take_mesh(abut_multigrid *mg, const abut_multigrid_mesh *mesh, int32_t l)
{
  abut_multigrid_level *level = &mg->level[l];
  abut_pool *pool = &mg->structure;
  const int32_t b = mg->block;
  const int64_t n = (int64_t)mesh->n_nodes * b;
  level->n = mesh->n_nodes;
  level->fixed = abut_pool_allocate(pool, n, 1);
  level->held = abut_pool_allocate(pool, n, 1);
  level->dirty = abut_pool_allocate(pool, mesh->n_nodes, 1);
  level->inverse = abut_pool_allocate(pool, n * b, sizeof(float));
  level->x = abut_pool_allocate(pool, n + 1, sizeof(float));
  level->r = abut_pool_allocate(pool, n + 1, sizeof(float));
  level->z = abut_pool_allocate(pool, n + 1, sizeof(float));
  if (!pool->failed && mesh->fixed != NULL)
    for (int64_t u = 0; u < n; ++u)
      level->fixed[u] = mesh->fixed[u] != 0;
  if (l + 1 == mg->n_levels)
    return;
  take_parents(pool, mesh, &level->parents);
  if (!pool->failed)
    transpose(pool, &level->parents, mesh->n_nodes, mesh[1].n_nodes,
              &level->children);
}

/* Whether node i of the finest level is this rank's. */
static bool
is_own(const abut_multigrid *mg, int64_t i)
{
  return i >= mg->level[0].first_own && i < mg->level[0].end_own;
}

/* Rows of this rank, which are the first ones. */
static int64_t
n_own_rows(const abut_multigrid *mg)
{
  return (int64_t)(mg->level[0].end_own - mg->level[0].first_own) * mg->block;
}

/* False if the numbers are no permutation, or own nodes not the first. */
static bool
take_unknowns(abut_multigrid *mg, const int32_t *unknown)
{
  const int64_t n = (int64_t)mg->level[0].n * mg->block;
  for (int64_t u = 0; u < n; ++u)
    mg->unknown[u] = unknown == NULL ? (int32_t)u : unknown[u];
  bool good = true;
  for (int64_t u = 0; u < n && good; ++u)
  {
    good = mg->unknown[u] >= 0 && mg->unknown[u] < n
           && mg->held[mg->unknown[u]] == 0
           && is_own(mg, u / mg->block) == (mg->unknown[u] < n_own_rows(mg));
    if (good)
      mg->held[mg->unknown[u]] = 1;
  }
  for (int64_t u = 0; u < n; ++u)
    mg->held[u] = 0;
  return good;
}

static abut_status
build(abut_multigrid *mg, const abut_multigrid_hierarchy *h)
{
  int32_t most = 0;
  for (int32_t l = 0; l < mg->n_levels; ++l)
  {
    take_mesh(mg, &h->mesh[l], l);
    take_own(mg, h->ranks, l);
    most = most > h->mesh[l].n_nodes ? most : h->mesh[l].n_nodes;
  }
  const int64_t n = (int64_t)mg->level[0].n * mg->block;
  mg->unknown = abut_pool_allocate(&mg->structure, n, sizeof(int32_t));
  mg->held = abut_pool_allocate(&mg->structure, n, 1);
  mg->added = abut_pool_allocate(&mg->structure, n, sizeof(double));
  mg->plain = abut_pool_allocate(&mg->structure, n, sizeof(float));
  mg->moved = abut_pool_allocate(&mg->structure, h->mesh[0].n_nodes, 1);
  mg->place = abut_pool_allocate(&mg->structure, most, sizeof(int32_t));
  mg->fine_place = abut_pool_allocate(&mg->structure, most, sizeof(int32_t));
  mg->list = abut_pool_allocate(&mg->structure, most, sizeof(int32_t));
  if (h->ranks != NULL)
  {
    mg->ranks = *h->ranks;
    mg->ranks.first_own = mg->ranks.n_own = NULL; /* the levels have them */
    mg->changed = abut_pool_allocate(&mg->structure, h->mesh[0].n_nodes, 1);
    mg->blocks = abut_pool_allocate(
        &mg->structure, (int64_t)most * mg->block * mg->block, sizeof(float));
  }
  if (mg->structure.failed)
    return abut_fail(mg->context, ABUT_OUT_OF_MEMORY, create_call, "no memory");
  for (int32_t i = 0; i < most; ++i)
    mg->fine_place[i] = -1;
  return take_unknowns(mg, h->unknown)
             ? ABUT_SUCCESS
             : abut_fail(mg->context, ABUT_INVALID_ARGUMENT, create_call,
                         "the unknowns are not a permutation of the rows");
}

abut_status
abut_multigrid_create(abut_context *context,
                      const abut_multigrid_hierarchy *hierarchy,
                      abut_multigrid **multigrid)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (multigrid == NULL || hierarchy == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, create_call,
                     "an argument is NULL");
  abut_multigrid_hierarchy taken = {sizeof(taken), 1, 0, NULL, NULL, NULL};
  abut_status status =
      abut_copy_in(context, create_call, &taken, sizeof(taken), hierarchy);
  if (status != ABUT_SUCCESS)
    return status;
  const char *what = wrong_hierarchy(&taken);
  if (what != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, create_call, what);
  abut_multigrid *mg = abut_object_create(context, sizeof(abut_multigrid));
  if (mg == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, create_call, "no memory");
  mg->context = context;
  mg->block = taken.block;
  mg->n_levels = taken.n_meshes;
  mg->structure.context = mg->matrices.context = context;
  mg->terms.context = mg->coarsest.context = context;
  status = build(mg, &taken);
  if (status == ABUT_SUCCESS)
    *multigrid = mg;
  else
    (void)abut_multigrid_destroy(&mg);
  return status;
}

abut_status
abut_multigrid_destroy(abut_multigrid **multigrid)
{
  if (multigrid == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (*multigrid == NULL)
    return ABUT_SUCCESS;
  abut_multigrid *mg = *multigrid;
  abut_pool_release(&mg->structure);
  abut_pool_release(&mg->matrices);
  abut_pool_release(&mg->terms);
  abut_pool_release(&mg->coarsest);
  abut_object_destroy(mg->context, mg, sizeof(*mg));
  *multigrid = NULL;
  return ABUT_SUCCESS;
}

static void
keep_plain_diagonal(abut_multigrid *mg)
{
  const abut_multigrid_level *level = &mg->level[0];
  const int32_t b = mg->block;
  for (int32_t i = 0; i < level->n; ++i)
    for (int32_t c = 0; c < b; ++c)
      mg->plain[(int64_t)i * b + c] =
          level->diagonal[i] < 0
              ? 0
              : level->matrix
                    .weight[level->diagonal[i] * b * b + (int64_t)c * (b + 1)];
}

abut_status
abut_multigrid_set_matrix(abut_multigrid *mg,
                          const abut_multigrid_matrix *matrix)
{
  static const char call[] = "abut_multigrid_set_matrix";
  if (mg == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_multigrid_matrix taken = {sizeof(taken), 0, NULL, NULL, NULL};
  abut_status status =
      matrix == NULL
          ? abut_fail(mg->context, ABUT_INVALID_ARGUMENT, call, "no matrix")
          : abut_copy_in(mg->context, call, &taken, sizeof(taken), matrix);
  if (status != ABUT_SUCCESS)
    return status;
  mg->is_ready = mg->has_matrix = false;
  abut_pool_release(&mg->matrices);
  status = abut_multigrid_fill(mg, &taken);
  if (status != ABUT_SUCCESS)
    return status;
  keep_plain_diagonal(mg);
  for (int32_t l = 0; l + 1 < mg->n_levels && !mg->matrices.failed; ++l)
    abut_galerkin_pattern(mg, l);
  if (mg->matrices.failed)
    return abut_fail(mg->context, ABUT_OUT_OF_MEMORY, call, "no memory");
  mg->has_matrix = true;
  return ABUT_SUCCESS;
}

/* Take the diagonal of node i of the finest level, and whether it changed. */
static bool
take_node(abut_multigrid *mg, int32_t i, const uint8_t *held,
          const double *added)
{
  abut_multigrid_level *level = &mg->level[0];
  const int32_t b = mg->block;
  bool changed = false;
  for (int32_t c = 0; c < b; ++c)
  {
    const int64_t u = (int64_t)i * b + c;
    const int32_t row = mg->unknown[u];
    const bool own = is_own(mg, i);
    const uint8_t is_held = own ? held != NULL && held[row] : mg->blocks[u] > 0;
    const double more = own && added != NULL ? added[row] : 0;
    changed |= is_held != mg->held[u] || more != mg->added[u];
    mg->held[u] = is_held;
    mg->added[u] = more;
    level->held[u] = is_held || level->fixed[u];
    if (level->diagonal[i] >= 0)
      level->matrix.weight[level->diagonal[i] * b * b + (int64_t)c * (b + 1)] =
          (float)((double)mg->plain[u] + more);
  }
  return changed;
}

/* Set the unknowns in mg->blocks that other ranks hold. */
static void
share_held(abut_multigrid *mg, const uint8_t *held)
{
  const abut_multigrid_level *level = &mg->level[0];
  for (int64_t u = 0; u < (int64_t)level->n * mg->block; ++u)
    mg->blocks[u] =
        is_own(mg, u / mg->block) && held != NULL && held[mg->unknown[u]];
  abut_level_share(level, mg->block, mg->blocks);
}

/* The same as mark_finest() where copies have no rows that would determine
 * whose columns they are. */
static void
mark_shared(abut_multigrid *mg, const uint8_t *held, const double *added,
            bool all)
{
  abut_multigrid_level *level = &mg->level[0];
  share_held(mg, held);
  for (int32_t i = 0; i < level->n; ++i)
    mg->changed[i] = take_node(mg, i, held, added);
  for (int32_t i = 0; i < level->n; ++i)
  {
    bool any = all || mg->moved[i] || mg->changed[i];
    for (int64_t e = level->matrix.start[i];
         !any && e < level->matrix.start[i + 1]; ++e)
      any = mg->changed[level->matrix.node[e]];
    level->dirty[i] = any;
  }
  abut_level_share_flags(level, 1, level->dirty);
}

/* Mark the rows of the finest level that differ from the last time. */
static void
mark_finest(abut_multigrid *mg, const uint8_t *held, const double *added,
            bool all)
{
  abut_multigrid_level *level = &mg->level[0];
  if (level->ranks != NULL)
  {
    mark_shared(mg, held, added, all);
    return;
  }
  memset(level->dirty, all, (size_t)level->n);
  for (int32_t i = 0; i < level->n; ++i)
  {
    if (take_node(mg, i, held, added) && !all)
      for (int64_t e = level->matrix.start[i]; e < level->matrix.start[i + 1];
           ++e)
        level->dirty[level->matrix.node[e]] = 1;
    level->dirty[i] |= mg->moved[i];
  }
}

static bool
any_rank(const abut_multigrid_level *level, bool here)
{
  double value = here;
  abut_level_reduce(level, ABUT_REDUCTION_MAX, &value, 1);
  return value > 0;
}

/* Mark the rows of level l + 1 that depend on those marked on level l. */
static bool
mark_coarse(abut_multigrid *mg, int32_t l)
{
  const abut_multigrid_level *fine = &mg->level[l];
  abut_multigrid_level *coarse = &mg->level[l + 1];
  bool any = false;
  memset(coarse->dirty, 0, (size_t)coarse->n);
  for (int32_t i = 0; i < fine->n; ++i)
    for (int64_t e = fine->parents.start[i];
         fine->dirty[i] && e < fine->parents.start[i + 1]; ++e)
    {
      coarse->dirty[fine->parents.node[e]] = 1;
      any = true;
    }
  abut_level_share_flags(coarse, 1, coarse->dirty);
  return any_rank(coarse, any);
}

/* Held unknowns do not reduce the largest eigenvalue of the finest level: its
 * bound is found once for each matrix. */
static void
prepare_finest(abut_multigrid *mg)
{
  mark_finest(mg, NULL, NULL, true);
  abut_multigrid_invert(mg, 0);
  abut_multigrid_bound(mg, 0, POWER_STEPS);
}

/* Make what depends on the rows of the finest level that are dirty. */
static abut_status
renew_coarse(abut_multigrid *mg, bool has_terms)
{
  for (int32_t l = 0; l + 1 < mg->n_levels; ++l)
  {
    if (!mark_coarse(mg, l))
      continue;
    const abut_status status = abut_galerkin_rows(mg, l);
    if (status != ABUT_SUCCESS)
      return abut_fail(mg->context, status, hold_call, "no memory");
    if (has_terms)
      abut_terms_rows(mg, l);
    abut_multigrid_invert(mg, l + 1);
    if (l + 2 < mg->n_levels && !mg->sweeps)
      abut_multigrid_bound(mg, l + 1, POWER_STEPS);
  }
  return ABUT_SUCCESS;
}

static bool
holds_numbers(const abut_multigrid *mg, const double *added)
{
  bool good = true;
  for (int64_t u = 0; added != NULL && u < n_own_rows(mg); ++u)
    good &= isfinite(added[u]) && added[u] >= 0;
  return good;
}

abut_status
abut_multigrid_set_constrained(abut_multigrid *mg, const uint8_t *held,
                               const double *added)
{
  if (mg == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (!mg->has_matrix)
    return abut_fail(mg->context, ABUT_INVALID_ARGUMENT, hold_call,
                     "there is no matrix yet");
  const bool good = holds_numbers(mg, added);
  if (any_rank(&mg->level[0], !good))
    return good ? abut_fail(mg->context, ABUT_FAILED_ELSEWHERE, hold_call,
                            "added values are wrong on another rank")
                : abut_fail(mg->context, ABUT_INVALID_ARGUMENT, hold_call,
                            "added values are negative or not finite");
  const bool first = !mg->is_ready;
  mg->is_ready = false;
  mg->n_renewed = 0;
  const bool has_terms = any_rank(&mg->level[0], mg->level[0].terms.n > 0);
  /* A sweep wants whole rows, and ranks have parts of them. */
  mg->sweeps = mg->block == 1 && !has_terms && mg->level[0].ranks == NULL;
  const bool is_prepared =
      !mg->sweeps && !has_terms && (first || mg->had_terms);
  if (is_prepared)
    prepare_finest(mg);
  mg->had_terms = has_terms;
  mark_finest(mg, held, added, first && !is_prepared);
  memset(mg->moved, 0, (size_t)mg->level[0].n);
  abut_multigrid_invert(mg, 0);
  if (first)
    memset(mg->level[0].dirty, 1, (size_t)mg->level[0].n);
  /* Eliminated unknowns have no stiffness left, and must be held here. */
  if (has_terms)
    abut_multigrid_bound(mg, 0, POWER_STEPS);
  abut_status status = renew_coarse(mg, has_terms);
  if (status == ABUT_SUCCESS)
    status = abut_multigrid_factorise(mg);
  mg->is_ready = status == ABUT_SUCCESS;
  return status;
}

static void
cycle(abut_multigrid *mg, int32_t l)
{
  abut_multigrid_level *level = &mg->level[l];
  if (l + 1 == mg->n_levels)
  {
    abut_multigrid_solve_coarsest(mg);
    return;
  }
  if (mg->sweeps)
  {
    abut_level_sweep_first(level);
    abut_level_sweep_restrict(level, &mg->level[l + 1]);
    cycle(mg, l + 1);
    abut_level_prolong(level, 1, &mg->level[l + 1]);
    abut_level_sweep_last(level);
    return;
  }
  abut_level_smooth_first(level, mg->block);
  abut_level_restrict(level, mg->block, &mg->level[l + 1]);
  cycle(mg, l + 1);
  abut_level_prolong(level, mg->block, &mg->level[l + 1]);
  abut_level_smooth_last(level, mg->block);
}

abut_status
abut_multigrid_cycle(abut_multigrid *mg, const double *r, double *x)
{
  static const char call[] = "abut_multigrid_cycle";
  if (mg == NULL)
    return ABUT_INVALID_ARGUMENT;
  const bool lacks_vector = n_own_rows(mg) > 0 && (r == NULL || x == NULL);
  if (!mg->is_ready || lacks_vector)
    return abut_fail(mg->context, ABUT_INVALID_ARGUMENT, call,
                     mg->is_ready
                         ? "a vector is NULL"
                         : "abut_multigrid_set_constrained() comes first");
  abut_multigrid_level *level = &mg->level[0];
  const int64_t first = (int64_t)level->first_own * mg->block;
  const int64_t end = (int64_t)level->end_own * mg->block;
  double size = 0;
  for (int64_t u = 0; u < end - first; ++u)
    size = fmax(size, fabs(r[u]));
  abut_level_reduce(level, ABUT_REDUCTION_MAX, &size, 1);
  const double scale = size > 0 ? 1 / size : 0;
  if (level->ranks != NULL)
    memset(level->r, 0, (size_t)level->n * (size_t)mg->block * sizeof(float));
  for (int64_t u = first; u < end; ++u)
    level->r[u] = level->held[u] ? 0 : (float)(scale * r[mg->unknown[u]]);
  abut_level_share(level, mg->block, level->r);
  cycle(mg, 0);
  for (int64_t u = first; u < end; ++u)
    x[mg->unknown[u]] = size * (double)level->x[u];
  return ABUT_SUCCESS;
}

abut_status
abut_multigrid_describe_sized(const abut_multigrid *mg,
                              abut_multigrid_report *report)
{
  if (mg == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_multigrid_report made;
  memset(&made, 0, sizeof(made));
  made.struct_size = sizeof(made);
  made.n_meshes = mg->n_levels;
  made.n_coarsest = mg->is_ready ? mg->factor.n : 0;
  made.n_renewed = mg->n_renewed;
  for (int32_t l = 0; l < mg->n_levels; ++l)
  {
    const abut_multigrid_level *level = &mg->level[l];
    if (mg->has_matrix)
      made.n_entries +=
          (level->upper != NULL ? level->upper : level->matrix.start)[level->n]
          * mg->block * mg->block;
    if (level->terms.n > 0)
      made.n_entries +=
          level->terms.rows.start[level->terms.n] * mg->block * mg->block;
    made.largest[l] = level->largest;
  }
  return report == NULL ? abut_fail(mg->context, ABUT_INVALID_ARGUMENT,
                                    "abut_multigrid_describe", "no report")
                        : abut_copy_out(mg->context, "abut_multigrid_describe",
                                        report, sizeof(made), &made);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Strategies on several ranks, played by threads: the same steps and numbers
 * as on one, and failures that all ranks share. */
#include "fixture.h"
#include "membrane.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum
{
  N_RANKS = 3, /* the last one has no rows */
  MAX_VALUES = 16
};

/* What the ranks share. Rank 0 owns the membrane; rows are dealt out to the
 * ranks 0 and 1 in turn. */
typedef struct world
{
  pthread_barrier_t barrier;
  double values[N_RANKS][MAX_VALUES];
  membrane *scene;
  const abut_strategy_options *options;
  /* Requests gathered over ranks. */
  double *p, *c, *a, *b, *dp, *dg, *gap;
  int bad_rank; /* reports a NaN gap, -1: none */
  abut_progress progress[N_RANKS];
  abut_reason reason[N_RANKS];
  abut_status start_status[N_RANKS];
} world;

typedef struct rank
{
  world *all;
  int number;
  int32_t n;
  int64_t *row; /* [n] rows of this rank */
} rank;

static abut_status
reduce(void *user, abut_reduction op, double *values, int32_t n)
{
  const rank *r = user;
  world *all = r->all;
  assert_true(n <= MAX_VALUES);
  memcpy(all->values[r->number], values, (size_t)n * sizeof(double));
  pthread_barrier_wait(&all->barrier);
  for (int32_t i = 0; i < n; ++i)
  {
    double result = all->values[0][i];
    for (int k = 1; k < N_RANKS; ++k)
      result = op == ABUT_REDUCTION_SUM ? result + all->values[k][i]
                                        : fmax(result, all->values[k][i]);
    values[i] = result;
  }
  pthread_barrier_wait(&all->barrier);
  return ABUT_SUCCESS;
}

static void
gather(const rank *r, const double *mine, double *all)
{
  for (int32_t i = 0; i < r->n; ++i)
    all[r->row[i]] = mine[i];
}

static void
scatter(const rank *r, const double *all, double *mine)
{
  for (int32_t i = 0; i < r->n; ++i)
    mine[i] = all[r->row[i]];
}

static abut_status
solve(void *user, const abut_request *request)
{
  const rank *r = user;
  world *all = r->all;
  gather(r, request->pressure, all->p);
  gather(r, request->residual, all->c);
  gather(r, request->d_pressure, all->a);
  gather(r, request->d_gap, all->b);
  pthread_barrier_wait(&all->barrier);
  if (r->number == 0)
  {
    abut_request whole = *request;
    whole.pressure = all->p;
    whole.residual = all->c;
    whole.d_pressure = all->a;
    whole.d_gap = all->b;
    whole.pressure_change = all->dp;
    whole.gap_change = all->dg;
    const abut_host host = membrane_host(all->scene);
    assert_ok(host.solve(host.user, &whole));
  }
  pthread_barrier_wait(&all->barrier);
  scatter(r, all->dp, request->pressure_change);
  scatter(r, all->dg, request->gap_change);
  return ABUT_SUCCESS;
}

static abut_status
move(void *user, const abut_request *request, double *gap)
{
  const rank *r = user;
  world *all = r->all;
  if (r->number == 0)
  {
    const abut_host host = membrane_host(all->scene);
    assert_ok(host.move(host.user, request, all->gap));
  }
  pthread_barrier_wait(&all->barrier);
  scatter(r, all->gap, gap);
  if (r->number == all->bad_rank && r->n > 0)
    gap[0] = NAN;
  return ABUT_SUCCESS;
}

/* One rank's program. */
static void *
play(void *argument)
{
  rank *r = argument;
  world *all = r->all;
  const membrane *scene = all->scene;
  double *numbers = calloc((size_t)r->n * 3 + 1, sizeof(double));
  double *weight = numbers, *stiffness = weight + r->n, *gap = stiffness + r->n;
  scatter(r, scene->weight, weight);
  scatter(r, scene->stiffness, stiffness);
  for (int32_t i = 0; i < r->n; ++i)
    gap[i] = -scene->psi[r->row[i]];
  /* A wrong weight on one rank is every rank's failure. */
  const bool spoil = all->bad_rank == -2 && r->number == 1;
  if (spoil)
    weight[0] = -1;
  abut_strategy_options options = *all->options;
  options.reduce = reduce;
  options.user = r;
  const abut_host host = {sizeof(host), r, solve, move, NULL};
  abut_context *context = fixture_context();
  abut_strategy *strategy = NULL;
  assert_ok(abut_strategy_create(context, &options, &strategy));
  const abut_status status = abut_strategy_start(
      strategy, r->n, r->row, weight, stiffness, NULL, gap, NULL, NULL);
  all->start_status[r->number] = status;
  if (status == ABUT_SUCCESS)
  {
    assert_ok(abut_strategy_run(strategy, &host, &all->reason[r->number]));
    assert_ok(abut_strategy_progress(strategy, &all->progress[r->number]));
  }
  assert_ok(abut_strategy_destroy(&strategy));
  assert_ok(abut_context_destroy(&context));
  free(numbers);
  return NULL;
}

/* Play all ranks to their end. */
static void
play_all(world *all)
{
  const size_t n = (size_t)all->scene->n;
  double *block = calloc(7 * n, sizeof(double));
  double **arrays[] = {&all->p,  &all->c,  &all->a,  &all->b,
                       &all->dp, &all->dg, &all->gap};
  for (size_t k = 0; k < 7; ++k)
    *arrays[k] = block + k * n;
  int64_t *rows = calloc(2 * n, sizeof(int64_t));
  rank ranks[N_RANKS] = {
      {all, 0, 0, rows}, {all, 1, 0, rows + n}, {all, 2, 0, NULL}};
  for (int32_t i = 0; i < all->scene->n; ++i)
  {
    rank *owner = &ranks[i % 2];
    owner->row[owner->n++] = i;
  }
  pthread_t threads[N_RANKS];
  assert_int_equal(pthread_barrier_init(&all->barrier, NULL, N_RANKS), 0);
  for (int k = 0; k < N_RANKS; ++k)
    assert_int_equal(pthread_create(&threads[k], NULL, play, &ranks[k]), 0);
  for (int k = 0; k < N_RANKS; ++k)
    assert_int_equal(pthread_join(threads[k], NULL), 0);
  pthread_barrier_destroy(&all->barrier);
  free(rows);
  free(block);
}

static void
ranks_do_what_one_does(void **unused)
{
  (void)unused;
  abut_context *context = fixture_context();
  const abut_law *law;
  for (int32_t i = 0; (law = abut_law_get(i)) != NULL; ++i)
  {
    membrane serial = membrane_create(4, 1, 1),
             parallel = membrane_create(4, 1, 1);
    const abut_strategy_options options = membrane_options(&serial, law->name);
    abut_progress progress;
    assert_int_equal(membrane_run(context, &serial, &options, false, &progress),
                     ABUT_REASON_CONVERGED);
    world all = {.scene = &parallel, .options = &options, .bad_rank = -1};
    play_all(&all);
    for (int k = 0; k < N_RANKS; ++k)
    {
      assert_int_equal(all.reason[k], ABUT_REASON_CONVERGED);
      assert_int_equal(all.progress[k].step, progress.step);
      assert_int_equal(all.progress[k].outer, progress.outer);
      assert_int_equal(all.progress[k].n_rows, progress.n_rows);
      assert_int_equal(all.progress[k].n_active, progress.n_active);
      assert_int_equal(all.progress[k].n_changes, 0);
      assert_close(all.progress[k].penetration, progress.penetration, 1e-12);
      if (progress.pressure_change > 0)
        assert_close(all.progress[k].pressure_change / progress.pressure_change,
                     1, 1e-6);
    }
    assert_close(membrane_energy(&parallel), membrane_energy(&serial), 1e-12);
    membrane_destroy(&serial);
    membrane_destroy(&parallel);
  }
  assert_ok(abut_context_destroy(&context));
}

static void
one_ranks_nan_stops_all(void **unused)
{
  (void)unused;
  membrane scene = membrane_create(3, 1, 1);
  const abut_strategy_options options = membrane_options(&scene, "lagrange");
  world all = {.scene = &scene, .options = &options, .bad_rank = 1};
  play_all(&all);
  for (int k = 0; k < N_RANKS; ++k)
    assert_int_equal(all.reason[k], ABUT_REASON_NOT_FINITE);
  membrane_destroy(&scene);
}

static void
one_ranks_mistake_is_everybodys(void **unused)
{
  (void)unused;
  membrane scene = membrane_create(3, 1, 1);
  const abut_strategy_options options = membrane_options(&scene, "lagrange");
  world all = {.scene = &scene, .options = &options, .bad_rank = -2};
  play_all(&all);
  for (int k = 0; k < N_RANKS; ++k)
    assert_int_equal(all.start_status[k],
                     k == 1 ? ABUT_INVALID_ARGUMENT : ABUT_FAILED_ELSEWHERE);
  membrane_destroy(&scene);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ranks_do_what_one_does),
      cmocka_unit_test(one_ranks_nan_stops_all),
      cmocka_unit_test(one_ranks_mistake_is_everybodys),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Friction on several ranks, played by threads: points are dealt out, the last
 * rank has none, and all take the steps that one takes, the cures for sets that
 * come back among them. */
#include "base/dense_lu.h"
#include "fixture.h"
#include "frictional.h"

#include <pthread.h>
#include <string.h>

enum
{
  N_RANKS = 3,
  MAX_VALUES = 32,
  SYSTEM = 2 * FRICTIONAL_SIZE
};

/* What the ranks share; rank 0 solves. Rows are those of the whole problem. */
typedef struct world
{
  pthread_barrier_t barrier;
  const frictional *problem;
  double values[N_RANKS][MAX_VALUES];
  double u[FRICTIONAL_SIZE], p[FRICTIONAL_SIZE], c[FRICTIONAL_SIZE];
  double a[3 * FRICTIONAL_SIZE], b[3 * FRICTIONAL_SIZE];
  double x[SYSTEM];
  abut_progress progress[N_RANKS];
  abut_reason reason[N_RANKS];
} world;

typedef struct rank
{
  world *all;
  int number;
} rank;

/* Points are dealt to ranks 0 and 1 in turn. */
static int32_t
n_points(const rank *r)
{
  return r->number > 1 ? 0 : (r->all->problem->n_points + 1 - r->number) / 2;
}

static int32_t
point_of(const rank *r, int32_t i)
{
  return 2 * i + r->number;
}

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

/* Copy [size] numbers of each point from the rank's array to the world's. */
static void
gather(const rank *r, int32_t size, const double *mine, double *all)
{
  for (int32_t i = 0; i < n_points(r); ++i)
    memcpy(all + point_of(r, i) * size, mine + i * size,
           (size_t)size * sizeof(double));
}

/* -1 for the normal, 1 for tangents: the direction in which the row's force
 * acts on its unknown, and the derivative of the row's gap by it. */
static double
sign(const frictional *problem, int32_t row)
{
  return row % problem->dimension == 0 ? -1 : 1;
}

static void
assemble(const world *all, double *matrix)
{
  const frictional *problem = all->problem;
  const int32_t n = problem->n, size = 2 * n, dim = problem->dimension;
  memset(matrix, 0, sizeof(double) * (size_t)(size * size));
  for (int32_t i = 0; i < n; ++i)
  {
    for (int32_t j = 0; j < n; ++j)
      matrix[i * size + j] = problem->stiffness[i * n + j];
    matrix[i * size + n + i] = -sign(problem, i);
    const int32_t first = i / dim * dim;
    for (int32_t k = 0; k < dim; ++k)
    {
      matrix[(n + i) * size + first + k] =
          all->b[i * dim + k] * sign(problem, k);
      matrix[(n + i) * size + n + first + k] = all->a[i * dim + k];
    }
  }
}

static void
solve_all(world *all)
{
  const frictional *problem = all->problem;
  const int32_t n = problem->n;
  double matrix[SYSTEM * SYSTEM], scale[SYSTEM];
  int32_t pivot[SYSTEM];
  assemble(all, matrix);
  for (int32_t i = 0; i < n; ++i)
  {
    all->x[i] = problem->force[i] + sign(problem, i) * all->p[i];
    for (int32_t j = 0; j < n; ++j)
      all->x[i] -= problem->stiffness[i * n + j] * all->u[j];
    all->x[n + i] = -all->c[i];
  }
  assert_true(abut_dense_lu_factorise(2 * n, matrix, pivot, scale));
  abut_dense_lu_solve(2 * n, matrix, pivot, scale, all->x);
}

static abut_status
solve(void *user, const abut_request *request)
{
  const rank *r = user;
  world *all = r->all;
  const int32_t dim = all->problem->dimension;
  gather(r, dim, request->pressure, all->p);
  gather(r, dim, request->residual, all->c);
  gather(r, dim * dim, request->d_pressure, all->a);
  gather(r, dim * dim, request->d_gap, all->b);
  pthread_barrier_wait(&all->barrier);
  if (r->number == 0)
    solve_all(all);
  pthread_barrier_wait(&all->barrier);
  for (int32_t i = 0; i < n_points(r); ++i)
    for (int32_t k = 0; k < dim; ++k)
    {
      const int32_t row = point_of(r, i) * dim + k;
      request->gap_change[i * dim + k] = sign(all->problem, k) * all->x[row];
      request->pressure_change[i * dim + k] = all->x[all->problem->n + row];
    }
  return ABUT_SUCCESS;
}

static void
find_gaps(const rank *r, double *gap)
{
  const frictional *problem = r->all->problem;
  const int32_t dim = problem->dimension;
  for (int32_t i = 0; i < n_points(r); ++i)
    for (int32_t k = 0; k < dim; ++k)
      gap[i * dim + k] =
          (k == 0 ? problem->gap[point_of(r, i)] : 0)
          + sign(problem, k) * r->all->u[point_of(r, i) * dim + k];
}

static abut_status
move(void *user, const abut_request *request, double *gap)
{
  const rank *r = user;
  world *all = r->all;
  for (int32_t i = 0; i < all->problem->n && r->number == 0; ++i)
    all->u[i] += request->step_length * all->x[i];
  pthread_barrier_wait(&all->barrier);
  find_gaps(r, gap);
  return ABUT_SUCCESS;
}

/* Rows and friction of a rank, and its run. */
static void *
play(void *argument)
{
  rank *r = argument;
  const frictional *problem = r->all->problem;
  const int32_t n = n_points(r), dim = problem->dimension;
  int32_t first[FRICTIONAL_POINTS];
  uint8_t n_tangents[FRICTIONAL_POINTS];
  int64_t id[FRICTIONAL_SIZE];
  double ones[FRICTIONAL_SIZE], stiffness[FRICTIONAL_SIZE];
  double gap[FRICTIONAL_SIZE], coefficient[FRICTIONAL_POINTS];
  for (int32_t i = 0; i < n; ++i)
  {
    first[i] = i * dim;
    n_tangents[i] = (uint8_t)(dim - 1);
    coefficient[i] = problem->coefficient[point_of(r, i)];
    for (int32_t k = 0; k < dim; ++k)
    {
      const int32_t row = point_of(r, i) * dim + k;
      id[i * dim + k] = row;
      ones[i * dim + k] = 1;
      stiffness[i * dim + k] = problem->stiffness[row * (problem->n + 1)];
    }
  }
  find_gaps(r, gap);
  abut_strategy_options options = exact_options();
  options.reduce = reduce;
  options.user = r;
  options.max_steps = 2000;
  const abut_strategy_friction friction = {
      .struct_size = sizeof(friction),
      .n = n,
      .first = first,
      .n_tangents = n_tangents,
      .coefficient = coefficient,
  };
  const abut_host host = {sizeof(host), r, solve, move, NULL};
  abut_context *context = fixture_context();
  abut_strategy *strategy = NULL;
  assert_ok(abut_strategy_create(context, &options, &strategy));
  assert_ok(abut_strategy_set_friction(strategy, &friction));
  assert_ok(abut_strategy_start(strategy, n * dim, id, ones, stiffness, NULL,
                                gap, NULL, NULL));
  assert_ok(abut_strategy_run(strategy, &host, &r->all->reason[r->number]));
  assert_ok(abut_strategy_progress(strategy, &r->all->progress[r->number]));
  assert_ok(abut_strategy_destroy(&strategy));
  assert_ok(abut_context_destroy(&context));
  return NULL;
}

static void
play_all(world *all)
{
  rank ranks[N_RANKS];
  pthread_t threads[N_RANKS];
  assert_int_equal(pthread_barrier_init(&all->barrier, NULL, N_RANKS), 0);
  for (int k = 0; k < N_RANKS; ++k)
  {
    ranks[k] = (rank){all, k};
    assert_int_equal(pthread_create(&threads[k], NULL, play, &ranks[k]), 0);
  }
  for (int k = 0; k < N_RANKS; ++k)
    assert_int_equal(pthread_join(threads[k], NULL), 0);
  pthread_barrier_destroy(&all->barrier);
}

static void
compare(const frictional *problem, const frictional_answer *serial)
{
  static world all;
  memset(&all, 0, sizeof(all));
  all.problem = problem;
  play_all(&all);
  for (int k = 0; k < N_RANKS; ++k)
  {
    const abut_progress *progress = &all.progress[k];
    assert_int_equal(all.reason[k], serial->reason);
    assert_int_equal(progress->friction_rung, serial->progress.friction_rung);
    assert_int_equal(progress->step, serial->progress.step);
    assert_int_equal(progress->n_rows, problem->n_points);
    assert_int_equal(progress->n_active, serial->progress.n_active);
    assert_int_equal(progress->n_slipping, serial->progress.n_slipping);
  }
  for (int32_t i = 0; i < problem->n; ++i)
    assert_close(all.u[i], serial->u[i], 1e-9);
}

static void
ranks_do_what_one_does(void **unused)
{
  (void)unused;
  const frictional_ranges ranges = {{1, 4}, {10, 1000}};
  abut_strategy_options options = exact_options();
  options.max_steps = 2000;
  int32_t rungs[5] = {0};
  for (int32_t dimension = 2; dimension <= 3; ++dimension)
  {
    uint64_t seed = 1;
    for (int i = 0; i < 40; ++i)
    {
      abut_context *context = fixture_context();
      const frictional problem = frictional_draw(dimension, &ranges, &seed);
      frictional_answer serial;
      memset(&serial, 0, sizeof(serial));
      frictional_solve(context, &problem, &options, false, &serial);
      assert_ok(serial.status);
      compare(&problem, &serial);
      rungs[serial.progress.friction_rung] += 1;
      assert_ok(abut_context_destroy(&context));
    }
  }
  assert_true(rungs[0] > 50 && rungs[1] > 0 && rungs[2] + rungs[3] > 0);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ranks_do_what_one_does),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

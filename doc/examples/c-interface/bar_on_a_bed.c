/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Friction with load steps from C, without deal.II: a bar of stiffness EA = 1
 * and length 1 lies on a bed with friction q = 1 per length, mu = 0.5 times a
 * pressing force of 2. Its end is pulled by F = 0.5, let go, and pushed: by
 * theory it is then at F^2/(2 EA q) = 0.125, F^2/(4 EA q) = 0.0625 and -0.125.
 * Compile it with
 *     cc $(pkg-config --cflags abut_core) bar_on_a_bed.c -o bar_on_a_bed \
 *        $(pkg-config --libs abut_core) -lm
 */
#include <abut/abut.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum
{
  NODES = 33, /* of 32 linear elements; unknowns of each: along, towards bed */
  N = 2 * NODES
};

static abut_context *context;
static abut_history *history;
static double stiffness[N][N], force[N], weight[NODES];
static double u[N], accepted[N]; /* displacements, now and at the last step */

static void
require(abut_status status)
{
  if (status == ABUT_SUCCESS)
    return;
  fprintf(stderr, "%s: %s\n", abut_status_text(status),
          abut_context_message(context));
  exit(1);
}

static void
set_up(void)
{
  const double h = 1. / (NODES - 1),
               k[2][2] = {{1 / h, -1 / h}, {-1 / h, 1 / h}};
  for (int i = 0; i < NODES; ++i)
  {
    weight[i] = i == 0 || i == NODES - 1 ? h / 2 : h;
    stiffness[2 * i + 1][2 * i + 1] = 1; /* of no matter: the bed is rigid */
    force[2 * i + 1] = 2 * weight[i];
    for (int a = 0; a < 2 && i > 0; ++a)
      for (int b = 0; b < 2; ++b)
        stiffness[2 * (i - 1 + a)][2 * (i - 1 + b)] += k[a][b];
  }
}

/* A point for each node: normal towards the bed, tangent along the bar, whose
 * slip counts from the last accepted step. */
static abut_points *
make_points(void)
{
  const double frame[4] = {0, 1, 1, 0}, one = 1;
  abut_points *points = NULL;
  require(abut_points_create(context, 2, &points));
  for (int32_t i = 0; i < NODES; ++i)
  {
    const double gap[2] = {0, -accepted[2 * i]};
    abut_point point = abut_point_defaults();
    point.id = 2 * i;
    point.n_components = 2;
    point.weight = weight[i];
    point.frame = frame;
    point.gap = gap;
    point.n_nodes = point.n_secondary = 1;
    point.node = &i;
    point.coefficient = &one;
    require(abut_points_append(points, &point));
  }
  return points;
}

/* One load step, from what the history remembers. */
static void
take_step(double end_force)
{
  int64_t id[N];
  int32_t first[NODES];
  uint8_t n_tangents[NODES], state[N], found[N];
  double mu[NODES], p[N], traction[NODES];
  for (int i = 0; i < N; ++i)
    id[i] = i;
  const abut_history_values past = {sizeof(past), p, state, found};
  require(abut_history_get(history, ABUT_HISTORY_COMMITTED, N, id, &past));
  for (int i = 0; i < NODES; ++i)
  {
    first[i] = 2 * i;
    n_tangents[i] = 1;
    mu[i] = 0.5;
    traction[i] = p[2 * i + 1];
    if (!found[2 * i]) /* the first step: the bar rests on its bed */
      state[2 * i] = state[2 * i + 1] = ABUT_STATE_CLOSED;
  }
  abut_strategy_friction friction = {.struct_size = sizeof(friction)};
  friction.n = NODES;
  friction.first = first;
  friction.n_tangents = n_tangents;
  friction.coefficient = mu;
  friction.reference_traction = traction; /* only springs of penalties look */
  force[0] = end_force;
  abut_points *points = make_points();
  const abut_dense_model model = {sizeof(model), N,      &stiffness[0][0],
                                  force,         points, &friction};
  const abut_strategy_options options = abut_strategy_defaults();
  abut_reason reason = ABUT_REASON_NONE;
  require(abut_dense_model_solve(context, &model, &options, u, p, state, NULL,
                                 NULL, NULL, &reason));
  require(abut_points_destroy(&points));
  if (reason != ABUT_REASON_CONVERGED) /* a program of one's own rolls back */
  {
    fprintf(stderr, "%s\n", abut_reason_text(reason));
    exit(1);
  }
  const abut_history_entries entries = {sizeof(entries), N, id, p, state, NULL};
  require(abut_history_begin_step(history));
  require(abut_history_set(history, &entries));
  require(abut_history_commit(history));
  for (int i = 0; i < N; ++i)
    accepted[i] = u[i];
}

int
main(void)
{
  const double end[] = {0.5, 0, -0.5}, expected[] = {0.125, 0.0625, -0.125};
  double worst = 0;
  require(abut_context_create(NULL, &context));
  require(abut_history_create(context, &history));
  set_up();
  for (int leg = 0; leg < 3; ++leg)
  {
    const double start = force[0];
    for (int step = 1; step <= 4; ++step)
    {
      take_step(start + (end[leg] - start) * step / 4);
      printf("force %6.3f  end at %9.6f\n", force[0], u[0]);
    }
    worst = fmax(worst, fabs(u[0] - expected[leg]));
  }
  printf("largest difference from theory: %.1e\n", worst);
  require(abut_history_destroy(&history));
  require(abut_context_destroy(&context));
  return worst < 1e-10 ? 0 : 1;
}

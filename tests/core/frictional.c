/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "frictional.h"

#include <math.h>
#include <string.h>

/* The generator of fixture.h, which needs cmocka. */
static double
uniform(uint64_t *seed)
{
  *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (double)(*seed >> 11) / 9007199254740992.0;
}

static double
normal(uint64_t *seed)
{
  const double r = sqrt(-2 * log(1 - uniform(seed)));
  return r * cos(6.283185307179586 * uniform(seed));
}

static double
between(const double range[2], uint64_t *seed)
{
  return range[0] * pow(range[1] / range[0], uniform(seed));
}

/* Orthonormal rows by Gram and Schmidt. */
static void
draw_basis(int32_t n, uint64_t *seed, double *q)
{
  for (int32_t i = 0; i < n * n; ++i)
    q[i] = normal(seed);
  for (int32_t i = 0; i < n; ++i)
  {
    double length = 0;
    for (int32_t j = 0; j < i; ++j)
    {
      double along = 0;
      for (int32_t k = 0; k < n; ++k)
        along += q[i * n + k] * q[j * n + k];
      for (int32_t k = 0; k < n; ++k)
        q[i * n + k] -= along * q[j * n + k];
    }
    for (int32_t k = 0; k < n; ++k)
      length += q[i * n + k] * q[i * n + k];
    for (int32_t k = 0; k < n; ++k)
      q[i * n + k] /= sqrt(length);
  }
}

/* Eigenvalues 1 .. condition, evenly in the logarithm. */
static void
draw_stiffness(frictional *problem, uint64_t *seed)
{
  const int32_t n = problem->n;
  double q[FRICTIONAL_SIZE * FRICTIONAL_SIZE];
  draw_basis(n, seed, q);
  for (int32_t m = 0; m < n; ++m)
  {
    const double value = pow(problem->condition, (double)m / (n - 1));
    for (int32_t i = 0; i < n; ++i)
      for (int32_t j = 0; j < n; ++j)
        problem->stiffness[i * n + j] += value * q[m * n + i] * q[m * n + j];
  }
}

frictional
frictional_draw(int32_t dimension, const frictional_ranges *ranges,
                uint64_t *seed)
{
  frictional problem;
  memset(&problem, 0, sizeof(problem));
  problem.dimension = dimension;
  problem.n_points = 2 + (int32_t)(4 * uniform(seed));
  problem.n = problem.n_points * dimension;
  problem.condition = between(ranges->condition, seed);
  draw_stiffness(&problem, seed);
  for (int32_t i = 0; i < problem.n; ++i)
    problem.force[i] = normal(seed) * sqrt(problem.condition);
  for (int32_t i = 0; i < problem.n_points; ++i)
  {
    problem.coefficient[i] = between(ranges->coefficient, seed);
    problem.cap[i] = INFINITY;
    problem.gap[i] = 0.3 * normal(seed);
  }
  return problem;
}

void
frictional_start(const frictional *problem, uint64_t *seed,
                 frictional_answer *answer)
{
  memset(answer, 0, sizeof(*answer));
  for (int32_t i = 0; i < problem->n; ++i)
  {
    answer->u[i] = normal(seed);
    answer->p[i] = sqrt(problem->condition) * normal(seed);
  }
  for (int32_t i = 0; i < problem->n_points && i < FRICTIONAL_POINTS; ++i)
    answer->state[i * problem->dimension] = (uint8_t)(3 * uniform(seed));
}

static abut_status
append_points(const frictional *problem, abut_points *points)
{
  const int32_t dim = problem->dimension;
  const double one = 1;
  double frame[9] = {0};
  for (int32_t d = 0; d < dim; ++d)
    frame[d * dim + d] = 1;
  abut_status status = ABUT_SUCCESS;
  for (int32_t i = 0; i < problem->n_points && status == ABUT_SUCCESS; ++i)
  {
    const double gap[3] = {problem->gap[i], 0, 0};
    abut_point point = abut_point_defaults();
    point.id = (int64_t)i * dim;
    point.n_components = i < problem->n_plain ? 1 : dim;
    point.frame = frame;
    point.gap = gap;
    point.n_nodes = point.n_secondary = 1;
    point.node = &i;
    point.coefficient = &one;
    status = abut_points_append(points, &point);
  }
  return status;
}

void
frictional_solve(abut_context *context, const frictional *problem,
                 const abut_strategy_options *options, bool from_state,
                 frictional_answer *answer)
{
  int32_t first[FRICTIONAL_POINTS];
  uint8_t n_tangents[FRICTIONAL_POINTS];
  const int32_t n_plain = problem->n_plain;
  for (int32_t i = 0; i < problem->n_points - n_plain; ++i)
  {
    first[i] = n_plain + i * problem->dimension;
    n_tangents[i] = (uint8_t)(problem->dimension - 1);
  }
  abut_strategy_friction friction = {.struct_size = sizeof(friction)};
  friction.n = problem->n_points - n_plain;
  friction.first = first;
  friction.n_tangents = n_tangents;
  friction.coefficient = problem->coefficient + n_plain;
  friction.cap = problem->cap + n_plain;
  friction.law = problem->law;
  friction.parameters = problem->parameters;
  abut_points *points = NULL;
  answer->status = abut_points_create(context, problem->dimension, &points);
  if (answer->status == ABUT_SUCCESS)
    answer->status = append_points(problem, points);
  const abut_dense_model model = {
      sizeof(model),  problem->n, problem->stiffness,
      problem->force, points,     friction.n == 0 ? NULL : &friction};
  if (answer->status == ABUT_SUCCESS)
    answer->status =
        abut_dense_model_solve(context, &model, options, answer->u, answer->p,
                               from_state ? answer->state : NULL, NULL, NULL,
                               &answer->progress, &answer->reason);
  abut_points_destroy(&points);
}

/* Of Signorini's and Coulomb's laws at one point. */
static double
violation_at(const frictional *problem, int32_t i, const double *u,
             const double *p)
{
  const int32_t dim = problem->dimension, row = i * dim;
  double traction = 0, slip = 0, power = 0;
  for (int32_t k = row + 1; k < row + dim; ++k)
  {
    traction += p[k] * p[k];
    slip += u[k] * u[k];
    power += p[k] * u[k];
  }
  const double bound =
      fmin(problem->coefficient[i] * fmax(p[row], 0), problem->cap[i]);
  const double signorini = fabs(fmin(p[row], problem->gap[i] - u[row]));
  const double disc = sqrt(traction) - bound;
  /* tau.s = -rho |s|: against the slip and at the bound, or no slip. */
  const double against = fabs(power + bound * sqrt(slip));
  return fmax(signorini, fmax(disc, against));
}

double
frictional_violation(const frictional *problem, const double *u,
                     const double *p)
{
  const int32_t n = problem->n;
  double worst = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    const double contact = i % problem->dimension == 0 ? -p[i] : p[i];
    double rest = -problem->force[i] - contact;
    for (int32_t j = 0; j < n; ++j)
      rest += problem->stiffness[i * n + j] * u[j];
    worst = fmax(worst, fabs(rest));
  }
  for (int32_t i = 0; i < problem->n_points; ++i)
    worst = fmax(worst, violation_at(problem, i, u, p));
  return worst;
}

bool
frictional_same(const frictional *problem, const frictional_answer *a,
                const frictional_answer *b)
{
  double size = 0, difference = 0;
  for (int32_t i = 0; i < problem->n; ++i)
  {
    size = fmax(size, fmax(fabs(a->u[i]), fabs(a->p[i])));
    difference = fmax(difference,
                      fmax(fabs(a->u[i] - b->u[i]), fabs(a->p[i] - b->p[i])));
  }
  return difference <= 1e-6 * size;
}

/* Number of different answers among n. */
static int32_t
count_different(const frictional *problem, const frictional_answer *answer,
                int32_t n)
{
  int32_t different = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    bool is_new = true;
    for (int32_t j = 0; j < i && is_new; ++j)
      is_new = !frictional_same(problem, &answer[i], &answer[j]);
    different += is_new;
  }
  return different;
}

static bool
is_found(const frictional_answer *answer)
{
  return answer->status == ABUT_SUCCESS
         && answer->reason == ABUT_REASON_CONVERGED;
}

static void
count_run(frictional_count *count, const frictional *problem,
          const frictional_answer *answer)
{
  count->n_runs += 1;
  if (!is_found(answer))
  {
    count->n_lost += 1;
    return;
  }
  const int32_t steps = answer->progress.step;
  count->cured[answer->progress.friction_rung] += 1;
  count->mean_steps += steps;
  count->most_steps = steps > count->most_steps ? steps : count->most_steps;
  count->worst_violation =
      fmax(count->worst_violation,
           frictional_violation(problem, answer->u, answer->p));
}

frictional_count
frictional_survey(int32_t dimension, const frictional_ranges *ranges, int32_t n,
                  int32_t starts, uint64_t seed)
{
  frictional_count count;
  memset(&count, 0, sizeof(count));
  count.n_problems = n;
  abut_context *context = NULL;
  if (abut_context_create(NULL, &context) != ABUT_SUCCESS)
    return count;
  abut_strategy_options options = abut_strategy_defaults();
  options.linear_tolerance = options.final_linear_tolerance;
  options.max_steps = 2000;
  options.max_outer = 1000;
  for (int32_t i = 0; i < n; ++i)
  {
    const frictional problem = frictional_draw(dimension, ranges, &seed);
    frictional_answer found[FRICTIONAL_STARTS + 1];
    int32_t n_found = 0;
    for (int32_t run = 0; run <= starts; ++run)
    {
      frictional_answer answer;
      memset(&answer, 0, sizeof(answer));
      if (run > 0)
        frictional_start(&problem, &seed, &answer);
      frictional_solve(context, &problem, &options, run > 0, &answer);
      count_run(&count, &problem, &answer);
      if (is_found(&answer))
        found[n_found++] = answer;
    }
    count.answers[count_different(&problem, found, n_found)] += 1;
  }
  const int32_t n_answers = count.n_runs - count.n_lost;
  count.mean_steps /= n_answers > 0 ? n_answers : 1;
  abut_context_destroy(&context);
  return count;
}

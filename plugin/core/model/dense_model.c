/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A host with a dense matrix: each SOLVE factorises
 *
 *     [ K    -B'W ] [du]   [-R]
 *     [ b B     a ] [dp] = [-c]
 *
 * as it stands, so that K may be singular as long as the active constraints
 * hold the body; a and b are diagonal but for blocks of points with friction.
 */
#include "base/dense_lu.h"
#include "base/memory.h"

#include <abut/dense_model.h>
#include <math.h>
#include <string.h>

static const char call[] = "abut_dense_model_solve";

enum
{
  MAX_SIZE = 5000 /* unknowns and components together: 200 MB */
};

typedef struct dense_host
{
  abut_context *context;
  const abut_dense_model *model;
  abut_points_view points;
  int32_t n, m; /* unknowns, components of points */
  double *u;    /* [n] displacement, the caller's */
  double *p;    /* [m] pressure, the caller's */
  abut_dense_monitor monitor;
  void *user;
  abut_array block, pivots;
  double *matrix, *scale, *x; /* [(n+m)^2], [n+m], [n+m] */
  double *gap, *stiffness;    /* [m] */
  double *b;                  /* [m * n] B = dg/du */
  int32_t *pivot;             /* [n+m] */
  bool singular, slips; /* the last matrix is singular, with points that slip */
} dense_host;

static abut_status
check_model(abut_context *context, const abut_dense_model *model)
{
  if (model->n < 1 || model->stiffness == NULL || model->force == NULL
      || model->points == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "the model is incomplete");
  if (model->n > MAX_SIZE)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "the model is too large for a dense matrix");
  double probe = 0;
  for (int64_t k = 0; k < (int64_t)model->n * model->n; ++k)
    probe += model->stiffness[k] * 0.0;
  for (int32_t i = 0; i < model->n; ++i)
    probe += model->force[i] * 0.0;
  return probe == 0 ? ABUT_SUCCESS
                    : abut_fail(context, ABUT_NOT_FINITE, call,
                                "stiffness or force is not finite");
}

static abut_status
place_arrays(dense_host *host)
{
  const int64_t size = (int64_t)host->n + host->m;
  host->block.element = sizeof(double);
  host->pivots.element = sizeof(int32_t);
  abut_status status = abut_array_reserve(
      host->context, &host->block, 0,
      size * size + 2 * size + (int64_t)host->m * (host->n + 2));
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(host->context, &host->pivots, 0, size);
  if (status != ABUT_SUCCESS)
    return status;
  host->matrix = host->block.data;
  host->scale = host->matrix + size * size;
  host->x = host->scale + size;
  host->gap = host->x + size;
  host->stiffness = host->gap + host->m;
  host->b = host->stiffness + host->m;
  host->pivot = host->pivots.data;
  return ABUT_SUCCESS;
}

/* The rows of B, one for each component of a point. */
static void
fill_rows(dense_host *host)
{
  const abut_points_view *v = &host->points;
  const int32_t dim = v->dimension;
  memset(host->b, 0, sizeof(double) * (size_t)host->m * (size_t)host->n);
  for (int32_t i = 0; i < v->n_points; ++i)
    for (int32_t c = v->component_start[i]; c < v->component_start[i + 1]; ++c)
    {
      const double sign =
          abut_point_sign(v->kind[i], c - v->component_start[i]);
      double *row = host->b + (int64_t)c * host->n;
      for (int64_t e = v->start[i]; e < v->start[i + 1]; ++e)
        for (int32_t d = 0; d < dim; ++d)
          row[v->node[e] * dim + d] +=
              sign * v->frame[c * dim + d] * v->coefficient[e];
    }
}

/* Stiffness that row i sees, as pressure per length: sum B^2 K_kk over
 * (sum B^2)^2 w. Exact for one unknown, and of the right size and units for
 * several. */
static double
stiffness_of_row(const dense_host *host, int32_t i)
{
  const double *row = host->b + (int64_t)i * host->n;
  double squares = 0, stiffness = 0;
  for (int32_t j = 0; j < host->n; ++j)
  {
    squares += row[j] * row[j];
    stiffness +=
        row[j] * row[j] * host->model->stiffness[j * (host->n + (int64_t)1)];
  }
  return stiffness / (squares * squares * host->points.component_weight[i]);
}

static abut_status
find_stiffness(dense_host *host)
{
  const abut_points_view *points = &host->points;
  for (int32_t point = 0; point < points->n_points; ++point)
  {
    const int32_t first = points->component_start[point];
    for (int32_t i = first; i < points->component_start[point + 1]; ++i)
    {
      const double stiffness = stiffness_of_row(host, i);
      /* A body may be free along a tangent. */
      host->stiffness[i] =
          i > first && !(stiffness > 0) ? host->stiffness[first] : stiffness;
      if (isfinite(host->stiffness[i]) && host->stiffness[i] > 0)
        continue;
      abut_text text = abut_fail_begin(host->context, call);
      abut_text_add(&text, "point ");
      abut_text_add_integer(&text, points->component_id[i]);
      abut_text_add(&text, " acts on no unknown with positive stiffness");
      return ABUT_INVALID_ARGUMENT;
    }
  }
  return ABUT_SUCCESS;
}

/* Unit of pressures. A stiffness of 1e13, such as mass by the square of a short
 * time, looks singular compared with the ones of B: there it is the largest
 * stiffness, so that all unknowns are lengths. Else it is 1: matrices that
 * friction makes nearly singular are sensitive to their pivots. */
static double
pressure_unit(const dense_host *host)
{
  static const double ordinary = 1e6;
  double largest = 0;
  for (int32_t i = 0; i < host->m; ++i)
    largest = fmax(largest, host->stiffness[i]);
  return largest > ordinary || largest * ordinary < 1 ? largest : 1;
}

/* Add a block of the laws, k rows from @p first on. */
static void
add_block(dense_host *host, int32_t first, int32_t k, double unit,
          const double *a, const double *b)
{
  const int64_t n = host->n, size = n + host->m;
  for (int32_t r = 0; r < k; ++r)
    for (int32_t c = 0; c < k; ++c)
    {
      double *row = host->matrix + (n + first + r) * size;
      const double *gap = host->b + (first + c) * n;
      row[n + first + c] = a[r * k + c] * unit;
      for (int64_t j = 0; j < n && b[r * k + c] != 0; ++j)
        row[j] += b[r * k + c] * gap[j];
    }
}

/* The matrix of the head comment, with pressures in their unit. */
static void
assemble(dense_host *host, const abut_request *request)
{
  const int64_t n = host->n, size = n + host->m;
  const double *weight = host->points.component_weight;
  const double unit = host->m > 0 ? pressure_unit(host) : 1;
  memset(host->matrix, 0, (size_t)(size * size) * sizeof(double));
  for (int64_t i = 0; i < n; ++i)
    memcpy(host->matrix + i * size, host->model->stiffness + i * n,
           (size_t)n * sizeof(double));
  for (int32_t i = 0; i < host->m; ++i)
    for (int64_t j = 0; j < n; ++j)
      host->matrix[j * size + n + i] -= host->b[i * n + j] * weight[i] * unit;
  int64_t at = 0;
  for (int32_t i = 0, block = 0; i < host->m; ++block)
  {
    const int32_t k =
        request->block_size == NULL ? 1 : request->block_size[block];
    add_block(host, i, k, unit, request->d_pressure + at, request->d_gap + at);
    i += k;
    at += (int64_t)k * k;
  }
}

/* Nodes that the unknowns make. */
static int32_t
n_nodes(const dense_host *host)
{
  return host->n / host->points.dimension;
}

/* x = (-R, -c) with R = K u - f - B'W p. */
static abut_status
right_hand_side(dense_host *host, const abut_request *request)
{
  const int64_t n = host->n;
  memset(host->x, 0, (size_t)n * sizeof(double));
  const abut_status status = abut_points_add_force(
      host->model->points, n_nodes(host), request->pressure, host->x);
  for (int64_t i = 0; i < n; ++i)
  {
    host->x[i] += host->model->force[i];
    for (int64_t j = 0; j < n; ++j)
      host->x[i] -= host->model->stiffness[i * n + j] * host->u[j];
  }
  for (int32_t i = 0; i < host->m; ++i)
    host->x[n + i] = -request->residual[i];
  return status;
}

static abut_status
solve(void *user, const abut_request *request)
{
  dense_host *host = user;
  const int32_t size = host->n + host->m;
  if (request->action == ABUT_ACTION_SOLVE)
  {
    assemble(host, request);
    if (!abut_dense_lu_factorise(size, host->matrix, host->pivot, host->scale))
    {
      host->singular = true;
      for (int32_t i = 0; i < host->m; ++i)
        host->slips |= request->state[i] == ABUT_STATE_SLIP;
      return ABUT_INVALID_ARGUMENT;
    }
  }
  const abut_status status = right_hand_side(host, request);
  if (status != ABUT_SUCCESS)
    return status;
  abut_dense_lu_solve(size, host->matrix, host->pivot, host->scale, host->x);
  const double unit = host->m > 0 ? pressure_unit(host) : 1;
  for (int32_t i = 0; i < host->m; ++i)
  {
    double change = 0;
    for (int32_t j = 0; j < host->n; ++j)
      change += host->b[(int64_t)i * host->n + j] * host->x[j];
    request->gap_change[i] = change;
    request->pressure_change[i] = unit * host->x[host->n + i];
  }
  return ABUT_SUCCESS;
}

static abut_status
move(void *user, const abut_request *request, double *gap)
{
  dense_host *host = user;
  for (int32_t i = 0; i < host->n; ++i)
    host->u[i] += request->step_length * host->x[i];
  return abut_points_gap(host->model->points, n_nodes(host), host->u, gap);
}

static void
watch(void *user, const abut_progress *progress, const abut_request *request)
{
  const dense_host *host = user;
  if (host->monitor != NULL)
    host->monitor(host->user, progress, host->u, request->pressure);
}

/* Run the strategy and read the last pressures and states. */
static abut_status
run(dense_host *host, abut_strategy *strategy, uint8_t *state,
    abut_progress *progress, abut_reason *reason)
{
  const abut_host functions = {sizeof(abut_host), host, solve, move, watch};
  abut_status status =
      abut_strategy_start(strategy, host->m, host->points.component_id,
                          host->points.component_weight, host->stiffness,
                          host->points.bilateral, host->gap, host->p, state);
  if (status == ABUT_SUCCESS)
    status = abut_strategy_run(strategy, &functions, reason);
  abut_request last;
  if (status == ABUT_SUCCESS)
    status = abut_strategy_next(strategy, NULL, &last);
  if (status != ABUT_SUCCESS)
    return status;
  if (host->m > 0)
    memcpy(host->p, last.pressure, (size_t)host->m * sizeof(double));
  if (host->m > 0 && state != NULL)
    memcpy(state, last.state, (size_t)host->m);
  return progress != NULL ? abut_strategy_progress_sized(strategy, progress)
                          : ABUT_SUCCESS;
}

/* A singular matrix: where something slips and the caller wants a reason, the
 * end of the iteration, else a failure. */
static abut_status
explain_singular(const dense_host *host, const abut_strategy *strategy,
                 abut_progress *progress, abut_reason *reason)
{
  const abut_status status = ABUT_SINGULAR;
  if (!host->slips)
    return abut_fail(host->context, status, call,
                     "the stiffness is singular with the closed constraints: "
                     "give a start state that supports the body");
  abut_fail(
      host->context, status, call,
      "the stiffness is singular with the closed and sticking constraints: "
      "friction does not carry the body, or not from this start");
  if (reason == NULL)
    return status;
  *reason = ABUT_REASON_UNHELD;
  return progress == NULL ? ABUT_SUCCESS
                          : abut_strategy_progress_sized(strategy, progress);
}

/* Arrays of the caller for host->n unknowns and host->m components. */
static abut_status
check_arrays(const dense_host *host)
{
  if (host->u == NULL || (host->m > 0 && host->p == NULL))
    return abut_fail(host->context, ABUT_INVALID_ARGUMENT, call,
                     "displacement or pressure is NULL");
  if (host->m > MAX_SIZE - host->n)
    return abut_fail(host->context, ABUT_INVALID_ARGUMENT, call,
                     "the model is too large for a dense matrix");
  double probe = 0;
  for (int32_t i = 0; i < host->n; ++i)
    probe += host->u[i] * 0.0;
  return probe == 0 ? ABUT_SUCCESS
                    : abut_fail(host->context, ABUT_NOT_FINITE, call,
                                "a displacement is not finite");
}

abut_status
abut_dense_model_solve_sized(abut_context *context,
                             const abut_dense_model *given,
                             const abut_strategy_options *options,
                             double *displacement, double *pressure,
                             uint8_t *state, abut_dense_monitor monitor,
                             void *user, abut_progress *progress,
                             abut_reason *reason)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (given == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "model is NULL");
  abut_dense_model taken;
  memset(&taken, 0, sizeof(taken));
  abut_status status =
      abut_copy_in(context, call, &taken, sizeof(taken), given);
  const abut_dense_model *model = &taken;
  if (status == ABUT_SUCCESS)
    status = check_model(context, model);
  if (status != ABUT_SUCCESS)
    return status;
  dense_host host = {.context = context,
                     .model = model,
                     .n = model->n,
                     .u = displacement,
                     .p = pressure,
                     .monitor = monitor,
                     .user = user};
  status = abut_points_get(model->points, &host.points);
  if (status != ABUT_SUCCESS)
    return status;
  host.m = host.points.n_components;
  status = check_arrays(&host);
  if (status != ABUT_SUCCESS)
    return status;
  abut_strategy *strategy = NULL;
  status = place_arrays(&host);
  if (status == ABUT_SUCCESS)
    status =
        abut_points_gap(model->points, n_nodes(&host), displacement, host.gap);
  if (status == ABUT_SUCCESS)
  {
    fill_rows(&host);
    status = find_stiffness(&host);
  }
  if (status == ABUT_SUCCESS)
    status = abut_strategy_create(context, options, &strategy);
  if (status == ABUT_SUCCESS && model->friction != NULL)
    status = abut_strategy_set_friction(strategy, model->friction);
  if (status == ABUT_SUCCESS)
    status = run(&host, strategy, state, progress, reason);
  if (host.singular)
    status = explain_singular(&host, strategy, progress, reason);
  abut_strategy_destroy(&strategy);
  abut_array_release(context, &host.block);
  abut_array_release(context, &host.pivots);
  return status;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Abut from C, without deal.II: two taut strings over one another, on meshes
 * that do not match. Both have length 1 and tension 1 and are held at their
 * ends; the upper one hangs down by its weight q = 1 per length and comes to
 * rest on the lower one, 0.02 below. Where they touch, from x = a to 1 - a,
 *     a = sqrt(2 gap / q) = 0.2,  pressure q / 2,  force q (1/2 - a) = 0.3.
 * Compile it with
 *     cc $(pkg-config --cflags abut_core) two_strings.c -o two_strings \
 *        $(pkg-config --libs abut_core) -lm
 */
#include <abut/abut.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
  UPPER = 61, /* nodes of the two strings */
  LOWER = 46,
  N = UPPER + LOWER /* unknowns: vertical displacements */
};

static const double weight = 1, distance = 0.02;

/* What the callbacks of the strategy need. */
typedef struct host
{
  abut_points *points;
  abut_points_view view;
  double stiffness[N][N], force[N], u[N], du[N];
} host;

/* Any failure ends the program with the library's message. */
static void
require(const abut_context *context, abut_status status)
{
  if (status == ABUT_SUCCESS)
    return;
  fprintf(stderr, "%s: %s\n", abut_status_text(status),
          abut_context_message(context));
  exit(1);
}

/* A string as a surface of straight facets. The normal is to the right of the
 * direction in which facets run: down for the upper string, which runs from
 * left to right, and up for the lower one. */
static abut_surface *
make_string(abut_context *context, int32_t n, double height, int leftwards)
{
  double position[2 * UPPER];
  int32_t connectivity[2 * UPPER];
  for (int32_t i = 0; i < n; ++i)
  {
    position[2 * i] = (double)i / (n - 1);
    position[2 * i + 1] = height;
  }
  for (int32_t i = 0; i + 1 < n; ++i)
  {
    connectivity[2 * i] = leftwards ? i + 1 : i;
    connectivity[2 * i + 1] = leftwards ? i : i + 1;
  }
  abut_surface_data data = abut_surface_data_defaults();
  data.dimension = 2;
  data.n_nodes = n;
  data.n_facets = n - 1;
  data.kind = ABUT_FACET_LINE2;
  data.connectivity = connectivity;
  data.position = position;
  abut_surface *surface = NULL;
  require(context, abut_surface_create(context, &data, &surface));
  return surface;
}

/* Linear elements of a string of n nodes, tension 1, load per length; the ends
 * are held by a large number. */
static void
assemble_string(host *h, int first, int n, double load)
{
  const double length = 1. / (n - 1);
  for (int i = first; i + 1 < first + n; ++i)
  {
    h->stiffness[i][i] += 1 / length;
    h->stiffness[i + 1][i + 1] += 1 / length;
    h->stiffness[i][i + 1] -= 1 / length;
    h->stiffness[i + 1][i] -= 1 / length;
    h->force[i] -= load * length / 2;
    h->force[i + 1] -= load * length / 2;
  }
  h->stiffness[first][first] = h->stiffness[first + n - 1][first + n - 1] =
      1e12;
}

/* Which nodes of the upper string have a facet of the lower one below them. */
static void
detect(abut_context *context, abut_surface *upper, abut_surface *lower)
{
  abut_detection_options options = abut_detection_defaults();
  options.search.reach = 2 * distance;
  abut_detection *detection = NULL;
  abut_detection_report report;
  require(context,
          abut_detection_create(context, upper, lower, &options, &detection));
  require(context, abut_detection_run(detection, 0));
  require(context, abut_detection_make_report(detection, &report));
  printf("%d of %d nodes have a partner\n", (int)report.n_paired,
         (int)report.n_nodes);
  require(context, abut_detection_destroy(&detection));
}

/* Mortar coupling of the two strings: points over the nodes of both, those of
 * the lower string behind those of the upper one, which are our unknowns. */
static void
make_points(abut_context *context, abut_surface *upper, abut_surface *lower,
            host *h)
{
  uint8_t held[UPPER] = {0};
  held[0] = held[UPPER - 1] = 1;
  abut_coupling_nodes nodes = abut_coupling_nodes_defaults();
  nodes.dropped = held;
  abut_coupling_options options = abut_coupling_defaults();
  options.search.reach = 2 * distance;
  abut_coupling *coupling = NULL;
  require(context,
          abut_coupling_create(context, upper, lower, &options, &coupling));
  require(context, abut_points_create(context, 2, &h->points));
  const abut_coupling_target target = abut_coupling_target_defaults(h->points);
  require(context, abut_coupling_build(coupling, &nodes, 0, &target));
  require(context, abut_points_get(h->points, &h->view));
  require(context, abut_coupling_destroy(&coupling));
}

/* dg/du of point i for the vertical displacement of the node of entry e. */
static double
slope(const abut_points_view *v, int i, int64_t e)
{
  return abut_point_sign(v->kind[i], 0) * v->frame[2 * i + 1]
         * v->coefficient[e];
}

/* Gaps at the present displacement. */
static void
find_gaps(const host *h, double *gap)
{
  const abut_points_view *v = &h->view;
  for (int i = 0; i < v->n_points; ++i)
  {
    gap[i] = v->gap[i];
    for (int64_t e = v->start[i]; e < v->start[i + 1]; ++e)
      gap[i] += slope(v, i, e) * h->u[v->node[e]];
  }
}

/* Gaussian elimination with row pivots; a is overwritten, x is b on entry. */
static int
solve_dense(int n, double *a, double *x)
{
  for (int k = 0; k < n; ++k)
  {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (fabs(a[i * n + k]) > fabs(a[pivot * n + k]))
        pivot = i;
    if (a[pivot * n + k] == 0)
      return 1;
    for (int j = 0; j < n && pivot != k; ++j)
    {
      const double swapped = a[k * n + j];
      a[k * n + j] = a[pivot * n + j];
      a[pivot * n + j] = swapped;
    }
    const double swapped = x[k];
    x[k] = x[pivot];
    x[pivot] = swapped;
    for (int i = k + 1; i < n; ++i)
    {
      const double factor = a[i * n + k] / a[k * n + k];
      for (int j = k; j < n && factor != 0; ++j)
        a[i * n + j] -= factor * a[k * n + j];
      x[i] -= factor * x[k];
    }
  }
  for (int k = n - 1; k >= 0; --k)
  {
    for (int j = k + 1; j < n; ++j)
      x[k] -= a[k * n + j] * x[j];
    x[k] /= a[k * n + k];
  }
  return 0;
}

/* SOLVE: K du - sum w dp B = -R with R = K u - f - sum w p B, and
 * a dp + b B du = -c for each point. */
static abut_status
solve(void *user, const abut_request *request)
{
  host *h = user;
  const abut_points_view *v = &h->view;
  const int size = N + v->n_points;
  double *a = calloc((size_t)(size * size + size), sizeof(double));
  if (a == NULL)
    return ABUT_OUT_OF_MEMORY;
  double *x = a + size * size;
  for (int i = 0; i < N; ++i)
  {
    x[i] = h->force[i];
    for (int j = 0; j < N; ++j)
    {
      a[i * size + j] = h->stiffness[i][j];
      x[i] -= h->stiffness[i][j] * h->u[j];
    }
  }
  for (int r = 0; r < v->n_points; ++r)
  {
    x[N + r] = -request->residual[r];
    a[(N + r) * size + N + r] = request->d_pressure[r];
    for (int64_t e = v->start[r]; e < v->start[r + 1]; ++e)
    {
      const int i = v->node[e];
      const double b = slope(v, r, e), w_b = v->weight[r] * b;
      a[i * size + N + r] = -w_b;
      a[(N + r) * size + i] = request->d_gap[r] * b;
      x[i] += w_b * request->pressure[r];
    }
  }
  const int singular = solve_dense(size, a, x);
  memcpy(h->du, x, sizeof(h->du));
  for (int r = 0; r < v->n_points; ++r)
  {
    request->pressure_change[r] = x[N + r];
    request->gap_change[r] = 0;
    for (int64_t e = v->start[r]; e < v->start[r + 1]; ++e)
      request->gap_change[r] += slope(v, r, e) * x[v->node[e]];
  }
  free(a);
  return singular ? ABUT_INTERNAL : ABUT_SUCCESS;
}

/* MOVE. */
static abut_status
move(void *user, const abut_request *request, double *gap)
{
  host *h = user;
  for (int i = 0; i < N; ++i)
    h->u[i] += request->step_length * h->du[i];
  find_gaps(h, gap);
  return ABUT_SUCCESS;
}

static void
report(void *user, const abut_progress *progress, const abut_request *request)
{
  const host *h = user;
  if (request->action != ABUT_ACTION_STOP)
    return;
  double force = 0, first = 1;
  for (int r = 0; r < h->view.n_points; ++r)
  {
    force += h->view.weight[r] * request->pressure[r];
    if (request->state[r] != ABUT_STATE_OPEN)
      first = fmin(first, (double)h->view.id[r] / (UPPER - 1));
  }
  printf("steps %d, rows %d, in contact %d\n", (int)progress->step,
         (int)progress->n_rows, (int)progress->n_active);
  printf("force %.9f, contact from x = %.4f\n", force, first);
}

int
main(void)
{
  static host h;
  abut_context *context = NULL;
  require(NULL, abut_context_create(NULL, &context));
  abut_surface *upper = make_string(context, UPPER, distance, 0);
  abut_surface *lower = make_string(context, LOWER, 0, 1);
  assemble_string(&h, 0, UPPER, weight);
  assemble_string(&h, UPPER, LOWER, 0);
  detect(context, upper, lower);
  make_points(context, upper, lower, &h);

  abut_strategy_options options = abut_strategy_defaults();
  options.length_scale = distance;
  options.pressure_scale = weight;
  double gap[UPPER], stiffness[UPPER];
  find_gaps(&h, gap);
  for (int r = 0; r < h.view.n_points; ++r)
    stiffness[r] = UPPER; /* pressure per length that a point sees, roughly */
  abut_strategy *strategy = NULL;
  abut_reason reason;
  const abut_host callbacks = {sizeof(callbacks), &h, solve, move, report};
  require(context, abut_strategy_create(context, &options, &strategy));
  require(context,
          abut_strategy_start(strategy, h.view.n_points, h.view.id,
                              h.view.weight, stiffness, NULL, gap, NULL, NULL));
  require(context, abut_strategy_run(strategy, &callbacks, &reason));
  puts(abut_reason_text(reason));

  require(context, abut_strategy_destroy(&strategy));
  require(context, abut_points_destroy(&h.points));
  require(context, abut_surface_destroy(&upper));
  require(context, abut_surface_destroy(&lower));
  require(context, abut_context_destroy(&context));
  return reason == ABUT_REASON_CONVERGED ? 0 : 1;
}

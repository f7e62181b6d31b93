/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Load steps with friction: slip from the last accepted step, tractions and
 * states from the history. All expected numbers are closed forms. */
#include "fixture.h"

#include <string.h>

enum
{
  MAX_MASSES = 17,
  SIZE = 3 * MAX_MASSES
};

/* Masses on a rigid plane; mass i has the unknowns i * dimension + 0 towards
 * the plane, and + 1, + 2 along it. */
typedef struct masses
{
  abut_context *context;
  abut_history *history;
  int32_t dimension, n, steps;
  double stiffness[SIZE * SIZE], force[SIZE];
  double weight[MAX_MASSES], coefficient[MAX_MASSES];
  double u[SIZE], committed[SIZE], p[SIZE]; /* displacement, at last commit */
  uint8_t state[SIZE];
  abut_progress progress;
  double dissipation; /* of all accepted steps */
} masses;

static void
set_up(masses *m, int32_t dimension, int32_t n, double coefficient)
{
  memset(m, 0, sizeof(*m));
  m->context = fixture_context();
  assert_ok(abut_history_create(m->context, &m->history));
  m->dimension = dimension;
  m->n = n;
  for (int32_t i = 0; i < n; ++i)
  {
    m->weight[i] = 1;
    m->coefficient[i] = coefficient;
  }
}

static void
tear_down(masses *m)
{
  assert_ok(abut_history_destroy(&m->history));
  assert_ok(abut_context_destroy(&m->context));
}

static void
add_spring(masses *m, int32_t i, int32_t j, double k)
{
  const int32_t size = m->n * m->dimension;
  m->stiffness[i * size + i] += k;
  if (j < 0)
    return;
  m->stiffness[j * size + j] += k;
  m->stiffness[i * size + j] -= k;
  m->stiffness[j * size + i] -= k;
}

/* The points as they are in this step: slips are measured from the last
 * commit. */
static abut_points *
make_points(const masses *m, int64_t *id)
{
  const int32_t dim = m->dimension;
  const double one = 1;
  double frame[9] = {0};
  abut_points *points = NULL;
  assert_ok(abut_points_create(m->context, dim, &points));
  for (int32_t d = 0; d < dim; ++d)
    frame[d * dim + d] = 1;
  for (int32_t i = 0; i < m->n; ++i)
  {
    double gap[3] = {0, 0, 0};
    for (int32_t d = 1; d < dim; ++d)
      gap[d] = -m->committed[i * dim + d];
    abut_point point = abut_point_defaults();
    point.id = 100 + 10 * (int64_t)i;
    point.n_components = dim;
    point.weight = m->weight[i];
    point.frame = frame;
    point.gap = gap;
    point.n_nodes = point.n_secondary = 1;
    point.node = &i;
    point.coefficient = &one;
    assert_ok(abut_points_append(points, &point));
    for (int32_t d = 0; d < dim; ++d)
      id[i * dim + d] = point.id + d;
  }
  return points;
}

static void
read_history(const masses *m, const int64_t *id, double *p, uint8_t *state)
{
  const abut_history_values past = {sizeof(past), p, state, NULL};
  assert_ok(abut_history_get(m->history, ABUT_HISTORY_COMMITTED,
                             m->n * m->dimension, id, &past));
}

/* One step; committed if it converges, else as before. */
static abut_reason
step(masses *m, const char *law)
{
  const int32_t dim = m->dimension, size = m->n * dim;
  int32_t first[MAX_MASSES];
  uint8_t n_tangents[MAX_MASSES];
  int64_t id[SIZE];
  double reference[SIZE];
  abut_points *points = make_points(m, id);
  read_history(m, id, m->p, m->state);
  /* Masses begin on the plane, and stick. */
  if (m->steps == 0)
    memset(m->state, ABUT_STATE_CLOSED, sizeof(m->state));
  for (int32_t i = 0; i < m->n; ++i)
  {
    first[i] = i * dim;
    n_tangents[i] = (uint8_t)(dim - 1);
    for (int32_t d = 1; d < dim; ++d)
      reference[i * (dim - 1) + d - 1] = m->p[i * dim + d];
  }
  const abut_strategy_friction friction = {
      .struct_size = sizeof(friction),
      .n = m->n,
      .first = first,
      .n_tangents = n_tangents,
      .coefficient = m->coefficient,
      .reference_traction = reference,
  };
  const abut_dense_model model = {sizeof(model), size,   m->stiffness,
                                  m->force,      points, &friction};
  abut_strategy_options options = exact_options();
  options.law = abut_law_find(law);
  options.penalty = strcmp(law, "penalty") == 0 ? 1 : 0;
  abut_reason reason = ABUT_REASON_NONE;
  assert_ok(abut_dense_model_solve(m->context, &model, &options, m->u, m->p,
                                   m->state, NULL, NULL, &m->progress,
                                   &reason));
  const abut_history_entries entries = {sizeof(entries), size, id, m->p,
                                        m->state,        NULL};
  assert_ok(abut_history_begin_step(m->history));
  assert_ok(abut_history_set(m->history, &entries));
  if (reason == ABUT_REASON_CONVERGED)
  {
    for (int32_t i = 0; i < size; ++i)
      if (i % dim != 0)
        m->dissipation -=
            m->weight[i / dim] * m->p[i] * (m->u[i] - m->committed[i]);
    memcpy(m->committed, m->u, sizeof(m->u));
    assert_ok(abut_history_commit(m->history));
    m->steps += 1;
  }
  else
  {
    memcpy(m->u, m->committed, sizeof(m->u));
    assert_ok(abut_history_rollback(m->history));
  }
  assert_ok(abut_points_destroy(&points));
  return reason;
}

/* Steps that take force i to its new value. */
static void
load(masses *m, const char *law, int32_t i, double force, int32_t increments)
{
  const double start = m->force[i];
  for (int32_t k = 1; k <= increments; ++k)
  {
    m->force[i] = start + (force - start) * k / increments;
    assert_int_equal(step(m, law), ABUT_REASON_CONVERGED);
    assert_true(m->progress.friction_rung <= 1);
  }
}

/* A bar of unit length and stiffness EA = 1 on a bed with friction 1 per
 * length; n elements, mass 0 is its free end that is pulled. */
static void
make_bar(masses *m, int32_t n)
{
  const double h = 1. / n, mu = 0.5, pressure = 2;
  set_up(m, 2, n + 1, mu);
  for (int32_t i = 0; i <= n; ++i)
  {
    m->weight[i] = i == 0 || i == n ? h / 2 : h;
    m->force[2 * i] = pressure * m->weight[i];
    add_spring(m, 2 * i, -1, 1);
    if (i > 0)
      add_spring(m, 2 * i + 1, 2 * i - 1, 1 / h);
  }
}

static void
a_bar_on_a_bed(void **unused)
{
  (void)unused;
  const int32_t increments[] = {1, 3, 7};
  const double f = 0.5;
  for (int k = 0; k < 3; ++k)
    for (int32_t n = 8; n <= 16; n *= 2)
    {
      static masses m;
      make_bar(&m, n);
      const double h = 1. / n;
      load(&m, "lagrange", 1, f, increments[k]);
      assert_close(m.u[1], f * f / 2, 1e-12);
      assert_close(m.p[0], 2, 1e-12);
      /* Slip in the first half; the node at its end sticks. */
      assert_int_equal(m.progress.n_slipping, n / 2);
      for (int32_t i = 0; i <= n; ++i)
      {
        const double x = i * h, rest = fmax(f - x, 0);
        assert_close(m.u[2 * i + 1], rest * rest / 2, 1e-12);
      }
      load(&m, "lagrange", 1, 0, increments[k]);
      assert_close(m.u[1], f * f / 4, 1e-12);
      load(&m, "lagrange", 1, -f, increments[k]);
      assert_close(m.u[1], -f * f / 2, 1e-12);
      load(&m, "lagrange", 1, f, increments[k]);
      assert_close(m.u[1], f * f / 2, 1e-12);
      const double before = m.dissipation;
      load(&m, "lagrange", 1, -f, increments[k]);
      load(&m, "lagrange", 1, f, increments[k]);
      assert_close(m.dissipation - before,
                   2 * f * f * f / 3 * (1 + h / f * (h / f) / 2), 1e-10);
      tear_down(&m);
    }
}

/* With springs of the penalty, tractions go on from the last step: the end
 * moves by the spring's own stretch in addition, and comes back by it. Loaded
 * below slip, nothing is left after unloading; springs that began from zero in
 * each step would keep half of the load. */
static void
springs_remember(void **unused)
{
  (void)unused;
  const char *laws[] = {"penalty", "augmented lagrangian", "lagrange"};
  for (int k = 0; k < 3; ++k)
  {
    static masses m;
    set_up(&m, 2, 1, 0.5);
    add_spring(&m, 0, -1, 1);
    add_spring(&m, 1, -1, 1);
    m.force[0] = 4;
    load(&m, laws[k], 1, 0.9, 4);
    /* The springs carry 0.9 together: penalty 1 is the mass's own stiffness.
     */
    assert_close(m.u[1], k == 0 ? 0.45 : 0, 1e-6);
    assert_close(m.p[1], k == 0 ? -0.45 : -0.9, 1e-5);
    load(&m, laws[k], 1, 0, 4);
    assert_close(m.u[1], 0, 1e-5);
    assert_close(m.p[1], 0, 1e-5);
    tear_down(&m);
  }
}

/* A row of masses, pressed by different forces and dragged by its end: once all
 * of it slides, the tractions are mu N, and turn round with it. */
static void
a_block_is_dragged(void **unused)
{
  (void)unused;
  static masses m;
  const double mu = 0.3, k = 5;
  double n = 0;
  set_up(&m, 2, 6, mu);
  for (int32_t i = 0; i < 6; ++i)
  {
    add_spring(&m, 2 * i, -1, 2);
    m.force[2 * i] = 1 + 0.2 * i;
    n += m.force[2 * i];
    if (i > 0)
      add_spring(&m, 2 * i + 1, 2 * i - 1, 50);
  }
  add_spring(&m, 1, -1, k);
  const double ends[] = {4, -4, 1};
  for (int way = 0; way < 3; ++way)
  {
    load(&m, "lagrange", 1, k * ends[way], 10);
    double t = 0, pressed = 0;
    for (int32_t i = 0; i < 6; ++i)
    {
      pressed += m.p[2 * i];
      t += m.p[2 * i + 1];
    }
    const double sign = way == 1 ? 1 : -1;
    assert_close(pressed, n, 1e-10);
    assert_close(t, sign * mu * n, 1e-10);
    assert_int_equal(m.progress.n_slipping, 6);
    /* The spring that drags carries it. */
    assert_close(k * (ends[way] - m.u[1]), -sign * mu * n, 1e-10);
  }
  assert_true(m.dissipation > 0);
  tear_down(&m);
}

/* A mass on an incline, held by nothing but friction. */
static abut_reason
incline(double angle, double mu, masses *m)
{
  set_up(m, 2, 1, mu);
  add_spring(m, 0, -1, 1);
  m->force[0] = 3 * cos(angle);
  m->force[1] = 3 * sin(angle);
  return step(m, "lagrange");
}

static void
an_incline(void **unused)
{
  (void)unused;
  const double mu = 0.4, slope = atan(mu);
  static masses m;
  assert_int_equal(incline(slope - 1e-6, mu, &m), ABUT_REASON_CONVERGED);
  assert_int_equal(m.progress.n_slipping, 0);
  assert_close(m.p[1], -3 * sin(slope - 1e-6), 1e-12);
  assert_close(m.u[1], 0, 1e-15);
  tear_down(&m);
  assert_int_equal(incline(slope + 1e-6, mu, &m), ABUT_REASON_UNHELD);
  assert_int_equal(abut_reason_failure(ABUT_REASON_UNHELD,
                                       abut_law_find("lagrange"), &m.progress),
                   ABUT_FAILURE_FREE_SLIDING);
  assert_non_null(
      strstr(abut_context_message(m.context), "friction does not carry"));
  /* Rolled back; with less load along the plane it holds. */
  m.force[1] = 0.3 * m.force[0];
  assert_int_equal(step(&m, "lagrange"), ABUT_REASON_CONVERGED);
  assert_close(m.p[1], -m.force[1], 1e-12);
  tear_down(&m);
}

/* Angle between the pull on a mass and y, after its spring's end was drawn far
 * along x and then by @p way along y in steps. */
static double
pull_angle(double way, double k, double n, double mu, int32_t increments)
{
  static masses m;
  set_up(&m, 3, 1, mu);
  add_spring(&m, 0, -1, 1);
  add_spring(&m, 1, -1, k);
  add_spring(&m, 2, -1, k);
  m.force[0] = n;
  load(&m, "lagrange", 1, k * 3 * mu * n / k, 3);
  assert_close(m.p[1], -mu * n, 1e-12);
  load(&m, "lagrange", 2, k * way, increments);
  assert_close(hypot(m.p[1], m.p[2]), mu * n, 1e-12);
  const double angle = atan2(-m.p[1], -m.p[2]);
  tear_down(&m);
  return angle;
}

/* tan(phi/2) = exp(-K s/(mu N)); first order in the increment. */
static void
tractrix(void **unused)
{
  (void)unused;
  const double k = 2, n = 3, mu = 0.4, way = 0.8;
  const double exact = 2 * atan(exp(-k * way / (mu * n)));
  double phi[3];
  for (int i = 0; i < 3; ++i)
    phi[i] = pull_angle(way, k, n, mu, 20 << i);
  const double order = log((phi[0] - exact) / (phi[1] - exact)) / log(2.);
  assert_close(order, 1, 0.05);
  const double once[2] = {2 * phi[1] - phi[0], 2 * phi[2] - phi[1]};
  assert_close((4 * once[1] - once[0]) / 3, exact, 1e-5);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_bar_on_a_bed),     cmocka_unit_test(springs_remember),
      cmocka_unit_test(a_block_is_dragged), cmocka_unit_test(an_incline),
      cmocka_unit_test(tractrix),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

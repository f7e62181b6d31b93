/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Friction at single points: where the law holds, its linearisation, and one
 * mass on springs, by formulas. */
#include "fixture.h"
#include "frictional.h"

#include <string.h>

enum
{
  MANY = 1000
};

/* Points in a row, with 1 and 2 tangents in turn. */
typedef struct sample
{
  int32_t n, m;
  uint8_t n_tangents[MANY], state[MANY];
  double slip[2 * MANY], traction[2 * MANY], reference[2 * MANY];
  double compliance[MANY], scale[MANY], bound[MANY], d_bound[MANY];
  bool has_tangent_compliance;
  double tangent_compliance[2 * MANY];
  double residual[2 * MANY], d_traction[4 * MANY], d_slip[4 * MANY];
  double d_pressure[2 * MANY], direction[2 * MANY];
} sample;

static double
between(uint64_t *seed, double low, double high)
{
  return low + (high - low) * fixture_random(seed);
}

static void
draw_direction(uint64_t *seed, int t, double *e)
{
  const double angle = between(seed, 0, 6.283185307179586);
  e[0] = t == 1 ? (angle < 3 ? -1 : 1) : cos(angle);
  e[1] = t == 1 ? 0 : sin(angle);
}

/* Random states; a third of them at exact stick, without springs. */
static void
draw(sample *s, uint64_t seed)
{
  memset(s, 0, sizeof(*s));
  s->n = MANY;
  for (int32_t i = 0; i < s->n; ++i)
  {
    s->n_tangents[i] = (uint8_t)(1 + i % 2);
    s->scale[i] = between(&seed, 0.1, 10);
    s->compliance[i] = i % 3 == 0 ? 0 : between(&seed, 0, 2) / s->scale[i];
    s->bound[i] = between(&seed, 0.1, 3);
    s->d_bound[i] = between(&seed, 0, 2);
    for (int k = 0; k < s->n_tangents[i]; ++k, ++s->m)
    {
      s->slip[s->m] = between(&seed, -1, 1);
      s->traction[s->m] = between(&seed, -3, 3);
      s->reference[s->m] = between(&seed, -1, 1);
    }
  }
}

static abut_friction_points
points_of(const sample *s)
{
  const abut_friction_points points = {
      .struct_size = sizeof(points),
      .n = s->n,
      .n_tangents = s->n_tangents,
      .slip = s->slip,
      .traction = s->traction,
      .reference_traction = s->reference,
      .compliance = s->compliance,
      .scale = s->scale,
      .bound = s->bound,
      .d_bound = s->d_bound,
      .tangent_compliance =
          s->has_tangent_compliance ? s->tangent_compliance : NULL,
  };
  return points;
}

static abut_friction_linearisation
result_of(sample *s)
{
  const abut_friction_linearisation result = {
      .struct_size = sizeof(result),
      .residual = s->residual,
      .d_traction = s->d_traction,
      .d_slip = s->d_slip,
      .d_pressure = s->d_pressure,
      .direction = s->direction,
  };
  return result;
}

static void
linearise(sample *s)
{
  const abut_friction_points points = points_of(s);
  const abut_friction_linearisation result = result_of(s);
  assert_ok(abut_friction_linearise(&points, s->state, &result));
}

static void
classify_and_linearise(sample *s)
{
  const abut_friction_points points = points_of(s);
  for (int32_t i = 0; i < s->n; ++i)
    s->state[i] = ABUT_STATE_CLOSED;
  assert_ok(abut_friction_classify(&points, s->state));
  linearise(s);
}

/* The state of point i obeys Coulomb's law: it sticks somewhere in the disc,
 * slips against its traction at the border, or presses nothing. */
static void
obey(sample *s, int32_t i, int32_t first, uint64_t *seed)
{
  double e[2];
  const int t = s->n_tangents[i];
  draw_direction(seed, t, e);
  const int kind = i / 2 % 3;
  const double share = kind == 0 ? between(seed, 0, 0.99) : kind == 1;
  const double way = kind == 0 ? 0 : between(seed, 0.1, 2);
  if (kind == 2)
    s->bound[i] = 0;
  s->compliance[i] = 0;
  for (int k = 0; k < t; ++k)
  {
    s->traction[first + k] = -share * s->bound[i] * e[k];
    s->slip[first + k] = way * e[k];
  }
}

static void
the_residual_vanishes_where_the_law_holds(void **unused)
{
  (void)unused;
  static sample s;
  uint64_t seed = 7;
  draw(&s, 1);
  int32_t first = 0, slipping = 0;
  for (int32_t i = 0; i < s.n; first += s.n_tangents[i++])
    obey(&s, i, first, &seed);
  classify_and_linearise(&s);
  for (int32_t k = 0; k < s.m; ++k)
    assert_close(s.residual[k], 0, 1e-14);
  for (int32_t i = 0; i < s.n; ++i)
    slipping += s.state[i] == ABUT_STATE_SLIP;
  assert_int_equal(slipping, s.n - (s.n + 5) / 6 * 2 + (s.n % 6 == 1));
  /* Each of them broken: more slip than none, a longer or turned traction. */
  first = 0;
  for (int32_t i = 0; i < s.n; first += s.n_tangents[i++])
    if (i / 2 % 3 == 0)
      s.slip[first] += 0.1;
    else
      s.traction[first] += s.traction[first] < 0 ? -0.1 : 0.1;
  classify_and_linearise(&s);
  first = 0;
  for (int32_t i = 0; i < s.n; first += s.n_tangents[i++])
  {
    double length = 0;
    for (int k = 0; k < s.n_tangents[i]; ++k)
      length = fmax(length, fabs(s.residual[first + k]));
    assert_true(length > 1e-3);
  }
}

/* |x| of a point that slips, else 1: |x| C has the derivative of the
 * linearisation times |x| where nothing is held back. */
static double
length_at(const sample *s, int32_t point, int32_t first)
{
  double square = 0;
  for (int32_t k = first; k < first + s->n_tangents[point]; ++k)
  {
    const double compliance = s->has_tangent_compliance
                                  ? s->tangent_compliance[k]
                                  : s->compliance[point];
    const double shifted =
        s->slip[k] + (s->traction[k] - s->reference[k]) * compliance;
    const double x = s->traction[k] - s->scale[point] * shifted;
    square += x * x;
  }
  return s->state[point] == ABUT_STATE_SLIP ? sqrt(square) : 1;
}

/* Whether the traction is in the disc and does not oppose the direction, so
 * that nothing is safeguarded. */
static bool
is_exact(const sample *s, int32_t i, int32_t first)
{
  if (s->state[i] != ABUT_STATE_SLIP)
    return true;
  double square = 0, along = 0;
  for (int32_t k = first; k < first + s->n_tangents[i]; ++k)
  {
    square += s->traction[k] * s->traction[k];
    along += s->traction[k] * s->direction[k];
  }
  return along >= 0 && sqrt(square) <= s->bound[i];
}

/* Differences by tangent c of all points, of slips or of tractions, against
 * blocks; the number of points that were compared. */
static int32_t
check_differences(const sample *s, int c, bool by_slip)
{
  static sample up, down;
  const double h = 1e-6;
  const double *blocks = by_slip ? s->d_slip : s->d_traction;
  up = down = *s;
  int32_t first = 0, block = 0, n = 0;
  for (int32_t i = 0; i < s->n; first += s->n_tangents[i++])
    if (c < s->n_tangents[i])
    {
      (by_slip ? up.slip : up.traction)[first + c] += h;
      (by_slip ? down.slip : down.traction)[first + c] -= h;
    }
  linearise(&up);
  linearise(&down);
  first = 0;
  for (int32_t i = 0; i < s->n; ++i)
  {
    const int t = s->n_tangents[i];
    const double scale = 2 * h * length_at(s, i, first);
    const double over = length_at(&up, i, first) / scale,
                 under = length_at(&down, i, first) / scale;
    for (int r = 0; r < t && c < t && is_exact(s, i, first); ++r, ++n)
      assert_close(up.residual[first + r] * over
                       - down.residual[first + r] * under,
                   blocks[block + r * t + c], 1e-6);
    first += t;
    block += t * t;
  }
  return n;
}

static void
check_all_differences(bool has_tangent_compliance)
{
  static sample s;
  draw(&s, 3);
  s.has_tangent_compliance = has_tangent_compliance;
  uint64_t seed = 7;
  for (int32_t k = 0; k < s.m; ++k)
    s.tangent_compliance[k] = k % 3 == 0 ? 0 : between(&seed, 0, 0.2);
  classify_and_linearise(&s);
  for (int32_t i = 0; i < s.n; i += 5)
    s.state[i] = ABUT_STATE_OPEN;
  linearise(&s);
  for (int by_slip = 0; by_slip < 2; ++by_slip)
  {
    assert_true(check_differences(&s, 0, by_slip != 0) > MANY / 2);
    assert_true(check_differences(&s, 1, by_slip != 0) > MANY / 4);
  }
}

static void
differences(void **unused)
{
  (void)unused;
  check_all_differences(false);
}

/* With one spring for each tangent. */
static void
differences_of_tangents(void **unused)
{
  (void)unused;
  check_all_differences(true);
}

/* Where the law holds, tau = rho e, the blocks are C's own derivatives, that by
 * the bound, too: the state moves along the border of the disc. */
static void
differences_at_slip(void **unused)
{
  (void)unused;
  static sample s, up, down;
  const double h = 1e-6;
  draw(&s, 4);
  uint64_t seed = 5;
  int32_t first = 0;
  for (int32_t i = 0; i < s.n; first += s.n_tangents[i++])
  {
    double e[2];
    draw_direction(&seed, s.n_tangents[i], e);
    const double beyond = between(&seed, 0.1, 3);
    for (int k = 0; k < s.n_tangents[i]; ++k)
    {
      s.traction[first + k] = s.bound[i] * e[k];
      s.slip[first + k] =
          -beyond * e[k]
          - s.compliance[i] * (s.traction[first + k] - s.reference[first + k]);
    }
  }
  classify_and_linearise(&s);
  up = down = s;
  for (int32_t i = 0; i < s.n; ++i)
  {
    assert_int_equal(s.state[i], ABUT_STATE_SLIP);
    up.bound[i] += h * s.d_bound[i];
    down.bound[i] -= h * s.d_bound[i];
  }
  linearise(&up);
  linearise(&down);
  for (int32_t k = 0; k < s.m; ++k)
  {
    assert_close(s.residual[k], 0, 1e-14);
    assert_close((up.residual[k] - down.residual[k]) / (2 * h), s.d_pressure[k],
                 1e-8);
  }
}

/* A c_p = drho e in all states, and A is regular: by how much, follows from
 * r = rho/|x| alone. */
static void
the_block_is_regular(void **unused)
{
  (void)unused;
  static sample s;
  draw(&s, 6);
  classify_and_linearise(&s);
  int32_t first = 0, block = 0, n = 0;
  for (int32_t i = 0; i < s.n; ++i)
  {
    const int t = s.n_tangents[i];
    const double *a = s.d_traction + block, *e = s.direction + first;
    const double determinant = t == 1 ? a[0] : a[0] * a[3] - a[1] * a[2];
    if (s.state[i] == ABUT_STATE_SLIP)
    {
      assert_true(determinant > 0);
      n += 1;
    }
    for (int r = 0; r < t && s.state[i] == ABUT_STATE_SLIP; ++r)
    {
      double value = 0;
      for (int c = 0; c < t; ++c)
        value -= s.d_bound[i] * a[r * t + c] * e[c];
      assert_close(s.d_pressure[first + r], value, 1e-12);
    }
    first += t;
    block += t * t;
  }
  assert_true(n > MANY / 4);
}

/* One point with two tangents and rho = 1, c = 1. */
static double
determinant_at(double traction, double x)
{
  const uint8_t n_tangents = 2, state = ABUT_STATE_SLIP;
  const double one = 1, tau[2] = {traction, 0}, slip[2] = {traction - x, 0};
  double c[2], a[4], b[4], c_p[2];
  const abut_friction_points points = {
      sizeof(points), 1, &n_tangents, slip, tau, NULL, NULL, &one, &one, &one};
  const abut_friction_linearisation result = {
      sizeof(result), c, a, b, c_p, NULL};
  assert_ok(abut_friction_linearise(&points, &state, &result));
  return a[0] * a[3] - a[1] * a[2];
}

static void
opposed_tractions(void **unused)
{
  (void)unused;
  /* tau = -rho e at |x| = 2 rho, where the plain derivative is singular: with
   * beta = 1/2, A = 1 - 1/2 (1/2 + 1/2) along e and 1 - 1/4 across it. */
  assert_close(determinant_at(-1, 2), 0.375, 1e-14);
  /* Far beyond the disc, tau is held inside it. */
  assert_close(determinant_at(-50, 2), 0.375, 1e-14);
  assert_close(determinant_at(50, 2), 0.5, 1e-14);
  /* x = 0 in a state of slip has no direction: as if open. */
  assert_close(determinant_at(0, 0), 1, 1e-14);
}

/* |x| = rho in a state of slip, as round-off may leave it: the spring rho/|s|
 * across the slip stays finite, and the block regular. */
static void
the_border_of_stick(void **unused)
{
  (void)unused;
  assert_close(determinant_at(1, 1) * 1e8, 1, 1e-6);
  assert_true(determinant_at(1, 1 - 1e-15) > 1e-9);
}

static void
bounds(void **unused)
{
  (void)unused;
  const double p[] = {2, 0, -1, 10}, mu[] = {.5, .5, .25, .5};
  const double cap[] = {9, 9, 9, 3};
  double rho[4], d_rho[4];
  const abut_friction *law = abut_friction_find("coulomb");
  assert_ptr_equal(law, abut_friction_get(0));
  assert_string_equal(law->name, "coulomb");
  const abut_friction_bounds points = {sizeof(points), 4, p, mu, cap, NULL};
  assert_ok(law->bound(&points, rho, d_rho));
  const double expected[] = {1, 0, 0, 3}, slope[] = {.5, .5, .25, 0};
  for (int i = 0; i < 4; ++i)
  {
    assert_close(rho[i], expected[i], 0);
    assert_close(d_rho[i], slope[i], 0);
  }
  const abut_friction_bounds without = {sizeof(without), 4, p, mu, NULL, NULL};
  assert_ok(law->bound(&without, rho, d_rho));
  assert_close(rho[3], 5, 0);
}

static void
table(void **unused)
{
  (void)unused;
  int32_t n = 0;
  for (; abut_friction_get(n) != NULL; ++n)
  {
    const abut_friction *law = abut_friction_get(n);
    assert_int_equal(law->struct_size, sizeof(abut_friction));
    assert_ptr_equal(abut_friction_find(law->name), law);
  }
  assert_true(n >= 1);
  assert_null(abut_friction_get(-1));
  assert_null(abut_friction_find("Coulomb"));
  assert_null(abut_friction_find(NULL));
}

static void
bad_input(void **unused)
{
  (void)unused;
  static sample s;
  draw(&s, 8);
  classify_and_linearise(&s);
  const abut_friction_linearisation result = result_of(&s);
  assert_int_equal(abut_friction_classify(NULL, s.state),
                   ABUT_INVALID_ARGUMENT);
  abut_friction_points points = points_of(&s);
  assert_int_equal(abut_friction_classify(&points, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_friction_linearise(&points, s.state, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_friction_linearise(&points, NULL, &result),
                   ABUT_INVALID_ARGUMENT);
  abut_friction_linearisation incomplete = result;
  incomplete.d_slip = NULL;
  assert_int_equal(abut_friction_linearise(&points, s.state, &incomplete),
                   ABUT_INVALID_ARGUMENT);
  points.slip = NULL;
  assert_int_equal(abut_friction_linearise(&points, s.state, &result),
                   ABUT_INVALID_ARGUMENT);
  points = points_of(&s);
  points.n = -1;
  assert_int_equal(abut_friction_classify(&points, s.state),
                   ABUT_INVALID_ARGUMENT);
  points = points_of(&s);
  const uint8_t three = 3;
  const double zero = 0, negative = -1;
  points.n = 1;
  points.n_tangents = &three;
  assert_int_equal(abut_friction_classify(&points, s.state),
                   ABUT_INVALID_ARGUMENT);
  points = points_of(&s);
  points.n = 1;
  points.scale = &zero;
  assert_int_equal(abut_friction_classify(&points, s.state),
                   ABUT_INVALID_ARGUMENT);
  points = points_of(&s);
  points.n = 1;
  points.bound = &negative;
  assert_int_equal(abut_friction_classify(&points, s.state),
                   ABUT_INVALID_ARGUMENT);
  s.traction[MANY / 2] = NAN;
  points = points_of(&s);
  assert_int_equal(abut_friction_linearise(&points, s.state, &result),
                   ABUT_NOT_FINITE);
  points.n = 0;
  assert_ok(abut_friction_linearise(&points, NULL, &result));
}

/* A mass on isotropic springs k, pressed on a plane by a force N beyond what
 * closes the gap, and pulled along it by F at an angle. */
static frictional
mass(int32_t dimension, double k, double n, double f, double angle, double mu)
{
  frictional problem;
  memset(&problem, 0, sizeof(problem));
  problem.dimension = problem.n = dimension;
  problem.n_points = 1;
  problem.condition = 1;
  problem.gap[0] = 0.5;
  problem.coefficient[0] = mu;
  problem.cap[0] = INFINITY;
  for (int32_t d = 0; d < dimension; ++d)
    problem.stiffness[d * dimension + d] = k;
  problem.force[0] = n + k * problem.gap[0];
  problem.force[1] = f * cos(angle);
  if (dimension == 3)
    problem.force[2] = f * sin(angle);
  return problem;
}

static frictional_answer
solve(const frictional *problem, const char *law)
{
  abut_context *context = fixture_context();
  abut_strategy_options options = exact_options();
  options.law = abut_law_find(law);
  frictional_answer answer;
  memset(&answer, 0, sizeof(answer));
  frictional_solve(context, problem, &options, false, &answer);
  assert_ok(answer.status);
  assert_int_equal(answer.reason, ABUT_REASON_CONVERGED);
  assert_ok(abut_context_destroy(&context));
  return answer;
}

static void
check_mass(int32_t dimension, double angle, double f)
{
  const double k = 2, n = 3, mu = 0.4;
  const frictional problem = mass(dimension, k, n, f, angle, mu);
  const frictional_answer answer = solve(&problem, "lagrange");
  const double e[2] = {cos(angle), sin(angle)};
  const bool sticks = fabs(f) <= mu * n;
  const double force = sticks ? f : copysign(mu * n, f);
  assert_close(answer.p[0], n, 1e-12);
  assert_int_equal(answer.progress.n_slipping, !sticks);
  double power = 0, traction = 0;
  for (int32_t t = 1; t < dimension; ++t)
  {
    assert_close(answer.p[t], -force * e[t - 1], 1e-12);
    assert_close(answer.u[t], (f - force) / k * e[t - 1], 1e-12);
    power += answer.p[t] * answer.u[t];
    traction = hypot(traction, answer.p[t]);
  }
  assert_true(power <= 0);
  if (!sticks)
  {
    assert_close(traction, mu * n, 1e-12);
    assert_close(power, -mu * n * (fabs(f) - mu * n) / k, 1e-12);
  }
  assert_true(frictional_violation(&problem, answer.u, answer.p) < 1e-12);
}

static void
a_mass_on_springs(void **unused)
{
  (void)unused;
  const double forces[] = {0.5, 1.19, 1.21, 5, -0.5, -5};
  const double angles[] = {0.1, 1, 2.5, 4};
  for (int i = 0; i < 6; ++i)
  {
    check_mass(2, 0, forces[i]);
    for (int k = 0; k < 4; ++k)
      check_mass(3, angles[k], forces[i]);
  }
}

/* Lifted off the plane: no traction. */
static void
an_open_mass(void **unused)
{
  (void)unused;
  const frictional problem = mass(3, 2, -3, 4, 1, 0.4);
  const frictional_answer answer = solve(&problem, "lagrange");
  for (int d = 0; d < 3; ++d)
    assert_close(answer.p[d], 0, 0);
  assert_int_equal(answer.progress.n_active, 0);
  assert_close(answer.u[1], 4 * cos(1.) / 2, 1e-14);
}

static void
a_cap(void **unused)
{
  (void)unused;
  frictional problem = mass(3, 2, 3, 4, 1, 0.4);
  problem.cap[0] = 0.25;
  const frictional_answer answer = solve(&problem, "lagrange");
  assert_close(hypot(answer.p[1], answer.p[2]), 0.25, 1e-12);
  assert_close(answer.u[2], (4 - 0.25) * sin(1.) / 2, 1e-12);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_residual_vanishes_where_the_law_holds),
      cmocka_unit_test(differences),
      cmocka_unit_test(differences_of_tangents),
      cmocka_unit_test(differences_at_slip),
      cmocka_unit_test(the_block_is_regular),
      cmocka_unit_test(opposed_tractions),
      cmocka_unit_test(the_border_of_stick),
      cmocka_unit_test(table),
      cmocka_unit_test(bounds),
      cmocka_unit_test(bad_input),
      cmocka_unit_test(a_mass_on_springs),
      cmocka_unit_test(an_open_mass),
      cmocka_unit_test(a_cap),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

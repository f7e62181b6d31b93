/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Time schemes on a bar that meets a wall: discrete values of each scheme, from
 * two programs that share no code with this one or with each other. */
#include "bar.h"

#include <string.h>

/* What a run of the bar comes to. */
typedef struct impact
{
  double energy_at_1, energy_at_2; /* by that of the start */
  double impulse, pressure_at_8, deviation, end, centre_velocity;
  int release;
} impact;

static double
energy(const bar *b)
{
  return bar_kinetic(b) + bar_strain(b) + bar_contact(b);
}

/* 50 elements, E = 900, falls with 10 from height 5; two seconds. */
static impact
fall(const char *scheme, abut_time_mass mass, abut_mass_rule rule, int steps)
{
  static bar b;
  bar_open(&b, 50, 10, 900, 1);
  b.wall = -5;
  b.penalty = strcmp(scheme, "central difference") == 0 ? 900 / b.h : 0;
  for (int32_t i = 0; i < b.n; ++i)
    b.v[i] = -10;
  bar_use(&b, scheme, 2. / steps, mass, rule);
  impact result = {.release = 0};
  for (int step = 1; step <= steps; ++step)
  {
    bar_step(&b);
    if (b.lambda > 1e-7)
      result.release = step + 1;
    /* .6 and 1.1 s, ends included, .8 s and 1 s. */
    if (10 * step >= 3 * steps && 20 * step <= 11 * steps)
      result.deviation = fmax(result.deviation, fabs(b.lambda - 300) / 300);
    if (10 * step == 4 * steps)
      result.pressure_at_8 = b.lambda;
    if (2 * step == steps)
      result.energy_at_1 = energy(&b) / 500;
  }
  double momentum = 0, columns[BAR_MAX] = {0};
  for (int32_t i = 0; i < b.n * b.n; ++i)
    columns[i % b.n] += b.m[i];
  for (int32_t i = 0; i < b.n; ++i)
    momentum += columns[i] * b.v[i];
  result.centre_velocity = momentum / 10;
  result.energy_at_2 = energy(&b) / 500;
  result.impulse = b.impulse;
  result.end = b.u[0];
  return result;
}

typedef struct reference
{
  const char *scheme;
  abut_time_mass mass;
  abut_mass_rule rule;
  int steps;
  impact expected;
} reference;

static void
bar_on_a_wall_is_that_of_the_table(void **unused)
{
  (void)unused;
  const abut_time_mass consistent = ABUT_TIME_MASS_CONSISTENT,
                       modified = ABUT_TIME_MASS_MODIFIED,
                       lumped = ABUT_TIME_MASS_LUMPED;
  const abut_mass_rule near = ABUT_MASS_NEIGHBOURS, centre = ABUT_MASS_CENTRE;
  const reference table[] = {
      {"trapezoid",
       consistent,
       near,
       300,
       {5.3098827222, 7.9827940090, 204.50703656, 996.33700885, 2.3925565283,
        3.9208026553, 0, 175}},
      {"hht",
       consistent,
       near,
       300,
       {0.9810026717, 0.9731965666, 197.53624841, 299.70268266, 0.0459213742,
        3.0783635036, 0, 177}},
      {"contact stabilised",
       consistent,
       near,
       300,
       {0.9942264973, 0.9942264973, 197.93880431, 300.12229925, 0.0076743210,
        3.1403246253, 0, 177}},
      {"trapezoid",
       modified,
       centre,
       300,
       {1.0000000000, 1.0003200564, 198.19785938, 299.88928212, 0.0782723343,
        3.1519727633, 0, 177}},
      {"trapezoid",
       modified,
       near,
       300,
       {1.0000000000, 1.0006903566, 198.53115070, 299.99498209, 0.0010080038,
        3.1954999794, 0, 177}},
      {"hht",
       modified,
       near,
       300,
       {0.9919532266, 0.9848786743, 198.16337922, 300.00005005, 0.0018308390,
        3.1415747479, 0, 177}},
      {"central difference",
       lumped,
       near,
       600,
       {1.0009599619, 1.0007142046, 199.21351255, 259.24525883, 0.1625208899,
        3.1260197736, 0, 355}},
  };
  for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); ++i)
  {
    const reference *r = &table[i];
    const impact got = fall(r->scheme, r->mass, r->rule, r->steps);
    assert_close(got.energy_at_1, r->expected.energy_at_1, 1e-8);
    assert_close(got.energy_at_2, r->expected.energy_at_2, 1e-8);
    assert_close(got.impulse, r->expected.impulse, 1e-8);
    assert_close(got.pressure_at_8, r->expected.pressure_at_8, 1e-8);
    assert_close(got.deviation, r->expected.deviation, 1e-8);
    assert_close(got.end, r->expected.end, 1e-8);
    assert_close(got.centre_velocity, got.impulse / 10 - 10, 1e-10);
    assert_int_equal(got.release, r->expected.release);
  }
}

/* A bar of wave speed 20 falls from height 10 under gravity 5 and bounces:
 * contacts in [2 + 4.8 k, 2.8 + 4.8 k] with impulse 192 each. What the first
 * one leaves in the bar as waves comes back late: errors of the later ones
 * grow. */
typedef struct bounces
{
  int n;
  double begin[6], end[6], impulse[6]; /* errors */
} bounces;

static bounces
bounce(int elements)
{
  static bar b;
  bar_open(&b, elements, 8, 400, 1);
  b.wall = -10;
  b.load = -5;
  const double dt = 0.4 / elements;
  bar_use(&b, "hht", dt, ABUT_TIME_MASS_MODIFIED, ABUT_MASS_NEIGHBOURS);
  bounces found = {.n = 0};
  double end = -1, before = 0;
  for (int step = 1; step * dt < 23; ++step)
  {
    bar_step(&b);
    if (b.lambda <= 1e-7)
      continue;
    const double t = step * dt;
    if (found.n == 0 || t > end + 1)
    {
      assert_true(found.n < 5);
      before = b.impulse - dt * b.lambda;
      found.begin[found.n] = fabs(t - 2 - 4.8 * found.n);
      ++found.n;
    }
    end = t;
    found.end[found.n - 1] = fabs(end - 2.8 - 4.8 * (found.n - 1));
    found.impulse[found.n - 1] = fabs((b.impulse - before) / 192 - 1);
  }
  return found;
}

static void
falling_bar_bounces_in_time(void **unused)
{
  (void)unused;
  const bounces found = bounce(100);
  assert_int_equal(found.n, 5);
  assert_true(found.begin[0] <= 2.001 * 0.4 / 100);
  assert_true(found.end[0] <= 2.001 * 0.4 / 100);
  assert_true(found.impulse[0] <= 0.01);
  for (int k = 1; k < 5; ++k)
  {
    assert_true(found.begin[k] < 0.02 * (2 + 4.8 * k));
    assert_true(found.impulse[k] < 0.05);
  }
}

/* Unknowns of both bars, the first one's first, for the host with a dense
 * matrix; its last node meets the second one's first. */
enum
{
  TWO = 42
};

static void
add_force_of_both(const bar *b, const double *m, const double *k,
                  const double *am, const double *uf, double *r)
{
  for (int32_t i = 0; i < TWO; ++i)
    for (int32_t j = 0; j < TWO; ++j)
      if (i / b->n == j / b->n)
        r[i] -= m[i % b->n * b->n + j % b->n] * am[j]
                + k[i % b->n * b->n + j % b->n] * uf[j];
}

/* Equal bars that meet with +-v: in contact for 2 L / c with stress rho c v,
 * then each has the other's velocity. */
static void
equal_bars_swap_velocities(void **unused)
{
  (void)unused;
  static bar b;
  bar_open(&b, TWO / 2 - 1, 4, 400, 1);
  abut_time_options options = abut_time_defaults();
  options.name = "contact stabilised";
  abut_time_scheme scheme;
  assert_ok(abut_time_scheme_make(&options, &scheme));
  abut_context *context = fixture_context();
  const int32_t nodes[] = {TWO / 2, TWO / 2 - 1};
  const double sides[] = {1, -1}, dt = 0.01;
  static double u[TWO], v[TWO], a[TWO], matrix[2][TWO * TWO];
  for (int32_t i = 0; i < TWO; ++i)
    v[i] = i < TWO / 2 ? 3 : -3;
  const abut_time_state state = {sizeof(state), &scheme, dt, TWO, u, v, a,
                                 NULL};
  for (int stage = 0; stage < 2; ++stage)
  {
    abut_time_weights w;
    assert_ok(abut_time_weigh(&scheme, dt, (abut_time_stage)stage, &w));
    for (int32_t i = 0; i < TWO * TWO; ++i)
    {
      const int32_t r = i / TWO, c = i % TWO;
      const int32_t at = r % b.n * b.n + c % b.n;
      matrix[stage][i] =
          r / b.n == c / b.n ? w.mass * b.m[at] + w.stiffness * b.k[at] : 0;
    }
  }
  double impulse = 0;
  int released = 0;
  const abut_strategy_options exact = exact_options();
  for (int step = 1; step <= 60; ++step)
  {
    double x[TWO], place[TWO], am[TWO], uf[TWO], force = 0;
    assert_ok(abut_time_begin(&state, x));
    for (int stage = 0; stage < 2; ++stage)
    {
      double r[TWO] = {0}, y[TWO] = {0}, p = 0;
      const abut_time_arguments arguments = {sizeof(arguments), am, NULL, uf};
      assert_ok(abut_time_evaluate(&state, x, &arguments));
      if (stage == ABUT_TIME_STEP)
        add_force_of_both(&b, b.m, b.k, am, uf, r);
      abut_points *points = NULL;
      assert_ok(abut_points_create(context, 1, &points));
      assert_ok(abut_points_append_scalar(points, 0, 1,
                                          x[TWO / 2] - x[TWO / 2 - 1],
                                          ABUT_POINT_CONTACT, 2, nodes, sides));
      const abut_dense_model model = {sizeof(model), TWO, matrix[stage], r,
                                      points,        NULL};
      abut_reason reason;
      assert_ok(abut_dense_model_solve(context, &model, &exact, y, &p, NULL,
                                       NULL, NULL, NULL, &reason));
      assert_int_equal(reason, ABUT_REASON_CONVERGED);
      assert_ok(abut_points_destroy(&points));
      for (int32_t i = 0; i < TWO; ++i)
        place[i] = x[i] + y[i];
      if (stage == ABUT_TIME_PROJECTION)
        assert_ok(abut_time_project(&state, x, place));
      memcpy(x, place, sizeof(x));
      force += p;
    }
    assert_ok(abut_time_end(&state, x));
    impulse += dt * force;
    if (force > 1e-7)
      released = step;
    /* rho c v = 60. */
    if (step == 20)
      assert_close(force / 60, 1, 0.03);
  }
  assert_close(released * dt, 0.4, 0.051);
  assert_close(impulse / 24, 1, 0.02);
  double momentum[2] = {0, 0};
  for (int32_t i = 0; i < TWO; ++i)
    momentum[i / b.n] += b.full_mass[i % b.n] * v[i];
  assert_close(momentum[0], -momentum[1], 1e-12);
  assert_close(momentum[1] / 12, 1, 0.04);
  assert_ok(abut_context_destroy(&context));
}

/* Contact is always closed: a linear system, whose limit is known for a bar
 * without end. */
static abut_time_verdict
vibrate(double part_of_limit, int steps)
{
  static bar b;
  bar_open(&b, 50, 10, 900, 1);
  /* Fixed at its far end, and so stretched that contact never opens. */
  b.clamped = true;
  b.wall = 1;
  b.penalty = 900 / b.h;
  const double pressed = b.penalty * b.wall / (b.penalty + 90);
  for (int32_t i = 0; i < b.n; ++i)
    b.u[i] = pressed * (1 - i * b.h / 10);
  for (int32_t i = 0; i + 1 < b.n; ++i)
    b.v[i] = i % 2 ? 0.1 : -0.1;
  const double limit = 2 / sqrt(2 + 2 * sqrt(2.)) * b.h / 30;
  bar_use(&b, "central difference", part_of_limit * limit,
          ABUT_TIME_MASS_LUMPED, ABUT_MASS_NEIGHBOURS);
  abut_time_balance balance = {.struct_size = sizeof(balance)};
  abut_time_verdict verdict = ABUT_TIME_STEADY;
  for (int step = 0; step <= steps && verdict != ABUT_TIME_BLOWS_UP; ++step)
  {
    const abut_time_energy now = {
        sizeof(now), bar_kinetic(&b), bar_strain(&b), bar_contact(&b), 0, 0};
    assert_ok(abut_time_judge(&b.scheme, &now, &balance, &verdict));
    bar_step(&b);
  }
  /* Energy swings with the step, and is not made. */
  assert_true(verdict == ABUT_TIME_BLOWS_UP || balance.gain < 1);
  return verdict;
}

static void
central_difference_has_its_limit(void **unused)
{
  (void)unused;
  assert_int_not_equal(vibrate(0.98, 4000), ABUT_TIME_BLOWS_UP);
  assert_int_equal(vibrate(1.02, 4000), ABUT_TIME_BLOWS_UP);
}

/* A mass falls, which gives 10, leaves the floor with 84 and flies up against
 * its weight: it has gained 74 of 10 wherever its flight ends, and falls back
 * with it. An impact that loses some takes nothing from what was gained. */
static void
gains_are_of_what_was_given(void **unused)
{
  (void)unused;
  abut_time_scheme scheme;
  assert_ok(abut_time_scheme_make(NULL, &scheme));
  abut_time_balance balance = {.struct_size = sizeof(balance)};
  const double kinetic[] = {0, 5, 10, 84, 40, 0, 84, 30},
               work[] = {0, 5, 10, 10, -34, -74, 10, 10},
               gain[] = {0, 0, 0, 7.4, 7.4, 7.4, 7.4, 7.4};
  for (int i = 0; i < 8; ++i)
  {
    const abut_time_energy now = {sizeof(now), kinetic[i], 0, 0, 0, work[i]};
    abut_time_verdict verdict;
    assert_ok(abut_time_judge(&scheme, &now, &balance, &verdict));
    assert_int_equal(verdict, i < 3 ? ABUT_TIME_STEADY : ABUT_TIME_GAINS);
    assert_close(balance.gain, gain[i], 1e-12);
  }
  assert_close(balance.scale, 10, 1e-12);
}

/* Half of what the first step gives is made, and loads give a thousand times as
 * much later: a gain of that part. */
static void
gains_are_of_what_is_given_later(void **unused)
{
  (void)unused;
  abut_time_scheme scheme;
  assert_ok(abut_time_scheme_make(NULL, &scheme));
  abut_time_balance balance = {.struct_size = sizeof(balance)};
  const double work[] = {0, 1, 10, 1000}, gain[] = {0, 0.5, 0.05, 0.0005};
  for (int i = 0; i < 4; ++i)
  {
    const double kinetic = i > 0 ? work[i] + 0.5 : 0;
    const abut_time_energy now = {sizeof(now), kinetic, 0, 0, 0, work[i]};
    abut_time_verdict verdict;
    assert_ok(abut_time_judge(&scheme, &now, &balance, &verdict));
    assert_close(balance.gain, gain[i], 1e-12);
    assert_int_equal(verdict,
                     gain[i] > 1e-3 ? ABUT_TIME_GAINS : ABUT_TIME_STEADY);
  }
}

/* What lies on a floor and is thrown up from it has nothing but made energy. */
static void
energy_of_nothing_blows_up(void **unused)
{
  (void)unused;
  abut_time_scheme scheme;
  assert_ok(abut_time_scheme_make(NULL, &scheme));
  abut_time_balance balance = {.struct_size = sizeof(balance)};
  abut_time_verdict verdict = ABUT_TIME_STEADY;
  for (int i = 0; i < 2; ++i)
  {
    const abut_time_energy now = {sizeof(now), 2. * i, 0, 0, 0, -1. * i};
    assert_ok(abut_time_judge(&scheme, &now, &balance, &verdict));
  }
  assert_int_equal(verdict, ABUT_TIME_BLOWS_UP);
}

/* What goes beside friction and damping is lost, that of impulses on purpose.
 */
static void
losses_are_told(void **unused)
{
  (void)unused;
  const struct
  {
    double kinetic, strain, dissipated, work, loss, fall;
    int64_t fall_at;
    bool is_told;
  } rows[] = {{100, 0, 0, 0, 0, 0, 0, false},
              {60, 30, 10, 0, 0, 0, 0, false},
              {70, 14, 12, 0, 0.04, 4, 2, false},
              /* Loads give 150 more. */
              {200, 34, 12, 150, 4. / 250, 4, 2, false},
              {195, 30, 12, 150, 13. / 250, 9, 4, true},
              {195, 39, 12, 150, 4. / 250, 9, 4, false}};
  for (int k = 0; k < 2; ++k)
  {
    abut_time_options options = abut_time_defaults();
    options.name = k ? "velocity level" : "trapezoid";
    abut_time_scheme scheme;
    assert_ok(abut_time_scheme_make(&options, &scheme));
    abut_time_balance balance = {.struct_size = sizeof(balance)};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); ++i)
    {
      const abut_time_energy now = {sizeof(now),        rows[i].kinetic,
                                    rows[i].strain,     0,
                                    rows[i].dissipated, rows[i].work};
      abut_time_verdict verdict;
      assert_ok(abut_time_judge(&scheme, &now, &balance, &verdict));
      assert_int_equal(verdict, rows[i].is_told && k == 0 ? ABUT_TIME_LOSES
                                                          : ABUT_TIME_STEADY);
      assert_close(balance.loss, rows[i].loss, 1e-12);
      assert_close(balance.fall, rows[i].fall, 1e-12);
      assert_int_equal(balance.fall_at, rows[i].fall_at);
    }
  }
}

/* The error of u'' = -u - v/5 at t = 1 in so many steps; damping and stiffness
 * are numbers, so that the step is a division. */
static double
oscillator_error(const abut_time_scheme *scheme, int steps)
{
  const double c = 0.2, decay = c / 2, omega = sqrt(1 - decay * decay);
  double u = 1, v = 0, a = -1;
  const double dt = 1. / steps;
  const abut_time_state state = {sizeof(state), scheme, dt, 1, &u, &v, &a,
                                 NULL};
  abut_time_weights w;
  assert_ok(abut_time_weigh(scheme, dt, ABUT_TIME_STEP, &w));
  const double tangent = w.mass + c * w.damping + w.stiffness;
  for (int k = 0; k < steps; ++k)
  {
    double x, am, vf, uf;
    assert_ok(abut_time_begin(&state, &x));
    if (scheme->beta == 0)
      x = 0;
    const abut_time_arguments arguments = {sizeof(arguments), &am, &vf, &uf};
    assert_ok(abut_time_evaluate(&state, &x, &arguments));
    x -= (am + c * vf + uf) / tangent;
    assert_ok(abut_time_end(&state, &x));
  }
  const double exact = exp(-decay) * (cos(omega) + decay / omega * sin(omega));
  return fabs(u - exact);
}

static void
schemes_are_of_second_order(void **unused)
{
  (void)unused;
  int n = 0;
  for (int32_t i = 0; abut_time_scheme_name(i) != NULL; ++i, ++n)
  {
    abut_time_options options = abut_time_defaults();
    options.name = abut_time_scheme_name(i);
    abut_time_scheme scheme;
    assert_ok(abut_time_scheme_make(&options, &scheme));
    const double rate =
        log2(oscillator_error(&scheme, 100) / oscillator_error(&scheme, 200));
    /* The damping of explicit schemes lags by half a step. */
    const double order = scheme.beta == 0 ? 1 : 2;
    assert_close(rate, order, 0.06);
  }
  assert_int_equal(n, 10);
}

/* One step of the contact problem of a single mass with friction, unknown is
 * the increment of the displacement. */
static double
friction_step(abut_context *context, double matrix, double residual,
              double slip, double *traction)
{
  const double stiffness[] = {matrix, 0, 0, matrix}, load[] = {residual, -1};
  const double frame[] = {0, -1, 1, 0}, gap[] = {0, slip}, one = 1, mu = 0.1;
  const int32_t node = 0, first = 0;
  const uint8_t tangents = 1;
  abut_points *points = NULL;
  assert_ok(abut_points_create(context, 2, &points));
  abut_point point = abut_point_defaults();
  point.n_components = 2;
  point.frame = frame;
  point.gap = gap;
  point.n_nodes = point.n_secondary = 1;
  point.node = &node;
  point.coefficient = &one;
  assert_ok(abut_points_append(points, &point));
  abut_strategy_friction friction = {.struct_size = sizeof(friction)};
  friction.n = 1;
  friction.first = &first;
  friction.n_tangents = &tangents;
  friction.coefficient = &mu;
  const abut_dense_model model = {sizeof(model), 2,      stiffness,
                                  load,          points, &friction};
  abut_strategy_options options = exact_options();
  options.gap_tolerance = options.pressure_tolerance = 1e-12;
  double y[2] = {0, 0}, p[2] = {1, 0};
  abut_reason reason;
  assert_ok(abut_dense_model_solve(context, &model, &options, y, p, NULL, NULL,
                                   NULL, NULL, &reason));
  assert_int_equal(reason, ABUT_REASON_CONVERGED);
  assert_ok(abut_points_destroy(&points));
  *traction = p[1];
  return y[0];
}

/* m = k = 1, friction 0.1, let go at 1. */
static void
mass_on_a_spring_comes_to_rest(void **unused)
{
  (void)unused;
  const int steps[] = {314, 629, 943, 1257};
  const double turns[] = {-0.79999882074, 0.59999644629, -0.400007694498,
                          0.200007301401};
  abut_time_options options = abut_time_defaults();
  options.name = "velocity level";
  abut_time_scheme scheme;
  assert_ok(abut_time_scheme_make(&options, &scheme));
  abut_context *context = fixture_context();
  double u = 1, v = 0, a = 0, largest = 0, dissipated = 0;
  const double dt = 0.01;
  const abut_time_state state = {sizeof(state), &scheme, dt, 1, &u, &v, &a,
                                 NULL};
  abut_time_weights w;
  assert_ok(abut_time_weigh(&scheme, dt, ABUT_TIME_STEP, &w));
  int turn = 0;
  for (int step = 1; step <= 1700; ++step)
  {
    double x, am, uf, traction;
    const double before = u, v_before = v;
    assert_ok(abut_time_begin(&state, &x));
    const abut_time_arguments arguments = {sizeof(arguments), &am, NULL, &uf};
    assert_ok(abut_time_evaluate(&state, &x, &arguments));
    x += friction_step(context, w.mass + w.stiffness, -am - uf, dt * v / 2,
                       &traction);
    assert_ok(abut_time_end(&state, &x));
    dissipated -= dt * traction * (v + v_before) / 2;
    largest = fmax(largest, (u * u + v * v) / 2 + dissipated - 0.5);
    /* A turning point is where the displacement turns back. */
    if (turn < 4 && v * v_before < 0)
    {
      const bool is_here = fabs(before) >= fabs(u);
      assert_int_equal(is_here ? step - 1 : step, steps[turn]);
      assert_close(is_here ? before : u, turns[turn], 1e-9);
      ++turn;
    }
    if (step >= 1572)
      assert_close(u, -9.62192652e-6, 1e-12);
    if (step >= 1572)
      assert_true(fabs(v) < 1e-12);
  }
  assert_int_equal(turn, 4);
  assert_true(largest < 1e-12);
  assert_ok(abut_context_destroy(&context));
}

/* y = K x of a chain of unit springs between two walls, for some of its masses.
 */
static void
chain_product(int32_t n, const double *x, double *y)
{
  for (int32_t i = 0; i < n; ++i)
    y[i] = 2 * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < n ? x[i + 1] : 0);
}

/* Power iteration, with the unknowns of a chain in two parts as if they were
 * those of two processes. */
static abut_time_limit
limit_of_chain(int32_t n, int32_t cut, const double *mass)
{
  double x[64], y[64];
  abut_time_limit limit;
  assert_ok(abut_time_limit_begin(&limit, cut, n - cut, x + cut));
  assert_ok(abut_time_limit_begin(&limit, 0, cut, x));
  do
  {
    double sums[2], more[2];
    chain_product(n, x, y);
    assert_ok(abut_time_limit_sums(cut, mass, x, y, sums));
    assert_ok(
        abut_time_limit_sums(n - cut, mass + cut, x + cut, y + cut, more));
    sums[0] += more[0];
    sums[1] += more[1];
    abut_time_limit part = limit;
    assert_ok(abut_time_limit_next(&part, sums, cut, mass, y, x));
    assert_ok(abut_time_limit_next(&limit, sums, n - cut, mass + cut, y + cut,
                                   x + cut));
  } while (limit.goes_on);
  return limit;
}

/* Equal masses m: omega = 2 / sqrt(m) cos(pi / (2 n + 2)). Held masses count as
 * walls. */
static void
power_iteration_finds_the_limit(void **unused)
{
  (void)unused;
  double mass[64];
  for (int32_t i = 0; i < 64; ++i)
    mass[i] = 0.25;
  for (int32_t n = 1; n <= 64; n *= 4)
  {
    const double exact = 0.5 / cos(acos(-1.) / (2 * n + 2));
    const abut_time_limit limit = limit_of_chain(n, 0, mass);
    assert_true(limit.step >= exact * (1 - 1e-12));
    assert_close(limit.step, exact, 1e-3 * exact);
    const abut_time_limit apart = limit_of_chain(n, n / 2, mass);
    assert_close(apart.step, limit.step, 1e-9 * exact);
  }
  mass[7] = 0;
  /* Seven masses on each side of the one that is held. */
  assert_close(limit_of_chain(15, 4, mass).step, 0.5 / cos(acos(-1.) / 16),
               5e-4);
  mass[0] = 0;
  assert_true(isinf(limit_of_chain(1, 0, mass).step));
}

static abut_status
make(const char *name, double alpha, double rho, double beta)
{
  abut_time_options options = abut_time_defaults();
  options.name = name;
  options.alpha = alpha;
  options.rho_infinity = rho;
  options.beta = beta;
  abut_time_scheme scheme;
  return abut_time_scheme_make(&options, &scheme);
}

static void
arguments_are_checked(void **unused)
{
  (void)unused;
  assert_ok(make("hht", -1. / 3, 2, 0));
  assert_int_equal(make("hht", 0.1, 0, 1), ABUT_INVALID_ARGUMENT);
  assert_int_equal(make("hht", NAN, 0, 1), ABUT_INVALID_ARGUMENT);
  assert_int_equal(make("generalised alpha", 0, 1.1, 1), ABUT_INVALID_ARGUMENT);
  assert_int_equal(make("newmark", 0, 0, 0), ABUT_INVALID_ARGUMENT);
  assert_int_equal(make("runge kutta", 0, 0, 1), ABUT_UNSUPPORTED);
  assert_int_equal(make(NULL, 0, 0, 1), ABUT_INVALID_ARGUMENT);

  abut_time_scheme scheme;
  abut_time_weights weights;
  assert_ok(abut_time_scheme_make(NULL, &scheme));
  assert_string_equal(scheme.name, abut_time_scheme_name(0));
  assert_null(abut_time_scheme_name(-1));
  assert_int_equal(
      abut_time_weigh(&scheme, 0.1, ABUT_TIME_PROJECTION, &weights),
      ABUT_UNSUPPORTED);
  assert_int_equal(abut_time_weigh(&scheme, 0, ABUT_TIME_STEP, &weights),
                   ABUT_INVALID_ARGUMENT);
  double u = 1, v = 2, a = 3, x = 4;
  abut_time_state state = {sizeof(state), &scheme, 0.1, 1, &u, &v, &a, NULL};
  assert_int_equal(abut_time_project(&state, &x, &x), ABUT_WRONG_ORDER);
  x = NAN;
  assert_int_equal(abut_time_end(&state, &x), ABUT_NOT_FINITE);
  assert_true(u == 1 && v == 2 && a == 3);
  state.dt = -1;
  assert_int_equal(abut_time_begin(&state, &x), ABUT_INVALID_ARGUMENT);
  state.dt = 0.1;
  state.velocity = NULL;
  assert_int_equal(abut_time_begin(&state, &x), ABUT_INVALID_ARGUMENT);
  state.scheme = NULL;
  assert_int_equal(abut_time_begin(&state, &x), ABUT_INVALID_ARGUMENT);

  abut_time_balance balance = {.struct_size = sizeof(balance)};
  abut_time_verdict verdict;
  const abut_time_energy none = {.struct_size = sizeof(none), .kinetic = NAN};
  assert_ok(abut_time_judge(&scheme, &none, &balance, &verdict));
  assert_int_equal(verdict, ABUT_TIME_BLOWS_UP);
  assert_int_equal(abut_time_judge(&scheme, &none, NULL, &verdict),
                   ABUT_INVALID_ARGUMENT);
}

/* Of gaps before and after a step: the force times the way is what the spring
 * gives, however short the way; the derivative is that of differences. */
static void
springs_give_what_they_store(void **unused)
{
  (void)unused;
  const double places[] = {-2, -1, -1 + 1e-9, -1e-3, 0, 1e-12, 1e-3, 1, 3},
               stiffness = 7, small = 1e-6;
  const size_t n = sizeof(places) / sizeof(places[0]);
  for (size_t i = 0; i < n; ++i)
    for (size_t k = 0; k < n; ++k)
    {
      const double before = places[i], after = places[k];
      const double in = before < 0 ? before : 0, out = after < 0 ? after : 0;
      double force, slope, higher, lower, unused_slope;
      assert_ok(abut_time_spring(stiffness, before, after, &force, &slope));
      assert_close(force * (after - before) + 1,
                   1 + stiffness / 2 * (in * in - out * out), 1e-14);
      assert_true(force >= 0 && force <= stiffness * fmax(-in, -out));
      assert_true(slope <= 0 && slope >= -stiffness / 2 * (1 + 1e-12));
      assert_ok(abut_time_spring(stiffness, before, after + small, &higher,
                                 &unused_slope));
      assert_ok(abut_time_spring(stiffness, before, after - small, &lower,
                                 &unused_slope));
      /* At the surface the slope turns within the way of one that starts
       * there: 0 and -1/2. */
      if (fabs(before) > 1e-3 || fabs(after) > 1e-3)
        assert_close(1 + (higher - lower) / (2 * small), 1 + slope, 1e-5);
    }
  double force = 0, slope = 0;
  assert_ok(abut_time_spring(4, -0.5, -0.5, &force, &slope));
  assert_close(force, 2, 1e-15);
  assert_int_equal(abut_time_spring(-1, 0, 0, &force, &slope),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_time_spring(1, NAN, 0, &force, &slope),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_time_spring(1, 0, 0, NULL, &slope),
                   ABUT_INVALID_ARGUMENT);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bar_on_a_wall_is_that_of_the_table),
      cmocka_unit_test(falling_bar_bounces_in_time),
      cmocka_unit_test(equal_bars_swap_velocities),
      cmocka_unit_test(central_difference_has_its_limit),
      cmocka_unit_test(power_iteration_finds_the_limit),
      cmocka_unit_test(gains_are_of_what_was_given),
      cmocka_unit_test(gains_are_of_what_is_given_later),
      cmocka_unit_test(energy_of_nothing_blows_up),
      cmocka_unit_test(losses_are_told),
      cmocka_unit_test(schemes_are_of_second_order),
      cmocka_unit_test(mass_on_a_spring_comes_to_rest),
      cmocka_unit_test(springs_give_what_they_store),
      cmocka_unit_test(arguments_are_checked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

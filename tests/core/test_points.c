/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "fixture.h"

#include <abut/points.h>
#include <string.h>

typedef struct scene
{
  abut_context *context;
  abut_points *points;
} scene;

static scene
open_scene(int dimension)
{
  scene s = {fixture_context(), NULL};
  assert_ok(abut_points_create(s.context, dimension, &s.points));
  return s;
}

static void
close_scene(scene *s)
{
  assert_ok(abut_points_destroy(&s->points));
  assert_null(s->points);
  assert_int_equal(abut_context_memory(s->context).live_bytes, 0);
  assert_ok(abut_context_destroy(&s->context));
}

static abut_points_view
view_of(const abut_points *points)
{
  abut_points_view view;
  assert_ok(abut_points_get(points, &view));
  return view;
}

/* Scalar nodes, point i: g = i/10 + 2 u_i - u_(i+1), weight i + 1. */
static void
append_chain(abut_points *points, int n)
{
  const double coefficient[] = {2, -1};
  for (int i = 0; i < n; ++i)
  {
    const int32_t node[] = {i, 1 + i};
    assert_ok(abut_points_append_scalar(points, 10 * i, i + 1, 0.1 * i,
                                        (abut_point_kind)(i % 2), 2, node,
                                        coefficient));
  }
}

static void
view_shows_what_was_appended(void **unused)
{
  (void)unused;
  scene s = open_scene(1);
  append_chain(s.points, 50);
  const abut_points_view view = view_of(s.points);
  assert_int_equal(view.dimension, 1);
  assert_int_equal(view.n_points, 50);
  assert_int_equal(view.n_components, 50);
  assert_int_equal(view.start[0], 0);
  for (int i = 0; i < 50; ++i)
  {
    assert_int_equal(view.id[i], 10 * i);
    assert_int_equal(view.component_id[i], 10 * i);
    assert_int_equal(view.bilateral[i] != 0, i % 2);
    assert_int_equal(view.component_start[i + 1], i + 1);
    assert_int_equal(view.start[i + 1], 2 * i + 2);
    assert_int_equal(view.n_secondary[i], 2);
    assert_int_equal(view.node[2 * i + 1], 1 + i);
    assert_close(view.weight[i], i + 1, 0);
    assert_close(view.component_weight[i], i + 1, 0);
    assert_close(view.gap[i], 0.1 * i, 0);
    assert_close(view.frame[i], -1, 0);
    assert_close(view.coefficient[2 * i], 2, 0);
  }
  close_scene(&s);
}

static void
gap_and_force_are_transposed(void **unused)
{
  (void)unused;
  scene s = open_scene(1);
  append_chain(s.points, 50);
  double u[51], gap[50], p[50], force[51] = {0};
  uint64_t seed = 1;
  for (int i = 0; i < 51; ++i)
    u[i] = fixture_random(&seed) - 0.5;
  for (int i = 0; i < 50; ++i)
    p[i] = fixture_random(&seed);
  assert_ok(abut_points_gap(s.points, 51, u, gap));
  assert_ok(abut_points_add_force(s.points, 51, p, force));
  double work_of_force = 0, work_of_pressure = 0;
  for (int i = 0; i < 50; ++i)
  {
    assert_close(gap[i], 0.1 * i + 2 * u[i] - u[i + 1], 1e-15);
    work_of_pressure += (i + 1) * p[i] * (gap[i] - 0.1 * i);
  }
  for (int i = 0; i < 51; ++i)
    work_of_force += force[i] * u[i];
  assert_close(work_of_force, work_of_pressure, 1e-13);
  close_scene(&s);
}

/* A secondary node in the middle of a primary facet below it, n = -e_z. */
static const double frame[] = {0, 0, -1, 1, 0, 0, 0, -1, 0};
static const double values[] = {0.3, 0.1, -0.2};
static const int32_t corner[] = {4, 0, 1, 2, 3};
static const double quarter[] = {1, -0.25, -0.25, -0.25, -0.25};

static abut_point
over_a_facet(int64_t id, int kind, int32_t n_components)
{
  abut_point p = abut_point_defaults();
  p.id = id;
  p.kind = kind;
  p.n_components = n_components;
  p.weight = 2;
  p.frame = frame;
  p.gap = values;
  p.n_nodes = 5;
  p.n_secondary = 1;
  p.node = corner;
  p.coefficient = quarter;
  return p;
}

static void
components_share_a_stencil(void **unused)
{
  (void)unused;
  scene s = open_scene(3);
  const abut_point p = over_a_facet(7, ABUT_POINT_CONTACT, 3);
  assert_ok(abut_points_append(s.points, &p));
  const abut_points_view view = view_of(s.points);
  assert_int_equal(view.n_components, 3);
  assert_int_equal(view.start[1], 5);
  for (int a = 0; a < 3; ++a)
    assert_int_equal(view.component_id[a], 7 + a);
  /* The secondary rises by 1 and moves by 2 along x and by 3 along y, and the
   * primary, as a whole, rises by 4: the gap closes by 3, and the slip of the
   * secondary is 2 along t1 = e_x and -3 along t2 = -e_y. */
  double v[15] = {0}, value[3];
  for (int l = 0; l < 4; ++l)
    v[3 * l + 2] = 4;
  v[12] = 2;
  v[13] = 3;
  v[14] = 1;
  assert_ok(abut_points_gap(s.points, 5, v, value));
  assert_close(value[0], 0.3 - 3, 1e-15);
  assert_close(value[1], 0.1 + 2, 1e-15);
  assert_close(value[2], -0.2 - 3, 1e-15);
  /* A pressure 5 lifts the secondary, a traction -1 along t1 holds it back;
   * action is reaction. */
  const double pressure[] = {5, -1, 0};
  double force[15] = {0};
  assert_ok(abut_points_add_force(s.points, 5, pressure, force));
  assert_close(force[12], -2, 1e-15);
  assert_close(force[13], 0, 1e-15);
  assert_close(force[14], 10, 1e-15);
  for (int l = 0; l < 4; ++l)
  {
    assert_close(force[3 * l], 0.5, 1e-15);
    assert_close(force[3 * l + 2], -2.5, 1e-15);
  }
  close_scene(&s);
}

static void
all_components_of_a_tie_are_gaps(void **unused)
{
  (void)unused;
  scene s = open_scene(3);
  const double axes[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  abut_point p = over_a_facet(9, ABUT_POINT_TIE, 3);
  p.frame = axes;
  assert_ok(abut_points_append(s.points, &p));
  const abut_points_view view = view_of(s.points);
  double v[15] = {0}, value[3];
  v[12] = 2;
  v[13] = 3;
  v[14] = 1;
  assert_ok(abut_points_gap(s.points, 5, v, value));
  for (int a = 0; a < 3; ++a)
  {
    assert_close(value[a], values[a] - v[12 + a], 1e-15);
    assert_true(view.bilateral[a] != 0);
    assert_close(view.component_weight[a], 2, 0);
  }
  close_scene(&s);
}

/* Points with one component before and after ones with three. */
static void
components_follow_their_points(void **unused)
{
  (void)unused;
  scene s = open_scene(3);
  const int n[] = {1, 1, 3, 1, 2};
  int32_t first = 0;
  for (int i = 0; i < 5; ++i)
  {
    const abut_point p = over_a_facet(10 * i, i % 2, n[i]);
    assert_ok(abut_points_append(s.points, &p));
  }
  const abut_points_view view = view_of(s.points);
  assert_int_equal(view.n_components, 8);
  for (int i = 0; i < 5; ++i)
  {
    assert_int_equal(view.component_start[i], first);
    for (int a = 0; a < n[i]; ++a, ++first)
    {
      assert_int_equal(view.component_id[first], 10 * i + a);
      assert_int_equal(view.bilateral[first] != 0, i % 2);
      assert_close(view.gap[first], values[a], 0);
      for (int d = 0; d < 3; ++d)
        assert_close(view.frame[3 * first + d], frame[3 * a + d], 0);
    }
  }
  close_scene(&s);
}

/* The obstacle of points 0 and 1 is one node more: it takes what they give. */
static void
a_driven_obstacle_is_a_node(void **unused)
{
  (void)unused;
  scene s = open_scene(2);
  enum
  {
    OBSTACLE = 2
  };
  const double down[] = {0, -1}, gap = 0, both[] = {1, -1};
  for (int i = 0; i < 2; ++i)
  {
    const int32_t node[] = {i, OBSTACLE};
    abut_point p = abut_point_defaults();
    p.id = i;
    p.weight = 0.5;
    p.frame = down;
    p.gap = &gap;
    p.n_nodes = 2;
    p.n_secondary = 1;
    p.node = node;
    p.coefficient = both;
    assert_ok(abut_points_append(s.points, &p));
  }
  const double v[] = {0, 0, 0, 0.25, 7, 0.5}, pressure[] = {2, 4};
  double value[2], force[6] = {0};
  assert_ok(abut_points_gap(s.points, 3, v, value));
  assert_close(value[0], -0.5, 1e-15);
  assert_close(value[1], -0.25, 1e-15);
  assert_ok(abut_points_add_force(s.points, 3, pressure, force));
  assert_close(force[1], 1, 1e-15);
  assert_close(force[3], 2, 1e-15);
  assert_close(force[2 * OBSTACLE], 0, 1e-15);
  assert_close(force[2 * OBSTACLE + 1], -3, 1e-15);
  close_scene(&s);
}

static void
filter_keeps_what_it_is_told(void **unused)
{
  (void)unused;
  scene s = open_scene(3);
  const int n[] = {1, 3, 2, 1, 3, 3};
  const uint8_t keep[] = {0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 0, 1};
  for (int i = 0; i < 6; ++i)
  {
    abut_point p =
        over_a_facet(10 * i, i < 5 ? ABUT_POINT_TIE : ABUT_POINT_CONTACT, n[i]);
    p.n_nodes = 1 + i % 5;
    p.weight = 1 + i;
    assert_ok(abut_points_append(s.points, &p));
  }
  assert_ok(abut_points_filter(s.points, keep));
  /* Points and, of each, components that are left: the second loses the one in
   * the middle, and so does the last, a contact point, of its tangents. */
  const int left[] = {1, 3, 4, 5},
            components[][3] = {{0, 2, -1}, {0, -1, -1}, {0, 1, 2}, {0, 2, -1}};
  const abut_points_view view = view_of(s.points);
  int32_t row = 0;
  assert_int_equal(view.n_points, 4);
  assert_int_equal(view.n_components, 8);
  for (int k = 0; k < 4; ++k)
  {
    const int i = left[k];
    assert_int_equal(view.id[k], 10 * i);
    assert_int_equal(view.component_start[k], row);
    assert_close(view.weight[k], 1 + i, 0);
    assert_int_equal(view.start[k + 1] - view.start[k], 1 + i % 5);
    for (int l = 0; l <= i % 5; ++l)
    {
      assert_int_equal(view.node[view.start[k] + l], corner[l]);
      assert_close(view.coefficient[view.start[k] + l], quarter[l], 0);
    }
    for (int a = 0; a < 3 && components[k][a] >= 0; ++a, ++row)
    {
      assert_int_equal(view.component_id[row], 10 * i + a);
      assert_int_equal(view.bilateral[row] != 0, i < 5);
      assert_close(view.gap[row], values[components[k][a]], 0);
      for (int d = 0; d < 3; ++d)
        assert_close(view.frame[3 * row + d], frame[3 * components[k][a] + d],
                     0);
    }
  }
  assert_int_equal(row, 8);
  close_scene(&s);
}

static void
nodes_get_new_numbers(void **unused)
{
  (void)unused;
  scene s = open_scene(1);
  append_chain(s.points, 2);
  const int32_t number[] = {5, 7, 6}, negative[] = {5, -1, 6};
  assert_ok(abut_points_renumber(s.points, 3, number));
  const abut_points_view view = view_of(s.points);
  const int32_t expected[] = {5, 7, 7, 6};
  for (int e = 0; e < 4; ++e)
    assert_int_equal(view.node[e], expected[e]);
  assert_int_equal(abut_points_renumber(s.points, 3, number),
                   ABUT_INVALID_ARGUMENT);
  assert_ok(abut_points_clear(s.points));
  append_chain(s.points, 2);
  assert_int_equal(abut_points_renumber(s.points, 3, negative),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_renumber(s.points, 3, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(view_of(s.points).node[1], 1);
  close_scene(&s);
}

static void
clear_keeps_the_memory(void **unused)
{
  (void)unused;
  scene s = open_scene(1);
  append_chain(s.points, 50);
  const abut_memory_usage before = abut_context_memory(s.context);
  assert_ok(abut_points_clear(s.points));
  assert_int_equal(view_of(s.points).n_points, 0);
  append_chain(s.points, 50);
  const abut_memory_usage after = abut_context_memory(s.context);
  assert_int_equal(before.n_allocations, after.n_allocations);
  close_scene(&s);
}

static void
reserved_points_need_no_memory(void **unused)
{
  (void)unused;
  scene s = open_scene(1);
  assert_ok(abut_points_reserve(s.points, 50, 50, 100));
  const abut_memory_usage before = abut_context_memory(s.context);
  append_chain(s.points, 50);
  const abut_memory_usage after = abut_context_memory(s.context);
  assert_int_equal(before.n_allocations, after.n_allocations);
  close_scene(&s);
}

/* Change one field of a good point and expect an answer. */
#define EXPECT(field, value, status)                                           \
  do                                                                           \
  {                                                                            \
    abut_point bad = good;                                                     \
    bad.field = value;                                                         \
    assert_int_equal(abut_points_append(s.points, &bad), status);              \
  } while (0)

static void
appending_checks_its_point(void **unused)
{
  (void)unused;
  scene s = open_scene(3);
  const abut_point good = over_a_facet(5, ABUT_POINT_CONTACT, 3);
  const double wrong[] = {NAN, 0, 0, 0, 0, 0, 0, 0, 0};
  const int32_t negative[] = {0, 1, 2, 3, -1};
  assert_ok(abut_points_append(s.points, &good));
  EXPECT(struct_size, 8, ABUT_INVALID_ARGUMENT);
  EXPECT(id, -1, ABUT_INVALID_ARGUMENT);
  EXPECT(kind, 2, ABUT_INVALID_ARGUMENT);
  EXPECT(n_components, 0, ABUT_INVALID_ARGUMENT);
  EXPECT(n_components, 4, ABUT_INVALID_ARGUMENT);
  EXPECT(weight, 0, ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(s.context), "point 5"));
  EXPECT(weight, NAN, ABUT_NOT_FINITE);
  EXPECT(frame, NULL, ABUT_INVALID_ARGUMENT);
  EXPECT(frame, wrong, ABUT_NOT_FINITE);
  EXPECT(gap, NULL, ABUT_INVALID_ARGUMENT);
  EXPECT(gap, wrong, ABUT_NOT_FINITE);
  EXPECT(n_nodes, -1, ABUT_INVALID_ARGUMENT);
  EXPECT(n_secondary, 6, ABUT_INVALID_ARGUMENT);
  EXPECT(node, NULL, ABUT_INVALID_ARGUMENT);
  EXPECT(node, negative, ABUT_INVALID_ARGUMENT);
  EXPECT(coefficient, NULL, ABUT_INVALID_ARGUMENT);
  EXPECT(coefficient, wrong, ABUT_NOT_FINITE);
  assert_int_equal(abut_points_append(NULL, &good), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_append(s.points, NULL), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_append_scalar(s.points, 6, 1, 0,
                                             ABUT_POINT_CONTACT, 1, corner,
                                             quarter),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_append_scalar(NULL, 6, 1, 0, ABUT_POINT_CONTACT,
                                             1, corner, quarter),
                   ABUT_INVALID_ARGUMENT);
  /* Nothing of all that was kept. */
  assert_int_equal(view_of(s.points).n_points, 1);
  close_scene(&s);
}

static void
products_check_their_range(void **unused)
{
  (void)unused;
  scene s = open_scene(1);
  append_chain(s.points, 2);
  double u[3] = {0, 0, 0}, gap[2], p[2] = {NAN, 0};
  assert_int_equal(abut_points_gap(s.points, 2, u, gap), ABUT_INVALID_ARGUMENT);
  assert_non_null(strstr(abut_context_message(s.context), "node 2"));
  assert_int_equal(abut_points_gap(s.points, 3, NULL, gap),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_gap(s.points, 3, u, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_gap(NULL, 3, u, gap), ABUT_INVALID_ARGUMENT);
  u[1] = INFINITY;
  assert_int_equal(abut_points_gap(s.points, 3, u, gap), ABUT_NOT_FINITE);
  assert_int_equal(abut_points_add_force(s.points, 3, p, u), ABUT_NOT_FINITE);
  assert_int_equal(abut_points_add_force(s.points, 3, NULL, u),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_add_force(NULL, 3, p, u), ABUT_INVALID_ARGUMENT);
  close_scene(&s);
}

static void
other_arguments_are_checked(void **unused)
{
  (void)unused;
  scene s = open_scene(2);
  abut_points *none = NULL;
  assert_int_equal(abut_points_create(NULL, 2, &none), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_create(s.context, 2, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_create(s.context, 0, &none),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_create(s.context, 4, &none),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_destroy(NULL), ABUT_INVALID_ARGUMENT);
  assert_ok(abut_points_destroy(&none));
  assert_int_equal(abut_points_clear(NULL), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_reserve(NULL, 1, 1, 1), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_reserve(s.points, -1, 1, 1),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_reserve(s.points, 1, -1, 1),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_reserve(s.points, 1, 1, -1),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_filter(NULL, NULL), ABUT_INVALID_ARGUMENT);
  assert_ok(abut_points_filter(s.points, NULL));
  assert_int_equal(abut_points_renumber(NULL, 0, NULL), ABUT_INVALID_ARGUMENT);
  assert_ok(abut_points_renumber(s.points, 0, NULL));
  assert_int_equal(abut_points_get(s.points, NULL), ABUT_INVALID_ARGUMENT);
  abut_points_view view = {0};
  assert_int_equal(abut_points_get_sized(s.points, &view),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_points_get(NULL, &view), ABUT_INVALID_ARGUMENT);
  close_scene(&s);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(view_shows_what_was_appended),
      cmocka_unit_test(gap_and_force_are_transposed),
      cmocka_unit_test(components_share_a_stencil),
      cmocka_unit_test(all_components_of_a_tie_are_gaps),
      cmocka_unit_test(components_follow_their_points),
      cmocka_unit_test(a_driven_obstacle_is_a_node),
      cmocka_unit_test(filter_keeps_what_it_is_told),
      cmocka_unit_test(nodes_get_new_numbers),
      cmocka_unit_test(clear_keeps_the_memory),
      cmocka_unit_test(reserved_points_need_no_memory),
      cmocka_unit_test(appending_checks_its_point),
      cmocka_unit_test(products_check_their_range),
      cmocka_unit_test(other_arguments_are_checked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

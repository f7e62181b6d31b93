/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Every call that may ask for memory, with every request refused in turn. A
 * story creates objects and uses them, in a context whose n-th request finds
 * none; n grows until none is refused. Once all later requests fail, too: then
 * the story ends with the failing call's status, everything can be destroyed,
 * and nothing is left. Once the n-th alone fails, and the failing call is made
 * again: then the story ends with the numbers that it has with plenty. Which
 * calls belong here is checked by tests/house/check_memory_calls.py. */
#include "fixture.h"
#include "grid.h"
#include "membrane.h"
#include "scarce.h"
#include "scenes.h"

#include <abut/contact_measures.h>
#include <abut/coupling_search.h>
#include <abut/interface.h>
#include <abut/missed_contact.h>
#include <abut/obstacle_facets.h>
#include <abut/pair_checks.h>

#include <string.h>

enum
{
  MOST_REQUESTS = 3000,
  MOST_DIGESTS = 400
};

typedef struct world
{
  abut_context *context;
  bool again; /* a call that found no memory is made a second time */
  int32_t kind;
  abut_surface *a, *b;
  abut_search *search;
  abut_pairs *pairs;
  abut_detection *detection;
  abut_coupling *coupling;
  abut_interface *pair;
  abut_points *points;
  abut_obstacle *obstacle;
  abut_history *history, *other;
  abut_strategy *strategy;
  abut_multigrid *multigrid;
  scene_mesh mesh_a, mesh_b;
  membrane membrane;
  grid grid;
  /* Numbers that the story came to. */
  int n_digests;
  double digest[MOST_DIGESTS];
} world;

typedef abut_status (*story)(world *w);

/* Make a call of a story. */
#define TRY(call)                                                              \
  do                                                                           \
  {                                                                            \
    abut_status status_ = (call);                                              \
    if (status_ == ABUT_OUT_OF_MEMORY)                                         \
    {                                                                          \
      assert_true(strlen(abut_context_message(w->context)) > 0);               \
      if (w->again)                                                            \
        status_ = (call);                                                      \
    }                                                                          \
    if (status_ != ABUT_SUCCESS)                                               \
      return status_;                                                          \
  } while (0)

static void
note(world *w, double value)
{
  assert_true(w->n_digests < MOST_DIGESTS);
  w->digest[w->n_digests++] = value;
}

static void
forget(world *w)
{
  assert_ok(abut_multigrid_destroy(&w->multigrid));
  grid_close(&w->grid);
  assert_ok(abut_strategy_destroy(&w->strategy));
  assert_ok(abut_history_destroy(&w->history));
  assert_ok(abut_history_destroy(&w->other));
  assert_ok(abut_coupling_destroy(&w->coupling));
  assert_ok(abut_interface_destroy(&w->pair));
  assert_ok(abut_points_destroy(&w->points));
  assert_ok(abut_detection_destroy(&w->detection));
  assert_ok(abut_search_destroy(&w->search));
  assert_ok(abut_pairs_destroy(&w->pairs));
  assert_ok(abut_obstacle_destroy(&w->obstacle));
  assert_ok(abut_surface_destroy(&w->a));
  assert_ok(abut_surface_destroy(&w->b));
  scene_free(&w->mesh_a);
  scene_free(&w->mesh_b);
  membrane_destroy(&w->membrane);
}

/* Tell a story; the requests first .. last find no memory. */
static abut_status
tell(story told, int32_t kind, int64_t first, int64_t last, bool again,
     world *w, int64_t *n_requests)
{
  scarce_memory memory = {.first = first, .last = last};
  const abut_context_options options = scarce_options(&memory);
  memset(w, 0, sizeof(*w));
  w->again = again;
  w->kind = kind;
  abut_status status = abut_context_create(&options, &w->context);
  if (status == ABUT_OUT_OF_MEMORY)
    assert_null(w->context);
  if (status == ABUT_OUT_OF_MEMORY && again)
    status = abut_context_create(&options, &w->context);
  if (status == ABUT_SUCCESS)
    status = told(w);
  forget(w);
  assert_int_equal(abut_context_memory(w->context).live_bytes, 0);
  assert_ok(abut_context_destroy(&w->context));
  assert_int_equal(memory.n_live, 0);
  assert_int_equal(memory.bytes_live, 0);
  *n_requests = memory.n_requests;
  return status;
}

static void
deny_each(story told, int32_t kind, int64_t least)
{
  static world plenty, w;
  int64_t n = 0, m = 0;
  assert_ok(tell(told, kind, -1, -1, false, &plenty, &n));
  assert_true(n >= least && n < MOST_REQUESTS);
  assert_true(plenty.n_digests > 0);
  for (int64_t i = 0; i < n; ++i)
  {
    assert_int_equal(tell(told, kind, i, INT64_MAX, false, &w, &m),
                     ABUT_OUT_OF_MEMORY);
    assert_ok(tell(told, kind, i, i, true, &w, &m));
    assert_int_equal(w.n_digests, plenty.n_digests);
    assert_memory_equal(w.digest, plenty.digest,
                        (size_t)w.n_digests * sizeof(double));
  }
}

/* Surfaces: two unit squares of different meshes, the second one above. */
static abut_status
make_surfaces(world *w, abut_facet_kind kind, double height)
{
  const double lower[5] = {0, 0, 1, 1, 0}, upper[5] = {0.2, 0.1, 1, 1, height};
  const double below[4] = {0, 0, 1, 0}, above[4] = {0.2, height, 1.2, height};
  const bool plane = abut_facet_dimension(kind) == 2;
  /* Facets with more nodes than corners take a good deal longer. */
  const bool rich =
      !plane && abut_facet_n_nodes(kind) > abut_facet_n_corners(kind);
  const int32_t more = rich ? 1 : 3, less = rich || plane ? 1 : 2;
  w->mesh_a = scene_patch(kind, more, less, plane ? scene_line : scene_plane,
                          plane ? below : lower, plane);
  w->mesh_b = scene_patch(kind, less, more, plane ? scene_line : scene_plane,
                          plane ? above : upper, !plane);
  const abut_surface_data a = scene_data(&w->mesh_a),
                          b = scene_data(&w->mesh_b);
  TRY(abut_surface_create(w->context, &a, &w->a));
  TRY(abut_surface_create(w->context, &b, &w->b));
  return ABUT_SUCCESS;
}

static abut_status
surfaces(world *w)
{
  TRY(make_surfaces(w, (abut_facet_kind)w->kind, 0.05));
  const double *normal = NULL;
  TRY(abut_surface_normals(w->a, &normal));
  note(w, normal[w->mesh_a.dimension - 1]);
  TRY(abut_surface_update(w->a, w->mesh_a.position));
  abut_surface_sizes sizes;
  TRY(abut_surface_measure(w->a, &sizes));
  note(w, sizes.area);
  uint8_t mask[64], side[64];
  TRY(abut_surface_features(w->a, 0.5, mask));
  note(w, mask[0]);
  abut_box boxes[4];
  int32_t n_boxes = 0;
  TRY(abut_surface_bounds(w->a, 0.1, 4, boxes, &n_boxes));
  note(w, n_boxes);
  const abut_split_options options = abut_split_defaults();
  abut_split_report report;
  TRY(abut_surface_split(w->context, w->a, &options, side, &report));
  note(w, side[0]);
  return ABUT_SUCCESS;
}

static abut_status
note_pairs(world *w)
{
  abut_pairs_view view;
  TRY(abut_pairs_get(w->pairs, &view));
  note(w, (double)view.start[view.n_queries]);
  return ABUT_SUCCESS;
}

static abut_status
searches(world *w)
{
  TRY(make_surfaces(w, ABUT_FACET_QUAD4, 0.05));
  abut_search_options options = abut_search_defaults();
  options.algorithm = (abut_search_algorithm)w->kind;
  options.skin = 0.1;
  TRY(abut_search_create(w->context, w->b, &options, &w->search));
  TRY(abut_pairs_create(w->context, &w->pairs));
  TRY(abut_search_update(w->search));
  TRY(abut_search_nodes(w->search, w->a, w->pairs));
  TRY(note_pairs(w));
  TRY(abut_search_nodes(w->search, w->a, w->pairs)); /* from the list */
  TRY(note_pairs(w));
  TRY(abut_search_facets(w->search, w->a, w->pairs));
  TRY(note_pairs(w));
  TRY(abut_search_set_reach(w->search, 0.5, 0.5, 0.));
  TRY(abut_search_points(w->search, w->mesh_a.n_nodes, w->mesh_a.position,
                         w->pairs));
  TRY(note_pairs(w));
  int32_t facets[64], n_facets = 0;
  const abut_box box = {{0, 0, 0}, {0.3, 0.3, 0.3}};
  TRY(abut_search_select(w->search, 1, &box, facets, &n_facets));
  note(w, n_facets);
  abut_search_statistics statistics;
  TRY(abut_search_get_statistics(w->search, &statistics));
  return ABUT_SUCCESS;
}

/* Nodes that are missed where the surfaces stand and on their way there, all in
 * the other surface by a gap. */
static abut_status
missed_contact(world *w)
{
  uint8_t marks[64];
  abut_missed_node missed[256];
  abut_missed_options options = abut_missed_defaults();
  abut_missed_report report;
  memset(marks, ABUT_NODE_OWNED, sizeof(marks));
  for (int paths = 0; paths < 2; ++paths)
  {
    options.gap = paths ? 0. : -0.2;
    options.secondary_start = paths ? w->mesh_a.position : NULL;
    options.primary_start = paths ? w->mesh_b.position : NULL;
    TRY(abut_missed_contact(w->context, w->a, w->b, marks, marks, &options,
                            missed, &report));
    note(w, report.n);
    for (int32_t i = 0; i < report.n; ++i)
      note(w, missed[i].depth);
  }
  return ABUT_SUCCESS;
}

static abut_status
detections(world *w)
{
  TRY(make_surfaces(w, (abut_facet_kind)w->kind, 0.05));
  abut_detection_options options = abut_detection_defaults();
  const int32_t group = 0;
  const double thickness = 1;
  options.n_thicknesses = 1;
  options.thickness_group = &group;
  options.thickness = &thickness;
  TRY(abut_detection_create(w->context, w->a, w->b, &options, &w->detection));
  TRY(abut_detection_pair_groups(w->detection, 0, 0));
  TRY(abut_detection_run(w->detection, 0.));
  TRY(abut_detection_run(w->detection, 0.01));
  abut_detection_report report;
  TRY(abut_detection_make_report(w->detection, &report));
  abut_detection_view view;
  TRY(abut_detection_get(w->detection, &view));
  note(w, report.n_paired);
  for (int32_t i = 0; i < view.n_nodes; ++i)
    note(w, view.contact[i].gap);
  return missed_contact(w);
}

/* Points of a coupling, and what is known of them. */
static abut_status
build(world *w, const abut_coupling_nodes *nodes)
{
  TRY(abut_points_create(w->context, w->mesh_a.dimension, &w->points));
  abut_coupling_target target = abut_coupling_target_defaults(w->points);
  TRY(abut_coupling_search(w->coupling, 0.));
  TRY(abut_coupling_build(w->coupling, nodes, 0., &target));
  target.tie_axes = w->obstacle == NULL ? 3 : 0;
  TRY(abut_points_clear(w->points));
  TRY(abut_coupling_build(w->coupling, nodes, 0., &target));
  abut_points_view points;
  TRY(abut_points_get(w->points, &points));
  abut_coupling_view view;
  TRY(abut_coupling_get(w->coupling, &view));
  abut_coupling_statistics statistics;
  TRY(abut_coupling_get_statistics(w->coupling, &statistics));
  note(w, statistics.covered_area);
  note(w, view.n_points);
  for (int32_t i = 0; i < points.n_points && i < 20; ++i)
    note(w, points.weight[i]);
  return ABUT_SUCCESS;
}

/* kind = discretisation + number of discretisations * kind of facet */
static abut_status
couplings(world *w)
{
  TRY(make_surfaces(w, (abut_facet_kind)(w->kind / ABUT_DISCRETISATION_N),
                    -0.02));
  abut_coupling_options options = abut_coupling_defaults();
  options.discretisation =
      (abut_discretisation)(w->kind % ABUT_DISCRETISATION_N);
  TRY(abut_coupling_create(w->context, w->a, w->b, &options, &w->coupling));
  /* One node hangs between two others, and one carries no multiplier. */
  uint8_t dropped[64] = {0, 1};
  const int32_t node = 2, start[2] = {0, 2}, parent[2] = {0, 3};
  const double weight[2] = {0.5, 0.5};
  abut_coupling_nodes nodes = abut_coupling_nodes_defaults();
  nodes.dropped = dropped;
  nodes.n_hanging = 1;
  nodes.hanging_node = &node;
  nodes.hanging_start = start;
  nodes.hanging_parent = parent;
  nodes.hanging_weight = weight;
  return build(w, &nodes);
}

/* z = 0.02 x^2. */
static int
bowl(void *user, int32_t n, const double *points, double *value,
     double *gradient)
{
  (void)user;
  for (int32_t i = 0; i < n; ++i)
  {
    const double *x = points + 3 * i;
    value[i] = x[2] - 0.02 * x[0] * x[0];
    gradient[3 * i] = -0.04 * x[0];
    gradient[3 * i + 1] = 0;
    gradient[3 * i + 2] = 1;
  }
  return 0;
}

static abut_status
make_obstacle(world *w, int32_t kind)
{
  const abut_obstacle_shape ball = {.struct_size = sizeof(ball),
                                    .dimension = 3,
                                    .kind = ABUT_OBSTACLE_SPHERE,
                                    .point = {0.5, 0.5, 2},
                                    .radius = 1.9};
  abut_obstacle_function function = abut_obstacle_function_defaults();
  function.evaluate = bowl;
  abut_obstacle_surface sheet = abut_obstacle_surface_defaults();
  sheet.open = true;
  switch (kind)
  {
  case 0:
    TRY(abut_obstacle_create_shape(w->context, &ball, &w->obstacle));
    break;
  case 1:
    TRY(abut_obstacle_create_function(w->context, &function, &w->obstacle));
    break;
  default:
    TRY(abut_obstacle_create_surface(w->context, w->b, &sheet, &w->obstacle));
  }
  return ABUT_SUCCESS;
}

/* kind = obstacle + 3 * discretisation */
static abut_status
obstacles(world *w)
{
  TRY(make_surfaces(w, ABUT_FACET_QUAD4, 0.05));
  TRY(make_obstacle(w, w->kind % 3));
  const double shift[3] = {0, 0, 0.01};
  TRY(abut_obstacle_set_pose(w->obstacle, NULL, shift));
  double distance[64], gradient[192], hessian[576];
  TRY(abut_obstacle_distance(w->obstacle, w->mesh_a.n_nodes, w->mesh_a.position,
                             distance, gradient, hessian));
  for (int32_t i = 0; i < w->mesh_a.n_nodes; ++i)
    note(w, distance[i]);
  TRY(abut_surface_update(w->b, w->mesh_b.position));
  TRY(abut_obstacle_distance(w->obstacle, w->mesh_a.n_nodes, w->mesh_a.position,
                             distance, NULL, NULL));
  TRY(abut_obstacle_gap(w->obstacle, w->mesh_a.n_nodes, w->mesh_a.position,
                        distance, gradient, hessian));
  abut_obstacle_path path[64];
  TRY(abut_obstacle_follow(w->obstacle, w->mesh_a.n_nodes, w->mesh_a.position,
                           w->mesh_b.position, path));
  note(w, path[0].depth);
  double normal[192], size[64];
  for (int32_t i = 0; i < 3 * w->mesh_a.n_nodes; ++i)
    normal[i] = -gradient[i];
  for (int32_t i = 0; i < w->mesh_a.n_nodes; ++i)
    size[i] = 1;
  TRY(abut_obstacle_face(w->obstacle, true, w->mesh_a.n_nodes,
                         w->mesh_a.position, normal, size, distance, gradient,
                         hessian));
  abut_coupling_options options = abut_coupling_defaults();
  options.discretisation = (abut_discretisation)(w->kind / 3);
  TRY(abut_coupling_create_obstacle(w->context, w->a, w->obstacle, &options,
                                    &w->coupling));
  return build(w, NULL);
}

/* A pair of bodies that move, and its points. kind = discretisation */
static abut_status
interfaces(world *w)
{
  TRY(make_surfaces(w, ABUT_FACET_QUAD4, 0.05));
  abut_interface_options options = abut_interface_defaults();
  options.coupling.discretisation = (abut_discretisation)w->kind;
  options.kinematics = ABUT_KINEMATICS_CURRENT;
  options.facet_size = 0.5;
  TRY(abut_interface_create(w->context, w->a, w->b, NULL, &options, &w->pair));
  TRY(abut_points_create(w->context, w->mesh_a.dimension, &w->points));
  const int32_t n = w->mesh_a.n_nodes + w->mesh_b.n_nodes;
  double position[384], displacement[384] = {0.}, clearance[64];
  assert_in_range(3 * n, 1, 384);
  memcpy(position, w->mesh_a.position,
         (size_t)w->mesh_a.n_nodes * 3 * sizeof(double));
  memcpy(position + 3 * w->mesh_a.n_nodes, w->mesh_b.position,
         (size_t)w->mesh_b.n_nodes * 3 * sizeof(double));
  TRY(abut_interface_move(w->pair, n, position));
  abut_interface_target target = abut_interface_target_defaults(w->points);
  target.n_nodes = n;
  target.displacement = displacement;
  TRY(abut_interface_build(w->pair, &target));
  abut_points_view view;
  abut_places_view places;
  TRY(abut_points_get(w->points, &view));
  TRY(abut_points_get_places(w->points, &places));
  note(w, places.n_points);
  note(w, view.n_points > 0 ? view.gap[0] : 0.);
  if (view.n_components > 64)
    return ABUT_SUCCESS;
  TRY(abut_interface_clearances(w->pair, w->points, NULL, 0.2, 0., n,
                                clearance));
  note(w, view.n_points > 0 ? clearance[0] : 0.);
  double value[64];
  uint8_t states[64];
  for (int i = 0; i < 64; ++i)
  {
    value[i] = 1.;
    states[i] = 1; /* closed */
  }
  const abut_kinematics kinematics[1] = {ABUT_KINEMATICS_CURRENT};
  const abut_node_positions nodes = {
      sizeof(nodes), n, 1, position, NULL, displacement, kinematics};
  abut_direction_change change;
  TRY(abut_interface_rotation(w->pair, w->points, &nodes, value, states,
                              &change));
  note(w, change.force);
  return ABUT_SUCCESS;
}

/* A ball between the nodes of facets. */
static abut_status
obstacle_in_facets(world *w)
{
  TRY(make_surfaces(w, ABUT_FACET_QUAD4, 0.05));
  TRY(make_obstacle(w, 0));
  abut_facet_samples samples = abut_facet_samples_defaults();
  samples.n = 3;
  abut_facet_depth found[64];
  abut_obstacle_beside beside;
  int32_t n = 0;
  double way = 0.;
  TRY(abut_obstacle_in_facets(w->obstacle, w->a, &samples, found, &n));
  TRY(abut_obstacle_passes_facets(w->obstacle, w->a, &samples,
                                  w->mesh_a.position, &way));
  TRY(abut_obstacle_narrowest(w->obstacle, w->a, &samples, &beside));
  TRY(abut_obstacle_beside_facet(w->obstacle, w->a, &samples,
                                 w->mesh_a.position, &beside));
  int32_t same = 0, material = 0;
  uint8_t marked[64];
  bool bends = false;
  double above = 0., below = 0.;
  memset(marked, 1, sizeof(marked));
  TRY(abut_obstacle_faces_away(w->obstacle, w->a, NULL, 0.1, &same, &material));
  TRY(abut_surface_bends(w->a, 1., marked, &bends));
  TRY(abut_surface_nearest(w->context, w->a, w->b, NULL, &above, &below));
  note(w, n);
  note(w, beside.width);
  return ABUT_SUCCESS;
}

static abut_status
scalar_points(world *w)
{
  const double one = 1;
  TRY(abut_points_create(w->context, 1, &w->points));
  for (int32_t i = 0; i < 5; ++i)
    TRY(abut_points_append_scalar(w->points, i, 1, 0.1, ABUT_POINT_CONTACT, 1,
                                  &i, &one));
  note(w, 5);
  return ABUT_SUCCESS;
}

/* Sums of friction, and points of one node. */
static abut_status
points_with_friction(world *w, const double *value)
{
  const int32_t node[2] = {0, 1};
  const uint8_t closed[14] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1},
                marks[1] = {ABUT_PAIR_FIXED_POINTS | ABUT_PAIR_FRICTION};
  const int32_t first[1] = {0};
  uint8_t keep[14] = {0};
  abut_friction_sums sums;
  abut_points_view view;
  int32_t n_rivals = 0;
  TRY(abut_points_get(w->points, &view));
  for (int32_t i = 0; i < view.n_points; ++i)
  {
    abut_place place = abut_place_defaults();
    place.node = node[i % 2];
    place.position = view.frame;
    place.line = place.column = node;
    place.n_lines = place.n_columns = 2;
    TRY(abut_points_append_place(w->points, &place));
  }
  const int32_t number[2] = {1, 0};
  abut_place_changes changes;
  TRY(abut_points_renumber_facets(w->points, 0, number));
  TRY(abut_points_count_changes(w->points, w->points, closed, &changes));
  TRY(abut_points_friction(w->points, 1, value, value, closed, &sums));
  TRY(abut_points_cover(w->points, 1, marks, keep));
  TRY(abut_points_rivals(w->points, 1, first, &n_rivals, NULL, NULL));
  note(w, sums.normal_force);
  note(w, n_rivals);
  return ABUT_SUCCESS;
}

static abut_status
points(world *w)
{
  const double frame[4] = {0, 1, 1, 0}, gap[2] = {0.1, 0.2},
               coefficient[2] = {1, -1};
  TRY(abut_points_create(w->context, 2, &w->points));
  TRY(abut_points_reserve(w->points, 3, 3, 4));
  abut_point point = abut_point_defaults();
  point.frame = frame;
  point.gap = gap;
  point.n_nodes = 2;
  point.n_secondary = 1;
  point.coefficient = coefficient;
  for (int32_t i = 0; i < 9; ++i)
  {
    const int32_t node[2] = {i, i + 1};
    point.node = node;
    point.id = 2 * i;
    /* The fifth point splits the components from the points. */
    point.kind = i < 4 ? ABUT_POINT_CONTACT : ABUT_POINT_TIE;
    point.n_components = i < 4 ? 1 : 2;
    TRY(abut_points_append(w->points, &point));
  }
  const uint8_t keep[14] = {1, 0, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1};
  const int32_t number[10] = {9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  TRY(abut_points_filter(w->points, keep));
  TRY(abut_points_renumber(w->points, 10, number));
  double u[20] = {0}, value[14], force[20] = {0};
  u[5] = 0.3;
  TRY(abut_points_gap(w->points, 10, u, value));
  TRY(abut_points_set_origin(w->points, 0, 1, 10, u));
  TRY(abut_points_add_force(w->points, 10, value, force));
  for (int i = 0; i < 12; ++i)
    note(w, value[i] + force[i]);
  return points_with_friction(w, value);
}

static abut_status
histories(world *w)
{
  TRY(abut_history_create(w->context, &w->history));
  TRY(abut_history_create(w->context, &w->other));
  const int64_t even[4] = {0, 2, 4, 6}, odd[5] = {1, 3, 4, 5, 9};
  const double pressure[5] = {1, 2, 3, 4, 5};
  abut_history_entries entries = {
      .struct_size = sizeof(entries), .n = 4, .id = even, .pressure = pressure};
  TRY(abut_history_begin_step(w->history));
  TRY(abut_history_set(w->history, &entries));
  TRY(abut_history_commit(w->history));
  entries.n = 5;
  entries.id = odd;
  TRY(abut_history_set(w->history, &entries)); /* between the others */
  const abut_history_problem problem = {.struct_size = sizeof(problem),
                                        .penalty = 7};
  TRY(abut_history_set_problem(w->history, ABUT_HISTORY_TRIAL, &problem));
  TRY(abut_history_commit(w->history));
  TRY(abut_history_clear(w->other));
  unsigned char bytes[1024];
  size_t n = sizeof(bytes);
  TRY(abut_history_pack(w->history, ABUT_HISTORY_COMMITTED, bytes, &n));
  TRY(abut_history_unpack(w->other, bytes, n));
  TRY(abut_history_rollback(w->other));
  TRY(abut_history_view(w->other, ABUT_HISTORY_TRIAL, &entries));
  for (int64_t i = 0; i < entries.n; ++i)
    note(w, entries.pressure[i]);
  return ABUT_SUCCESS;
}

/* kind = number of the law */
static abut_status
strategies(world *w)
{
  membrane *m = &w->membrane;
  *m = membrane_create(2, 1, 1);
  for (int32_t i = 0; i < m->n; ++i)
    m->gap[i] = m->u[i] - m->psi[i];
  const abut_strategy_options options =
      membrane_options(m, abut_law_get(w->kind)->name);
  const abut_host host = membrane_host(m);
  abut_reason reason = ABUT_REASON_NONE;
  abut_request request;
  TRY(abut_strategy_create(w->context, &options, &w->strategy));
  TRY(abut_strategy_start(w->strategy, 0, NULL, NULL, NULL, NULL, NULL, NULL,
                          NULL));
  TRY(abut_strategy_next(w->strategy, NULL, &request));
  TRY(abut_strategy_start(w->strategy, m->n, NULL, m->weight, m->stiffness,
                          NULL, m->gap, m->pressure, NULL));
  TRY(abut_strategy_run(w->strategy, &host, &reason));
  note(w, reason);
  note(w, membrane_force(m));
  return ABUT_SUCCESS;
}

/* One point that slips and one row without friction. */
static abut_status
frictions(world *w)
{
  const int32_t first = 1;
  const uint8_t one_tangent = 1;
  const double mu = 0.5, ones[3] = {1, 1, 1}, gap[3] = {0.1, -0.1, 0.3};
  const abut_strategy_options options = exact_options();
  const abut_strategy_friction friction = {.struct_size = sizeof(friction),
                                           .n = 1,
                                           .first = &first,
                                           .n_tangents = &one_tangent,
                                           .coefficient = &mu};
  abut_request request;
  TRY(abut_strategy_create(w->context, &options, &w->strategy));
  TRY(abut_strategy_set_friction(w->strategy, &friction));
  TRY(abut_strategy_start(w->strategy, 3, NULL, ones, ones, NULL, gap, NULL,
                          NULL));
  TRY(abut_strategy_next(w->strategy, NULL, &request));
  assert_int_equal(request.n_blocks, 2);
  for (int i = 0; i < 3; ++i)
    note(w, request.residual[i]);
  return ABUT_SUCCESS;
}

static abut_status
dense_models(world *w)
{
  const double k[] = {2, -1, -1, 2}, f[] = {-1, -1};
  TRY(scalar_points(w));
  const uint8_t keep[5] = {1, 1};
  TRY(abut_points_filter(w->points, keep));
  const abut_dense_model model = {sizeof(model), 2, k, f, w->points, NULL};
  const abut_strategy_options options = exact_options();
  double u[2] = {0, 0}, p[2] = {0, 0};
  TRY(abut_dense_model_solve(w->context, &model, &options, u, p, NULL, NULL,
                             NULL, NULL, NULL));
  /* Symmetric: u = -0.1 on both, reaction k u - f = -0.1 + 1. */
  assert_close(u[0], -0.1, 1e-14);
  assert_close(p[1], 0.9, 1e-14);
  note(w, u[0]);
  return ABUT_SUCCESS;
}

static abut_status
masses(world *w)
{
  /* Two elements of length 1: node 0 hands all of its 2/3 to node 1. */
  const int64_t start[] = {0, 2, 5, 7};
  const int32_t column[] = {0, 1, 0, 1, 2, 1, 2};
  double value[] = {2. / 6, 1. / 6, 1. / 6, 4. / 6, 1. / 6, 1. / 6, 2. / 6};
  const double place[] = {0, 1, 2};
  const uint8_t candidate[] = {1, 0, 0};
  const abut_mass_matrix mass = {sizeof(mass), 3,     1,    start,
                                 column,       value, place};
  TRY(abut_mass_modify(w->context, &mass, candidate, ABUT_MASS_NEIGHBOURS));
  assert_close(value[3], 4. / 6 + 2. / 3, 1e-15);
  note(w, value[3]);
  return ABUT_SUCCESS;
}

static abut_status
multigrids(world *w)
{
  grid_open(&w->grid, 2, 1, 3, 1);
  TRY(abut_multigrid_create(w->context, &w->grid.hierarchy, &w->multigrid));
  TRY(abut_multigrid_set_matrix(w->multigrid, &w->grid.matrix));
  TRY(abut_multigrid_set_terms(w->multigrid, &w->grid.matrix));
  uint8_t held[81] = {0};
  double r[81], x[81];
  for (int32_t i = 0; i < 81; ++i)
    r[i] = i % 5;
  held[40] = 1;
  TRY(abut_multigrid_set_constrained(w->multigrid, held, NULL));
  held[31] = 1;
  TRY(abut_multigrid_set_constrained(w->multigrid, held, NULL));
  TRY(abut_multigrid_cycle(w->multigrid, r, x));
  for (int32_t i = 0; i < 81; ++i)
    note(w, x[i]);
  return ABUT_SUCCESS;
}

static void
surfaces_without_memory(void **unused)
{
  (void)unused;
  for (int32_t kind = 0; kind < ABUT_FACET_N_KINDS; ++kind)
    deny_each(surfaces, kind, 10);
}

static void
searches_without_memory(void **unused)
{
  (void)unused;
  for (int32_t kind = 0; kind < ABUT_SEARCH_N_ALGORITHMS; ++kind)
    deny_each(searches, kind, 10);
}

static void
detections_without_memory(void **unused)
{
  (void)unused;
  for (int32_t kind = 0; kind < ABUT_FACET_N_KINDS; ++kind)
    deny_each(detections, kind, 10);
}

static void
couplings_without_memory(void **unused)
{
  (void)unused;
  for (int32_t kind = 0; kind < ABUT_FACET_N_KINDS; ++kind)
    for (int32_t k = 0; k < ABUT_DISCRETISATION_N; ++k)
      if (abut_coupling_check((abut_discretisation)k, 0, (abut_facet_kind)kind,
                              NULL)
          == ABUT_SUCCESS)
        deny_each(couplings, k + ABUT_DISCRETISATION_N * kind, 20);
  for (int32_t k = 0; k < ABUT_DISCRETISATION_N; ++k)
    deny_each(interfaces, k, 25);
}

static void
obstacles_without_memory(void **unused)
{
  (void)unused;
  for (int32_t kind = 0; kind < 3 * ABUT_DISCRETISATION_N; ++kind)
    deny_each(obstacles, kind, 10);
  deny_each(obstacle_in_facets, 0, 8);
}

static void
points_without_memory(void **unused)
{
  (void)unused;
  deny_each(scalar_points, 0, 5);
  deny_each(points, 0, 10);
}

static void
histories_without_memory(void **unused)
{
  (void)unused;
  deny_each(histories, 0, 10);
}

static void
strategies_without_memory(void **unused)
{
  (void)unused;
  for (int32_t i = 0; abut_law_get(i) != NULL; ++i)
    deny_each(strategies, i, 5);
}

static void
frictions_without_memory(void **unused)
{
  (void)unused;
  deny_each(frictions, 0, 9);
}

static void
dense_models_without_memory(void **unused)
{
  (void)unused;
  deny_each(dense_models, 0, 5);
}

static void
masses_without_memory(void **unused)
{
  (void)unused;
  deny_each(masses, 0, 2);
}

static void
multigrids_without_memory(void **unused)
{
  (void)unused;
  deny_each(multigrids, 0, 40);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(surfaces_without_memory),
      cmocka_unit_test(searches_without_memory),
      cmocka_unit_test(detections_without_memory),
      cmocka_unit_test(couplings_without_memory),
      cmocka_unit_test(obstacles_without_memory),
      cmocka_unit_test(points_without_memory),
      cmocka_unit_test(histories_without_memory),
      cmocka_unit_test(strategies_without_memory),
      cmocka_unit_test(frictions_without_memory),
      cmocka_unit_test(dense_models_without_memory),
      cmocka_unit_test(masses_without_memory),
      cmocka_unit_test(multigrids_without_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

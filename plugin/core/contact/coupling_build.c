/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The course of a build: search, a pass that drops weak nodes of quadratic
 * surfaces and corners, the pass that makes the shares of all facets, and the
 * rows. */
#include "constraint/points.h"
#include "contact/discretisation.h"
#include "geometry/vector.h"

#include <abut/coupling_search.h>

#include <string.h>

/* Pairs of facets, or contact elements of nodes. */
static abut_status
find(abut_coupling *c, double motion)
{
  const abut_search_options *o = &c->options.search;
  if (c->detection != NULL)
    return abut_detection_run(c->detection, motion);
  abut_status status =
      abut_search_set_reach(c->search, c->reach, o->relative_reach, o->skin);
  if (status == ABUT_SUCCESS)
    status = abut_search_facets(c->search, c->secondary, c->pairs);
  return status == ABUT_SUCCESS ? abut_pairs_get(c->pairs, &c->pairs_view)
                                : status;
}

/* The same, unless it has been done. */
static abut_status
search(abut_coupling *c, double motion)
{
  c->reach = max2(c->options.search.reach, 1.5 * motion);
  if (c->primary == NULL)
    return abut_coupling_measure_obstacle(c);
  const uint64_t revision[2] = {c->secondary->revision, c->primary->revision};
  if (c->has_searched && c->searched_motion == motion
      && c->searched_revision[0] == revision[0]
      && c->searched_revision[1] == revision[1])
    return ABUT_SUCCESS;
  c->has_searched = false;
  const abut_status status = find(c, motion);
  c->has_searched = status == ABUT_SUCCESS;
  c->searched_motion = motion;
  memcpy(c->searched_revision, revision, sizeof(revision));
  return status;
}

abut_status
abut_coupling_search(abut_coupling *coupling, double motion)
{
  if (coupling == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (!(motion >= 0 && motion <= ABUT_FACET_LIMIT))
    return abut_fail(coupling->context, ABUT_INVALID_ARGUMENT,
                     "abut_coupling_search",
                     "motion is negative or not finite");
  return coupling->primary != NULL ? search(coupling, motion) : ABUT_SUCCESS;
}

const abut_search *
abut_coupling_searcher(const abut_coupling *coupling)
{
  return coupling == NULL ? NULL
         : coupling->detection != NULL
             ? abut_detection_search(coupling->detection)
             : coupling->search;
}

/* Add the integrals of chi over the current points to the sums of the nodes;
 * returns the area of the points. */
double
abut_coupling_add_integrals(abut_coupling *c, const abut_coupling_facet *facet,
                            const abut_coupling_functions *f, double *sum)
{
  const abut_coupling_point *p = c->work.points.data;
  double area = 0.;
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    double base[ABUT_FACET_MAX_NODES];
    abut_coupling_base(c, facet->kind, p + q, base);
    area += p[q].weight;
    for (int32_t j = 0; j < f->n_kept; ++j)
    {
      double chi = 0.;
      for (int32_t a = 0; a < f->n_base; ++a)
        chi += f->chi[j][a] * base[a];
      sum[f->node[f->kept[j]]] += p[q].weight * chi;
    }
  }
  if (c->method->detects_nodes)
    abut_coupling_add_axis(c, facet, sum);
  return area;
}

/* Shares of one facet. */
static abut_status
take_facet(abut_coupling *c, int32_t index)
{
  abut_coupling_facet facet;
  abut_coupling_functions f;
  abut_coupling_load(c, index, &facet);
  ++c->statistics.n_facets;
  c->statistics.largest_warping =
      max2(c->statistics.largest_warping, facet.warping);
  abut_status status = abut_coupling_make_functions(
      c, &facet, c->of_node.dropped_as_given.data, &f);
  if (status == ABUT_SUCCESS)
    status = abut_coupling_whole(c, &facet);
  if (status != ABUT_SUCCESS)
    return status;
  const double whole =
      abut_coupling_add_integrals(c, &facet, &f, c->of_node.full.data);
  if (c->detection != NULL)
    return ABUT_SUCCESS;
  if (c->of_node.drops)
    status =
        abut_coupling_make_functions(c, &facet, c->of_node.dropped.data, &f);
  if (status == ABUT_SUCCESS)
    status = abut_coupling_make_points(c, &facet, true);
  if (status != ABUT_SUCCESS || c->work.n_points == 0)
    return status;
  ++c->statistics.n_covered;
  return c->method->take_facet(c, &facet, &f, whole);
}

static abut_status
add_full_area(abut_coupling *c)
{
  const double *full = c->of_node.full.data;
  const uint8_t *wanted = c->of_node.given->wanted;
  for (int32_t n = 0; n < c->secondary->view.n_nodes; ++n)
    if (wanted == NULL || wanted[n])
      c->statistics.full_area += full[n];
  if (c->primary == NULL || c->primary->view.n_facets == 0
      || c->secondary->view.n_facets == 0)
    return ABUT_SUCCESS;
  abut_surface_sizes s, m;
  abut_status status = abut_surface_measure(c->secondary, &s);
  if (status == ABUT_SUCCESS)
    status = abut_surface_measure(c->primary, &m);
  if (status == ABUT_SUCCESS)
    c->statistics.size_ratio = s.median / m.median;
  return status;
}

/* Nothing is known yet of how mortar that moves changes. */
static abut_status
begin_turning(abut_coupling *c)
{
  const int64_t n = c->secondary->view.n_nodes,
                n_all = n + c->primary->view.n_nodes;
  c->change.n_rates = c->change.n_blocks = c->change.n_block_values =
      c->change.n_directions = 0;
  abut_status status =
      abut_array_reserve(c->context, &c->change.directions, 0, n + 1);
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(c->context, &c->change.line_place, 0, n_all + 1);
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(c->context, &c->change.column_place, 0, n_all + 1);
  if (status != ABUT_SUCCESS)
    return status;
  for (int64_t i = 0; i < n; ++i)
    ((abut_coupling_direction *)c->change.directions.data)[i].n = -1;
  memset(c->change.line_place.data, 0, sizeof(int32_t) * (size_t)n_all);
  memset(c->change.column_place.data, 0, sizeof(int32_t) * (size_t)n_all);
  return ABUT_SUCCESS;
}

static abut_status
build(abut_coupling *c, double motion)
{
  const int32_t *order = c->order.facet.data;
  abut_status status = abut_coupling_read_nodes(c);
  if (status == ABUT_SUCCESS)
    status = abut_surface_normals(c->secondary, &c->of_node.normal);
  if (status == ABUT_SUCCESS)
  {
    abut_coupling_set_purpose(c);
    status = search(c, motion);
  }
  if (status == ABUT_SUCCESS && abut_coupling_has_current_directions(c))
    status = begin_turning(c);
  if (status == ABUT_SUCCESS && c->of_node.drops)
    status = abut_coupling_drop(c);
  const uint8_t *purpose = c->of_node.purpose.data;
  for (int32_t i = 0; i < c->secondary->view.n_facets && status == ABUT_SUCCESS;
       ++i)
    if (purpose[order[i]] & ABUT_COUPLING_FOR_ROWS)
      status = take_facet(c, order[i]);
  if (status == ABUT_SUCCESS && c->method->finish != NULL)
    status = c->method->finish(c);
  if (status == ABUT_SUCCESS)
    status = add_full_area(c);
  return status == ABUT_SUCCESS ? abut_coupling_append(c) : status;
}

/* On the axis of revolution or on its positive side. */
static bool
has_radii(const abut_surface *s, const double *reference)
{
  abut_surface_view v = s->view;
  const double *position = reference != NULL ? reference : v.position;
  double largest = 0., least = 0.;
  for (int32_t e = 0; e < v.facet_start[v.n_facets]; ++e)
  {
    const double x = position[2 * (int64_t)v.connectivity[e]];
    largest = max2(largest, x);
    least = min2(least, x);
  }
  return least >= -1e-12 * largest;
}

/* Whether positions are missing, or given without being required. */
static bool
does_not_fit(const double *position, bool is_asked_for,
             const abut_surface *surface)
{
  const bool is_empty = surface == NULL || surface->view.n_nodes == 0;
  return position == NULL ? is_asked_for && !is_empty : !is_asked_for;
}

static const char *
fault_of_places(const abut_coupling *c, const abut_coupling_target *t)
{
  const abut_kinematics_info *k = abut_kinematics_get(t->kinematics);
  if (k == NULL)
    return "there is no such kinematics";
  const bool is_displaced = k->points != ABUT_CONFIGURATION_REFERENCE;
  const bool turns = k->directions != k->points;
  if (does_not_fit(t->reference, is_displaced, c->secondary))
    return "reference positions are given only if the surfaces are in another "
           "configuration";
  if (does_not_fit(t->current, turns, c->secondary)
      || does_not_fit(t->current_primary, turns, c->primary))
    return "current positions are given, of both surfaces, where kinematics is "
           "corotational";
  if (t->tie_axes != 0 && k->directions != ABUT_CONFIGURATION_REFERENCE)
    return "ties have the reference kinematics";
  if (k->bodies_only && (c->primary == NULL || !abut_coupling_is_mortar(c)))
    return "this kinematics is for mortar between surfaces";
  if (!k->weighted_obstacle && c->primary == NULL && abut_coupling_is_mortar(c))
    return "mortar against an obstacle does not have this kinematics";
  return NULL;
}

static const char *
fault_of_target(const abut_coupling *c, const abut_coupling_target *t)
{
  if (t->points == NULL)
    return "there is no set of points";
  if (abut_points_dimension(t->points) != c->view.dimension)
    return "points and surfaces have different dimensions";
  if (t->tie_axes >> c->view.dimension != 0)
    return "an axis of a tie does not exist";
  if (!(fabs(t->gap) <= ABUT_FACET_LIMIT))
    return "the gap to be added is not finite";
  return fault_of_places(c, t);
}

abut_status
abut_coupling_build(abut_coupling *coupling, const abut_coupling_nodes *nodes,
                    double motion, const abut_coupling_target *target)
{
  static const char call[] = "abut_coupling_build";
  if (coupling == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_coupling *c = coupling;
  abut_coupling_nodes chosen = abut_coupling_nodes_defaults();
  abut_coupling_target place = abut_coupling_target_defaults(NULL);
  abut_status status =
      abut_copy_in(c->context, call, &chosen, sizeof(chosen), nodes);
  if (status == ABUT_SUCCESS)
    status = abut_copy_in(c->context, call, &place, sizeof(place), target);
  if (status != ABUT_SUCCESS)
    return status;
  const char *fault = fault_of_target(c, &place);
  if (fault == NULL && !(motion >= 0 && motion <= ABUT_FACET_LIMIT))
    fault = "motion is negative or not finite";
  if (fault == NULL && c->options.axisymmetric
      && !has_radii(c->secondary, place.reference))
    fault = "axisymmetric: a node of the secondary surface has a negative "
            "radius x";
  if (fault != NULL)
    return abut_fail(c->context, ABUT_INVALID_ARGUMENT, call, fault);
  const abut_coupling_statistics none = {0};
  c->of_node.given = &chosen;
  c->target = &place;
  c->kinematics = abut_kinematics_get(place.kinematics);
  c->statistics = none;
  c->view.first = abut_points_n(place.points);
  c->view.n_points = 0;
  c->sum.n_shares = c->sum.n_entries = c->answer.n_hessian = 0;
  status = build(c, motion);
  c->of_node.given = NULL;
  c->target = NULL;
  if (status != ABUT_SUCCESS)
  {
    abut_points_truncate(place.points, c->view.first);
    c->view.n_points = 0;
  }
  return status;
}

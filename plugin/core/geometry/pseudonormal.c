/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Angle-weighted pseudonormals, and borders. Which side or corner the nearest
 * point lies on is read from its local coordinates; the normal of the facet
 * across a side is taken at the point of it that is nearest, which serves
 * straight and curved facets alike. O(facets at the corner). */
#include "geometry/pseudonormal.h"

#include "geometry/kernels.h"
#include "geometry/vector.h"

#include <string.h>

/* Local coordinates this near a side are on it: projections clamp them to it
 * but for round-off. */
static const double on_side = 1e-10;

/* Bits of the sides that the point lies on; side k joins the corners k and
 * k + 1 on the way around. */
static unsigned
sides_at(int32_t n_corners, const double *local)
{
  const double s = local[0], t = local[1];
  unsigned sides = 0;
  if (n_corners == 2)
    return (s < on_side - 1. ? 1u : 0u) | (s > 1. - on_side ? 2u : 0u);
  if (n_corners == 3)
  {
    sides |= t < on_side ? 1u : 0u;
    sides |= s + t > 1. - on_side ? 2u : 0u;
    return sides | (s < on_side ? 4u : 0u);
  }
  sides |= t < on_side - 1. ? 1u : 0u;
  sides |= s > 1. - on_side ? 2u : 0u;
  sides |= t > 1. - on_side ? 4u : 0u;
  return sides | (s < on_side - 1. ? 8u : 0u);
}

/* The corner, on the way around, where two of the sides meet; or -1. */
static int32_t
corner_at(int32_t n_corners, unsigned sides)
{
  if (n_corners == 2)
    return sides == 1u ? 0 : sides == 2u ? 1 : -1;
  for (int32_t k = 0; k < n_corners; ++k)
  {
    const int32_t before = (k + n_corners - 1) % n_corners;
    if ((sides >> k & 1u) != 0 && (sides >> before & 1u) != 0)
      return k;
  }
  return -1;
}

bool
abut_beyond_border(const abut_surface *s, int32_t f, const abut_projection *p)
{
  if (p->inside)
    return false;
  const unsigned sides = sides_at(
      abut_facet_n_corners((abut_facet_kind)s->view.kinds[f]), p->local);
  for (int k = 0; k < 4; ++k)
    if ((sides >> k & 1u) != 0
        && s->view.neighbour[4 * (int64_t)f + k] == ABUT_NEIGHBOUR_BORDER)
      return true;
  return false;
}

/* Add the normal of the facet across side k of facet f at the point y. */
static void
add_neighbour(const abut_surface *s, int32_t f, int32_t k, const double *y,
              double *sum)
{
  const int32_t g = s->view.neighbour[4 * (int64_t)f + k];
  if (g < 0)
    return;
  double nodes[3 * ABUT_FACET_MAX_NODES];
  abut_projection q;
  abut_surface_gather(s, g, nodes);
  abut_project((abut_facet_kind)s->view.kinds[g], nodes, y, &q);
  for (int d = 0; d < 3; ++d)
    sum[d] += q.normal[d];
}

void
abut_pseudonormal(const abut_surface *surface, int32_t f,
                  const abut_projection *p, double *normal)
{
  const abut_surface *s = surface;
  const int32_t n = abut_facet_n_corners((abut_facet_kind)s->view.kinds[f]);
  memcpy(normal, p->normal, 3 * sizeof(*normal));
  if (p->inside)
    return;
  const unsigned sides = sides_at(n, p->local);
  const int32_t corner = corner_at(n, sides);
  double sum[3] = {p->normal[0], p->normal[1], p->normal[2]};
  if (corner >= 0)
  {
    const int32_t *c = s->view.connectivity + s->view.facet_start[f];
    const int32_t a = n == 2 ? corner : abut_facet_loop(n, corner);
    abut_surface_angle_weighted(s, c[a], sum);
  }
  else
    for (int32_t k = 0; k < n; ++k)
      if ((sides >> k & 1u) != 0)
        add_neighbour(s, f, k, p->point, sum);
  /* Facets folded on each other cancel; then the facet's own has to do. */
  if (unit3(sum, ABUT_TINY) > 1e-8)
    memcpy(normal, sum, sizeof(sum));
}

double
abut_side_of(const abut_surface *surface, int32_t f, const double *x,
             const abut_projection *p)
{
  double normal[3], r[3] = {0., 0., 0.};
  abut_pseudonormal(surface, f, p, normal);
  for (int d = 0; d < surface->view.dimension; ++d)
    r[d] = x[d] - p->point[d];
  return dot3(normal, r) < 0. ? -1. : 1.;
}

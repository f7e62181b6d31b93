/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nodes inside a surface, by detection. */
#include "interface/inside.h"

#include "geometry/kernels.h"
#include "geometry/pseudonormal.h"

/* Whether the nearest point of the facet is a corner or an edge beside which
 * the node is, though behind the plane of the facet. */
static bool
is_beside(const abut_surface *nodes, const abut_surface *facets, int32_t node,
          int32_t facet)
{
  double x[3] = {0., 0., 0.}, y[3 * ABUT_FACET_MAX_NODES];
  abut_projection p;
  for (int d = 0; d < nodes->view.dimension; ++d)
    x[d] = nodes->view.position[(int64_t)nodes->view.dimension * node + d];
  abut_surface_gather(facets, facet, y);
  abut_project((abut_facet_kind)facets->view.kinds[facet], y, x, &p);
  return !p.inside && abut_side_of(facets, facet, x, &p) > 0.;
}

static int32_t
select_deep(const abut_surface *nodes, const abut_surface *facets,
            const abut_detection_view *view, double depth, double thickness,
            abut_inside *found)
{
  int32_t n = 0;
  for (int32_t i = 0; i < view->n_nodes; ++i)
  {
    const abut_contact *c = &view->contact[i];
    if (c->facet < 0 || !(c->gap < -depth)
        || (thickness > 0. && c->gap < -0.5 * thickness)
        || is_beside(nodes, facets, i, c->facet))
      continue;
    const abut_inside inside = {i, c->facet, -c->gap};
    found[n++] = inside;
  }
  return n;
}

abut_status
abut_detect(abut_context *context, abut_surface *nodes, abut_surface *facets,
            const abut_detection_options *options, abut_detection **detection,
            abut_detection_view *view)
{
  abut_status status =
      abut_detection_create(context, nodes, facets, options, detection);
  if (status == ABUT_SUCCESS)
    status = abut_detection_run(*detection, 0.);
  return status == ABUT_SUCCESS ? abut_detection_get(*detection, view) : status;
}

abut_status
abut_nodes_inside(abut_context *context, abut_surface *nodes,
                  abut_surface *facets, const abut_detection_options *options,
                  double depth, double thickness, abut_inside *found,
                  int32_t *n)
{
  abut_detection_options chosen = *options;
  abut_detection *detection = NULL;
  abut_detection_view view;
  chosen.extension = 0.;
  *n = 0;
  const abut_status status =
      abut_detect(context, nodes, facets, &chosen, &detection, &view);
  if (status == ABUT_SUCCESS)
    *n = select_deep(nodes, facets, &view, depth, thickness, found);
  (void)abut_detection_destroy(&detection);
  return status;
}

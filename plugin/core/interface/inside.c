/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nodes inside a surface, by detection. */
#include "interface/inside.h"

/* The point nearest to a node inside is above it along a normal, or at a
 * reentrant corner between two normals. A node whose nearest point is a corner
 * far away along the facet is beside the surface: the facets nearer to it face
 * away from it. */
static bool
is_beside(const abut_contact *c)
{
  return c->distance * c->distance > 4. * c->gap * c->gap;
}

static int32_t
select_deep(const abut_detection_view *view, double depth, double thickness,
            abut_inside *found)
{
  int32_t n = 0;
  for (int32_t i = 0; i < view->n_nodes; ++i)
  {
    const abut_contact *c = &view->contact[i];
    if (c->facet < 0 || !(c->gap < -depth) || is_beside(c)
        || (thickness > 0. && c->gap < -0.5 * thickness))
      continue;
    const abut_inside inside = {i, c->facet, -c->gap};
    found[n++] = inside;
  }
  return n;
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
  abut_status status =
      abut_detection_create(context, nodes, facets, &chosen, &detection);
  if (status == ABUT_SUCCESS)
    status = abut_detection_run(detection, 0.);
  if (status == ABUT_SUCCESS)
    status = abut_detection_get(detection, &view);
  if (status == ABUT_SUCCESS)
    *n = select_deep(&view, depth, thickness, found);
  (void)abut_detection_destroy(&detection);
  return status;
}

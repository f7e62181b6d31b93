/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The report on a detection before solving. */
#include "contact/detect.h"

/* Area of the secondary surface at paired and unpaired nodes: each node has
 * an equal share of its facets. */
static void
cover(const abut_detection *d, abut_detection_report *z)
{
  const abut_surface *s = d->secondary;
  const uint64_t *groups = d->node_groups.data;
  const abut_contact *contact = d->contact.data;
  for (int32_t f = 0; f < s->view.n_facets; ++f)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_facet_measures m;
    const int32_t n = abut_surface_gather(s, f, nodes);
    const int32_t *c = s->view.connectivity + s->view.facet_start[f];
    if (abut_facet_measure((abut_facet_kind)s->view.kinds[f], nodes, &m)
        != ABUT_SUCCESS)
      continue;
    for (int32_t a = 0; a < n; ++a)
      if (groups[c[a]] != 0)
      {
        z->area += m.area / n;
        z->uncovered_area += contact[c[a]].facet < 0 ? m.area / n : 0;
      }
  }
}

abut_status
abut_detection_make_report_sized(abut_detection *detection,
                                 abut_detection_report *report)
{
  if (detection == NULL || report == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_detection *d = detection;
  if (d->view.contact == NULL)
    return abut_fail(d->context, ABUT_WRONG_ORDER, "abut_detection_make_report",
                     "nothing was detected yet");
  abut_surface_sizes secondary, primary;
  abut_status status = abut_surface_measure(d->secondary, &secondary);
  if (status == ABUT_SUCCESS)
    status = abut_surface_measure(d->primary, &primary);
  if (status != ABUT_SUCCESS)
    return status;
  abut_detection_report z = {0};
  const uint64_t *groups = d->node_groups.data;
  const uint8_t *reversed = d->reversed.data;
  z.deepest_node = -1;
  for (int32_t i = 0; i < d->view.n_nodes; ++i)
  {
    z.n_nodes += groups[i] != 0;
    const abut_contact *contact = d->view.contact + i;
    const int32_t f = contact->facet;
    z.n_paired += f >= 0;
    z.n_reversed += reversed[i];
    if (f < 0)
      continue;
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_surface_gather(d->primary, f, nodes);
    const double size = abut_surface_longest_side(
        (abut_facet_kind)d->primary->view.kinds[f], nodes);
    z.n_overlaps += contact->gap < -1e-10 * size;
    if (-contact->gap > z.largest_overlap)
    {
      z.largest_overlap = -contact->gap;
      z.deepest_node = i;
    }
  }
  cover(d, &z);
  if (primary.median > 0)
    z.size_ratio = secondary.median / primary.median;
  return abut_copy_out(d->context, "abut_detection_make_report", report,
                       sizeof(z), &z);
}

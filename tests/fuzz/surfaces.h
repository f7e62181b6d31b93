/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_FUZZ_SURFACES_H
#define ABUT_FUZZ_SURFACES_H

/* Surfaces and search options from the bytes of a fuzzer. */

#include "input.h"

#include <abut/search.h>

enum
{
  max_nodes = 64,
  max_entries = 256,
  max_facets = 64
};

typedef struct arrays
{
  abut_surface_data data;
  double position[3 * max_nodes];
  int32_t connectivity[max_entries];
  uint8_t kinds[max_facets];
  int32_t group[max_facets];
  int64_t id[max_nodes];
} arrays;

/* Facets over nodes in any order; mostly refused. */
static inline void
take_any(input *in, arrays *a)
{
  a->data.dimension = 2 + take_byte(in) % 2;
  a->data.n_nodes = take_below(in, max_nodes);
  a->data.n_facets = take_below(in, max_facets / 2);
  const int first = a->data.dimension == 2 ? 0 : 2,
            n_kinds = a->data.dimension == 2 ? 2 : 4;
  int n = 0;
  for (int f = 0; f < a->data.n_facets; ++f)
  {
    a->kinds[f] = (uint8_t)(first + take_byte(in) % n_kinds);
    const int m = abut_facet_n_nodes((abut_facet_kind)a->kinds[f]);
    if (n + m > max_entries)
    {
      a->data.n_facets = f;
      break;
    }
    for (int k = 0; k < m; ++k)
      a->connectivity[n++] = (int32_t)take_byte(in) - 1;
  }
  a->data.kinds = a->kinds;
}

/* A sheet of n x m quadrilaterals or triangles, a chain of lines in 2D. */
static inline void
take_sheet(input *in, arrays *a)
{
  const int n = 1 + take_below(in, 7), m = 1 + take_below(in, 7);
  const int kind = take_byte(in) % 3;
  a->data.dimension = kind == 0 ? 2 : 3;
  a->data.kind = kind == 0   ? ABUT_FACET_LINE2
                 : kind == 1 ? ABUT_FACET_QUAD4
                             : ABUT_FACET_TRI3;
  a->data.n_nodes = kind == 0 ? n * m + 1 : (n + 1) * (m + 1);
  a->data.n_facets = kind == 0 ? n * m : kind == 1 ? n * m : m;
  int k = 0;
  for (int f = 0; f < a->data.n_facets; ++f)
  {
    const int i = f % n, j = f / n, o = j * (n + 1) + i;
    const int32_t quad[4] = {o, o + 1, o + n + 1, o + n + 2};
    const int32_t triangle[3] = {f * (n + 1), f * (n + 1) + 1,
                                 (f + 1) * (n + 1)};
    for (int c = 0; c < abut_facet_n_nodes(a->data.kind); ++c)
      a->connectivity[k++] = kind == 0   ? f + c
                             : kind == 1 ? quad[c]
                                         : triangle[c];
  }
}

/* Regular places with a disturbance, so that most facets are sound. */
static inline void
take_positions(input *in, arrays *a, int regular)
{
  const int dim = a->data.dimension, style = take_byte(in) % 3;
  const double scale = take_scale(in);
  const double offset = take_byte(in) % 4 == 0 ? 1e6 * scale : 0.;
  const int columns = 1 + take_below(in, 8);
  for (int i = 0; i < a->data.n_nodes; ++i)
    for (int d = 0; d < dim; ++d)
    {
      const double place = d == 0 ? i % columns : d == 1 ? i / columns : 0.;
      a->position[i * dim + d] =
          regular ? offset + scale * (place + take_grid(in) / 20.)
                  : take_coordinate(in, style, scale, offset);
    }
}

static inline void
take_arrays(input *in, arrays *a)
{
  memset(a, 0, sizeof(*a));
  a->data = abut_surface_data_defaults();
  const int flags = take_byte(in);
  if (flags & 1)
    take_any(in, a);
  else
    take_sheet(in, a);
  take_positions(in, a, flags & 2);
  for (int f = 0; f < a->data.n_facets; ++f)
    a->group[f] = flags & 4 ? take_byte(in) % 3 : 0;
  for (int i = 0; i < a->data.n_nodes; ++i)
    a->id[i] = flags & 8 ? 1000 - i : take_byte(in);
  a->data.connectivity = a->connectivity;
  a->data.position = a->position;
  a->data.group = flags & 4 ? a->group : NULL;
  a->data.node_id = flags & 16 ? a->id : NULL;
  a->data.borrow = flags & 32;
  a->data.check_orientation = flags & 64;
}

static inline abut_search_options
take_options(input *in)
{
  abut_search_options o = abut_search_defaults();
  static const double sizes[] = {0., 1e-12, 0.1, 1., 3., 1e12, 1e300, NAN};
  o.bucket_size = sizes[take_byte(in) % 8];
  o.capacity = take_byte(in) % 4 == 0 ? take_below(in, 5000) : 0;
  o.reach = take_byte(in) % 4 == 0 ? take_raw(in) : 0.;
  o.relative_reach = take_below(in, 100) / 20.;
  o.skin = take_byte(in) % 2 == 0 ? 0. : take_below(in, 100) / 50.;
  return o;
}

#endif

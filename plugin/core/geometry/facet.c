/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Constants of each kind of facet, and dispatch of the shape functions. */
#include "geometry/kernels.h"

typedef struct kind_entry
{
  const char *name;
  int32_t n_nodes, n_corners, dimension;
} kind_entry;

static const kind_entry kinds[] = {
#define ABUT_KIND(kind, name, nodes, corners, dimension)                       \
  {name, nodes, corners, dimension},
    ABUT_FACET_KIND_LIST(ABUT_KIND)
#undef ABUT_KIND
};

static int
known(abut_facet_kind kind)
{
  return (int)kind >= 0 && (int)kind < (int)ABUT_FACET_N_KINDS;
}

int32_t
abut_facet_n_nodes(abut_facet_kind kind)
{
  return known(kind) ? kinds[kind].n_nodes : 0;
}

int32_t
abut_facet_n_corners(abut_facet_kind kind)
{
  return known(kind) ? kinds[kind].n_corners : 0;
}

int32_t
abut_facet_dimension(abut_facet_kind kind)
{
  return known(kind) ? kinds[kind].dimension : 0;
}

int32_t
abut_facet_n_second(abut_facet_kind kind)
{
  return !known(kind) ? 0 : kinds[kind].dimension == 2 ? 1 : 3;
}

const char *
abut_facet_name(abut_facet_kind kind)
{
  return known(kind) ? kinds[kind].name : "unknown";
}

const int8_t *
abut_facet_vtk_order(abut_facet_kind kind)
{
  static const int8_t same[] = {0, 1, 2, 3, 4, 5};
  static const int8_t quad[] = {0, 1, 3, 2, 6, 5, 7, 4, 8};
  if (!known(kind))
    return NULL;
  return kind == ABUT_FACET_QUAD4 || kind == ABUT_FACET_QUAD9 ? quad : same;
}

const double *
abut_facet_node_local(abut_facet_kind kind, int32_t a)
{
  static const double line[3][2] = {{-1, 0}, {1, 0}, {0, 0}};
  static const double triangle[6][2] = {{0, 0},  {1, 0},   {0, 1},
                                        {.5, 0}, {.5, .5}, {0, .5}};
  static const double quad[9][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}, {-1, 0},
                                    {1, 0},   {0, -1}, {0, 1},  {0, 0}};
  if (kinds[kind].dimension == 2)
    return line[a];
  return kinds[kind].n_corners == 3 ? triangle[a] : quad[a];
}

const char *
abut_facet_fault_text(abut_facet_fault fault)
{
  switch (fault)
  {
#define ABUT_FAULT(name, text)                                                 \
  case ABUT_FACET_FAULT_##name:                                                \
    return text;
    ABUT_FACET_FAULT_LIST(ABUT_FAULT)
#undef ABUT_FAULT
  }
  return "unknown fault";
}

int
abut_facet_finite(const double *x, int32_t n)
{
  /* NaN compares false. */
  for (int32_t i = 0; i < n; ++i)
    if (!(fabs(x[i]) <= ABUT_FACET_LIMIT))
      return 0;
  return 1;
}

abut_status
abut_facet_shape(abut_facet_kind kind, const double *local, double *value,
                 double *first, double *second)
{
  if (!known(kind) || !local)
    return ABUT_INVALID_ARGUMENT;
  if (!abut_facet_finite(local, kinds[kind].dimension - 1))
    return ABUT_NOT_FINITE;
  abut_shape shape;
  if (kinds[kind].dimension == 2)
    abut_shape2(kind, local[0], &shape);
  else
    abut_shape3(kind, local[0], local[1], &shape);
  const int32_t n = kinds[kind].n_nodes;
  const int32_t n_first = kinds[kind].dimension - 1,
                n_second = n_first == 1 ? 1 : 3;
  for (int32_t a = 0; a < n; ++a)
  {
    if (value)
      value[a] = shape.n[a];
    for (int32_t i = 0; first && i < n_first; ++i)
      first[a * n_first + i] = shape.d[i][a];
    for (int32_t i = 0; second && i < n_second; ++i)
      second[a * n_second + i] = shape.dd[i][a];
  }
  return ABUT_SUCCESS;
}

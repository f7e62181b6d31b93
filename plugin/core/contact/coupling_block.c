/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* How the force of a point of mortar that moves changes. With its weight W,
 * direction n and coefficients c_l, the force on node l is - W p n c_l, and
 *
 *     d(n c_l) = n dc_l + dn c_l
 *
 * where dc_l comes from the blocks of its shares (none: partners stay) and dn
 * from its direction. Rows of the matrix are the nodes of its stencil, columns
 * all nodes that these depend on. */
#include "contact/coupling.h"
#include "geometry/vector.h"

#include <string.h>

/* Nodes of both sides that a point's matrix has in one direction, in the order
 * of their entering: place[] is one more than the index of a node, 0 of all
 * others. */
typedef struct node_list
{
  abut_coupling *c;
  int32_t *place;
  abut_array *number; /* in the set */
  int64_t first;
  int32_t n;
} node_list;

static int32_t
key_of(const abut_coupling *c, int side, int32_t node)
{
  return side == 0 ? node : c->secondary->view.n_nodes + node;
}

/* Index of a node, entered if it is new and there is memory, else -1. The keys
 * stand in the list until it is finished. */
static int32_t
enter(node_list *list, int side, int32_t node)
{
  const int32_t key = key_of(list->c, side, node);
  const int64_t used = list->first + list->n;
  if (list->place[key] > 0)
    return list->place[key] - 1;
  if (abut_array_reserve(list->c->context, list->number, used, used + 1)
      != ABUT_SUCCESS)
    return -1;
  ((int32_t *)list->number->data)[used] = key;
  list->place[key] = ++list->n;
  return list->n - 1;
}

/* Forget the places, and give the nodes the numbers of the set. */
static void
finish(node_list *list)
{
  int32_t *number = (int32_t *)list->number->data + list->first;
  const int32_t n_secondary = list->c->secondary->view.n_nodes;
  for (int32_t i = 0; i < list->n; ++i)
  {
    const int32_t key = number[i];
    list->place[key] = 0;
    number[i] = key < n_secondary
                    ? abut_coupling_number(list->c, 0, key)
                    : abut_coupling_number(list->c, 1, key - n_secondary);
  }
}

/* The current matrix. */
typedef struct matrix
{
  abut_coupling *c;
  node_list lines, columns;
  int dim;
  double *value;
} matrix;

static double *
at(const matrix *m, int32_t line, int d, int32_t column)
{
  return m->value
         + (((int64_t)line * m->dim + d) * m->columns.n + column) * m->dim;
}

static const abut_coupling_share *
share_at(const abut_coupling *c, int64_t i)
{
  return (const abut_coupling_share *)c->sum.shares.data + i;
}

static const int32_t *
nodes_of(const abut_surface *s, int32_t facet, int32_t *n)
{
  const abut_surface_view *v = &s->view;
  *n = v->facet_start[facet + 1] - v->facet_start[facet];
  return v->connectivity + v->facet_start[facet];
}

static abut_status
enter_direction(matrix *m, const abut_coupling_direction *direction)
{
  bool done = true;
  for (int32_t k = 0; k < direction->n && done; ++k)
    done = enter(&m->columns, 0,
                 ((const int32_t *)
                      m->c->change.direction_node.data)[direction->first + k])
           >= 0;
  return done ? ABUT_SUCCESS : ABUT_OUT_OF_MEMORY;
}

/* The normal at node a of a block's secondary facet. */
static abut_status
normal_at(abut_coupling *c, const abut_coupling_block *b, int32_t a,
          abut_coupling_direction *direction)
{
  int32_t n;
  const int32_t *node = nodes_of(c->secondary, b->facet, &n);
  return b->own_normals >> a & 1u
             ? abut_coupling_facet_direction(c, b->facet, a, direction)
             : abut_coupling_average(c, node[a], direction);
}

/* Enter what a block's columns are. */
static abut_status
enter_block(matrix *m, const abut_coupling_block *b)
{
  abut_coupling *c = m->c;
  abut_status status = ABUT_SUCCESS;
  for (int side = 0; side < 2; ++side)
  {
    int32_t n;
    const int32_t *node = nodes_of(side == 0 ? c->secondary : c->primary,
                                   side == 0 ? b->facet : b->primary, &n);
    for (int32_t a = 0; a < n; ++a)
      if (enter(&m->columns, side, node[a]) < 0)
        return ABUT_OUT_OF_MEMORY;
    for (int32_t a = 0;
         a < n && side == 0 && m->dim == 2 && status == ABUT_SUCCESS; ++a)
    {
      abut_coupling_direction normal;
      status = normal_at(c, b, a, &normal);
      if (status == ABUT_SUCCESS)
        status = enter_direction(m, &normal);
    }
  }
  return status;
}

/* Enter the nodes of all shares and their blocks. */
static abut_status
enter_shares(matrix *m, const int64_t *list, int64_t n)
{
  abut_status status = ABUT_SUCCESS;
  for (int64_t i = 0; i < n; ++i)
  {
    const abut_coupling_share s = *share_at(m->c, list[i]);
    const abut_coupling_entry *e =
        (const abut_coupling_entry *)m->c->sum.entries.data + s.first;
    for (int32_t k = 0; k < s.n_secondary + s.n_primary; ++k)
      if (enter(&m->lines, k >= s.n_secondary, e[k].node) < 0)
        return ABUT_OUT_OF_MEMORY;
    for (int32_t k = 0; k < s.n_blocks && status == ABUT_SUCCESS; ++k)
      status =
          enter_block(m, (const abut_coupling_block *)m->c->change.blocks.data
                             + s.first_block + k);
  }
  return status;
}

/* Subtract factor times the derivatives of a direction from the lines of a
 * node. */
static void
add_direction(const matrix *m, const abut_coupling_direction *direction,
              int32_t line, double factor)
{
  const int32_t *node =
      (const int32_t *)m->c->change.direction_node.data + direction->first;
  const double *change =
      (const double *)m->c->change.direction_change.data + 9 * direction->first;
  for (int32_t k = 0; k < direction->n; ++k)
    for (int d = 0; d < m->dim; ++d)
      for (int e = 0; e < m->dim; ++e)
        at(m, line, d, m->columns.place[node[k]] - 1)[e] -=
            factor * change[9 * k + 3 * d + e];
}

/* Subtract n times a derivative [dim] of the coefficient of a node. */
static void
add_change(const matrix *m, const double *normal, int32_t line, int32_t column,
           const double *change)
{
  for (int d = 0; d < m->dim; ++d)
    for (int e = 0; e < m->dim; ++e)
      at(m, line, d, column)[e] -= normal[d] * change[e];
}

/* Subtract n times the derivative by a normal [dim], which is one by nodes. */
static void
add_by_normal(const matrix *m, const double *normal, int32_t line,
              const abut_coupling_direction *of, const double *change)
{
  const int32_t *node =
      (const int32_t *)m->c->change.direction_node.data + of->first;
  const double *by =
      (const double *)m->c->change.direction_change.data + 9 * of->first;
  for (int32_t k = 0; k < of->n; ++k, by += 9)
  {
    double sum[3] = {0., 0., 0.};
    for (int d = 0; d < m->dim; ++d)
      for (int e = 0; e < m->dim; ++e)
        sum[e] += change[d] * by[3 * d + e];
    add_change(m, normal, line, m->columns.place[node[k]] - 1, sum);
  }
}

/* The coefficients of the primary's nodes are minus the entries by the
 * weight. */
static abut_status
add_block(matrix *m, const abut_coupling_block *b, const double *normal,
          double weight)
{
  abut_coupling *c = m->c;
  int32_t n_s, n_m;
  const int32_t *s = nodes_of(c->secondary, b->facet, &n_s),
                *p = nodes_of(c->primary, b->primary, &n_m);
  const int32_t n_columns = abut_coupling_columns(c, n_s, n_m), dim = m->dim;
  const int32_t behind = c->secondary->view.n_nodes;
  const double *value = (const double *)c->change.block_values.data + b->first;
  for (int32_t k = 0; k * dim < n_columns; ++k)
  {
    abut_coupling_direction of;
    const bool by_normal = k >= n_s + n_m;
    if (by_normal)
    {
      const abut_status status = normal_at(c, b, k - n_s - n_m, &of);
      if (status != ABUT_SUCCESS)
        return status;
    }
    for (int32_t a = 0; a < n_m; ++a)
    {
      double change[3] = {0., 0., 0.};
      const int32_t line = m->lines.place[behind + p[a]] - 1;
      for (int d = 0; d < dim; ++d)
        change[d] = -value[a * n_columns + k * dim + d] / weight;
      if (by_normal)
        add_by_normal(m, normal, line, &of, change);
      else
        add_change(m, normal, line,
                   m->columns.place[k < n_s ? s[k] : behind + p[k - n_s]] - 1,
                   change);
    }
  }
  return ABUT_SUCCESS;
}

static abut_status
fill(matrix *m, const int64_t *list, int64_t n,
     const abut_coupling_share *total, const abut_coupling_direction *direction)
{
  abut_status status = ABUT_SUCCESS;
  for (int64_t i = 0; i < n; ++i)
  {
    const abut_coupling_share s = *share_at(m->c, list[i]);
    const abut_coupling_entry *e =
        (const abut_coupling_entry *)m->c->sum.entries.data + s.first;
    for (int32_t k = 0; k < s.n_secondary + s.n_primary; ++k)
    {
      const bool opposite = k >= s.n_secondary;
      add_direction(m, direction,
                    m->lines.place[key_of(m->c, opposite, e[k].node)] - 1,
                    (opposite ? -1. : 1.) * e[k].value / total->weight);
    }
    for (int32_t k = 0; k < s.n_blocks && status == ABUT_SUCCESS; ++k)
      status = add_block(m,
                         (const abut_coupling_block *)m->c->change.blocks.data
                             + s.first_block + k,
                         direction->normal, total->weight);
  }
  return status;
}

/* Add the rotation of the tangents t[2] of the point about its normal, to the
 * matrices behind that of the normal. */
static void
add_tangent_rotation(matrix *m, const int64_t *list, int64_t n,
                     const abut_coupling_share *total, int32_t facet,
                     const double *normal, double (*t)[3])
{
  const int64_t size = (int64_t)m->lines.n * m->columns.n * m->dim * m->dim;
  const int32_t *corner;
  double rotation[4][3];
  const int n_corners =
      abut_coupling_tangent_rotation(m->c, facet, normal, &corner, rotation);
  for (int64_t i = 0; i < n; ++i)
  {
    const abut_coupling_share *s = share_at(m->c, list[i]);
    const abut_coupling_entry *e =
        (const abut_coupling_entry *)m->c->sum.entries.data + s->first;
    for (int32_t k = 0; k < s->n_secondary + s->n_primary; ++k)
    {
      const bool opposite = k >= s->n_secondary;
      const double share = (opposite ? -1. : 1.) * e[k].value / total->weight;
      const int32_t line =
          m->lines.place[key_of(m->c, opposite, e[k].node)] - 1;
      for (int a = 0; a < n_corners; ++a)
        for (int d = 0; d < 3; ++d)
        {
          double *to = at(m, line, d, m->columns.place[corner[a]] - 1);
          for (int f = 0; f < 3; ++f)
          {
            to[size + f] += share * t[1][d] * rotation[a][f];
            to[2 * size + f] -= share * t[0][d] * rotation[a][f];
          }
        }
    }
  }
}

/* Enter the facet that an auxiliary vector rotates with. */
static abut_status
enter_facet(matrix *m, int32_t facet)
{
  int32_t n;
  const int32_t *node = nodes_of(m->c->secondary, facet, &n);
  for (int32_t a = 0; a < n; ++a)
    if (enter(&m->columns, 0, node[a]) < 0)
      return ABUT_OUT_OF_MEMORY;
  return ABUT_SUCCESS;
}

/* The matrices by the tangents, behind that by the normal. */
static void
fill_tangents(matrix *m, const int64_t *list, int64_t n,
              const abut_coupling_share *total, const double *normal,
              const double *auxiliary, int32_t facet)
{
  double t[2][3];
  const int64_t n_columns = (int64_t)m->columns.n * m->dim,
                size = m->lines.n * m->dim * n_columns;
  abut_coupling_tangent_derivatives_of_lines(m->dim, m->lines.n, n_columns,
                                             normal, auxiliary, m->value,
                                             m->value + size);
  if (facet < 0)
    return;
  abut_coupling_tangents(m->dim, normal, auxiliary, t[0]);
  add_tangent_rotation(m, list, n, total, facet, normal, t);
}

/* The next matrix begins where the last one ends. */
static abut_status
begin_at(abut_coupling *c, abut_array *start, int64_t *first)
{
  const int64_t i = c->view.n_points;
  const abut_status status =
      abut_array_reserve(c->context, start, i > 0 ? i + 1 : 0, i + 2);
  if (status != ABUT_SUCCESS)
    return status;
  if (i == 0)
    ((int64_t *)start->data)[0] = 0;
  *first = ((const int64_t *)start->data)[i];
  return ABUT_SUCCESS;
}

static void
end_at(abut_coupling *c, abut_array *start, int64_t n)
{
  int64_t *s = (int64_t *)start->data + c->view.n_points;
  s[1] = s[0] + n;
}

abut_status
abut_coupling_record_block(abut_coupling *c, const int64_t *list, int64_t n,
                           const abut_coupling_share *total,
                           const abut_coupling_direction *direction)
{
  matrix m = {.c = c, .dim = c->view.dimension};
  m.lines = (node_list){c, c->change.line_place.data, &c->made.line, 0, 0};
  m.columns =
      (node_list){c, c->change.column_place.data, &c->made.column, 0, 0};
  int64_t first = 0;
  abut_status status = begin_at(c, &c->made.line_start, &m.lines.first);
  if (status == ABUT_SUCCESS)
    status = begin_at(c, &c->made.column_start, &m.columns.first);
  if (status == ABUT_SUCCESS)
    status = begin_at(c, &c->made.hessian_start, &first);
  if (status == ABUT_SUCCESS)
    status = enter_direction(&m, direction);
  if (status == ABUT_SUCCESS)
    status = enter_shares(&m, list, n);
  double auxiliary[3];
  const int32_t facet = c->target->tangents ? abut_coupling_auxiliary_vector(
                            c, total, direction->normal, auxiliary)
                                            : -1;
  if (status == ABUT_SUCCESS && facet >= 0)
    status = enter_facet(&m, facet);
  const int64_t size = (int64_t)m.lines.n * m.columns.n * m.dim * m.dim,
                all = c->target->tangents ? m.dim * size : size;
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(c->context, &c->made.hessian, first, first + all);
  if (status == ABUT_SUCCESS)
  {
    m.value = (double *)c->made.hessian.data + first;
    memset(m.value, 0, sizeof(double) * (size_t)size);
    status = fill(&m, list, n, total, direction);
    if (c->target->tangents)
      fill_tangents(&m, list, n, total, direction->normal, auxiliary, facet);
  }
  finish(&m.lines);
  finish(&m.columns);
  if (status != ABUT_SUCCESS)
    return status;
  end_at(c, &c->made.line_start, m.lines.n);
  end_at(c, &c->made.column_start, m.columns.n);
  end_at(c, &c->made.hessian_start, all);
  return ABUT_SUCCESS;
}

void
abut_coupling_gap(const abut_coupling *c, const int64_t *list, int64_t n,
                  bool present, double *gap)
{
  const int dim = c->view.dimension;
  const double *place[2] = {abut_coupling_place(c, 0),
                            abut_coupling_place(c, 1)};
  double x[2][3] = {{0.}}, weight[2] = {0., 0.};
  if (!present)
  {
    place[0] = c->secondary->view.position;
    place[1] = c->primary->view.position;
  }
  for (int64_t i = 0; i < n; ++i)
  {
    const abut_coupling_share *s = share_at(c, list[i]);
    const abut_coupling_entry *e =
        (const abut_coupling_entry *)c->sum.entries.data + s->first;
    for (int32_t k = 0; k < s->n_secondary + s->n_primary; ++k)
    {
      const int side = k >= s->n_secondary;
      weight[side] += e[k].value;
      for (int d = 0; d < dim; ++d)
        x[side][d] += e[k].value * place[side][(int64_t)dim * e[k].node + d];
    }
  }
  for (int d = 0; d < 3; ++d)
    gap[d] = x[1][d] / weight[1] - x[0][d] / weight[0];
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Facets as bytes, and one surface out of several such buffers.
 *
 * A buffer is a header and, each aligned to eight bytes, the arrays
 * facet_id, node_id (int64), position (double), group, connectivity (int32),
 * kinds (uint8); nodes are counted within the buffer. */
#include "pack.h"

#include "search/order.h"

#include "geometry/surface.h"

#include <string.h>

static const uint64_t magic = UINT64_C(0x3174726150747541);

typedef struct
{
  uint64_t magic;
  int32_t dimension;
  int32_t n_facets;
  int32_t n_nodes;
  int32_t n_entries;
} header;

/* Places of the arrays of a buffer. */
typedef struct
{
  size_t facet_id, node_id, position, group, connectivity, kinds, end;
} layout;

static layout
lay_out(const header *h)
{
  const size_t f = (size_t)h->n_facets, n = (size_t)h->n_nodes;
  const size_t e = (size_t)h->n_entries, d = (size_t)h->dimension;
  layout l;
  l.facet_id = sizeof(header);
  l.node_id = l.facet_id + 8 * f;
  l.position = l.node_id + 8 * n;
  l.group = l.position + 8 * n * d;
  l.connectivity = l.group + (4 * f + 7) / 8 * 8;
  l.kinds = l.connectivity + (4 * e + 7) / 8 * 8;
  l.end = l.kinds + (f + 7) / 8 * 8;
  return l;
}

/* Number the nodes of the facets in the order in which they are met: local[i]
 * is the number of node i, or -1. */
static abut_status
count(const abut_surface *s, int32_t n, const int32_t *facets, int32_t *local,
      header *h)
{
  h->magic = magic;
  h->dimension = s->view.dimension;
  h->n_facets = n;
  h->n_nodes = h->n_entries = 0;
  for (int32_t i = 0; i < s->view.n_nodes; ++i)
    local[i] = -1;
  for (int32_t k = 0; k < n; ++k)
  {
    const int32_t f = facets[k];
    if (f < 0 || f >= s->view.n_facets)
      return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "pack_surface",
                       "a facet is out of range");
    for (int32_t e = s->view.facet_start[f]; e < s->view.facet_start[f + 1];
         ++e, ++h->n_entries)
      if (local[s->view.connectivity[e]] < 0)
        local[s->view.connectivity[e]] = h->n_nodes++;
  }
  return ABUT_SUCCESS;
}

/* memcpy, because the caller's buffer need not be aligned. */
static void
put(void *buffer, size_t at, size_t i, const void *value, size_t size)
{
  memcpy((char *)buffer + at + i * size, value, size);
}

static void
write(const abut_surface *s, const int32_t *facets, const int32_t *local,
      const header *h, void *buffer)
{
  const layout l = lay_out(h);
  const size_t d = (size_t)h->dimension;
  memset(buffer, 0, l.end);
  memcpy(buffer, h, sizeof(*h));
  size_t entry = 0;
  for (int32_t k = 0; k < h->n_facets; ++k)
  {
    const int32_t f = facets[k], group = abut_surface_group(s, f);
    const int64_t id = abut_surface_facet_id(s, f);
    put(buffer, l.facet_id, (size_t)k, &id, 8);
    put(buffer, l.group, (size_t)k, &group, 4);
    put(buffer, l.kinds, (size_t)k, s->view.kinds + f, 1);
    for (int32_t e = s->view.facet_start[f]; e < s->view.facet_start[f + 1];
         ++e)
      put(buffer, l.connectivity, entry++, local + s->view.connectivity[e], 4);
  }
  for (int32_t i = 0; i < s->view.n_nodes; ++i)
    if (local[i] >= 0)
    {
      const int64_t id = abut_surface_node_id(s, i);
      put(buffer, l.node_id, (size_t)local[i], &id, 8);
      put(buffer, l.position, (size_t)local[i],
          s->view.position + d * (size_t)i, 8 * d);
    }
}

abut_status
pack_surface(abut_surface *surface, int32_t n_facets, const int32_t *facets,
             void *buffer, size_t *bytes)
{
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_surface *s = surface;
  if (n_facets < 0 || (n_facets > 0 && facets == NULL) || bytes == NULL)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "pack_surface",
                     "n_facets is negative, or facets or bytes is NULL");
  abut_array local = {NULL, 0, sizeof(int32_t)};
  abut_status status =
      abut_array_reserve(s->context, &local, 0, (int64_t)s->view.n_nodes + 1);
  if (status != ABUT_SUCCESS)
    return status;
  header h;
  status = count(s, n_facets, facets, local.data, &h);
  if (status == ABUT_SUCCESS)
  {
    const size_t needed = lay_out(&h).end;
    if (buffer != NULL && *bytes < needed)
      status = abut_fail(s->context, ABUT_INVALID_ARGUMENT, "pack_surface",
                         "the buffer is too small");
    else if (buffer != NULL)
      write(s, facets, local.data, &h, buffer);
    *bytes = needed;
  }
  abut_array_release(s->context, &local);
  return status;
}

/* All that unpacking works on. Items of facets and nodes are numbered through
 * all buffers; `of` is the buffer that an item came from. */
typedef struct
{
  abut_context *context;
  int32_t dimension;
  int32_t n_buffers;
  const void *const *buffers;
  int64_t n_facets, n_nodes, n_entries; /* of all buffers */
  abut_array keyed;                     /* abut_keyed, with room */
  abut_array of, start;                 /* int32_t, of facets: buffer, entry */
  abut_array facet_id, node_id;         /* int64_t */
  abut_array position;                  /* double */
  abut_array group, connectivity, node; /* int32_t */
  abut_array kinds;                     /* uint8_t */
  int32_t n_merged_facets, n_merged_nodes;
} merger;

static header
header_of(const merger *m, int32_t b)
{
  header h;
  memcpy(&h, m->buffers[b], sizeof(h));
  return h;
}

static void
get(const void *buffer, size_t at, size_t i, void *value, size_t size)
{
  memcpy(value, (const char *)buffer + at + i * size, size);
}

static abut_status
refuse(abut_context *context, int32_t b)
{
  abut_text text = abut_fail_begin(context, "unpack_surfaces");
  abut_text_add(&text, "buffer ");
  abut_text_add_integer(&text, b);
  abut_text_add(&text, " was not written by pack_surface() for this "
                       "dimension, or is damaged");
  return ABUT_INVALID_ARGUMENT;
}

/* Header, kinds and node numbers of a buffer are what pack writes. */
static bool
is_sound(const void *buffer, size_t bytes, int32_t dimension)
{
  header h;
  if (buffer == NULL || bytes < sizeof(h))
    return false;
  memcpy(&h, buffer, sizeof(h));
  if (h.magic != magic || h.dimension != dimension || h.n_facets < 0
      || h.n_nodes < 0 || h.n_entries < 0 || lay_out(&h).end > bytes)
    return false;
  const layout l = lay_out(&h);
  int64_t entries = 0;
  for (int32_t k = 0; k < h.n_facets; ++k)
  {
    uint8_t kind;
    get(buffer, l.kinds, (size_t)k, &kind, 1);
    entries += abut_facet_n_nodes((abut_facet_kind)kind);
    if (abut_facet_dimension((abut_facet_kind)kind) != dimension)
      return false;
  }
  for (int32_t e = 0; e < h.n_entries; ++e)
  {
    int32_t node;
    get(buffer, l.connectivity, (size_t)e, &node, 4);
    if (node < 0 || node >= h.n_nodes)
      return false;
  }
  return entries == h.n_entries;
}

static abut_status
reserve(merger *m)
{
  const int64_t f = m->n_facets, n = m->n_nodes, most = f > n ? f : n;
  struct
  {
    abut_array *array;
    size_t element;
    int64_t n;
  } const list[] = {{&m->keyed, sizeof(abut_keyed), 2 * most},
                    {&m->of, 4, f},
                    {&m->start, 4, f},
                    {&m->facet_id, 8, f},
                    {&m->node_id, 8, n},
                    {&m->position, 8, n * m->dimension},
                    {&m->group, 4, f},
                    {&m->connectivity, 4, m->n_entries},
                    {&m->node, 4, n},
                    {&m->kinds, 1, f}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    list[i].array->element = list[i].element;
    const abut_status status =
        abut_array_reserve(m->context, list[i].array, 0, list[i].n + 1);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

/* Numbers as keys: negative ones come first. */
static uint64_t
key_of(int64_t id)
{
  return (uint64_t)id ^ UINT64_C(0x8000000000000000);
}

/* Nodes by number, each once: node[i] is the merged number of item i. */
static void
merge_nodes(merger *m)
{
  abut_keyed *items = m->keyed.data;
  int32_t *node = m->node.data;
  int64_t *node_id = m->node_id.data;
  double *position = m->position.data;
  const size_t d = (size_t)m->dimension;
  int32_t n = 0;
  for (int32_t b = 0; b < m->n_buffers; ++b)
  {
    const header h = header_of(m, b);
    for (int32_t k = 0; k < h.n_nodes; ++k, ++n)
    {
      int64_t id;
      get(m->buffers[b], lay_out(&h).node_id, (size_t)k, &id, 8);
      items[n].key = key_of(id);
      items[n].index = n;
    }
  }
  abut_order_sort(items, items + n, n);
  int32_t merged = -1;
  for (int32_t i = 0; i < n; ++i)
  {
    merged += i == 0 || items[i].key != items[i - 1].key;
    node[items[i].index] = merged;
  }
  m->n_merged_nodes = merged + 1;
  /* From the last buffer to the first, so that the first one met stays. */
  for (int32_t b = m->n_buffers; b-- > 0;)
  {
    const header h = header_of(m, b);
    const layout l = lay_out(&h);
    n -= h.n_nodes;
    for (int32_t k = 0; k < h.n_nodes; ++k)
    {
      const size_t to = (size_t)node[n + k];
      get(m->buffers[b], l.node_id, (size_t)k, node_id + to, 8);
      get(m->buffers[b], l.position, (size_t)k, position + d * to, 8 * d);
    }
  }
}

/* Facets by number, each once. */
static void
merge_facets(merger *m)
{
  abut_keyed *items = m->keyed.data;
  int32_t *of = m->of.data, *start = m->start.data, *group = m->group.data;
  int32_t *connectivity = m->connectivity.data;
  const int32_t *node = m->node.data;
  int64_t *facet_id = m->facet_id.data;
  uint8_t *kinds = m->kinds.data;
  int32_t n = 0;
  for (int32_t b = 0; b < m->n_buffers; ++b)
  {
    const header h = header_of(m, b);
    int32_t entry = 0;
    for (int32_t k = 0; k < h.n_facets; ++k, ++n)
    {
      int64_t id;
      uint8_t kind;
      get(m->buffers[b], lay_out(&h).facet_id, (size_t)k, &id, 8);
      get(m->buffers[b], lay_out(&h).kinds, (size_t)k, &kind, 1);
      items[n].key = key_of(id);
      items[n].index = n;
      of[n] = b;
      start[n] = entry;
      entry += abut_facet_n_nodes((abut_facet_kind)kind);
    }
  }
  abut_order_sort(items, items + n, n);
  int32_t to = 0, entry = 0, first_facet = 0, first_node = 0, buffer = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    if (i > 0 && items[i].key == items[i - 1].key)
      continue;
    const int32_t item = items[i].index, b = of[item];
    first_facet = first_node = 0;
    for (buffer = 0; buffer < b; ++buffer)
    {
      first_facet += header_of(m, buffer).n_facets;
      first_node += header_of(m, buffer).n_nodes;
    }
    const header h = header_of(m, b);
    const layout l = lay_out(&h);
    const size_t k = (size_t)(item - first_facet);
    get(m->buffers[b], l.facet_id, k, facet_id + to, 8);
    get(m->buffers[b], l.group, k, group + to, 4);
    get(m->buffers[b], l.kinds, k, kinds + to, 1);
    const int32_t n_nodes = abut_facet_n_nodes((abut_facet_kind)kinds[to]);
    for (int32_t a = 0; a < n_nodes; ++a)
    {
      int32_t local;
      get(m->buffers[b], l.connectivity, (size_t)(start[item] + a), &local, 4);
      connectivity[entry++] = node[first_node + local];
    }
    ++to;
  }
  m->n_merged_facets = to;
}

static abut_status
make_surface(const merger *m, abut_surface **surface)
{
  abut_surface_data data = abut_surface_data_defaults();
  data.dimension = m->dimension;
  data.kind = m->dimension == 2 ? ABUT_FACET_LINE2 : ABUT_FACET_QUAD4;
  data.n_nodes = m->n_merged_nodes;
  data.n_facets = m->n_merged_facets;
  data.kinds = m->kinds.data;
  data.connectivity = m->connectivity.data;
  data.position = m->position.data;
  data.node_id = m->node_id.data;
  data.facet_id = m->facet_id.data;
  data.group = m->group.data;
  data.check_orientation = false;
  return abut_surface_create(m->context, &data, surface);
}

static void
release(merger *m)
{
  abut_array *arrays[] = {
      &m->keyed,    &m->of,    &m->start,        &m->facet_id, &m->node_id,
      &m->position, &m->group, &m->connectivity, &m->node,     &m->kinds};
  for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
    abut_array_release(m->context, arrays[i]);
}

abut_status
unpack_surfaces(abut_context *context, int32_t dimension, int32_t n_buffers,
                const void *const *buffers, const size_t *bytes,
                abut_surface **surface)
{
  if (context == NULL || surface == NULL || n_buffers < 0
      || (dimension != 2 && dimension != 3)
      || (n_buffers > 0 && (buffers == NULL || bytes == NULL)))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "unpack_surfaces",
                     "an argument is NULL or out of range");
  merger m;
  memset(&m, 0, sizeof(m));
  m.context = context;
  m.dimension = dimension;
  m.n_buffers = n_buffers;
  m.buffers = buffers;
  for (int32_t b = 0; b < n_buffers; ++b)
  {
    if (!is_sound(buffers[b], bytes[b], dimension))
      return refuse(context, b);
    const header h = header_of(&m, b);
    m.n_facets += h.n_facets;
    m.n_nodes += h.n_nodes;
    m.n_entries += h.n_entries;
  }
  if (m.n_entries > INT32_MAX / 4)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "unpack_surfaces",
                     "more facets than 32-bit numbers can count");
  abut_status status = reserve(&m);
  if (status == ABUT_SUCCESS)
  {
    merge_nodes(&m);
    merge_facets(&m);
    status = make_surface(&m, surface);
  }
  release(&m);
  return status;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "search/grid.h"

#include <math.h>

enum
{
  GRID_BITS = 20 /* most cells per direction, as a power of two */
};

/* Number of the cell at x in direction d; monotone in x, clamped to the grid.
 */
static inline uint64_t
cell_at(const abut_grid *g, double x, int d)
{
  double c = (x - g->origin[d]) / g->edge;
  c = c > 0 ? c : 0;
  c = c < g->limit[d] ? c : g->limit[d];
  return (uint64_t)c;
}

static inline uint64_t
key_of(uint64_t i, uint64_t j, uint64_t k)
{
  return abut_spread(i) | abut_spread(j) << 1 | abut_spread(k) << 2;
}

static inline uint32_t
place_of(const abut_grid *g, uint64_t key)
{
  return (uint32_t)((key * UINT64_C(0x9e3779b97f4a7c15))
                    >> (64 - g->hash_bits));
}

/* Every third bit of a key, gathered. */
static uint64_t
gather_bits(uint64_t v)
{
  v &= UINT64_C(0x1249249249249249);
  v = (v | v >> 2) & UINT64_C(0x10c30c30c30c30c3);
  v = (v | v >> 4) & UINT64_C(0x100f00f00f00f00f);
  v = (v | v >> 8) & UINT64_C(0x001f0000ff0000ff);
  v = (v | v >> 16) & UINT64_C(0x001f00000000ffff);
  v = (v | v >> 32) & UINT64_C(0x1fffff);
  return v;
}

/* Origin, edge and limits from the sites. */
static void
choose_cells(abut_grid *g, const abut_site *sites, int32_t n, double edge)
{
  double lower[3] = {INFINITY, INFINITY, INFINITY};
  double upper[3] = {-INFINITY, -INFINITY, -INFINITY};
  g->radius = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    g->radius = sites[i].half > g->radius ? sites[i].half : g->radius;
    for (int d = 0; d < 3; ++d)
    {
      const double c = sites[i].centre[d];
      lower[d] = c < lower[d] ? c : lower[d];
      upper[d] = c > upper[d] ? c : upper[d];
    }
  }
  double extent = 0;
  for (int d = 0; d < 3; ++d)
    extent = upper[d] - lower[d] > extent ? upper[d] - lower[d] : extent;
  g->edge = edge;
  g->raised = edge > 0 && edge < g->radius;
  if (!(g->edge > g->radius))
    g->edge = g->radius;
  if (g->edge < extent / (1 << GRID_BITS))
    g->edge = extent / (1 << GRID_BITS);
  if (!(g->edge > 1e-100))
    g->edge = 1;
  for (int d = 0; d < 3; ++d)
  {
    g->origin[d] = lower[d];
    g->limit[d] = floor((upper[d] - lower[d]) / g->edge);
  }
}

static abut_status
build_table(abut_context *context, abut_grid *g, const abut_keyed *items,
            int32_t n)
{
  int32_t n_cells = 0;
  for (int32_t i = 0; i < n; ++i)
    n_cells += i == 0 || items[i].key != items[i - 1].key;
  g->n_cells = n_cells;
  g->hash_bits = 4;
  while (((int64_t)1 << g->hash_bits) < 3 * (int64_t)n_cells / 2)
    ++g->hash_bits;
  const int64_t places = (int64_t)1 << g->hash_bits;
  abut_status status = abut_array_reserve(context, &g->cell_key, 0, n_cells);
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(context, &g->cell_start, 0, (int64_t)n_cells + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &g->table, 0, places);
  if (status != ABUT_SUCCESS)
    return status;
  uint64_t *key = g->cell_key.data;
  int32_t *start = g->cell_start.data, *table = g->table.data;
  for (int64_t p = 0; p < places; ++p)
    table[p] = -1;
  int32_t cell = 0;
  for (int32_t i = 0; i < n; ++i)
    if (i == 0 || items[i].key != items[i - 1].key)
    {
      key[cell] = items[i].key;
      start[cell] = i;
      int64_t p = place_of(g, items[i].key);
      while (table[p] >= 0)
        p = (p + 1) & (places - 1);
      table[p] = cell++;
    }
  start[n_cells] = n;
  return ABUT_SUCCESS;
}

abut_status
abut_grid_build(abut_context *context, abut_grid *g, const abut_site *sites,
                int32_t n, double edge, abut_keyed *items, abut_keyed *room)
{
  choose_cells(g, sites, n, edge);
  g->drift = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    const double *c = sites[i].centre;
    items[i].index = i;
    items[i].key =
        key_of(cell_at(g, c[0], 0), cell_at(g, c[1], 1), cell_at(g, c[2], 2));
  }
  abut_order_sort(items, room, n);
  return build_table(context, g, items, n);
}

bool
abut_grid_refit(abut_grid *g, const abut_record *records)
{
  const uint64_t *key = g->cell_key.data;
  const int32_t *start = g->cell_start.data;
  double radius = 0, drift = 0;
  for (int32_t cell = 0; cell < g->n_cells; ++cell)
    for (int32_t i = start[cell]; i < start[cell + 1]; ++i)
      for (int d = 0; d < 3; ++d)
      {
        const abut_record *r = records + i;
        const double half = 0.5 * (r->upper[d] - r->lower[d]) + r->reach;
        const double at = (0.5 * (r->upper[d] + r->lower[d]) - g->origin[d]);
        const double low = (double)gather_bits(key[cell] >> d) * g->edge;
        const double below = low - at, above = at - (low + g->edge);
        radius = half > radius ? half : radius;
        drift = below > drift ? below : drift;
        drift = above > drift ? above : drift;
      }
  g->radius = radius;
  g->drift = drift;
  return drift <= 0.5 * g->edge && radius <= 1.5 * g->edge;
}

static int32_t
find_cell(const abut_grid *g, uint64_t key)
{
  const uint64_t *keys = g->cell_key.data;
  const int32_t *table = g->table.data;
  const uint32_t mask = (UINT32_C(1) << g->hash_bits) - 1;
  uint32_t p = place_of(g, key);
  for (; table[p] >= 0; p = (p + 1) & mask)
    if (keys[table[p]] == key)
      return table[p];
  return -1;
}

static void
add_cell(const abut_grid *g, int32_t cell, abut_runs *runs)
{
  const int32_t *start = g->cell_start.data;
  abut_runs_add(runs, start[cell], start[cell + 1]);
}

/* All occupied cells within the range: for ranges of more cells than those. */
static void
gather_from_all(const abut_grid *g, const uint64_t (*range)[2], abut_runs *runs)
{
  const uint64_t *key = g->cell_key.data;
  for (int32_t cell = 0; cell < g->n_cells; ++cell)
  {
    int in = 1;
    for (int d = 0; d < 3; ++d)
    {
      const uint64_t c = gather_bits(key[cell] >> d);
      in &= (c >= range[d][0]) & (c <= range[d][1]);
    }
    if (in)
      add_cell(g, cell, runs);
  }
}

void
abut_grid_gather(const abut_grid *g, const double *lower, const double *upper,
                 abut_runs *runs)
{
  uint64_t range[3][2];
  double n_range = 1;
  /* Centres lie within the radius of the box; the slack covers the rounding
   * of centres and cell borders. */
  for (int d = 0; d < 3; ++d)
  {
    const double magnitude =
        fmax(fabs(lower[d]), fabs(upper[d])) + fabs(g->origin[d]);
    const double r =
        g->radius + g->drift + 1e-14 * (magnitude + g->limit[d] * g->edge);
    range[d][0] = cell_at(g, lower[d] - r, d);
    range[d][1] = cell_at(g, upper[d] + r, d);
    n_range *= (double)(range[d][1] - range[d][0] + 1);
  }
  if (n_range > g->n_cells)
  {
    gather_from_all(g, (const uint64_t(*)[2])range, runs);
    return;
  }
  for (uint64_t k = range[2][0]; k <= range[2][1]; ++k)
    for (uint64_t j = range[1][0]; j <= range[1][1]; ++j)
      for (uint64_t i = range[0][0]; i <= range[0][1]; ++i)
      {
        const int32_t cell = find_cell(g, key_of(i, j, k));
        if (cell >= 0)
          add_cell(g, cell, runs);
      }
}

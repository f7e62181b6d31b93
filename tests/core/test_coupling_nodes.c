/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Hanging, dropped and unwanted nodes; order of arrays; memory; arguments. */
#include "coupling_fixture.h"

/* A square of n x n cells of which some are cut into four, as quad4 or quad9,
 * with its hanging nodes. Positions in [0, 1]^2 on a lattice of 4 n steps. */
typedef struct irregular
{
  scene_mesh mesh;
  int32_t n_hanging;
  int32_t node[2000], start[2001], parent[6000];
  double weight[6000];
} irregular;

enum
{
  MOST = 8 /* coarse cells per side */
};

typedef struct lattice
{
  int n, order;
  bool fine[MOST][MOST];
  /* Number of the node at a place: [1] of the fine side of an edge between
   * coarse and fine, where it hangs; -1 if there is none. */
  int32_t node[2][4 * MOST + 1][4 * MOST + 1];
  irregular *result;
} lattice;

static bool
is_coarse(const lattice *l, int i, int j)
{
  return i >= 0 && j >= 0 && i < l->n && j < l->n && !l->fine[j][i];
}

/* Whether a node of a fine cell lies inside an edge of a coarse cell. */
static bool
hangs(const lattice *l, int x, int y)
{
  if (x % 4 == 0 && y % 4 != 0)
    return is_coarse(l, x / 4, y / 4) || is_coarse(l, x / 4 - 1, y / 4);
  if (y % 4 == 0 && x % 4 != 0)
    return is_coarse(l, x / 4, y / 4) || is_coarse(l, x / 4, y / 4 - 1);
  return false;
}

static int32_t
node_at(lattice *l, int x, int y, bool fine)
{
  const bool hanging = fine && hangs(l, x, y);
  int32_t *node = &l->node[hanging][y][x];
  if (*node < 0)
  {
    scene_mesh *m = &l->result->mesh;
    *node = m->n_nodes++;
    m->position[3 * *node] = x / (4. * l->n);
    m->position[3 * *node + 1] = y / (4. * l->n);
    m->position[3 * *node + 2] = 0.;
  }
  return *node;
}

/* Facet with its lower corner at (x, y) and edges of size steps; down: with
 * the normal along -z. */
static void
add_facet(lattice *l, int x, int y, int size, bool fine, bool down)
{
  static const int8_t place[9][2] = {{0, 0}, {2, 0}, {0, 2}, {2, 2}, {0, 1},
                                     {2, 1}, {1, 0}, {1, 2}, {1, 1}};
  scene_mesh *m = &l->result->mesh;
  const int k = l->order == 1 ? 4 : 9;
  for (int a = 0; a < k; ++a)
  {
    const int u = place[a][0], v = place[a][1];
    m->connectivity[m->n_facets * k + a] = node_at(
        l, x + (down ? v : u) * size / 2, y + (down ? u : v) * size / 2, fine);
  }
  ++m->n_facets;
}

static void
add_parent(lattice *l, int x, int y, double weight)
{
  irregular *r = l->result;
  const int32_t e = r->start[r->n_hanging];
  assert_true(l->node[0][y][x] >= 0);
  r->parent[e] = l->node[0][y][x];
  r->weight[e] = weight;
  r->start[r->n_hanging] = e + 1;
}

/* The traces of both sides agree on the edge: degree 1 between the two ends,
 * degree 2 with the middle node of the coarse side. */
static void
add_hanging(lattice *l, int x, int y)
{
  irregular *r = l->result;
  const bool along_x = y % 4 == 0;
  const int t = along_x ? x % 4 : y % 4;
  const int ax = along_x ? x - t : x, ay = along_x ? y : y - t;
  const int step = along_x, up = !along_x;
  const double s = t / 4.;
  r->node[r->n_hanging] = l->node[1][y][x];
  ++r->n_hanging;
  r->start[r->n_hanging] = r->start[r->n_hanging - 1];
  if (l->order == 1)
  {
    add_parent(l, ax, ay, 1. - s);
    add_parent(l, ax + 4 * step, ay + 4 * up, s);
    return;
  }
  if (t != 2)
  {
    add_parent(l, ax, ay, (1. - s) * (1. - 2. * s));
    add_parent(l, ax + 4 * step, ay + 4 * up, s * (2. * s - 1.));
  }
  add_parent(l, ax + 2 * step, ay + 2 * up, 4. * s * (1. - s));
}

static void
make_irregular(int order, int n, bool down, uint64_t *seed, irregular *r)
{
  static lattice l;
  memset(r, 0, sizeof(*r));
  l.n = n;
  l.order = order;
  l.result = r;
  memset(l.node, -1, sizeof(l.node));
  r->mesh.dimension = 3;
  r->mesh.kind = order == 1 ? ABUT_FACET_QUAD4 : ABUT_FACET_QUAD9;
  r->mesh.position = malloc(sizeof(double) * 3 * 4000);
  r->mesh.connectivity = malloc(sizeof(int32_t) * 4000);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      l.fine[j][i] = scene_uniform(seed) < 0.5;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if (!l.fine[j][i])
        add_facet(&l, 4 * i, 4 * j, 4, false, down);
      else
        for (int k = 0; k < 4; ++k)
          add_facet(&l, 4 * i + 2 * (k % 2), 4 * j + 2 * (k / 2), 2, true,
                    down);
  for (int y = 0; y <= 4 * n; ++y)
    for (int x = 0; x <= 4 * n; ++x)
      if (l.node[1][y][x] >= 0)
        add_hanging(&l, x, y);
}

static abut_coupling_nodes
nodes_of(const irregular *r)
{
  abut_coupling_nodes nodes = abut_coupling_nodes_defaults();
  nodes.n_hanging = r->n_hanging;
  nodes.hanging_node = r->node;
  nodes.hanging_start = r->start;
  nodes.hanging_parent = r->parent;
  nodes.hanging_weight = r->weight;
  return nodes;
}

/* Areas of the free nodes: those of hanging nodes handed to their parents. */
static void
free_areas(const abut_surface *s, const irregular *r, double *area)
{
  nodal_areas(s, area);
  for (int32_t h = 0; h < r->n_hanging; ++h)
  {
    for (int32_t e = r->start[h]; e < r->start[h + 1]; ++e)
      area[r->parent[e]] += r->weight[e] * area[r->node[h]];
    area[r->node[h]] = 0.;
  }
}

static const double angles[3] = {1.1, 0.3, -0.4}, shift[3] = {-1., 2., 0.1};

static abut_coupling_options
options_of(int k)
{
  return mortar_options(k == 0 ? ABUT_DISCRETISATION_DUAL_MORTAR
                               : ABUT_DISCRETISATION_MORTAR,
                        k == 2);
}

/* Sum over rows of W_j c_jl against the areas of the nodes. */
static void
check_areas(const couple_view *v, int side, const double *area, int32_t n_nodes)
{
  const side_entries of = entries_of(v, side);
  double *sum = calloc((size_t)n_nodes, sizeof(double));
  for (int32_t j = 0; j < v->n_rows; ++j)
    for (int64_t e = of.start[j]; e < of.start[j + 1]; ++e)
      sum[of.node[e]] += v->weight[j] * of.value[e];
  for (int32_t l = 0; l < n_nodes; ++l)
    near(sum[l], area[l], 1e-14, side == 0 ? "secondary" : "primary");
  free(sum);
}

static double
linear_field(const double *x, const void *data)
{
  (void)data;
  return 1. + x[0] - 2. * x[1] + 0.7 * x[2];
}

/* Random 1-irregular meshes on both sides: a uniform pressure gives the
 * consistent forces of the free nodes; no hanging node has a row or an entry;
 * dual rows have one secondary node. */
static void
test_hanging(void **state)
{
  (void)state;
  static irregular s, m;
  static double area[4000];
  for (uint64_t seed = 1; seed <= 6; ++seed)
    for (int order = 1; order <= 2; ++order)
      for (int k = 0; k < (order == 1 ? 2 : 3); ++k)
      {
        uint64_t bits = seed;
        const abut_coupling_options o = options_of(k);
        make_irregular(order, 3, false, &bits, &s);
        make_irregular(seed % 2 == 0 ? 1 : order, 4, true, &bits, &m);
        scene_move(&s.mesh, 1., angles, shift);
        scene_move(&m.mesh, 1., angles, shift);
        const abut_coupling_nodes nodes = nodes_of(&s);
        couple c = couple_meshes(&s.mesh, &m.mesh, &o, &nodes);
        check_rows(&c);
        check_balance(&c, 1e-12, 1e-12);
        near(field_difference(&c, linear_field, NULL), 0., 2e-13, "field");
        near(c.statistics.covered_area, 1., 1e-14, "covered");
        near(c.statistics.full_area, 1., 1e-14, "full");
        free_areas(c.secondary, &s, area);
        check_areas(&c.view, 0, area, s.mesh.n_nodes);
        nodal_areas(c.primary, area);
        check_areas(&c.view, 1, area, m.mesh.n_nodes);
        for (int32_t j = 0; j < c.view.n_rows; ++j)
        {
          near(c.view.gap[j], 0., 1e-13, "gap");
          for (int32_t h = 0; h < s.n_hanging; ++h)
            assert_int_not_equal(c.view.node[j], s.node[h]);
        }
        if (k < 2)
          assert_int_equal(c.view.n_rows, s.mesh.n_nodes - s.n_hanging);
        if (k == 0)
          assert_int_equal(c.view.secondary_start[c.view.n_rows],
                           c.view.n_rows);
        couple_destroy(&c);
        scene_free(&s.mesh);
        scene_free(&m.mesh);
      }
}

/* Fine facets only: the middle nodes of the coarse edges, on which nodes hang,
 * have no facet of this surface, and have rows. */
static void
test_parents_without_facets(void **state)
{
  (void)state;
  static irregular s;
  uint64_t seed = 5;
  const double p[5] = {-0.1, -0.1, 1.2, 1.2, 0.01};
  make_irregular(2, 3, false, &seed, &s);
  int32_t n = 0;
  for (int32_t f = 0; f < s.mesh.n_facets; ++f)
  {
    const int32_t *c = s.mesh.connectivity + 9 * f;
    if (s.mesh.position[3 * c[1]] - s.mesh.position[3 * c[0]] < 0.2)
      memmove(s.mesh.connectivity + 9 * n++, c, 9 * sizeof(int32_t));
  }
  assert_true(n > 0 && n < s.mesh.n_facets);
  s.mesh.n_facets = n;
  scene_mesh m = scene_patch(ABUT_FACET_QUAD4, 4, 4, scene_plane, p, true);
  const abut_coupling_nodes nodes = nodes_of(&s);
  couple c = couple_meshes(&s.mesh, &m, NULL, &nodes);
  check_rows(&c);
  near(c.statistics.covered_area, n / 36., 1e-14, "covered");
  int32_t n_without = 0;
  abut_surface_view v;
  require(abut_surface_get(c.secondary, &v));
  for (int32_t j = 0; j < c.view.n_rows; ++j)
  {
    n_without +=
        v.node_start[c.view.node[j] + 1] == v.node_start[c.view.node[j]];
    near(c.view.normal[3 * j + 2], 1., 1e-14, "normal");
    near(c.view.gap[j], 0.01, 1e-13, "gap");
  }
  assert_true(n_without > 0);
  couple_destroy(&c);
  scene_free(&s.mesh);
  scene_free(&m);
}

/* Dropped nodes have no row; their share goes to kept neighbours, so that
 * weights still add up and forces stay consistent, also at dropped nodes. */
static void
test_dropped(void **state)
{
  (void)state;
  static irregular s, m;
  static double area[4000];
  static uint8_t dropped[4000];
  for (int order = 1; order <= 2; ++order)
    for (int k = 0; k < (order == 1 ? 2 : 3); ++k)
    {
      uint64_t seed = 3;
      const abut_coupling_options o = options_of(k);
      make_irregular(order, 4, false, &seed, &s);
      make_irregular(1, 3, true, &seed, &m);
      int32_t n_dropped = 0;
      for (int32_t i = 0; i < s.mesh.n_nodes; ++i)
        dropped[i] =
            s.mesh.position[3 * i] < 1e-10
            || (s.mesh.position[3 * i] > 0.49 && s.mesh.position[3 * i] < 0.51
                && s.mesh.position[3 * i + 1] > 0.49
                && s.mesh.position[3 * i + 1] < 0.51);
      abut_coupling_nodes nodes = nodes_of(&s);
      nodes.dropped = dropped;
      for (int32_t i = 0; i < s.mesh.n_nodes; ++i)
        n_dropped += dropped[i];
      couple c = couple_meshes(&s.mesh, &m.mesh, &o, &nodes);
      check_rows(&c);
      check_balance(&c, 1e-12, 1e-11);
      near(field_difference(&c, linear_field, NULL), 0., 1e-12, "field");
      near(c.statistics.covered_area, 1., 1e-14, "covered");
      free_areas(c.secondary, &s, area);
      check_areas(&c.view, 0, area, s.mesh.n_nodes);
      nodal_areas(c.primary, area);
      check_areas(&c.view, 1, area, m.mesh.n_nodes);
      assert_true(n_dropped > 4);
      for (int32_t j = 0; j < c.view.n_rows; ++j)
      {
        assert_false(dropped[c.view.node[j]]);
        for (int64_t e = c.view.secondary_start[j];
             k == 0 && e < c.view.secondary_start[j + 1]; ++e)
          assert_true(c.view.secondary_node[e] == c.view.node[j]
                      || dropped[c.view.secondary_node[e]]);
      }
      couple_destroy(&c);
      scene_free(&s.mesh);
      scene_free(&m.mesh);
    }
}

static void
assert_same_row(const couple_view *a, int32_t i, const couple_view *b,
                int32_t j)
{
  const int dim = a->dimension;
  assert_memory_equal(&a->weight[i], &b->weight[j], sizeof(double));
  assert_memory_equal(&a->full_weight[i], &b->full_weight[j], sizeof(double));
  assert_memory_equal(&a->gap[i], &b->gap[j], sizeof(double));
  assert_memory_equal(a->normal + dim * i, b->normal + dim * j,
                      sizeof(double) * (size_t)dim);
  const int64_t n = a->secondary_start[i + 1] - a->secondary_start[i],
                k = a->primary_start[i + 1] - a->primary_start[i];
  assert_int_equal(n, b->secondary_start[j + 1] - b->secondary_start[j]);
  assert_int_equal(k, b->primary_start[j + 1] - b->primary_start[j]);
  assert_memory_equal(a->secondary_node + a->secondary_start[i],
                      b->secondary_node + b->secondary_start[j],
                      sizeof(int32_t) * (size_t)n);
  assert_memory_equal(a->secondary_coefficient + a->secondary_start[i],
                      b->secondary_coefficient + b->secondary_start[j],
                      sizeof(double) * (size_t)n);
  assert_memory_equal(a->primary_node + a->primary_start[i],
                      b->primary_node + b->primary_start[j],
                      sizeof(int32_t) * (size_t)k);
  assert_memory_equal(a->primary_coefficient + a->primary_start[i],
                      b->primary_coefficient + b->primary_start[j],
                      sizeof(double) * (size_t)k);
}

/* The rows of some nodes are those of all, to the last bit; of a primary that
 * covers a part, too. */
static void
test_wanted(void **state)
{
  (void)state;
  static irregular s;
  static uint8_t wanted[4000];
  const double p[5] = {0.13, -0.2, 0.6, 1.1, 0.001};
  for (int order = 1; order <= 2; ++order)
    for (int k = 0; k < 5; ++k)
    {
      uint64_t seed = 11;
      make_irregular(order, 4, false, &seed, &s);
      scene_mesh m = scene_patch(ABUT_FACET_QUAD4, 3, 4, scene_plane, p, true);
      abut_coupling_options o = options_of(k);
      if (k >= 3)
        o.multiplier_degree = 0;
      if (k == 3)
        o.discretisation = ABUT_DISCRETISATION_NODE_TO_SEGMENT;
      if (k == 4)
        o.discretisation = ABUT_DISCRETISATION_QUADRATURE_POINT;
      abut_coupling_nodes nodes = nodes_of(&s);
      couple all = couple_meshes(&s.mesh, &m, &o, &nodes);
      for (int32_t i = 0; i < s.mesh.n_nodes; ++i)
        wanted[i] = scene_uniform(&seed) < 0.4;
      if (k == 4)
        nodes.wanted_facet = wanted;
      else
        nodes.wanted = wanted;
      couple some = couple_meshes(&s.mesh, &m, &o, &nodes);
      int32_t n = 0;
      for (int32_t j = 0; j < all.view.n_rows; ++j)
        if (wanted[k == 4 ? all.view.facet[j] : all.view.node[j]])
        {
          assert_true(n < some.view.n_rows);
          assert_int_equal(some.view.node[n], all.view.node[j]);
          assert_int_equal(some.view.facet[n], all.view.facet[j]);
          assert_int_equal(some.view.point[n], all.view.point[j]);
          assert_same_row(&all.view, j, &some.view, n++);
        }
      assert_int_equal(n, some.view.n_rows);
      assert_true(n > 3 && n < all.view.n_rows);
      couple_destroy(&all);
      couple_destroy(&some);
      scene_free(&s.mesh);
      scene_free(&m);
    }
}

/* Numbers, not the order of the arrays, settle the order of rows, entries and
 * sums. */
static void
test_order(void **state)
{
  (void)state;
  const double p[5] = {0., 0., 1., 1., 0.}, q[5] = {0.2, -0.3, 1., 1., 0.01};
  for (int k = 0; k < 3; ++k)
  {
    uint64_t seed = 21;
    scene_mesh s = scene_patch(ABUT_FACET_QUAD9, 3, 3, scene_plane, p, false),
               m = scene_patch(ABUT_FACET_QUAD9, 4, 3, scene_plane, q, true);
    const abut_coupling_options o = options_of(k);
    couple first = couple_meshes(&s, &m, &o, NULL);
    int64_t node[2][100], facet[2][20];
    scene_shuffle(&s, &seed, node[0], facet[0]);
    scene_shuffle(&m, &seed, node[1], facet[1]);
    couple second;
    memset(&second, 0, sizeof(second));
    for (int i = 0; i < 2; ++i)
    {
      abut_surface_data data = scene_data(i == 0 ? &s : &m);
      data.node_id = node[i];
      data.facet_id = facet[i];
      /* The numbers of the two sides mean different nodes. */
      for (int l = 0; i == 1 && l < m.n_nodes; ++l)
        node[1][l] += 1000;
      require(abut_surface_create(
          context, &data, i == 0 ? &second.secondary : &second.primary));
    }
    require(abut_coupling_create(context, second.secondary, second.primary, &o,
                                 &second.coupling));
    couple_build(&second, NULL);
    check_rows(&first);
    assert_int_equal(first.view.n_rows, second.view.n_rows);
    for (int32_t j = 0; j < first.view.n_rows; ++j)
    {
      const couple_view *a = &first.view, *b = &second.view;
      assert_int_equal(a->node[j], node[0][b->node[j]]);
      assert_memory_equal(&a->weight[j], &b->weight[j], sizeof(double));
      const int64_t n = a->primary_start[j + 1] - a->primary_start[j];
      assert_int_equal(n, b->primary_start[j + 1] - b->primary_start[j]);
      for (int64_t e = 0; e < n; ++e)
      {
        assert_int_equal(a->primary_node[a->primary_start[j] + e] + 1000,
                         node[1][b->primary_node[b->primary_start[j] + e]]);
        assert_memory_equal(a->primary_coefficient + a->primary_start[j] + e,
                            b->primary_coefficient + b->primary_start[j] + e,
                            sizeof(double));
      }
    }
    couple_destroy(&first);
    couple_destroy(&second);
    scene_free(&s);
    scene_free(&m);
  }
}

/* Facets that have a node of the same number are no pair. */
static void
test_own_facets(void **state)
{
  (void)state;
  double x[8] = {0., 0., 1., 0., 0.5, 0.05, 0., 1.};
  int32_t wedge[4] = {1, 0, 0, 2}, n_rows[2];
  for (int k = 0; k < 2; ++k)
  {
    const int64_t node_s[3] = {10, 11, 12}, node_m[3] = {20, 21, 22};
    scene_mesh mesh = {2, 3, 1, ABUT_FACET_LINE2, x, wedge},
               other = {2, 3, 1, ABUT_FACET_LINE2, x, wedge + 2};
    couple c;
    memset(&c, 0, sizeof(c));
    abut_surface_data s = scene_data(&mesh), m = scene_data(&other);
    s.node_id = node_s;
    m.node_id = k == 0 ? node_s : node_m;
    require(abut_surface_create(context, &s, &c.secondary));
    require(abut_surface_create(context, &m, &c.primary));
    require(abut_coupling_create(context, c.secondary, c.primary, NULL,
                                 &c.coupling));
    couple_build(&c, NULL);
    n_rows[k] = c.view.n_rows;
    couple_destroy(&c);
  }
  assert_int_equal(n_rows[0], 0);
  assert_int_equal(n_rows[1], 2);
}

/* Two parallel sheets of n x n and 4 n / 3 x n cells that overlap in part. */
static void
make_sheets(int32_t n, scene_mesh *s, scene_mesh *m)
{
  const double p[5] = {0., 0., 1., 1., 0.}, q[5] = {0.2, -0.3, 1., 1., 0.01};
  *s = scene_patch(ABUT_FACET_QUAD9, n, n, scene_plane, p, false);
  *m = scene_patch(ABUT_FACET_QUAD4, 4 * n / 3, n, scene_plane, q, true);
}

/* A warmed-up build allocates nothing. */
static void
test_memory(void **state)
{
  (void)state;
  for (int k = 0; k < ABUT_DISCRETISATION_N; ++k)
  {
    const abut_coupling_options o = mortar_options((abut_discretisation)k, 0);
    scene_mesh s, m;
    make_sheets(3, &s, &m);
    couple c = couple_meshes(&s, &m, &o, NULL);
    const int32_t n = c.view.n_rows;
    double *x = malloc(sizeof(double) * 3 * (size_t)m.n_nodes);
    memcpy(x, m.position, sizeof(double) * 3 * (size_t)m.n_nodes);
    for (int i = 0; i < m.n_nodes; ++i)
      x[3 * i + 2] = 0.02;
    require(abut_surface_update(c.primary, x));
    couple_build(&c, NULL);
    const uint64_t before = abut_context_memory(context).n_allocations;
    require(abut_surface_update(c.primary, m.position));
    couple_build(&c, NULL);
    require(abut_surface_update(c.primary, x));
    couple_build(&c, NULL);
    assert_int_equal(abut_context_memory(context).n_allocations, before);
    assert_int_equal(c.view.n_rows, n);
    assert_true(n > 5);
    for (int32_t j = 0; j < n; ++j)
      near(c.view.gap[j], 0.02, 1e-13, "gap");
    free(x);
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
}

static abut_status
create(const couple *c, const abut_coupling_options *o)
{
  abut_coupling *made = NULL;
  const abut_status status =
      abut_coupling_create(context, c->secondary, c->primary, o, &made);
  assert_int_equal(made != NULL, status == ABUT_SUCCESS);
  require(abut_coupling_destroy(&made));
  return status;
}

static void
test_options(void **state)
{
  (void)state;
  const double p[5] = {0., 0., 1., 1., 0.};
  scene_mesh s = scene_patch(ABUT_FACET_QUAD9, 2, 2, scene_plane, p, false),
             t = scene_patch(ABUT_FACET_TRI6, 2, 2, scene_plane, p, false);
  couple c = couple_meshes(&s, &s, NULL, NULL);
  couple d;
  memset(&d, 0, sizeof(d));
  d.secondary = surface_of(&t);
  d.primary = surface_of(&t);
  const abut_coupling_options good = abut_coupling_defaults();
  abut_coupling_options o = good;
  assert_int_equal(create(&c, &o), ABUT_SUCCESS);
  assert_int_equal(create(&d, &o), ABUT_UNSUPPORTED);
  assert_non_null(strstr(abut_context_message(context), "tri6"));
  o.multiplier_degree = 1;
  assert_int_equal(create(&c, &o), ABUT_UNSUPPORTED);
  o.discretisation = ABUT_DISCRETISATION_MORTAR;
  assert_int_equal(create(&c, &o), ABUT_SUCCESS);
  assert_int_equal(create(&d, &o), ABUT_SUCCESS);
  o.multiplier_degree = -1; /* constants per facet */
  assert_int_equal(create(&c, &o), ABUT_UNSUPPORTED);
  const int32_t degrees[] = {-1, 9};
  for (int i = 0; i < 2; ++i)
  {
    o = good;
    o.quadrature_degree = degrees[i];
    assert_int_equal(create(&c, &o), ABUT_INVALID_ARGUMENT);
  }
  o = good;
  o.axisymmetric = true;
  assert_int_equal(create(&c, &o), ABUT_INVALID_ARGUMENT);
  const double wrong[] = {(double)NAN, -1.5, 1.5};
  for (int i = 0; i < 3; ++i)
  {
    o = good;
    o.normal_cosine = wrong[i];
    assert_int_equal(create(&c, &o), ABUT_INVALID_ARGUMENT);
    o = good;
    o.thickness = -fabs(wrong[i]);
    assert_int_equal(create(&c, &o), ABUT_INVALID_ARGUMENT);
    o = good;
    o.search.reach = -fabs(wrong[i]);
    assert_int_equal(create(&c, &o), ABUT_INVALID_ARGUMENT);
  }
  o = good;
  o.discretisation = ABUT_DISCRETISATION_N;
  assert_int_equal(create(&c, &o), ABUT_INVALID_ARGUMENT);
  o = good;
  o.struct_size = 8;
  assert_int_equal(create(&c, &o), ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_coupling_create(context, NULL, c.primary, &good, &d.coupling),
      ABUT_INVALID_ARGUMENT);
  abut_discretisation found;
  for (int i = 0; i < ABUT_DISCRETISATION_N; ++i)
  {
    require(abut_discretisation_find(
        abut_discretisation_name((abut_discretisation)i), &found));
    assert_int_equal(found, i);
  }
  assert_int_equal(abut_discretisation_find("mortal", &found),
                   ABUT_INVALID_ARGUMENT);
  require(abut_surface_destroy(&d.secondary));
  require(abut_surface_destroy(&d.primary));
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&t);
}

/* Wrong lists of hanging nodes are refused, and the next build is fine. */
static void
test_node_arguments(void **state)
{
  (void)state;
  const double p[5] = {0., 0., 1., 1., 0.};
  scene_mesh s = scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, p, false),
             m = scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, p, true);
  couple c = couple_meshes(&s, &m, NULL, NULL);
  const int32_t node[2] = {1, 3}, start[3] = {0, 2, 4},
                parent[4] = {0, 2, 0, 6};
  const double weight[4] = {0.5, 0.5, 0.5, 0.5};
  abut_coupling_nodes good = abut_coupling_nodes_defaults(), n;
  good.n_hanging = 2;
  good.hanging_node = node;
  good.hanging_start = start;
  good.hanging_parent = parent;
  good.hanging_weight = weight;
  require(couple_try(&c, &good));
  const int32_t node_wrong[][2] = {{1, 1}, {1, 9}, {1, -1}},
                parent_wrong[][4] = {{0, 2, 0, 9}, {0, 2, 0, -1}, {0, 3, 0, 6}},
                start_wrong[][3] = {{0, 2, 2}, {1, 2, 4}};
  const double weight_wrong[][4] = {{0.5, 0.4, 0.5, 0.5},
                                    {0.5, (double)NAN, 0.5, 0.5}};
  for (int i = 0; i < 3; ++i)
  {
    n = good;
    n.hanging_node = node_wrong[i];
    assert_int_equal(couple_try(&c, &n), ABUT_INVALID_ARGUMENT);
    n = good;
    n.hanging_parent = parent_wrong[i];
    assert_int_equal(couple_try(&c, &n), ABUT_INVALID_ARGUMENT);
  }
  for (int i = 0; i < 2; ++i)
  {
    n = good;
    n.hanging_start = start_wrong[i];
    assert_int_equal(couple_try(&c, &n), ABUT_INVALID_ARGUMENT);
    n = good;
    n.hanging_weight = weight_wrong[i];
    assert_int_equal(couple_try(&c, &n),
                     i == 0 ? ABUT_INVALID_ARGUMENT : ABUT_NOT_FINITE);
  }
  n = good;
  n.hanging_weight = NULL;
  assert_int_equal(couple_try(&c, &n), ABUT_INVALID_ARGUMENT);
  const abut_coupling_target target = abut_coupling_target_defaults(c.points);
  n = good;
  n.struct_size = 1;
  assert_int_equal(couple_try(&c, &n), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_coupling_build(c.coupling, NULL, -1., &target),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_coupling_build(c.coupling, NULL, (double)NAN, &target),
                   ABUT_INVALID_ARGUMENT);
  couple_build(&c, &good);
  assert_int_equal(c.view.n_rows, 7);
  check_rows(&c);
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&m);
}

/* Numbers, kinds and gaps are the caller's, behind points that are there. */
static void
test_target(void **state)
{
  (void)state;
  const double p[5] = {0., 0., 1., 1., 0.}, q[5] = {0., 0., 1., 1., -0.02};
  scene_mesh s = scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, p, false),
             m = scene_patch(ABUT_FACET_QUAD4, 3, 3, scene_plane, q, true);
  couple c = couple_meshes(&s, &m, NULL, NULL);
  const couple_view v = c.view;
  int32_t secondary[9], primary[16];
  int64_t id[9];
  for (int l = 0; l < 9; ++l)
  {
    secondary[l] = 100 + l;
    id[l] = 1000 - 3 * l;
  }
  for (int l = 0; l < 16; ++l)
    primary[l] = 50 - l;
  abut_points *points = NULL;
  require(abut_points_create(context, 3, &points));
  abut_coupling_target target = abut_coupling_target_defaults(points);
  abut_points_view view;
  abut_coupling_view last;
  target.secondary_node = secondary;
  target.primary_node = primary;
  target.id = id;
  target.gap = 0.5;
  require(abut_coupling_build(c.coupling, NULL, 0., &target));
  target.flush = true;
  require(abut_coupling_build(c.coupling, NULL, 0., &target));
  target.tie_axes = 5; /* x and z */
  require(abut_coupling_build(c.coupling, NULL, 0., &target));
  require(abut_coupling_get(c.coupling, &last));
  require(abut_points_get(points, &view));
  assert_int_equal(v.n_rows, 9);
  assert_int_equal(view.n_points, 27);
  assert_int_equal(view.n_components, 9 + 9 + 18);
  assert_int_equal(last.first, 18);
  assert_int_equal(last.n_points, 9);
  for (int32_t i = 0; i < 27; ++i)
  {
    const int32_t j = i % 9, a = view.component_start[i];
    const bool tie = i >= 18;
    assert_int_equal(view.id[i], id[v.node[j]]);
    assert_int_equal(view.kind[i], tie ? ABUT_POINT_TIE : ABUT_POINT_CONTACT);
    assert_int_equal(view.component_start[i + 1] - a, tie ? 2 : 1);
    near(view.weight[i], v.weight[j], 0., "weight");
    near(view.gap[a], i < 9 ? 0.5 + v.gap[j] : i < 18 ? 0.5 : 0., 0., "gap");
    for (int d = 0; d < 3; ++d)
      near(view.frame[3 * a + d], tie ? d == 0 : v.normal[3 * j + d], 0.,
           "direction");
    if (tie)
      near(view.frame[3 * (a + 1) + 2], 1., 0., "second direction");
    int64_t e = view.start[i];
    for (int64_t k = v.secondary_start[j]; k < v.secondary_start[j + 1]; ++k)
    {
      assert_int_equal(view.node[e], 100 + v.secondary_node[k]);
      near(view.coefficient[e++], v.secondary_coefficient[k], 0., "D");
    }
    for (int64_t k = v.primary_start[j]; k < v.primary_start[j + 1]; ++k)
    {
      assert_int_equal(view.node[e], 50 - v.primary_node[k]);
      near(view.coefficient[e++], -v.primary_coefficient[k], 0., "M");
    }
    assert_int_equal(e, view.start[i + 1]);
  }
  /* After a failure there is what was there before. */
  primary[5] = -1;
  assert_int_equal(abut_coupling_build(c.coupling, NULL, 0., &target),
                   ABUT_INVALID_ARGUMENT);
  require(abut_points_get(points, &view));
  assert_int_equal(view.n_points, 27);
  require(abut_points_destroy(&points));
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&m);
}

static void
test_target_arguments(void **state)
{
  (void)state;
  const double p[5] = {0., 0., 1., 1., 0.};
  scene_mesh s = scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, p, false),
             m = scene_patch(ABUT_FACET_QUAD4, 2, 2, scene_plane, p, true);
  couple c = couple_meshes(&s, &m, NULL, NULL);
  abut_points *flat = NULL;
  require(abut_points_create(context, 2, &flat));
  for (int k = 0; k < 6; ++k)
  {
    abut_coupling_target target = abut_coupling_target_defaults(c.points);
    target.struct_size -= k == 0;
    target.points = k == 1 ? NULL : k == 2 ? flat : c.points;
    target.tie_axes = k == 3 ? 8 : 0;
    target.gap = k == 4 ? (double)NAN : 0.;
    assert_int_equal(
        abut_coupling_build(c.coupling, NULL, 0., k == 5 ? NULL : &target),
        ABUT_INVALID_ARGUMENT);
  }
  require(abut_points_destroy(&flat));
  couple_destroy(&c);
  scene_free(&s);
  scene_free(&m);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_hanging, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_parents_without_facets, set_up,
                                      tear_down),
      cmocka_unit_test_setup_teardown(test_dropped, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_wanted, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_order, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_own_facets, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_memory, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_options, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_node_arguments, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_target, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_target_arguments, set_up,
                                      tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

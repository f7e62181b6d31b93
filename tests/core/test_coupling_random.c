/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Random surfaces, good and bad: rows are always finite, and coefficients of
 * each side add up to one. Moved rigidly, they are the same. */
#include "coupling_fixture.h"

static const abut_facet_kind kinds[2][3] = {
    {ABUT_FACET_LINE2, ABUT_FACET_LINE3, ABUT_FACET_LINE2},
    {ABUT_FACET_QUAD4, ABUT_FACET_TRI3, ABUT_FACET_QUAD9}};

static abut_coupling_options
random_options(uint64_t *seed)
{
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation =
      (abut_discretisation)(scene_bits(seed) % ABUT_DISCRETISATION_N);
  if (o.discretisation == ABUT_DISCRETISATION_MORTAR)
    o.multiplier_degree = (int32_t)(scene_bits(seed) % 2);
  o.quadrature_degree = (int32_t)(scene_bits(seed) % 9);
  o.segments = scene_uniform(seed) < 0.8;
  o.search.relative_reach = 1.;
  o.thickness = scene_uniform(seed) < 0.3 ? 0.2 : 0.;
  o.normal_cosine = scene_uniform(seed) < 0.5 ? -0.17 : 1.;
  return o;
}

/* Soups of single facets of all sizes and directions. */
static void
test_soup(void **state)
{
  (void)state;
  int64_t n_rows = 0, n_layers = 0;
  for (uint64_t k = 1; k <= 150; ++k)
  {
    uint64_t seed = 7 * k;
    const int dim = 2 + (int)(k % 2);
    const abut_coupling_options o = random_options(&seed);
    scene_mesh s = scene_random(kinds[dim - 2][scene_bits(&seed) % 3], 15, 1.,
                                0.05, 1., &seed),
               m = scene_random(kinds[dim - 2][scene_bits(&seed) % 3], 15, 1.,
                                0.05, 1., &seed);
    couple c = couple_meshes(&s, &m, &o, NULL);
    check_rows(&c);
    n_rows += c.view.n_rows;
    n_layers += c.statistics.n_layers;
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
  assert_true(n_rows > 500 && n_layers > 25);
}

static void
bump(const double *p, double u, double v, double *x)
{
  x[0] = p[0] + p[1] * u;
  x[1] = p[0] + p[1] * v;
  x[2] = p[2] + p[3] * sin(p[4] * u + 1.) * cos(p[4] * v + p[5]);
}

/* Wavy sheets whose nodes are then moved at random, up to folded facets. */
static void
test_sheets(void **state)
{
  (void)state;
  int64_t n_rows = 0;
  for (uint64_t k = 1; k <= 40; ++k)
  {
    uint64_t seed = 13 * k;
    abut_coupling_options o = random_options(&seed);
    o.normal_cosine = -0.17;
    const double p[6] = {0., 1., 0., 0.1, 6., 1.},
                 q[6] = {-0.1, 1.1, 0.05, 0.1, 5., 0.};
    scene_mesh s = scene_patch(kinds[1][k % 3], 4, 4, bump, p, false),
               m = scene_patch(kinds[1][k / 3 % 3], 5, 5, bump, q, true);
    couple c = couple_meshes(&s, &m, &o, NULL);
    check_rows(&c);
    n_rows += c.view.n_rows;
    const double noise = pow(10., -4. * scene_uniform(&seed));
    for (int32_t i = 0; i < 3 * s.n_nodes; ++i)
      s.position[i] += noise * (scene_uniform(&seed) - 0.5);
    for (int32_t i = 0; i < 3 * m.n_nodes; ++i)
      m.position[i] += noise * (scene_uniform(&seed) - 0.5);
    require(abut_surface_update(c.secondary, s.position));
    require(abut_surface_update(c.primary, m.position));
    couple_build(&c, NULL);
    check_rows(&c);
    /* Everything at one place. */
    for (int32_t i = 0; i < 3 * m.n_nodes; ++i)
      m.position[i] = 0.;
    require(abut_surface_update(c.primary, m.position));
    couple_build(&c, NULL);
    check_rows(&c);
    for (int32_t i = 0; i < 3 * s.n_nodes; ++i)
      s.position[i] = 0.;
    require(abut_surface_update(c.secondary, s.position));
    couple_build(&c, NULL);
    check_rows(&c);
    couple_destroy(&c);
    scene_free(&s);
    scene_free(&m);
  }
  assert_true(n_rows > 400);
}

/* Rows of surfaces moved, turned and scaled together: gaps scale, normals turn,
 * coefficients stay. */
static void
test_frame(void **state)
{
  (void)state;
  const double scale = 37., angles[3] = {0.7, -1.2, 2.2},
               shift[3] = {5., -3., 11.}, none[3] = {0., 0., 0.};
  for (int k = 0; k < 12; ++k)
  {
    const double p[6] = {0., 1., 0., 0.1, 3., 1.},
                 q[6] = {-0.1, 0.9, 0.03, 0.1, 3., 1.};
    abut_coupling_options o = abut_coupling_defaults();
    o.discretisation = (abut_discretisation)(k % ABUT_DISCRETISATION_N);
    scene_mesh s = scene_patch(kinds[1][k / 4], 4, 4, bump, p, false),
               m = scene_patch(ABUT_FACET_QUAD4, 5, 5, bump, q, true);
    couple a = couple_meshes(&s, &m, &o, NULL);
    scene_move(&s, scale, angles, shift);
    scene_move(&m, scale, angles, shift);
    couple b = couple_meshes(&s, &m, &o, NULL);
    const couple_view *v = &a.view, *w = &b.view;
    assert_int_equal(v->n_rows, w->n_rows);
    assert_true(v->n_rows > 10);
    scene_mesh turned = {3, v->n_rows, 0, ABUT_FACET_QUAD4, NULL, NULL};
    turned.position = malloc(sizeof(double) * 3 * (size_t)v->n_rows);
    memcpy(turned.position, v->normal, sizeof(double) * 3 * (size_t)v->n_rows);
    scene_move(&turned, 1., angles, none);
    for (int32_t j = 0; j < v->n_rows; ++j)
    {
      near(w->weight[j], scale * scale * v->weight[j], 1e-9, "weight");
      near(w->gap[j], scale * v->gap[j], 1e-9, "gap");
      for (int d = 0; d < 3; ++d)
        near(w->normal[3 * j + d], turned.position[3 * j + d], 1e-12, "normal");
      assert_int_equal(v->primary_start[j], w->primary_start[j]);
    }
    for (int64_t e = 0; e < v->primary_start[v->n_rows]; ++e)
      near(v->primary_coefficient[e], w->primary_coefficient[e], 1e-9,
           "coefficient");
    free(turned.position);
    couple_destroy(&a);
    couple_destroy(&b);
    scene_free(&s);
    scene_free(&m);
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_soup, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_sheets, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_frame, set_up, tear_down)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Energies of membranes above obstacles, by a program that shares nothing with
 * Abut: least 1/2 |grad u|^2 - f u with u >= psi on a square, u = 0 on its
 * boundary. Differences on five points, which are linear triangles, and
 * projected relaxation.
 *
 *     membrane_limits curved [ENERGY FORCE RELATIVE]
 *     membrane_limits hills.pgm [ENERGY FORCE RELATIVE]
 *
 * prints energy, contact force, and what the energy tends to (error h^2) on
 * finer and finer grids; with expected values it ends with 1 unless the last
 * limit and the last force are that near to them. The problems are those of
 * prm/curved-obstacle.prm, and of prm/height-map.prm with its image. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct image
{
  int width, height, white;
  double *grey; /* rows from the top */
} image;

typedef struct membrane
{
  double lower, upper, load;
  const image *hills; /* NULL: the curved obstacle */
  int n;              /* cells along a side */
  double *u, *psi;    /* [(n + 1)^2] */
} membrane;

/* A text image (P2) with one line of comment. */
static image
read_image(const char *name)
{
  image m = {0, 0, 0, NULL};
  char line[256];
  FILE *file = fopen(name, "r");
  bool good = file != NULL && fgets(line, sizeof(line), file) != NULL
              && strcmp(line, "P2\n") == 0
              && fgets(line, sizeof(line), file) != NULL
              && fscanf(file, "%d %d %d", &m.width, &m.height, &m.white) == 3;
  if (good)
    m.grey = calloc((size_t)(m.width * m.height), sizeof(double));
  for (int i = 0; good && i < m.width * m.height; ++i)
    good = fscanf(file, "%lf", &m.grey[i]) == 1;
  if (file != NULL)
    fclose(file);
  if (!good)
  {
    fprintf(stderr, "%s is no text image\n", name);
    exit(2);
  }
  return m;
}

/* Grey between pixels, 0 to 1, at (x, y) in the unit square. */
static double
brightness(const image *m, double x, double y)
{
  const double column = x * (m->width - 1), row = (1 - y) * (m->height - 1);
  const int i = (int)fmin(column, m->width - 2),
            j = (int)fmin(row, m->height - 2);
  const double s = column - i, t = row - j;
  const double *g = m->grey + j * m->width + i;
  return ((1 - t) * ((1 - s) * g[0] + s * g[1])
          + t * ((1 - s) * g[m->width] + s * g[m->width + 1]))
         / m->white;
}

static double
obstacle(const membrane *m, double x, double y)
{
  return m->hills == NULL ? 0.15 - 1.2 * (x * x + y * y)
                          : -1 + 0.9 * brightness(m->hills, x, y);
}

/* Twice as many cells, from the values that are there. */
static void
refine(membrane *m, int n)
{
  const int old = m->n, w = n + 1, v = old + 1;
  double *u = calloc((size_t)(w * w), sizeof(double));
  for (int k = 0; old > 0 && k < w * w; ++k)
  {
    const int i = k % w / 2, j = k / w / 2, a = (k % w + 1) / 2,
              b = (k / w + 1) / 2;
    u[k] = 0.25
           * (m->u[j * v + i] + m->u[j * v + a] + m->u[b * v + i]
              + m->u[b * v + a]);
  }
  free(m->u);
  free(m->psi);
  m->u = u;
  m->n = n;
  m->psi = calloc((size_t)(w * w), sizeof(double));
  const double h = (m->upper - m->lower) / n;
  for (int k = 0; k < w * w; ++k)
    m->psi[k] = obstacle(m, m->lower + h * (k % w), m->lower + h * (k / w));
}

/* h^2 (f + Lap u), five points. */
static double
residual(const membrane *m, int k)
{
  const int w = m->n + 1;
  const double h = (m->upper - m->lower) / m->n;
  return m->u[k - 1] + m->u[k + 1] + m->u[k - w] + m->u[k + w] - 4 * m->u[k]
         + h * h * m->load;
}

static void
relax(membrane *m)
{
  /* The best factor without contact. */
  const double factor = 2 / (1 + sin(3.14159265358979324 / m->n));
  double largest = 1;
  for (int step = 0; step < 40 * m->n && largest > 1e-13; ++step)
  {
    largest = 0;
    for (int j = 1; j < m->n; ++j)
      for (int k = j * (m->n + 1) + 1; k < (j + 1) * (m->n + 1) - 1; ++k)
      {
        const double next =
            fmax(m->u[k] + 0.25 * factor * residual(m, k), m->psi[k]);
        largest = fmax(largest, fabs(next - m->u[k]));
        m->u[k] = next;
      }
  }
}

/* 1/2 u.Ku - f.u = -1/2 u.(r + f h^2), r the residual; force is -sum r. */
static double
energy_of(const membrane *m, double *force)
{
  const double h = (m->upper - m->lower) / m->n;
  double sum = 0;
  *force = 0;
  for (int j = 1; j < m->n; ++j)
    for (int k = j * (m->n + 1) + 1; k < (j + 1) * (m->n + 1) - 1; ++k)
    {
      const double r = residual(m, k);
      sum -= 0.5 * m->u[k] * (r + h * h * m->load);
      if (m->u[k] <= m->psi[k])
        *force -= r;
    }
  return sum;
}

static bool
near(double value, const char *expected, const char *relative)
{
  return fabs(value - atof(expected)) <= atof(relative) * fabs(atof(expected));
}

int
main(int argc, char **argv)
{
  if (argc != 2 && argc != 5)
  {
    fprintf(stderr, "membrane_limits curved|IMAGE [ENERGY FORCE RELATIVE]\n");
    return 2;
  }
  membrane m = {.lower = -1, .upper = 1};
  image hills = {0, 0, 0, NULL};
  if (strcmp(argv[1], "curved") != 0)
  {
    hills = read_image(argv[1]);
    m = (membrane){.upper = 1, .load = -20, .hills = &hills};
  }
  double last = 0, limit = 0, force = 0;
  for (int n = 32; n <= 512; n *= 2)
  {
    refine(&m, n);
    relax(&m);
    const double energy = energy_of(&m, &force);
    limit = energy + (energy - last) / 3;
    printf("%4d cells: energy %.11f, limit %.11f, force %.8f\n", n, energy,
           limit, force);
    last = energy;
  }
  free(m.u);
  free(m.psi);
  free(hills.grey);
  return argc == 2
                 || (near(limit, argv[2], argv[4])
                     && near(force, argv[3], argv[4]))
             ? 0
             : 1;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Mass of nodes that may come into contact, handed to their neighbours.
 *
 * An entry between a candidate i and another node j goes, with its mirror
 * image, to the diagonal of j. The entries of row i with candidates, itself
 * among them, are shared by the neighbours j that are not candidates, in
 * proportion to |M_ij|. So the sum of all entries stays, and nothing travels
 * further than an element. */
#include "base/dense_lu.h"
#include "base/memory.h"

#include <abut/time.h>
#include <math.h>
#include <string.h>

static const char call[] = "abut_mass_modify";

enum
{
  MAX_MOMENTS = 4 /* 1 and the places */
};

typedef struct redistribution
{
  abut_context *context;
  abut_mass_matrix mass;
  const uint8_t *candidate;
  abut_array doubles, integers, bytes; /* of the arrays below */
  double *added;                       /* [n] to the diagonal */
  int32_t *part;  /* [n] number of the connected part, -1: not yet */
  int32_t *stack; /* [n] */
  uint8_t *may;   /* [n] whether the diagonal may change */
} redistribution;

static abut_status
complain(abut_context *context, abut_status status, int32_t node,
         const char *what)
{
  abut_text text = abut_fail_begin(context, call);
  abut_text_add(&text, "node ");
  abut_text_add_integer(&text, node);
  abut_text_add(&text, what);
  return status;
}

static abut_status
check_row(abut_context *context, const abut_mass_matrix *m, int32_t i)
{
  bool has_diagonal = false;
  double probe = 0;
  if (m->start[i + 1] < m->start[i])
    return complain(context, ABUT_INVALID_ARGUMENT, i, " has a negative row");
  for (int64_t e = m->start[i]; e < m->start[i + 1]; ++e)
  {
    if (m->column[e] < 0 || m->column[e] >= m->n)
      return complain(context, ABUT_INVALID_ARGUMENT, i,
                      " has a column that is no node");
    has_diagonal |= m->column[e] == i;
    probe += 0.0 * m->value[e];
  }
  for (int32_t d = 0; d < m->dimension && m->place != NULL; ++d)
    probe += 0.0 * m->place[(int64_t)i * m->dimension + d];
  if (probe != 0)
    return complain(context, ABUT_NOT_FINITE, i,
                    " has a mass or a position that is not finite");
  return has_diagonal ? ABUT_SUCCESS
                      : complain(context, ABUT_INVALID_ARGUMENT, i,
                                 " has no diagonal entry");
}

static abut_status
check_matrix(abut_context *context, const abut_mass_matrix *m,
             const uint8_t *candidate, abut_mass_rule rule)
{
  if (m->n < 1 || m->dimension < 1 || m->dimension > 3 || m->start == NULL
      || m->column == NULL || m->value == NULL || candidate == NULL
      || m->start[0] != 0
      || (rule != ABUT_MASS_NEIGHBOURS && rule != ABUT_MASS_CENTRE)
      || (rule == ABUT_MASS_CENTRE && m->place == NULL))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "the matrix is incomplete, or there is no such rule");
  for (int32_t i = 0; i < m->n; ++i)
  {
    const abut_status status = check_row(context, m, i);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

static abut_status
reserve(redistribution *r)
{
  const int64_t n = r->mass.n;
  r->doubles.element = sizeof(double);
  r->integers.element = sizeof(int32_t);
  r->bytes.element = 1;
  abut_status status = abut_array_reserve(r->context, &r->doubles, 0, n);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(r->context, &r->integers, 0, 2 * n);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(r->context, &r->bytes, 0, n);
  if (status != ABUT_SUCCESS)
    return status;
  r->added = r->doubles.data;
  r->part = r->integers.data;
  r->stack = r->part + n;
  r->may = r->bytes.data;
  memset(r->added, 0, (size_t)n * sizeof(double));
  memset(r->may, 0, (size_t)n);
  return ABUT_SUCCESS;
}

/* Share the entries of row i of a candidate. False if no node can take them. */
static bool
hand_on(redistribution *r, int32_t i)
{
  const abut_mass_matrix *m = &r->mass;
  double own = 0, shares = 0;
  for (int64_t e = m->start[i]; e < m->start[i + 1]; ++e)
    if (r->candidate[m->column[e]])
      own += m->value[e];
    else
      shares += fabs(m->value[e]);
  for (int64_t e = m->start[i]; e < m->start[i + 1] && shares > 0; ++e)
  {
    const int32_t j = m->column[e];
    if (r->candidate[j] || m->value[e] == 0)
      continue;
    r->added[j] += 2 * m->value[e] + own * fabs(m->value[e]) / shares;
    r->may[j] = 1;
  }
  return shares > 0 || own == 0;
}

/* The nodes that hang together with one, as a part. */
static void
mark_part(redistribution *r, int32_t first, int32_t number)
{
  const abut_mass_matrix *m = &r->mass;
  int32_t n = 0;
  r->stack[n++] = first;
  r->part[first] = number;
  while (n > 0)
  {
    const int32_t i = r->stack[--n];
    for (int64_t e = m->start[i]; e < m->start[i + 1]; ++e)
      if (r->part[m->column[e]] < 0)
      {
        r->part[m->column[e]] = number;
        r->stack[n++] = m->column[e];
      }
  }
}

/* Neighbours of receivers may change, too, unless they are candidates. */
static void
widen(redistribution *r)
{
  const abut_mass_matrix *m = &r->mass;
  for (int32_t i = 0; i < m->n; ++i)
    for (int64_t e = m->start[i]; e < m->start[i + 1] && r->may[i] == 1; ++e)
      if (r->may[m->column[e]] == 0 && !r->candidate[m->column[e]])
        r->may[m->column[e]] = 2;
}

/* (1, (x - origin) / length). */
static void
moments_at(const abut_mass_matrix *m, const double *origin, double length,
           int32_t i, double *moments)
{
  moments[0] = 1;
  for (int32_t d = 0; d < m->dimension; ++d)
    moments[1 + d] =
        (m->place[(int64_t)i * m->dimension + d] - origin[d]) / length;
}

/* Furthest distance of a node of the part from its first one. */
static double
size_of_part(const redistribution *r, int32_t number, const double *origin)
{
  double size = 0;
  for (int32_t i = 0; i < r->mass.n; ++i)
    if (r->part[i] == number)
      for (int32_t d = 0; d < r->mass.dimension; ++d)
        size = fmax(size, fabs(r->mass.place[(int64_t)i * r->mass.dimension + d]
                               - origin[d]));
  return size > 0 ? size : 1;
}

/* Missing moments of a part: what went from candidates less what came to
 * receivers. */
static void
add_lacking(const redistribution *r, int32_t i, const double *moments,
            double *lacking)
{
  const abut_mass_matrix *m = &r->mass;
  double lost = -r->added[i];
  for (int64_t e = m->start[i]; e < m->start[i + 1]; ++e)
    if (r->candidate[i] || r->candidate[m->column[e]])
      lost += m->value[e];
  for (int32_t k = 0; k <= m->dimension; ++k)
    lacking[k] += lost * moments[k];
}

static double
diagonal(const abut_mass_matrix *m, int32_t i)
{
  for (int64_t e = m->start[i]; e < m->start[i + 1]; ++e)
    if (m->column[e] == i)
      return m->value[e];
  return 0;
}

/* The least change of a part's diagonal D, as part of it, that restores its
 * moments: D_i sum_k c_k moment_k on the nodes that may change, from the normal
 * equations. */
static bool
centre_part(redistribution *r, int32_t number, int32_t first)
{
  const abut_mass_matrix *m = &r->mass;
  const int32_t size = m->dimension + 1;
  const double *origin = m->place + (int64_t)first * m->dimension;
  const double length = size_of_part(r, number, origin);
  double moments[MAX_MOMENTS], matrix[MAX_MOMENTS * MAX_MOMENTS] = {0};
  double x[MAX_MOMENTS] = {0}, scale[MAX_MOMENTS];
  int32_t pivot[MAX_MOMENTS];
  bool changes = false;
  for (int32_t i = 0; i < m->n; ++i)
  {
    if (r->part[i] != number)
      continue;
    moments_at(m, origin, length, i, moments);
    add_lacking(r, i, moments, x);
    changes |= r->may[i] != 0;
    for (int32_t k = 0; k < size * size && r->may[i]; ++k)
      matrix[k] += diagonal(m, i) * moments[k / size] * moments[k % size];
  }
  if (!changes)
    return true;
  if (!abut_dense_lu_factorise(size, matrix, pivot, scale))
    return false;
  abut_dense_lu_solve(size, matrix, pivot, scale, x);
  for (int32_t i = 0; i < m->n; ++i)
  {
    if (r->part[i] != number || !r->may[i])
      continue;
    moments_at(m, origin, length, i, moments);
    for (int32_t k = 0; k < size; ++k)
      r->added[i] += diagonal(m, i) * x[k] * moments[k];
  }
  return true;
}

static abut_status
centre(redistribution *r)
{
  widen(r);
  for (int32_t i = 0; i < r->mass.n; ++i)
    r->part[i] = -1;
  int32_t n_parts = 0;
  for (int32_t i = 0; i < r->mass.n; ++i)
    if (r->part[i] < 0)
    {
      mark_part(r, i, n_parts);
      if (!centre_part(r, n_parts++, i))
        return complain(r->context, ABUT_UNSUPPORTED, i,
                        " belongs to a body whose centre of mass cannot be "
                        "preserved: the nodes that receive mass are on a line");
    }
  return ABUT_SUCCESS;
}

static abut_status
check_diagonal(const redistribution *r)
{
  const abut_mass_matrix *m = &r->mass;
  for (int32_t i = 0; i < m->n; ++i)
    if (!r->candidate[i] && r->added[i] != 0
        && !(diagonal(m, i) + r->added[i] > 0))
      return complain(r->context, ABUT_UNSUPPORTED, i,
                      " would have no positive mass: redistribute mass without "
                      "preserving its centre");
  return ABUT_SUCCESS;
}

static void
write_values(const redistribution *r)
{
  const abut_mass_matrix *m = &r->mass;
  for (int32_t i = 0; i < m->n; ++i)
    for (int64_t e = m->start[i]; e < m->start[i + 1]; ++e)
      if (r->candidate[i] || r->candidate[m->column[e]])
        m->value[e] = 0;
      else if (m->column[e] == i)
        m->value[e] += r->added[i];
}

static abut_status
redistribute(redistribution *r, abut_mass_rule rule)
{
  for (int32_t i = 0; i < r->mass.n; ++i)
    if (r->candidate[i] && !hand_on(r, i))
      return complain(r->context, ABUT_UNSUPPORTED, i,
                      " has no neighbour outside of contact that could receive "
                      "its mass: use contact stabilised");
  abut_status status = ABUT_SUCCESS;
  if (rule == ABUT_MASS_CENTRE)
    status = centre(r);
  if (status == ABUT_SUCCESS)
    status = check_diagonal(r);
  if (status == ABUT_SUCCESS)
    write_values(r);
  return status;
}

abut_status
abut_mass_modify(abut_context *context, const abut_mass_matrix *mass,
                 const uint8_t *candidate, abut_mass_rule rule)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (mass == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "mass is NULL");
  redistribution r = {.context = context,
                      .mass = {.struct_size = sizeof(r.mass)},
                      .candidate = candidate};
  abut_status status =
      abut_copy_in(context, call, &r.mass, sizeof(r.mass), mass);
  if (status == ABUT_SUCCESS)
    status = check_matrix(context, &r.mass, candidate, rule);
  if (status == ABUT_SUCCESS)
    status = reserve(&r);
  if (status == ABUT_SUCCESS)
    status = redistribute(&r, rule);
  abut_array_release(context, &r.doubles);
  abut_array_release(context, &r.integers);
  abut_array_release(context, &r.bytes);
  return status;
}

/* Share of node j in what the row of a candidate has with candidates. */
static double
share(int32_t n, const uint8_t *candidate, const double *row, int32_t j)
{
  double all = 0;
  int32_t others = 0;
  for (int32_t k = 0; k < n; ++k)
    if (!candidate[k])
    {
      all += fabs(row[k]);
      ++others;
    }
  return all > 0 ? fabs(row[j]) / all : 1. / others;
}

static double
own_of_row(int32_t n, const uint8_t *candidate, const double *row)
{
  double own = 0;
  for (int32_t k = 0; k < n; ++k)
    if (candidate[k])
      own += row[k];
  return own;
}

abut_status
abut_mass_modify_element(int32_t n, const uint8_t *candidate, double *mass)
{
  if (n < 1 || candidate == NULL || mass == NULL)
    return ABUT_INVALID_ARGUMENT;
  int32_t n_candidates = 0;
  for (int32_t i = 0; i < n; ++i)
    n_candidates += candidate[i] != 0;
  if (n_candidates == n)
    return ABUT_UNSUPPORTED;
  /* Rows of candidates stay as they are until all of them are shared. */
  for (int32_t i = 0; i < n; ++i)
  {
    const double *row = mass + (int64_t)i * n;
    for (int32_t j = 0; j < n && candidate[i]; ++j)
      if (!candidate[j])
        mass[(int64_t)j * n + j] +=
            2 * row[j]
            + own_of_row(n, candidate, row) * share(n, candidate, row, j);
  }
  for (int32_t i = 0; i < n; ++i)
    for (int32_t j = 0; j < n; ++j)
      if (candidate[i] || candidate[j])
        mass[(int64_t)i * n + j] = 0;
  return ABUT_SUCCESS;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_DENSE_LU_H
#define ABUT_BASE_DENSE_LU_H

/* Elimination with row scaling and partial pivoting (Golub and Van Loan,
 * Matrix Computations, section 3.4), n^3/3 multiplications. */

#include <stdbool.h>
#include <stdint.h>

/* Factorise the row-major a[n*n] in place; pivot[n] receives the row
 * exchanges, scale[n] the rows' scaling. False if a pivot is less than 1e-13 of
 * its row's size: then the matrix is singular for all purposes. */
bool abut_dense_lu_factorise(int32_t n, double *a, int32_t *pivot,
                             double *scale);

/* Solve in place of the right-hand side x[n]. */
void abut_dense_lu_solve(int32_t n, const double *a, const int32_t *pivot,
                         const double *scale, double *x);

#endif

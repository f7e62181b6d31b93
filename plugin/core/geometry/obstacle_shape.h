/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_GEOMETRY_OBSTACLE_SHAPE_H
#define ABUT_GEOMETRY_OBSTACLE_SHAPE_H

/* Kernels of the shapes. Vectors have three components; in 2D the third is
 * zero, and third rows and columns of second derivatives mean nothing. */

#include <abut/obstacle.h>

/* A shape ready for evaluation. */
typedef struct abut_shape_data
{
  abut_obstacle_shape shape; /* axis: unit */
  double half[3];            /* box: half edges; 2D: third infinite */
  double across[3];          /* unit vector orthogonal to the axis, in the
                                plane in 2D: the direction on the axis */
  /* Cylinder and cone, in the half plane (r, z) around the axis. */
  double side[2];   /* unit normal of the side */
  double offset;    /* of the side along its normal */
  double top;       /* of the end along the axis; infinite: none */
  double corner[2]; /* where side and end meet */
} abut_shape_data;

/* Distance, gradient and second derivatives of a point. */
typedef struct abut_shape_distance
{
  double value;
  double gradient[3];
  double hessian[9];
} abut_shape_distance;

void abut_plane_distance(const abut_shape_data *s, const double *x,
                         abut_shape_distance *d);
void abut_sphere_distance(const abut_shape_data *s, const double *x,
                          abut_shape_distance *d);
void abut_box_distance(const abut_shape_data *s, const double *x,
                       abut_shape_distance *d);
/* Cylinder and cone (2D: wedge). */
void abut_revolved_distance(const abut_shape_data *s, const double *x,
                            abut_shape_distance *d);

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_RIGID_MOTION_WORDS_H
#define ABUT_SOLVE_RIGID_MOTION_WORDS_H

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace abut::solve
{
  /** A rigid motion in words: "slide along (1, 0)", "rotate about (0.5, 0)" in
   * the plane, "rotate about the axis through (0, 0, 1) along (0, 1, 0)" in
   * space, with a translation along the axis if there is one.
   * @param mode translations, then rotations about @p center whose
   *   displacement at the distance @p radius is 1: [dim], [3] in the plane or
   *   [6] in space */
  std::string rigid_motion_in_words(unsigned int dim,
                                    const std::vector<double> &mode,
                                    const dealii::Point<3> &center,
                                    double radius);

  /** A rigid displacement in words, as "moved by 0.01 along (1, 0)" or "moved
   * by 0.01 along (1, 0) and rotated by 0.1 about (0, 1)", angles in radian:
   * the translation of the centre, rotations whose displacements at a distance
   * of @p radius are no round-off of it. */
  std::string
  rigid_displacement_in_words(unsigned int dim,
                              const dealii::Tensor<1, 3> &translation,
                              const dealii::Tensor<1, 3> &rotation,
                              const dealii::Point<3> &center, double radius);
} // namespace abut::solve

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rigid_motion_words.h"

#include <cmath>
#include <sstream>

namespace abut::solve
{
  namespace
  {
    using Triple = dealii::Tensor<1, 3>;

    /** Numbers below this part of @p unit are written as 0. */
    constexpr double no_digit = 5e-4;

    /** An axis this many radii away is at infinity: a translation. */
    constexpr double far_axis = 1e3;

    std::string triple_in_words(const Triple &values, const unsigned int dim,
                                const double unit)
    {
      std::ostringstream text;
      text.precision(3);
      for (unsigned int d = 0; d < dim; ++d)
        text << (d == 0 ? "(" : ", ")
             << (std::abs(values[d]) < no_digit * unit ? 0. : values[d]);
      text << ")";
      return text.str();
    }
  } // namespace

  std::string rigid_motion_in_words(const unsigned int dim,
                                    const std::vector<double> &mode,
                                    const dealii::Point<3> &center,
                                    const double radius)
  {
    Triple translation, rotation;
    for (unsigned int d = 0; d < dim; ++d)
      translation[d] = mode[d];
    const std::size_t n_rotations = mode.size() - dim;
    for (std::size_t r = 0; r < n_rotations; ++r)
      rotation[n_rotations == 1 ? 2 : r] = mode[dim + r];
    const double angle = rotation.norm();
    if (angle * far_axis <= translation.norm())
      return "slide along "
             + triple_in_words(translation / translation.norm(), dim, 1.);
    // v = t + w x (x - c) / r is along w where x - c = r w x t / w^2.
    const Triple axis = rotation / angle;
    const dealii::Point<3> place =
        center
        + cross_product_3d(rotation, translation) * (radius / (angle * angle));
    if (dim == 2)
      return "rotate about " + triple_in_words(place, 2, radius);
    const double pitch = translation * axis;
    return "rotate about the axis through " + triple_in_words(place, 3, radius)
           + " along " + triple_in_words(axis, 3, 1.)
           + (std::abs(pitch) > no_digit * angle ? " while it moves along it"
                                                 : "");
  }

  std::string rigid_displacement_in_words(
      const unsigned int dim, const dealii::Tensor<1, 3> &translation,
      const dealii::Tensor<1, 3> &rotation, const dealii::Point<3> &center,
      const double radius)
  {
    constexpr double none = 1e-6;
    const double distance = translation.norm(), angle = rotation.norm();
    const bool turns = radius * angle > none * distance;
    std::ostringstream text;
    text.precision(3);
    if (distance > none * radius * angle)
      text << "moved by " << distance << " along "
           << triple_in_words(translation / distance, dim, 1.)
           << (turns ? " and " : "");
    else if (!turns)
      text << "not moved";
    if (turns)
      text << "rotated by " << (dim == 2 ? rotation[2] : angle)
           << " rad about its centre "
           << triple_in_words(dealii::Tensor<1, 3>(center), dim, radius);
    if (turns && dim == 3)
      text << " along " << triple_in_words(rotation / angle, dim, 1.);
    return text.str();
  }
} // namespace abut::solve

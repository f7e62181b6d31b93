// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SHORT_TEXT_H
#define ABUT_SHIM_SHORT_TEXT_H

#include <abut/dealii/solver_words.h>

#include <deal.II/base/tensor.h>

#include <string>

namespace abut::shim
{
  /** A part of 1 in a message. */
  inline std::string percent(const double part)
  {
    return three_digits(100. * part) + " %";
  }

  template <int dim> std::string numbers(const dealii::Tensor<1, dim> &vector)
  {
    std::string text = "(" + three_digits(vector[0]);
    for (unsigned int d = 1; d < dim; ++d)
      text += ", " + three_digits(vector[d]);
    return text + ")";
  }
} // namespace abut::shim

#endif

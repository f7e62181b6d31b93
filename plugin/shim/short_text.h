// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SHORT_TEXT_H
#define ABUT_SHIM_SHORT_TEXT_H

#include <deal.II/base/tensor.h>

#include <sstream>
#include <string>

namespace abut::shim
{
  /** A number in a message, with three digits. */
  inline std::string number(const double value)
  {
    std::ostringstream out;
    out.precision(3);
    out << value;
    return out.str();
  }

  /** A part of 1 in a message. */
  inline std::string percent(const double part)
  {
    return number(100. * part) + " %";
  }

  template <int dim> std::string numbers(const dealii::Tensor<1, dim> &vector)
  {
    std::string text = "(" + number(vector[0]);
    for (unsigned int d = 1; d < dim; ++d)
      text += ", " + number(vector[d]);
    return text + ")";
  }
} // namespace abut::shim

#endif

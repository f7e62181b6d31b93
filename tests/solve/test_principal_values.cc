// SPDX-License-Identifier: LGPL-2.1-or-later
// Principal values of tensors that are made of them, and turned: as exact where
// they are nearly the same as where they are far apart, and numbers always.
#include "shim/principal_values.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace
{
  dealii::SymmetricTensor<2, 2> turned(const double first, const double second,
                                       const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    dealii::SymmetricTensor<2, 2> result;
    result[0][0] = first * c * c + second * s * s;
    result[1][1] = first * s * s + second * c * c;
    result[0][1] = (first - second) * c * s;
    return result;
  }
} // namespace

int
main()
{
  constexpr double round_off = 1e-15;
  unsigned int n = 0, n_wrong = 0;
  for (const double scale : {1e-150, 1., 1e100})
    for (double apart = 1.; apart > 1e-18; apart /= 3.)
      for (double angle = 0.; angle < 3.2; angle += 0.01, ++n)
      {
        const auto values = abut::shim::principal_values(
            turned(scale * (1. + apart), scale, angle));
        const double error = std::max(std::abs(values[0] / scale - 1. - apart),
                                      std::abs(values[1] / scale - 1.));
        // Written so that NaN is wrong.
        n_wrong += error <= round_off ? 0 : 1;
      }
  const auto solid = abut::shim::principal_values(
      dealii::SymmetricTensor<2, 3>(dealii::unit_symmetric_tensor<3>()));
  for (const double value : solid)
    n_wrong += std::abs(value - 1.) <= round_off ? 0 : 1;
  std::cout << n_wrong << " of " << n << " tensors wrong" << std::endl;
  return n > 1000 && n_wrong == 0 ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PRINCIPAL_VALUES_H
#define ABUT_SHIM_PRINCIPAL_VALUES_H

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <cmath>

namespace abut::shim
{
  /** Principal values of a symmetric tensor, in falling order. In the plane
   * from its mean and its radius (Mohr's circle), a number whatever the tensor:
   * deal.II takes the root of a difference there, which round-off makes
   * negative where the two are nearly equal. */
  inline std::array<double, 2>
  principal_values(const dealii::SymmetricTensor<2, 2> &tensor)
  {
    const double mean = (tensor[0][0] + tensor[1][1]) / 2.;
    const double radius =
        std::hypot((tensor[0][0] - tensor[1][1]) / 2., tensor[0][1]);
    return {{mean + radius, mean - radius}};
  }

  inline std::array<double, 3>
  principal_values(const dealii::SymmetricTensor<2, 3> &tensor)
  {
    return dealii::eigenvalues(tensor);
  }
} // namespace abut::shim

#endif

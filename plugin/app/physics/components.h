// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PHYSICS_COMPONENTS_H
#define ABUT_APP_PHYSICS_COMPONENTS_H

#include <deal.II/base/tensor.h>

#include <vector>

namespace abut::app
{
  /** The components of a vector, for reports. */
  template <int dim>
  std::vector<double> components(const dealii::Tensor<1, dim> &vector)
  {
    return {&vector[0], &vector[0] + dim};
  }
} // namespace abut::app

#endif

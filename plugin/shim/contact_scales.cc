// SPDX-License-Identifier: LGPL-2.1-or-later
// Scales of pressures, gaps and residuals.
#include "contact_problem.h"

#include "deformation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    // The square of a smaller number underflows, and norms do not see it: it
    // counts as 0.
    constexpr double least_scale = 1e-150;
  } // namespace

  template <int dim>
  void shim::ContactProblem<dim>::set_scales(const solve::Stiffness &matrix,
                                             const la::Vector &residual)
  {
    // Internal forces at the start measure the load when the residual is
    // small because the start is good.
    la::Vector internal(residual);
    host.reference_or(matrix).vmult(internal, start_displacement);
    host.constraints().set_zero(internal);
    smallest_residual = method.options.final_linear_tolerance
                        * std::max(residual.l2_norm(), internal.l2_norm());

    double weight = 0.;
    for (int i = 0; i < coefficients.n_rows(); ++i)
      weight += coefficients.weights()[i];
    weight = MPI::sum(weight, communicator);
    const double load = std::max(residual.l1_norm(), internal.l1_norm());
    // The stiffness of a rotated body does not measure its displacement.
    present_load = moves() ? residual.l1_norm() : load;
    abut_strategy_options &options = method.options;
    options.pressure_scale =
        load > least_scale && weight > 0. ? load / weight : 1.;
    options.length_scale = length_scale();
    if (surfaces == nullptr || weight <= 0.)
      return;
    // Bodies without load are pressed by their overlap. Surfaces that touch
    // have no gaps, or such of round-off, which measure nothing: then it is
    // the indentation by the load, if that is more than round-off.
    const double soft = softness();
    const double least =
        std::numeric_limits<double>::epsilon() * unmeasured_length();
    const double length =
        std::max(measured_length(), options.pressure_scale * soft);
    if (load <= least_scale)
      options.pressure_scale = options.length_scale / soft;
    else if (given_length == 0. && start_displacement.linfty_norm() == 0.
             && length > least)
      options.length_scale = length;
  }

  template <int dim> double shim::ContactProblem<dim>::softness() const
  {
    double sums[2] = {0., 0.};
    for (int i = 0; i < coefficients.n_rows(); ++i)
    {
      sums[0] += coefficients.weights()[i];
      sums[1] += coefficients.weights()[i] * stiffness[i];
    }
    MPI::sum(sums, communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }

  template <int dim>
  double
  shim::ContactProblem<dim>::length_scale(const la::Vector &displacement) const
  {
    if (given_length > 0.)
      return given_length;
    if (surfaces == nullptr)
      return displacement.linfty_norm();
    return std::min(shim::largest_displacement(near_null_space(), displacement,
                                               communicator),
                    surfaces->set().facet_size());
  }

  template <int dim> double shim::ContactProblem<dim>::length_scale() const
  {
    const double length = measured_length();
    return length > 0. ? length : unmeasured_length();
  }

  template <int dim> double shim::ContactProblem<dim>::unmeasured_length() const
  {
    const double facet =
        surfaces == nullptr ? 0. : surfaces->set().facet_size();
    return facet > 0. ? facet : 1.; // any: there is no row, or none has a gap
  }

  template <int dim> double shim::ContactProblem<dim>::measured_length() const
  {
    const double way = length_scale(start_displacement);
    if (way > least_scale)
      return way;
    // The harmonic mean of the gaps: parts of an obstacle that are out of
    // reach do not count.
    double sums[2] = {0., 0.};
    for (int i = 0; i < coefficients.n_rows(); ++i)
      if (gap[i] != 0.)
      {
        sums[0] += coefficients.weights()[i];
        sums[1] += coefficients.weights()[i] / std::abs(gap[i]);
      }
    MPI::sum(sums, communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }

  template <int dim>
  double
  shim::ContactProblem<dim>::deformation(const la::Vector &displacement) const
  {
    return surfaces == nullptr ? displacement.linfty_norm()
                               : shim::deformation(near_null_space(),
                                                   displacement, communicator);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void shim::ContactProblem<dim>::set_scales(                         \
      const solve::Stiffness &, const la::Vector &);                           \
  template double shim::ContactProblem<dim>::deformation(const la::Vector &)   \
      const;                                                                   \
  template double shim::ContactProblem<dim>::softness() const;                 \
  template double shim::ContactProblem<dim>::length_scale(const la::Vector &)  \
      const;                                                                   \
  template double shim::ContactProblem<dim>::length_scale() const;             \
  template double shim::ContactProblem<dim>::unmeasured_length() const;        \
  template double shim::ContactProblem<dim>::measured_length() const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut

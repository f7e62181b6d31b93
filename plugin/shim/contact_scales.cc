// SPDX-License-Identifier: LGPL-2.1-or-later
// Scales of pressures, gaps and residuals.
#include "contact_problem.h"

#include "deformation.h"
#include "solve/row_stiffness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    // The square of a smaller number underflows, and norms do not see it: it
    // counts as 0.
    constexpr double least_scale = 1e-150;
  } // namespace

  template <int dim>
  void ContactScales<dim>::set(const solve::Stiffness &matrix,
                               const la::Vector &residual)
  {
    // Internal forces at the start measure the load when the residual is
    // small because the start is good.
    la::Vector internal(residual);
    i.host.reference_or(matrix).vmult(internal, i.start_displacement);
    i.host.constraints().set_zero(internal);
    smallest_residual = i.input.method.options.final_linear_tolerance
                        * std::max(residual.l2_norm(), internal.l2_norm());

    double weight = 0.;
    for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
      weight += i.rows.coefficients.weights()[row];
    weight = MPI::sum(weight, i.communicator);
    const double load = std::max(residual.l1_norm(), internal.l1_norm());
    // The stiffness of a rotated body does not measure its displacement.
    present_load = i.moves() ? residual.l1_norm() : load;
    abut_strategy_options &options = i.input.method.options;
    options.pressure_scale =
        load > least_scale && weight > 0. ? load / weight : 1.;
    options.length_scale = length_scale();
    if (i.surfaces == nullptr || weight <= 0.)
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
    else if (given_length == 0. && i.start_displacement.linfty_norm() == 0.
             && length > least)
      options.length_scale = length;
  }

  template <int dim> double ContactScales<dim>::softness() const
  {
    double sums[2] = {0., 0.};
    for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
    {
      sums[0] += i.rows.coefficients.weights()[row];
      sums[1] += i.rows.coefficients.weights()[row] * stiffness[row];
    }
    MPI::sum(sums, i.communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }

  template <int dim>
  double ContactScales<dim>::length_scale(const la::Vector &displacement) const
  {
    if (given_length > 0.)
      return given_length;
    if (i.surfaces == nullptr)
      return displacement.linfty_norm();
    return std::min(
        largest_displacement(i.near_null_space(), displacement, i.communicator),
        i.surfaces->set().facet_size());
  }

  template <int dim> double ContactScales<dim>::length_scale() const
  {
    const double length = measured_length();
    return length > 0. ? length : unmeasured_length();
  }

  template <int dim> double ContactScales<dim>::unmeasured_length() const
  {
    const double facet =
        i.surfaces == nullptr ? 0. : i.surfaces->set().facet_size();
    return facet > 0. ? facet : 1.; // any: there is no row, or none has a gap
  }

  template <int dim> double ContactScales<dim>::measured_length() const
  {
    const double way = length_scale(i.start_displacement);
    if (way > least_scale)
      return way;
    // The harmonic mean of the gaps: parts of an obstacle that are out of
    // reach do not count, nor those of surfaces that touch but for round-off.
    constexpr double round_off = 1e-10;
    const double least =
        i.surfaces == nullptr ? 0. : round_off * unmeasured_length();
    double sums[2] = {0., 0.};
    for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
      if (std::abs(i.rows.gap[row]) > least)
      {
        sums[0] += i.rows.coefficients.weights()[row];
        sums[1] +=
            i.rows.coefficients.weights()[row] / std::abs(i.rows.gap[row]);
      }
    MPI::sum(sums, i.communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }

  template <int dim>
  double ContactScales<dim>::deformation(const la::Vector &displacement) const
  {
    return i.surfaces == nullptr
               ? displacement.linfty_norm()
               : shim::deformation(i.near_null_space(), displacement,
                                   i.communicator);
  }

  template <int dim> double ContactScales<dim>::round_off() const
  {
    constexpr double digits = 1e-13;
    if (law_compliance.size() == 0)
      return 0.;
    la::Vector force(i.present_displacement);
    i.host.constraints().set_zero(force);
    for (int k = 0; k < la::n_owned(force); ++k)
      la::data(force)[k] /= la::data(law_compliance)[k];
    return digits * force.l2_norm();
  }

  template <int dim>
  void ContactScales<dim>::find_compliance(const solve::Stiffness &matrix)
  {
    la::Vector compliance = solve::compliance(matrix);
    row_stiffness = solve::row_stiffness(compliance, i.rows.coefficients);
    if (law_compliance.size() == 0)
    {
      if (i.host.reference())
        compliance = solve::compliance(*i.host.reference());
      law_compliance.swap(compliance);
      if (i.moves()) // directions turn, and the law must not
        i.surfaces->fields().make_isotropic(law_compliance);
    }
  }

  template class ContactScales<2>;
  template class ContactScales<3>;
} // namespace abut::shim

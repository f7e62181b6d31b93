// SPDX-License-Identifier: LGPL-2.1-or-later
// What a contact solve found, as numbers and as nodal fields.
#include "contact_implementation.h"

#include <cmath>

namespace abut
{
  namespace MPI = dealii::Utilities::MPI;

  template <int dim> double ContactAssembler<dim>::contact_force() const
  {
    const Implementation &i = *implementation;
    double force = 0.;
    for (int row = 0; row < i.view.n_rows; ++row)
      force += i.view.weight[row] * i.row_pressure(row)
               * i.view.coefficient[i.view.row_start[row]];
    return MPI::sum(force, i.communicator);
  }

  template <int dim> double ContactAssembler<dim>::complementarity() const
  {
    const Implementation &i = *implementation;
    double sums[2] = {0., 0.};
    for (int row = 0; row < i.view.n_rows; ++row)
    {
      const double p = i.row_pressure(row);
      sums[0] += i.view.weight[row] * std::abs(p * i.gap[row]);
      sums[1] += i.view.weight[row] * std::abs(p);
    }
    MPI::sum(sums, i.communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }

  template <int dim> double ContactAssembler<dim>::penetration() const
  {
    double largest = 0.;
    for (const double g : implementation->gap)
      largest = std::max(largest, -g);
    return MPI::max(largest, implementation->communicator);
  }

  template <int dim> la::Vector ContactAssembler<dim>::pressure() const
  {
    const Implementation &i = *implementation;
    return i.source->pressure(i.row_pressures().data());
  }

  template <int dim> la::Vector ContactAssembler<dim>::gap() const
  {
    const Implementation &i = *implementation;
    return i.source->gap(i.gap.data());
  }

  template <int dim> la::Vector ContactAssembler<dim>::status() const
  {
    const Implementation &i = *implementation;
    return i.source->status(i.is_started ? i.request.state : nullptr);
  }

  template double ContactAssembler<2>::contact_force() const;
  template double ContactAssembler<2>::complementarity() const;
  template double ContactAssembler<2>::penetration() const;
  template la::Vector ContactAssembler<2>::pressure() const;
  template la::Vector ContactAssembler<2>::gap() const;
  template la::Vector ContactAssembler<2>::status() const;
  template double ContactAssembler<3>::contact_force() const;
  template double ContactAssembler<3>::complementarity() const;
  template double ContactAssembler<3>::penetration() const;
  template la::Vector ContactAssembler<3>::pressure() const;
  template la::Vector ContactAssembler<3>::gap() const;
  template la::Vector ContactAssembler<3>::status() const;
} // namespace abut

// SPDX-License-Identifier: LGPL-2.1-or-later
// What a motion is measured by: energies, works, momenta, and the limit of
// explicit steps.
#include "body_motion.h"

#include "nodal_places.h"
#include "shim/values_by_element.h"
#include "time_status.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe_values.h>

#include <limits>

namespace abut::app
{
  namespace
  {
    /** A component of the velocity at a place of what turns about an axis of
     * the origin, once in 2 pi of time. */
    template <int dim>
    double turned(const dealii::Point<dim> &place, const unsigned int axis,
                  const unsigned int component)
    {
      const unsigned int next = (axis + 1) % 3, last = (axis + 2) % 3;
      return component == next   ? -place[last]
             : component == last ? place[next]
                                 : 0.;
    }
  } // namespace

  template <int dim>
  std::vector<la::Vector>
  BodyMotion<dim>::turns_at(const la::Vector *displacement) const
  {
    const auto &owned = problem_.dof_handler.locally_owned_dofs();
    const auto places_of = shim::cell_values(
        problem_.mapping, problem_.dof_handler, shim::nodes<dim>,
        dealii::update_quadrature_points, shim::ValuesOf::component);
    const shim::ByElement unknowns_of(problem_.dof_handler, nodal_places<dim>);
    std::vector<la::Vector> result(dim == 2 ? 1 : 3, problem_.vector());
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : problem_.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const dealii::FiniteElement<dim> &fe = cell->get_fe();
      dealii::FEValues<dim> &places = places_of.of(cell);
      const NodalPlaces<dim> &unknowns = unknowns_of.of(cell);
      places.reinit(
          static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
              cell));
      shim::get_dofs(cell, dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (!owned.is_element(dofs[i]))
          continue;
        const auto k = owned.index_within_set(dofs[i]);
        const auto [component, node] = fe.system_to_component_index(i);
        dealii::Point<dim> place = places.quadrature_point(node);
        for (unsigned int d = 0; displacement != nullptr && d < dim; ++d)
          place[d] += (*displacement)(dofs[unknowns(d, node)]);
        for (unsigned int r = 0; r < result.size(); ++r)
          la::data(result[r])[k] = turned(place, dim == 2 ? 2 : r, component);
      }
    }
    return result;
  }

  template <int dim> void BodyMotion<dim>::find_rigid_motions()
  {
    const unsigned int n_components = problem_.n_components();
    std::vector<la::Vector> motions(n_components, problem_.vector());
    std::vector<dealii::types::global_dof_index> dofs;
    const auto &owned = problem_.dof_handler.locally_owned_dofs();
    for (const auto &cell : problem_.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      shim::get_dofs(cell, dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (owned.is_element(dofs[i]))
          la::data(motions[cell->get_fe().system_to_component_index(i).first])
              [owned.index_within_set(dofs[i])] = 1.;
    }
    const auto times_mass = [this](const std::vector<la::Vector> &given)
    {
      std::vector<la::Vector> result(given.size(), problem_.vector());
      for (std::size_t m = 0; m < given.size(); ++m)
        mass_->vmult(result[m], given[m]);
      return result;
    };
    mass_of_component_ = times_mass(motions);
    mass_of_rotation_.clear();
    if (has_rotations() && problem_.is_linear())
      mass_of_rotation_ = times_mass(turns_at(nullptr));
  }

  template <int dim>
  double BodyMotion<dim>::damping_energy(const la::Vector &way) const
  {
    double result = 0.;
    la::Vector product = problem_.vector();
    if (settings_.mass_damping > 0.)
    {
      mass_->vmult(product, way);
      result += settings_.mass_damping * (product * way);
    }
    if (settings_.stiffness_damping > 0.)
    {
      la::Vector free(way);
      problem_.hanging.set_zero(free);
      result +=
          settings_.stiffness_damping * (problem_.stiffness_times(way) * free);
    }
    return result / dt_;
  }

  template <int dim>
  double BodyMotion<dim>::energy_not_kept(const double dt,
                                          const la::Vector &acceleration) const
  {
    if (!is_explicit())
      return 0.;
    const la::Vector free = without_prescribed(acceleration);
    la::Vector product = problem_.vector();
    mass_->vmult(product, free);
    return dt * dt / 8. * (product * free);
  }

  template <int dim> void BodyMotion<dim>::measure_works()
  {
    la::Vector way(next_displacement_);
    way -= displacement_;
    problem_.hanging.set_zero(way);
    la::Vector force(load_);
    force += problem_.external;
    force *= 0.5;
    // Prescribed unknowns are moved by what holds them and by their loads.
    const double now = part_of_end(settings_.scheme);
    la::Vector held(next_held_);
    held *= now;
    held.add(1. - now, held_);
    held -= without_prescribed(held);
    force += held;
    record_.energy.dissipated = dissipated_ + damping_energy(way);
    record_.energy.external_work = work_ + force * way;
  }

  template <int dim>
  BodyMotionRecord BodyMotion<dim>::measure(const la::Vector &u,
                                            const la::Vector &v) const
  {
    BodyMotionRecord result;
    la::Vector product = problem_.vector();
    mass_->vmult(product, v);
    result.energy.kinetic = 0.5 * (product * v);
    result.energy.strain = problem_.stored_energy(u);
    for (const la::Vector &mass : mass_of_component_)
      result.momentum.push_back(mass * v);
    for (const la::Vector &mass : mass_of_rotation_)
      result.angular_momentum.push_back(mass * v);
    if (!has_rotations() || problem_.is_linear())
      return result;
    const la::Vector place = problem_.ghosted_field(u);
    for (const la::Vector &turn : turns_at(&place))
      result.angular_momentum.push_back(turn * product);
    return result;
  }

  template <int dim> std::vector<double> BodyMotion<dim>::total_mass() const
  {
    std::vector<double> result;
    for (const la::Vector &mass : mass_of_component_)
      result.push_back(mass.mean_value() * double(mass.size()));
    return result;
  }

  template <int dim> double BodyMotion<dim>::cancelling_forces() const
  {
    la::Vector product = problem_.vector();
    mass_->vmult(product, velocity_);
    la::Vector held(displacement_);
    const std::vector<double> diagonal =
        la::diagonal(la::local_rows(problem_.stiffness));
    for (std::size_t i = 0; i < diagonal.size(); ++i)
      la::data(held)[i] *= diagonal[i];
    problem_.constraints.set_zero(held);
    const double stopping = dt_ > 0. ? product.l2_norm() / dt_ : 0.;
    return stopping + held.l2_norm();
  }

  template <int dim> double BodyMotion<dim>::stable_step() const
  {
    if (!is_explicit())
      return std::numeric_limits<double>::infinity();
    const std::vector<double> mass = la::diagonal(la::local_rows(*free_mass_));
    const auto n = static_cast<std::int64_t>(mass.size());
    const auto &owned = problem_.dof_handler.locally_owned_dofs();
    const auto first =
        n > 0 ? static_cast<std::int64_t>(owned.nth_index_in_set(0)) : 0;
    la::Vector x = problem_.vector(), y = problem_.vector();
    abut_time_limit limit;
    check_motion(abut_time_limit_begin(&limit, first, n, la::data(x)));
    problem_.constraints.set_zero(x);
    while (limit.goes_on != 0)
    {
      double sums[2];
      problem_.stiffness.vmult(y, x);
      check_motion(
          abut_time_limit_sums(n, mass.data(), la::data(x), la::data(y), sums));
      dealii::Utilities::MPI::sum(
          sums, versions::communicator(problem_.dof_handler), sums);
      check_motion(abut_time_limit_next(&limit, sums, n, mass.data(),
                                        la::data(y), la::data(x)));
    }
    return limit.step;
  }

  template std::vector<la::Vector>
  BodyMotion<2>::turns_at(const la::Vector *) const;
  template void BodyMotion<2>::find_rigid_motions();
  template double BodyMotion<2>::damping_energy(const la::Vector &) const;
  template double BodyMotion<2>::energy_not_kept(double,
                                                 const la::Vector &) const;
  template void BodyMotion<2>::measure_works();
  template BodyMotionRecord BodyMotion<2>::measure(const la::Vector &,
                                                   const la::Vector &) const;
  template std::vector<double> BodyMotion<2>::total_mass() const;
  template double BodyMotion<2>::cancelling_forces() const;
  template double BodyMotion<2>::stable_step() const;
  template std::vector<la::Vector>
  BodyMotion<3>::turns_at(const la::Vector *) const;
  template void BodyMotion<3>::find_rigid_motions();
  template double BodyMotion<3>::damping_energy(const la::Vector &) const;
  template double BodyMotion<3>::energy_not_kept(double,
                                                 const la::Vector &) const;
  template void BodyMotion<3>::measure_works();
  template BodyMotionRecord BodyMotion<3>::measure(const la::Vector &,
                                                   const la::Vector &) const;
  template std::vector<double> BodyMotion<3>::total_mass() const;
  template double BodyMotion<3>::cancelling_forces() const;
  template double BodyMotion<3>::stable_step() const;
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "moving_model.h"

#include "app/restart/archive.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace abut::app
{
  template <int dim> la::Vector MovingModel<dim>::last_place() const
  {
    return motion ? motion->bodies().displacement()
                  : ContactModel<dim>::last_place();
  }

  template <int dim> la::Vector MovingModel<dim>::first_increment() const
  {
    if (!motion)
      return ContactModel<dim>::first_increment();
    la::Vector result = motion->bodies().velocity();
    result *= motion->step_length();
    return result;
  }

  template <int dim> la::Vector MovingModel<dim>::start()
  {
    if (!motion)
      return ContactModel<dim>::start();
    const la::Vector velocity = velocity_of_supports();
    this->assemble();
    return motion->start(initial_motion(), velocity, initial_rigid_energy());
  }

  /* By the parabola through the displacements at 0 and within a small part of
   * the first step: before 0 formulas may have no values. */
  template <int dim> la::Vector MovingModel<dim>::velocity_of_supports()
  {
    constexpr double part = 0.01;
    const double dt = part * motion->step_length();
    la::Vector result = this->problem().vector();
    const std::vector<std::pair<double, double>> samples = {
        {dt, -1.}, {0.5 * dt, 4.}, {0., -3.}};
    for (const auto &[time, factor] : samples)
    {
      this->set_time(time);
      la::Vector displacement = this->problem().vector();
      this->problem().constraints.distribute(displacement);
      result.add(factor / dt, displacement);
    }
    return result;
  }

  template <int dim> bool MovingModel<dim>::begin_start(la::Vector &u)
  {
    return motion && motion->begin_start(has_friction(), u);
  }

  template <int dim> void MovingModel<dim>::end_start(la::Vector &u)
  {
    motion->end_start(u, contact_actions());
    u = motion->bodies().displacement();
  }

  template <int dim> bool MovingModel<dim>::begin_solve(la::Vector &u)
  {
    return motion && motion->begin_step(u);
  }

  template <int dim>
  void MovingModel<dim>::residual(const la::Vector &u, la::Vector &result) const
  {
    if (motion)
      motion->bodies().residual(u, result);
    else
      ContactModel<dim>::residual(u, result);
  }

  template <int dim> double MovingModel<dim>::small_force() const
  {
    const double of_loads = ContactModel<dim>::small_force();
    // Contact forces that are round-off of others say nothing of the balance.
    return motion
               ? std::max(of_loads, 1e-6 * motion->bodies().cancelling_forces())
               : of_loads;
  }

  template <int dim>
  const la::Matrix &MovingModel<dim>::tangent(const la::Vector &u)
  {
    return motion ? motion->tangent(u) : ContactModel<dim>::tangent(u);
  }

  template <int dim> bool MovingModel<dim>::next_solve(const la::Vector &u)
  {
    return motion && motion->next_problem(u, contact_actions());
  }

  template <int dim> void MovingModel<dim>::end_solve()
  {
    if (motion)
      motion->end_step();
  }

  template <int dim> Message MovingModel<dim>::commit()
  {
    return motion ? motion->commit() : Message();
  }

  template <int dim> bool MovingModel<dim>::is_usable() const
  {
    return !motion || motion->keeps_energy();
  }

  template <int dim> double MovingModel<dim>::energy(const la::Vector &u) const
  {
    return motion ? motion->energy() : ContactModel<dim>::energy(u);
  }

  template <int dim>
  void MovingModel<dim>::prepare_contact(ContactAssembler<dim> &contact)
  {
    // Penalties and loads are measured by the stiffness, without inertia.
    if (motion)
      contact.set_reference_stiffness(reference_stiffness());
  }

  template <int dim>
  void MovingModel<dim>::renew_tangent(ContactAssembler<dim> &contact)
  {
    if (motion && motion->has_new_tangent())
      prepare_contact(contact);
  }

  template <int dim> std::vector<la::Vector> MovingModel<dim>::history() const
  {
    return motion ? motion->bodies().fields() : std::vector<la::Vector>();
  }

  template <int dim> unsigned int MovingModel<dim>::n_history() const
  {
    return motion ? BodyMotion<dim>::n_fields : 0;
  }

  template <int dim>
  void MovingModel<dim>::resume(std::vector<la::Vector> fields)
  {
    if (!motion)
      return;
    this->set_time(run.load_steps.time());
    this->assemble();
    motion->resume(std::move(fields));
  }

  template <int dim> std::string MovingModel<dim>::motion_state() const
  {
    return motion ? to_bytes(*motion) : std::string();
  }

  template <int dim>
  void MovingModel<dim>::load_motion(const std::string &bytes)
  {
    if (motion)
      from_bytes(bytes, *motion);
  }

  template class MovingModel<2>;
  template class MovingModel<3>;
} // namespace abut::app

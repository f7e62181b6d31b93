// SPDX-License-Identifier: LGPL-2.1-or-later
#include "body_motion.h"

#include "time_status.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Steps that differ by less than this part are of one length. */
    constexpr double same_length = 1e-9;

    /** M on the unknowns with mass, the identity on the others. */
    struct MassOperator
    {
      const la::Matrix &mass;
      const std::vector<std::uint8_t> &without;

      void vmult(la::Vector &dst, const la::Vector &src) const
      {
        mass.vmult(dst, src);
        double *out = la::data(dst);
        const double *in = la::data(src);
        for (std::size_t i = 0; i < without.size(); ++i)
          out[i] = without[i] ? in[i] : out[i];
      }
    };

    /** Constrained unknowns have a diagonal that nothing comes of, as that of
     * the stiffness. */
    template <int dim>
    void hold_constrained(const DiscreteProblem<dim> &problem,
                          la::Matrix &matrix)
    {
      const la::LocalRows rows = la::local_rows(matrix);
      const auto &owned = problem.dof_handler.locally_owned_dofs();
      const std::vector<double> own =
          la::diagonal(la::local_rows(problem.stiffness));
      for (int i = 0; i < rows.n_rows; ++i)
        for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
          if (rows.column[k] == i
              && problem.constraints.is_constrained(owned.nth_index_in_set(i)))
            rows.value[k] = own[i];
    }

    /** The inverse of its diagonal. */
    struct DiagonalInverse
    {
      std::vector<double> factor;

      void vmult(la::Vector &dst, const la::Vector &src) const
      {
        double *out = la::data(dst);
        const double *in = la::data(src);
        for (std::size_t i = 0; i < factor.size(); ++i)
          out[i] = factor[i] * in[i];
      }
    };
  } // namespace

  double part_of_end(const abut_time_scheme &scheme)
  {
    // Midpoint rules have the forces of the step alone.
    return scheme.projects != 0 ? 1. : scheme.gamma;
  }

  template <int dim>
  BodyMotion<dim>::BodyMotion(DiscreteProblem<dim> &problem,
                              const Settings &settings)
      : problem_(problem), settings_(settings)
  {
  }

  template <int dim> void BodyMotion<dim>::setup(const MassData<dim> &data)
  {
    mass_ = std::make_unique<la::Matrix>(mass_matrix(problem_, data));
    free_mass_ = std::make_unique<la::Matrix>(free_part(problem_, *mass_));
    touches_with_mass_ = data.kind != ABUT_TIME_MASS_MODIFIED;
    tangent_.clear();
    projection_.clear();
    dt_ = 0.;
    mark_massless();
    find_rigid_motions();
  }

  template <int dim> void BodyMotion<dim>::mark_massless()
  {
    const la::LocalRows rows = la::local_rows(*mass_);
    massless_.assign(rows.n_rows, 1);
    for (int i = 0; i < rows.n_rows; ++i)
      for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (rows.column[k] == i && rows.value[k] > 0.)
          massless_[i] = 0;
  }

  template <int dim>
  abut_time_state BodyMotion<dim>::state(la::Vector &u, la::Vector &v,
                                         la::Vector &a) const
  {
    return {sizeof(abut_time_state),
            &settings_.scheme,
            dt_,
            la::n_owned(u),
            la::data(u),
            la::data(v),
            la::data(a),
            massless_.data()};
  }

  template <int dim> void BodyMotion<dim>::set_forces_before()
  {
    load_ = problem_.external;
  }

  template <int dim>
  la::Vector BodyMotion<dim>::resistance(const la::Vector &u) const
  {
    la::Vector moved = velocity_;
    moved *= settings_.stiffness_damping;
    moved += u;
    la::Vector force = problem_.internal_forces(moved);
    la::Vector product = problem_.vector();
    mass_->vmult(product, velocity_);
    force.add(settings_.mass_damping, product);
    force -= load_;
    return force;
  }

  template <int dim>
  void BodyMotion<dim>::find_acceleration(const la::Vector &u,
                                          const la::Vector &contact)
  {
    held_ = resistance(u);
    la::Vector right(contact);
    right -= held_;
    problem_.constraints.set_zero(right);
    std::vector<std::uint8_t> without = massless_;
    const auto &owned = problem_.dof_handler.locally_owned_dofs();
    for (std::size_t i = 0; i < without.size(); ++i)
    {
      if (problem_.constraints.is_constrained(owned.nth_index_in_set(i)))
        without[i] = 1;
      if (without[i])
        la::data(right)[i] = 0.;
    }
    acceleration_ = problem_.vector();
    const double size = right.l2_norm();
    if (size == 0.)
      return;
    DiagonalInverse jacobi{la::diagonal(la::local_rows(*mass_))};
    for (std::size_t i = 0; i < without.size(); ++i)
      jacobi.factor[i] = without[i] ? 1. : 1. / jacobi.factor[i];
    dealii::SolverControl control(1000, 1e-14 * size);
    dealii::SolverCG<la::Vector> solver(control);
    solver.solve(MassOperator{*free_mass_, without}, acceleration_, right,
                 jacobi);
    la::Vector inertia = problem_.vector();
    mass_->vmult(inertia, acceleration_);
    held_ += inertia;
  }

  template <int dim>
  bool BodyMotion<dim>::begin_start(const double dt, const bool has_friction,
                                    la::Vector &u)
  {
    const abut_time_scheme &scheme = settings_.scheme;
    if (scheme.projects != 0 || scheme.contact_in_step == 0
        || abut_time_needs_acceleration(&scheme) == 0
        || !(touches_with_mass_ || has_friction))
      return false;
    if (touches_with_mass_)
      scale_mass(1. / (dt * dt), projection_);
    else
    {
      problem_.tangent(displacement_);
      projection_.reinit(problem_.stiffness);
      projection_ = 0.;
      projection_.add(1., problem_.stiffness);
      projection_.add(1. / (dt * dt), *free_mass_);
    }
    stage_ = ABUT_TIME_PROJECTION;
    u = displacement_;
    base_ = u;
    base_residual_ = without_prescribed(resistance(u));
    return true;
  }

  template <int dim>
  void BodyMotion<dim>::end_start(const la::Vector &u,
                                  const la::Vector &contact,
                                  const la::Vector &on_supports)
  {
    find_acceleration(touches_with_mass_ ? displacement_ : u, contact);
    held_ -= on_supports;
    stage_ = ABUT_TIME_STEP;
    projection_.clear();
  }

  template <int dim>
  void BodyMotion<dim>::start(const la::Vector &displacement,
                              const la::Vector &velocity)
  {
    displacement_ = displacement;
    velocity_ = velocity;
    set_forces_before();
    find_acceleration(displacement_, problem_.vector());
    next_velocity_ = velocity_;
    dissipated_ = work_ = 0.;
    record_ = measure(displacement_, velocity_);
  }

  template <int dim>
  void BodyMotion<dim>::resume(const la::Vector &displacement,
                               std::vector<la::Vector> fields)
  {
    displacement_ = displacement;
    velocity_ = fields[0];
    acceleration_ = fields[1];
    held_ = fields[2];
    next_velocity_ = velocity_;
    set_forces_before();
  }

  template <int dim>
  void BodyMotion<dim>::scale_mass(const double factor,
                                   la::Matrix &matrix) const
  {
    la::copy(*free_mass_, matrix);
    matrix *= factor;
    hold_constrained(problem_, matrix);
  }

  template <int dim>
  void BodyMotion<dim>::make_tangent(const abut_time_stage stage,
                                     la::Matrix &matrix) const
  {
    abut_time_weights weights;
    check_motion(abut_time_weigh(&settings_.scheme, dt_, stage, &weights));
    const double mass = weights.mass + settings_.mass_damping * weights.damping;
    const double stiffness =
        weights.stiffness + settings_.stiffness_damping * weights.damping;
    // Without stiffness its couplings would only fill the solver's factors.
    if (stiffness == 0.)
    {
      scale_mass(mass, matrix);
      return;
    }
    if (matrix.m() == 0)
      matrix.reinit(problem_.stiffness);
    matrix = 0.;
    matrix.add(stiffness, problem_.stiffness);
    matrix.add(mass, *free_mass_);
  }

  template <int dim> void BodyMotion<dim>::make_tangents()
  {
    if (settings_.scheme.projects != 0)
      make_tangent(ABUT_TIME_PROJECTION, projection_);
    if (has_constant_tangent() && !is_explicit())
      make_tangent(ABUT_TIME_STEP, tangent_);
  }

  template <int dim>
  const la::Matrix &BodyMotion<dim>::tangent(const la::Vector &u)
  {
    if (stage_ == ABUT_TIME_PROJECTION)
      return projection_;
    if (!has_constant_tangent())
    {
      problem_.tangent(elastic_place(u));
      make_tangent(ABUT_TIME_STEP, tangent_);
    }
    return tangent_;
  }

  template <int dim>
  bool BodyMotion<dim>::begin_step(const double dt, la::Vector &u)
  {
    const bool is_new = std::abs(dt - dt_) > same_length * dt;
    if (is_new)
    {
      dt_ = dt;
      make_tangents();
    }
    const bool projects = settings_.scheme.projects != 0;
    stage_ = projects ? ABUT_TIME_PROJECTION : ABUT_TIME_STEP;
    step_velocity_ = velocity_;
    projection_force_ = problem_.vector();
    predicted_ = displacement_;
    const abut_time_state from =
        state(displacement_, step_velocity_, acceleration_);
    check_motion(abut_time_begin(&from, la::data(predicted_)));
    u = predicted_;
    if (has_constant_tangent())
      problem_.constraints.distribute(u);
    else
    {
      take_prescribed(displacement_, u);
      problem_.hanging.distribute(u);
    }
    begin_problem(u);
    return is_new || (projects && !is_explicit());
  }

  template <int dim> void BodyMotion<dim>::begin_problem(const la::Vector &u)
  {
    if (stage_ == ABUT_TIME_STEP && !has_constant_tangent())
      return;
    base_ = u;
    base_residual_ = full_residual(u);
    problem_.constraints.set_zero(base_residual_);
  }

  template <int dim> bool BodyMotion<dim>::next_problem(const la::Vector &u)
  {
    if (stage_ == ABUT_TIME_STEP)
      return false;
    projection_force_ = full_residual(u);
    const abut_time_state from =
        state(displacement_, step_velocity_, acceleration_);
    la::Vector projected(predicted_);
    projected += way_of_projection(u);
    check_motion(
        abut_time_project(&from, la::data(predicted_), la::data(projected)));
    if (is_explicit())
      return false;
    stage_ = ABUT_TIME_STEP;
    begin_problem(u);
    return true;
  }

  template <int dim>
  la::Vector BodyMotion<dim>::projection_residual(const la::Vector &u) const
  {
    abut_time_weights weights;
    check_motion(abut_time_weigh(&settings_.scheme, dt_, ABUT_TIME_PROJECTION,
                                 &weights));
    la::Vector result = problem_.vector();
    mass_->vmult(result, way_of_projection(u));
    result *= weights.mass;
    return result;
  }

  template <int dim>
  la::Vector BodyMotion<dim>::way_of_projection(const la::Vector &u) const
  {
    la::Vector way(u);
    way -= predicted_;
    if (is_explicit())
      return way;
    // What is prescribed moves in the step that follows: here it would push its
    // neighbours by its mass.
    take_prescribed(problem_.vector(), way);
    return way;
  }

  template <int dim>
  void BodyMotion<dim>::take_prescribed(const la::Vector &from,
                                        la::Vector &values) const
  {
    const auto &owned = problem_.dof_handler.locally_owned_dofs();
    for (int i = 0; i < la::n_owned(values); ++i)
    {
      const auto unknown = owned.nth_index_in_set(i);
      if (problem_.constraints.is_constrained(unknown)
          && !problem_.hanging.is_constrained(unknown))
        la::data(values)[i] = la::data(from)[i];
    }
  }

  template <int dim>
  la::Vector BodyMotion<dim>::elastic_place(const la::Vector &u) const
  {
    la::Vector result = problem_.vector();
    abut_time_arguments arguments = {sizeof(abut_time_arguments), nullptr,
                                     nullptr, la::data(result)};
    // The state is not changed.
    la::Vector before(displacement_), v(step_velocity_), a(acceleration_);
    const abut_time_state from = state(before, v, a);
    check_motion(abut_time_evaluate(&from, la::data(u), &arguments));
    return result;
  }

  template <int dim>
  la::Vector BodyMotion<dim>::step_residual(const la::Vector &unknown) const
  {
    la::Vector inertia = problem_.vector(), damping = problem_.vector(),
               elastic = problem_.vector(), product = problem_.vector();
    abut_time_arguments arguments = {sizeof(abut_time_arguments),
                                     la::data(inertia), la::data(damping),
                                     la::data(elastic)};
    // The state is not changed.
    la::Vector before(displacement_), v(step_velocity_), a(acceleration_);
    const abut_time_state from = state(before, v, a);
    check_motion(abut_time_evaluate(&from, la::data(unknown), &arguments));
    elastic.add(settings_.stiffness_damping, damping);
    inertia.add(settings_.mass_damping, damping);
    la::Vector result = problem_.internal_forces(elastic);
    mass_->vmult(product, inertia);
    result += product;
    abut_time_weights weights;
    check_motion(
        abut_time_weigh(&settings_.scheme, dt_, ABUT_TIME_STEP, &weights));
    result.add(-weights.load, problem_.external, -weights.load_before, load_);
    return result;
  }

  template <int dim>
  la::Vector BodyMotion<dim>::full_residual(const la::Vector &u) const
  {
    return stage_ == ABUT_TIME_STEP ? step_residual(u) : projection_residual(u);
  }

  template <int dim> la::Vector BodyMotion<dim>::explicit_acceleration() const
  {
    la::Vector result = step_residual(problem_.vector());
    problem_.constraints.set_zero(result);
    const std::vector<double> mass = la::diagonal(la::local_rows(*free_mass_));
    for (std::size_t i = 0; i < mass.size(); ++i)
      la::data(result)[i] = mass[i] > 0. ? -la::data(result)[i] / mass[i] : 0.;
    return result;
  }

  template <int dim>
  void BodyMotion<dim>::residual(const la::Vector &u, la::Vector &result) const
  {
    if (stage_ == ABUT_TIME_STEP && !has_constant_tangent())
      result = step_residual(u);
    else
    {
      la::Vector way(u);
      way -= base_;
      const bool steps = stage_ == ABUT_TIME_STEP;
      (steps ? tangent_ : projection_).vmult(result, way);
      result += base_residual_;
    }
    problem_.constraints.set_zero(result);
  }

  template <int dim>
  la::Vector BodyMotion<dim>::without_prescribed(const la::Vector &values) const
  {
    la::Vector result(values);
    problem_.constraints.set_zero(result);
    return result;
  }

  template <int dim>
  void BodyMotion<dim>::end_step(const la::Vector &u,
                                 const la::Vector &on_supports)
  {
    const la::Vector unknown = is_explicit() ? explicit_acceleration() : u;
    unbalanced_ = step_residual(unknown);
    unbalanced_ += projection_force_;
    next_held_ = unbalanced_;
    next_held_ -= on_supports;
    problem_.hanging.set_zero(next_held_);
    next_displacement_ = displacement_;
    next_velocity_ = step_velocity_;
    next_acceleration_ = acceleration_;
    const abut_time_state to =
        state(next_displacement_, next_velocity_, next_acceleration_);
    check_motion(abut_time_end(&to, la::data(unknown)));
    record_ = measure(next_displacement_, next_velocity_);
    record_.not_kept = energy_not_kept(dt_, next_acceleration_);
    measure_works();
  }

  template <int dim> void BodyMotion<dim>::commit()
  {
    displacement_ = next_displacement_;
    velocity_ = next_velocity_;
    acceleration_ = next_acceleration_;
    held_ = next_held_;
    load_ = problem_.external;
    dissipated_ = record_.energy.dissipated;
    work_ = record_.energy.external_work;
  }

  template class BodyMotion<2>;
  template class BodyMotion<3>;
} // namespace abut::app

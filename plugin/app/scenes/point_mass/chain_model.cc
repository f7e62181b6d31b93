// SPDX-License-Identifier: LGPL-2.1-or-later
#include "chain_model.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Scales of lengths and forces, from the data; 1 where there is nothing.
     */
    void set_scales(const Chain &chain, const std::vector<double> &stiffness,
                    const ChainLoad &load, abut_strategy_options &options)
    {
      double length = 0, force = 0;
      for (const double gap : chain.gap)
        length = std::max(length, std::abs(gap));
      for (std::size_t i = 0; i < load.force.size(); ++i)
      {
        const double k = stiffness[i * (load.force.size() + 1)];
        force = std::max(force, std::abs(load.force[i]));
        if (k > 0)
          length = std::max(length, std::abs(load.force[i]) / k);
      }
      options.length_scale = length > 0 ? length : 1.;
      options.pressure_scale = force > 0 ? force : 1.;
    }

    /** What a solve without an answer has seen. */
    Message explain(const abut_context *context, const abut_law *law,
                    const abut_status status, const abut_reason reason,
                    const abut_progress &progress)
    {
      if (status != ABUT_SUCCESS)
        return coded(ABUT_FAILURE_FLOATING_BODY, shim::core_message(context));
      const abut_failure failure = abut_reason_failure(reason, law, &progress);
      return coded(failure, failure == ABUT_FAILURE_STICK_SLIP
                                ? shim::core_message(context)
                                : abut_reason_text(reason));
    }
  } // namespace

  std::vector<double> Chain::stiffness() const
  {
    const std::size_t size = n_unknowns();
    std::vector<double> matrix(size * size, 0.);
    const auto add = [&](const std::size_t i, const std::size_t j,
                         const double k) { matrix[i * size + j] += k; };
    for (std::size_t i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dimension; ++d)
      {
        const std::size_t here = i * dimension + d, before = here - dimension;
        if (d == n_tangents())
        {
          add(here, here, normal_spring);
          continue;
        }
        add(here, here,
            (i == 0 ? end_spring : spring)
                + (i + 1 == n ? wall_spring : spring));
        if (i == 0)
          continue;
        add(here, before, -spring);
        add(before, here, -spring);
      }
    return matrix;
  }

  ChainSteps::ChainSteps(const Chain &chain_, const bool has_friction_)
      : chain(chain_),
        has_friction(has_friction_),
        stiffness(chain.stiffness()),
        context(shim::create_context()),
        history(shim::create_history(context.get())),
        last_progress()
  {
    const unsigned int dim = chain.dimension;
    committed.displacement.assign(chain.n_unknowns(), 0.);
    committed.pressure.assign(chain.n_unknowns(), 0.);
    committed.slip.assign(chain.n * chain.n_tangents(), 0.);
    // What is on the plane begins with stick.
    for (const double gap : chain.gap)
      committed.state.push_back(gap > 0 ? ABUT_STATE_OPEN : ABUT_STATE_CLOSED);
    for (std::size_t i = 0; i < chain.n_unknowns(); ++i)
      if (has_friction || i % dim == 0)
        id.push_back(static_cast<std::int64_t>(i));
    trial = committed;
    remember();
    shim::check(context.get(), abut_history_commit(history.get()));
  }

  shim::Handle<abut_points> ChainSteps::make_points() const
  {
    const unsigned int dim = chain.dimension;
    auto points =
        shim::create_points(context.get(), static_cast<std::int32_t>(dim));
    // Outwards of the mass is down; tangents are the axes along the plane.
    std::vector<double> frame(dim * dim, 0.);
    frame[dim - 1] = -1.;
    for (unsigned int t = 0; t + 1 < dim; ++t)
      frame[(t + 1) * dim + t] = 1.;
    for (std::size_t i = 0; i < chain.n; ++i)
    {
      std::vector<double> gap = {chain.gap[i]};
      for (unsigned int t = 0; t + 1 < dim; ++t)
        gap.push_back(-committed.displacement[i * dim + t]);
      const auto node = static_cast<std::int32_t>(i);
      const double one = 1.;
      abut_point point = abut_point_defaults();
      point.id = static_cast<std::int64_t>(i * dim);
      point.n_components = has_friction ? static_cast<std::int32_t>(dim) : 1;
      point.frame = frame.data();
      point.gap = gap.data();
      point.n_nodes = point.n_secondary = 1;
      point.node = &node;
      point.coefficient = &one;
      shim::check(context.get(), abut_points_append(points.get(), &point));
    }
    return points;
  }

  void ChainSteps::remember()
  {
    const std::size_t per_mass = id.size() / chain.n;
    std::vector<double> pressure;
    std::vector<std::uint8_t> state;
    for (std::size_t k = 0; k < id.size(); ++k)
    {
      pressure.push_back(trial.pressure[id[k]]);
      state.push_back(trial.state[k / per_mass]);
    }
    const abut_history_entries entries = {
        sizeof(entries), static_cast<std::int64_t>(id.size()),
        id.data(),       pressure.data(),
        state.data(),    nullptr};
    shim::check(context.get(), abut_history_begin_step(history.get()));
    shim::check(context.get(), abut_history_set(history.get(), &entries));
  }

  Message ChainSteps::solve(const ChainLoad &load,
                            const MethodParameters &method)
  {
    abut_strategy_options options = method.options;
    set_scales(chain, stiffness, load, options);
    const std::size_t per_mass = id.size() / chain.n;
    std::vector<double> pressure(id.size()), reference;
    std::vector<std::uint8_t> state(id.size());
    const abut_history_values past = {sizeof(past), pressure.data(),
                                      state.data(), nullptr};
    shim::check(context.get(),
                abut_history_get(history.get(), ABUT_HISTORY_COMMITTED,
                                 static_cast<std::int64_t>(id.size()),
                                 id.data(), &past));
    std::vector<std::int32_t> first;
    for (std::size_t k = 0; k < id.size(); ++k)
      if (k % per_mass == 0)
        first.push_back(static_cast<std::int32_t>(k));
      else
        reference.push_back(pressure[k]);
    const std::vector<std::uint8_t> n_tangents(
        chain.n, static_cast<std::uint8_t>(chain.n_tangents()));
    abut_strategy_friction friction = {};
    friction.struct_size = sizeof(friction);
    friction.n = static_cast<std::int32_t>(chain.n);
    friction.first = first.data();
    friction.n_tangents = n_tangents.data();
    friction.coefficient = load.coefficient.data();
    friction.cap = load.cap.empty() ? nullptr : load.cap.data();
    friction.reference_traction = reference.data();
    method.set_law(friction);

    const auto points = make_points();
    abut_dense_model model = {};
    model.struct_size = sizeof(model);
    model.n = static_cast<std::int32_t>(chain.n_unknowns());
    model.stiffness = stiffness.data();
    model.force = load.force.data();
    model.points = points.get();
    model.friction = has_friction ? &friction : nullptr;
    trial.displacement = committed.displacement;
    abut_reason reason = ABUT_REASON_NONE;
    const abut_status status = abut_dense_model_solve(
        context.get(), &model, &options, trial.displacement.data(),
        pressure.data(), state.data(), nullptr, nullptr, &last_progress,
        &reason);
    if (status != ABUT_SUCCESS && status != ABUT_SINGULAR)
      return coded(
          ABUT_FAILURE_NOT_FINITE,
          std::string("forces and springs exceed the range of numbers (")
              + shim::core_message(context.get())
              + "). Choose other units of lengths and forces.");
    if (status != ABUT_SUCCESS || reason != ABUT_REASON_CONVERGED)
      return explain(context.get(), options.law, status, reason, last_progress);
    for (std::size_t k = 0; k < id.size(); ++k)
    {
      trial.pressure[id[k]] = pressure[k];
      trial.state[k / per_mass] = state[k / per_mass * per_mass];
    }
    return "";
  }

  void ChainSteps::accept()
  {
    const unsigned int dim = chain.dimension, tangents = chain.n_tangents();
    for (std::size_t i = 0; i < chain.n; ++i)
      for (unsigned int t = 0; t < tangents; ++t)
      {
        const double slip = trial.displacement[i * dim + t]
                            - committed.displacement[i * dim + t];
        const bool touches = trial.state[i] != ABUT_STATE_OPEN;
        trial.slip[i * tangents + t] = touches ? slip : 0.;
        trial.dissipated -=
            trial.pressure[i * dim + 1 + t] * trial.slip[i * tangents + t];
      }
    remember();
    shim::check(context.get(), abut_history_commit(history.get()));
    committed = trial;
  }

  void ChainSteps::reject()
  {
    shim::check(context.get(), abut_history_rollback(history.get()));
    trial = committed;
  }

  double ChainSteps::energy(const ChainLoad &load) const
  {
    const std::size_t n = load.force.size();
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = 0; j < n; ++j)
        sum += 0.5 * trial.displacement[i] * stiffness[i * n + j]
               * trial.displacement[j];
      sum -= load.force[i] * trial.displacement[i];
    }
    return sum;
  }
} // namespace abut::app

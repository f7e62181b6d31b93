// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_mass_model.h"

#include "app/input/input_error.h"
#include "shim/handles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    /** A positive status is the fault of the data. */
    void throw_if_failed(const abut_status status, const abut_context *context)
    {
      if (status == ABUT_SUCCESS)
        return;
      const std::string text = shim::core_message(context);
      if (status > 0)
        throw InputError("Masses/Stiffness", text);
      throw std::runtime_error(text);
    }

    shim::Handle<abut_points> make_points(const PointMassModel &model,
                                          abut_context *context)
    {
      shim::Handle<abut_points> points = shim::create_points(context, 1);
      std::vector<std::int32_t> nodes(model.n());
      for (std::size_t j = 0; j < nodes.size(); ++j)
        nodes[j] = static_cast<std::int32_t>(j);
      for (std::size_t i = 0; i < model.rows.size(); ++i)
        throw_if_failed(
            abut_points_append_scalar(
                points.get(), static_cast<std::int64_t>(i), 1.,
                model.initial_gap[i],
                model.equality[i] ? ABUT_POINT_TIE : ABUT_POINT_CONTACT,
                static_cast<std::int32_t>(model.n()), nodes.data(),
                model.rows[i].data()),
            context);
      return points;
    }

    void record(void *user, const abut_progress *progress,
                const double *displacement, const double *pressure)
    {
      auto &solution = *static_cast<PointMassSolution *>(user);
      PointMassStep step = {
          *progress,
          {displacement, displacement + solution.displacement.size()},
          {pressure, pressure + solution.pressure.size()}};
      // The end of a solve is reported even if nothing moved any more.
      if (!solution.history.empty()
          && solution.history.back().progress.barrier == progress->barrier
          && solution.history.back().displacement == step.displacement
          && solution.history.back().pressure == step.pressure)
        solution.history.pop_back();
      solution.history.push_back(std::move(step));
    }
  } // namespace

  double PointMassModel::energy(const std::vector<double> &u) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < n(); ++i)
    {
      for (std::size_t j = 0; j < n(); ++j)
        sum += 0.5 * u[i] * stiffness[i * n() + j] * u[j];
      sum -= force[i] * u[i];
    }
    return sum;
  }

  double PointMassModel::gap(const std::size_t row,
                             const std::vector<double> &u) const
  {
    double g = initial_gap[row];
    for (std::size_t j = 0; j < n(); ++j)
      g += rows[row][j] * u[j];
    return g;
  }

  double PointMassModel::row_stiffness(const std::size_t row) const
  {
    double sum = 0, squares = 0;
    for (std::size_t j = 0; j < n(); ++j)
    {
      const double square = rows[row][j] * rows[row][j];
      sum += square * stiffness[j * n() + j];
      squares += square;
    }
    return sum / (squares * squares);
  }

  double PointMassModel::length_scale() const
  {
    double scale = 0;
    for (std::size_t j = 0; j < n(); ++j)
      if (stiffness[j * n() + j] > 0)
        scale = std::max(scale, std::abs(force[j]) / stiffness[j * n() + j]);
    for (const double gap : initial_gap)
      scale = std::max(scale, std::abs(gap));
    return scale;
  }

  double PointMassModel::pressure_scale() const
  {
    double scale = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      double largest = 0;
      for (std::size_t j = 0; j < n(); ++j)
        largest = std::max(largest, std::abs(rows[i][j]));
      for (std::size_t j = 0; j < n(); ++j)
        scale = std::max(scale, std::abs(force[j]) / largest);
      scale = std::max(scale, std::abs(initial_gap[i]) * row_stiffness(i));
    }
    return scale;
  }

  PointMassSolution solve(const PointMassModel &model,
                          abut_strategy_options options)
  {
    options.length_scale = model.length_scale();
    options.pressure_scale = model.pressure_scale();

    const auto context = shim::create_context();
    const auto points = make_points(model, context.get());
    abut_dense_model dense = {};
    dense.struct_size = sizeof(dense);
    dense.n = static_cast<std::int32_t>(model.n());
    dense.stiffness = model.stiffness.data();
    dense.force = model.force.data();
    dense.points = points.get();

    PointMassSolution solution = {};
    solution.displacement = model.start;
    solution.pressure.assign(model.rows.size(), 0.);
    throw_if_failed(
        abut_dense_model_solve(context.get(), &dense, &options,
                               solution.displacement.data(),
                               solution.pressure.data(), nullptr, record,
                               &solution, &solution.progress, &solution.reason),
        context.get());
    return solution;
  }
} // namespace abut::app

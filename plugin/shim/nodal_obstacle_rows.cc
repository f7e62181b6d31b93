// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_obstacle_rows.h"

#include "agree.h"
#include "fnv_hash.h"
#include "solve/projected_gauss_seidel.h"

#include <abut/dealii/versions.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Values of an obstacle at all nodes; none, or +-infinity, where there
     * is no obstacle. Collective. */
    template <int dim>
    std::vector<double>
    evaluate(const std::shared_ptr<const dealii::Function<dim>> &function,
             const std::vector<typename NodalCandidates<dim>::Node> &nodes,
             const double otherwise, const MPI_Comm communicator)
    {
      std::vector<double> values(nodes.size(), otherwise);
      if (function == nullptr)
        return values;
      std::vector<dealii::Point<dim>> points;
      points.reserve(nodes.size());
      for (const auto &node : nodes)
        points.push_back(node.point);
      run_everywhere<ObstacleError>(communicator, [&]
                                    { function->value_list(points, values); });
      return values;
    }

    template <int dim> std::string at(const dealii::Point<dim> &point)
    {
      std::ostringstream text;
      text << " at (" << point << ")";
      return text.str();
    }

    Message of_upper(const std::string &text)
    {
      Message message(text);
      message.field = PairField::upper_obstacle;
      return message;
    }

    dealii::types::global_dof_index first_of(const dealii::IndexSet &owned)
    {
      return owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    }

    /** Numbers of points: two per unknown, so that numbers are unique over
     * ranks and sorted by unknown. */
    std::int64_t row_id(const dealii::types::global_dof_index dof,
                        const bool upper)
    {
      return 2 * static_cast<std::int64_t>(dof) + (upper ? 1 : 0);
    }
  } // namespace

  template <int dim>
  NodalObstacleRows<dim>::NodalObstacleRows(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints,
      const Obstacle<dim> &obstacle)
      : mapping_(mapping),
        dof_handler_(dof_handler),
        constraints_(constraints),
        obstacle_(obstacle),
        communicator_(versions::communicator(dof_handler)),
        candidates_(collect_nodal_candidates(mapping, dof_handler, constraints,
                                             obstacle.boundary_ids)),
        nodes_(solve::NodeMap::numbered(
            first_of(dof_handler.locally_owned_dofs())))
  {
  }

  template <int dim> la::Vector NodalObstacleRows<dim>::nodal_vector() const
  {
    return la::Vector(dof_handler_.locally_owned_dofs(), communicator_);
  }

  template <int dim>
  void NodalObstacleRows<dim>::check_obstacles(
      const std::vector<double> &lower, const std::vector<double> &upper) const
  {
    Message message;
    for (std::size_t i = 0; i < lower.size() && message.empty(); ++i)
    {
      if (std::isnan(lower[i]) || lower[i] == INFINITY)
        message = "The obstacle is not finite";
      else if (std::isnan(upper[i]) || upper[i] == -INFINITY)
        message = of_upper("The upper obstacle is not finite");
      else if (upper[i] < lower[i])
        message = "No displacement can lie between the upper obstacle, "
                  + std::to_string(upper[i]) + ", and the obstacle, "
                  + std::to_string(lower[i]) + ",";
      if (!message.empty())
        message.text += at(candidates_.free[i].point) + ".";
    }
    throw_everywhere<ObstacleError>(communicator_, message);
  }

  template <int dim>
  void NodalObstacleRows<dim>::check_prescribed_values() const
  {
    const auto lower = evaluate<dim>(obstacle_.lower, candidates_.prescribed,
                                     -INFINITY, communicator_);
    const auto upper = evaluate<dim>(obstacle_.upper, candidates_.prescribed,
                                     INFINITY, communicator_);
    // Round-off of a formula that is 0 at a node is measured by its values
    // elsewhere.
    double largest = 0.;
    for (const auto &line : constraints_.get_lines())
      largest = std::max(largest, std::abs(line.inhomogeneity));
    for (std::size_t i = 0; i < lower.size(); ++i)
      largest = std::max({largest, obstacle_.lower ? std::abs(lower[i]) : 0.,
                          obstacle_.upper ? std::abs(upper[i]) : 0.});
    const double slack = 1e-10 * MPI::max(largest, communicator_);
    Message message;
    for (std::size_t i = 0; i < lower.size() && message.empty(); ++i)
    {
      const auto &node = candidates_.prescribed[i];
      const double value = constraints_.get_inhomogeneity(node.dof);
      if (value < lower[i] - slack)
        message = "The obstacle (" + std::to_string(lower[i])
                  + ") lies above the prescribed value ("
                  + std::to_string(value) + ")" + at(node.point)
                  + ". Lower the obstacle there, or raise the prescribed "
                    "displacement.";
      else if (value > upper[i] + slack)
        message = of_upper("The upper obstacle (" + std::to_string(upper[i])
                           + ") lies below the prescribed value ("
                           + std::to_string(value) + ")" + at(node.point)
                           + ". Raise the obstacle there, or lower the "
                             "prescribed displacement.");
    }
    throw_everywhere<ObstacleError>(communicator_, message);
  }

  template <int dim>
  void NodalObstacleRows<dim>::append_points(const std::vector<double> &lower,
                                             const std::vector<double> &upper,
                                             abut_points *points)
  {
    const dealii::IndexSet &owned = dof_handler_.locally_owned_dofs();
    const auto append =
        [&](const auto &node, const bool is_upper, const double initial_gap)
    {
      const auto number =
          static_cast<std::int32_t>(owned.index_within_set(node.dof));
      const double slope = is_upper ? -1. : 1.;
      return abut_points_append_scalar(points, row_id(node.dof, is_upper),
                                       node.weight, initial_gap,
                                       ABUT_POINT_CONTACT, 1, &number, &slope);
    };

    const auto n = static_cast<std::int32_t>(
        lower.size() - std::count(lower.begin(), lower.end(), -INFINITY)
        + upper.size() - std::count(upper.begin(), upper.end(), INFINITY));
    abut_status status = abut_points_reserve(points, n, n, n);
    for (std::size_t i = 0; i < lower.size() && status == ABUT_SUCCESS; ++i)
    {
      if (lower[i] != -INFINITY)
        status = append(candidates_.free[i], false, -lower[i]);
      if (upper[i] != INFINITY && status == ABUT_SUCCESS)
        status = append(candidates_.free[i], true, upper[i]);
    }
    if (status == ABUT_SUCCESS)
      status = abut_points_get(points, &view_);
    throw_everywhere<std::runtime_error>(
        communicator_, status == ABUT_SUCCESS ? "" : abut_status_text(status));
  }

  template <int dim>
  RowSource::Change NodalObstacleRows<dim>::find(const la::Vector &,
                                                 abut_points *points)
  {
    const auto lower = evaluate<dim>(obstacle_.lower, candidates_.free,
                                     -INFINITY, communicator_);
    const auto upper = evaluate<dim>(obstacle_.upper, candidates_.free,
                                     INFINITY, communicator_);
    check_obstacles(lower, upper);
    check_prescribed_values();
    abut_points_clear(points);
    append_points(lower, upper, points);
    return Change::points;
  }

  template <int dim>
  std::uint64_t NodalObstacleRows<dim>::mesh_signature() const
  {
    // Unknowns are numbered by rank: rows have the same numbers where the same
    // unknowns are at the same places.
    std::uint64_t sum = 0;
    for (const auto &node : candidates_.free)
    {
      FnvHash hash;
      hash.mix(node.dof);
      for (unsigned int d = 0; d < dim; ++d)
      {
        std::uint64_t word = 0;
        std::memcpy(&word, &node.point[d], sizeof(word));
        hash.mix(word);
      }
      sum += hash.value;
    }
    FnvHash hash;
    hash.mix(dof_handler_.n_dofs());
    hash.mix(MPI::sum(sum, communicator_));
    return std::max<std::uint64_t>(hash.value, 1);
  }

  template <int dim>
  std::vector<double>
  NodalObstacleRows<dim>::row_pressure(const la::Vector &field) const
  {
    const double *p = la::data(field);
    std::vector<double> result(n_rows());
    for (int i = 0; i < n_rows(); ++i)
      result[i] = slope(i) * p[unknown(i)];
    return result;
  }

  template <int dim>
  la::Vector NodalObstacleRows<dim>::pressure(const double *row_pressure) const
  {
    la::Vector result = nodal_vector();
    double *p = la::data(result);
    for (int i = 0; i < n_rows(); ++i)
      p[unknown(i)] += slope(i) * row_pressure[i];
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim>
  la::Vector NodalObstacleRows<dim>::gap(const double *row_gap) const
  {
    la::Vector result = nodal_vector();
    double *g = la::data(result);
    int previous = -1;
    for (int i = 0; i < n_rows(); ++i)
    {
      const int u = unknown(i);
      g[u] = u == previous ? std::min(g[u], row_gap[i]) : row_gap[i];
      previous = u;
    }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim>
  la::Vector NodalObstacleRows<dim>::status(const std::uint8_t *row_state) const
  {
    la::Vector result = nodal_vector();
    result = -1.;
    double *s = la::data(result);
    for (int i = 0; i < n_rows(); ++i)
    {
      const int u = unknown(i);
      s[u] = std::max(s[u], 0.);
      if (row_state != nullptr && row_state[i] != ABUT_STATE_OPEN)
        s[u] = is_upper(i) ? 2. : 1.;
    }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim>
  std::vector<std::uint8_t> NodalObstacleRows<dim>::relax(
      const Tangent &tangent, const la::Vector &residual,
      const std::vector<double> &gap, const unsigned int n_sweeps,
      la::Vector &displacement) const
  {
    AssertThrow(
        tangent.has_matrix(),
        dealii::ExcMessage("Relaxation sweeps need the matrix of the tangent, "
                           "not a HostOperator: leave them out."));
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> lower(la::n_owned(displacement), -infinity);
    std::vector<double> upper(la::n_owned(displacement), infinity);
    for (int i = 0; i < n_rows(); ++i)
      if (is_upper(i))
        upper[unknown(i)] = gap[i];
      else
        lower[unknown(i)] = -gap[i];

    la::Vector correction = nodal_vector();
    solve::projected_gauss_seidel(tangent.matrix(), residual, lower, upper,
                                  n_sweeps, correction);
    const double *d = la::data(correction);
    std::vector<std::uint8_t> state(n_rows());
    for (int i = 0; i < n_rows(); ++i)
    {
      const double change = slope(i) * d[unknown(i)];
      state[i] = change <= -gap[i] ? ABUT_STATE_CLOSED : ABUT_STATE_OPEN;
    }
    displacement += correction;
    return state;
  }

  template <int dim>
  void NodalObstacleRows<dim>::push_inside(const std::vector<double> &,
                                           std::vector<double> margin,
                                           la::Vector &displacement) const
  {
    double *u = la::data(displacement);
    for (int i = 0; i < n_rows(); ++i)
    {
      // Between two obstacles the margin is at most a quarter of the room.
      const int own = unknown(i);
      const bool before = i > 0 && unknown(i - 1) == own;
      const bool after = i + 1 < n_rows() && unknown(i + 1) == own;
      if (before || after)
        margin[i] =
            std::min(margin[i],
                     0.25 * (view_.gap[i] + view_.gap[before ? i - 1 : i + 1]));
      const double g = view_.gap[i] + slope(i) * u[own];
      if (g < margin[i])
        u[own] += slope(i) * (margin[i] - g);
    }
    displacement.compress(dealii::VectorOperation::insert);
  }

  template <int dim>
  void NodalObstacleRows<dim>::filter(const std::vector<std::uint8_t> &)
  {
    Assert(false, dealii::ExcInternalError());
  }

  template class NodalObstacleRows<2>;
  template class NodalObstacleRows<3>;
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_operator.h"

#include <algorithm>
#include <cmath>

namespace abut::solve
{
  using dealii::make_array_view;
  using dealii::types::global_dof_index;

  namespace
  {
    /** A row of B in the making: entries in the order in which they come, and
     * those of one unknown added up in that order. */
    class Line
    {
    public:
      void clear()
      {
        terms_.clear();
      }

      void add(const global_dof_index unknown, const double value)
      {
        terms_.push_back({unknown, value});
      }

      /** Append the sums, sorted by unknown, but for those that are round-off
       * of what cancels. */
      void write(std::vector<global_dof_index> &column,
                 std::vector<double> &coefficient)
      {
        constexpr double round_off = 1e-14;
        if (terms_.size() == 1)
        {
          write_sum(terms_.front().first, terms_.front().second, column,
                    coefficient);
          return;
        }
        double largest = 0.;
        for (const auto &[unknown, value] : terms_)
          largest = std::max(largest, std::abs(value));
        std::stable_sort(terms_.begin(), terms_.end(),
                         [](const auto &a, const auto &b)
                         { return a.first < b.first; });
        for (std::size_t first = 0, end; first < terms_.size(); first = end)
        {
          double sum = 0.;
          for (end = first;
               end < terms_.size() && terms_[end].first == terms_[first].first;
               ++end)
            sum += terms_[end].second;
          // A value that is not finite is kept, so that it is reported.
          if (!(std::abs(sum) <= round_off * largest))
            write_sum(terms_[first].first, sum, column, coefficient);
        }
      }

      /** Whether write() would append anything. */
      bool has_columns() const
      {
        const auto largest =
            std::max_element(terms_.begin(), terms_.end(),
                             [](const auto &a, const auto &b) {
                               return std::abs(a.second) < std::abs(b.second);
                             });
        if (largest == terms_.end())
          return false;
        if (largest->second != 0.
            && std::count_if(terms_.begin(), terms_.end(),
                             [&](const auto &term)
                             { return term.first == largest->first; })
                   == 1)
          return true;
        std::vector<global_dof_index> column;
        std::vector<double> coefficient;
        Line(*this).write(column, coefficient);
        return !column.empty();
      }

    private:
      static void write_sum(const global_dof_index unknown, const double sum,
                            std::vector<global_dof_index> &column,
                            std::vector<double> &coefficient)
      {
        if (sum == 0.)
          return;
        column.push_back(unknown);
        coefficient.push_back(sum);
      }

      std::vector<std::pair<global_dof_index, double>> terms_;
    };

    /** Gather the terms of a row of a point. */
    void gather(const abut_points_view &points, const int point, const int row,
                const NodeMap &nodes, Line &line)
    {
      const int dim = points.dimension;
      const double sign = abut_point_sign(points.kind[point],
                                          row - points.component_start[point]);
      line.clear();
      for (auto e = points.start[point]; e < points.start[point + 1]; ++e)
        for (int d = 0; d < dim; ++d)
        {
          const double factor = sign * points.frame[row * std::size_t(dim) + d]
                                * points.coefficient[e];
          if (factor == 0.)
            continue;
          const auto node = static_cast<std::size_t>(points.node[e]);
          nodes.for_each_term(
              node, d,
              [&](const global_dof_index unknown, const double term)
              { line.add(unknown, factor * term); });
        }
    }
  } // namespace

  std::vector<global_dof_index> PointOperator::expand(const NodeMap &nodes)
  {
    const int dim = points_.dimension;
    std::vector<global_dof_index> columns;
    Line line;
    start_.reserve(n_rows() + std::size_t(1));
    initial_gap_.reserve(n_rows());
    if (dim == 1 && n_rows() > 0)
    {
      columns.reserve(points_.start[points_.n_points]);
      coefficient_.reserve(points_.start[points_.n_points]);
    }
    for (int i = 0; i < points_.n_points; ++i)
      for (int row = points_.component_start[i];
           row < points_.component_start[i + 1]; ++row)
      {
        gather(points_, i, row, nodes, line);
        line.write(columns, coefficient_);
        initial_gap_.push_back(initial_gap(i, row, nodes));
        start_.push_back(static_cast<std::int64_t>(columns.size()));
      }
    return columns;
  }

  double PointOperator::initial_gap(const int point, const int row,
                                    const NodeMap &nodes) const
  {
    const int dim = points_.dimension;
    const double sign = abut_point_sign(points_.kind[point],
                                        row - points_.component_start[point]);
    double gap = points_.gap[row];
    for (auto e = points_.start[point]; e < points_.start[point + 1]; ++e)
      for (int d = 0; d < dim; ++d)
      {
        const double factor = sign * points_.frame[row * std::size_t(dim) + d]
                              * points_.coefficient[e];
        if (factor != 0.)
          gap += factor
                 * nodes.constant(static_cast<std::size_t>(points_.node[e]), d);
      }
    return gap;
  }

  void PointOperator::share_with_points()
  {
    const auto n = static_cast<std::size_t>(n_rows());
    is_shared_ =
        points_.n_points == points_.n_components && n > 0
        && std::equal(start_.begin(), start_.end(), points_.start,
                      points_.start + n + 1)
        && std::equal(column_.begin(), column_.end(), points_.node)
        && std::equal(coefficient_.begin(), coefficient_.end(),
                      points_.coefficient)
        && std::equal(initial_gap_.begin(), initial_gap_.end(), points_.gap);
    if (!is_shared_)
      return;
    start_ = {};
    column_ = {};
    coefficient_ = {};
    initial_gap_ = {};
  }

  void PointOperator::renew_constants(const NodeMap &nodes)
  {
    if (is_shared_)
      initial_gap_.assign(points_.gap, points_.gap + n_rows());
    for (int i = 0; i < points_.n_points; ++i)
      for (int row = points_.component_start[i];
           row < points_.component_start[i + 1]; ++row)
        initial_gap_[row] = initial_gap(i, row, nodes);
  }

  PointOperator::PointOperator(const dealii::IndexSet &owned,
                               const abut_points_view &points,
                               const NodeMap &nodes,
                               const MPI_Comm communicator)
      : points_(points), n_owned_(static_cast<int>(owned.n_elements()))
  {
    const std::vector<global_dof_index> columns = expand(nodes);
    std::vector<global_dof_index> others;
    for (const global_dof_index column : columns)
      if (!owned.is_element(column))
        others.push_back(column);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    dealii::IndexSet ghosts(owned.size());
    ghosts.add_indices(others.begin(), others.end());
    partitioner_ = std::make_shared<dealii::Utilities::MPI::Partitioner>(
        owned, ghosts, communicator);

    column_.reserve(columns.size());
    for (const global_dof_index column : columns)
      column_.push_back(
          static_cast<int>(partitioner_->global_to_local(column)));
    mark_tangents();
    share_with_points();
    if (!is_alone())
      values_.resize(n_columns());
    buffer_.resize(partitioner_->n_import_indices());
  }

  global_dof_index PointOperator::global_column(const int column) const
  {
    return partitioner_->local_to_global(static_cast<unsigned int>(column));
  }

  void PointOperator::get_columns(const int row,
                                  std::vector<global_dof_index> &columns) const
  {
    columns.clear();
    for (auto e = begin(row); e < end(row); ++e)
      columns.push_back(global_column(column(e)));
  }

  const double *PointOperator::import(const la::Vector &vector) const
  {
    if (is_alone())
      return la::data(vector);
    std::copy_n(la::data(vector), n_owned_, values_.data());
    const std::size_t n_ghosts = values_.size() - n_owned_;
    const dealii::ArrayView<double> ghosts(values_.data() + n_owned_, n_ghosts);
    std::vector<MPI_Request> requests;
    partitioner_->export_to_ghosted_array_start(
        0, dealii::ArrayView<const double>(values_.data(), n_owned_),
        make_array_view(buffer_), ghosts, requests);
    partitioner_->export_to_ghosted_array_finish(ghosts, requests);
    return values_.data();
  }

  void PointOperator::times(const la::Vector &u, double *const result) const
  {
    const double *const values = import(u), *const b = coefficients();
    const int *const j = columns();
    for (int i = 0; i < n_rows(); ++i)
    {
      double sum = 0.;
      for (std::int64_t e = begin(i); e < end(i); ++e)
        sum += b[e] * values[j[e]];
      result[i] = sum;
    }
  }

  void PointOperator::gap(const la::Vector &u, double *const result) const
  {
    times(u, result);
    for (int i = 0; i < n_rows(); ++i)
      result[i] += initial_gap()[i];
  }

  void PointOperator::mark_tangents()
  {
    for (int i = 0; i < points_.n_points; ++i)
      for (int row = points_.component_start[i] + 1;
           row < points_.component_start[i + 1]
           && points_.kind[i] == ABUT_POINT_CONTACT;
           ++row)
      {
        is_tangent_.resize(n_rows(), 0);
        is_tangent_[row] = 1;
      }
  }

  void PointOperator::clear_ghosts() const
  {
    if (!is_alone())
      std::fill(values_.begin() + n_owned_, values_.end(), 0.);
  }

  /** Add the ghosts of values_ to the owned entries of a vector. */
  void PointOperator::export_values(la::Vector &vector) const
  {
    if (is_alone())
      return;
    const std::size_t n_ghosts = values_.size() - n_owned_;
    const dealii::ArrayView<double> ghosts(values_.data() + n_owned_, n_ghosts);
    std::vector<MPI_Request> requests;
    partitioner_->import_from_ghosted_array_start(
        dealii::VectorOperation::add, 0, ghosts, make_array_view(buffer_),
        requests);
    partitioner_->import_from_ghosted_array_finish(
        dealii::VectorOperation::add,
        dealii::ArrayView<const double>(buffer_.data(), buffer_.size()),
        dealii::ArrayView<double>(la::data(vector), n_owned_), ghosts,
        requests);
  }

  template <typename Function>
  void PointOperator::add_entries(const double *const factor,
                                  const Function &function,
                                  la::Vector &vector) const
  {
    double *const out = la::data(vector);
    clear_ghosts();
    const double *const b = coefficients();
    for (int i = 0; i < n_rows(); ++i)
    {
      if (factor[i] == 0.)
        continue;
      for (std::int64_t e = begin(i); e < end(i); ++e)
      {
        const double value = factor[i] * function(b[e]);
        const int j = column(e);
        (j < n_owned_ ? out[j] : values_[j]) += value;
      }
    }
    export_values(vector);
  }

  void PointOperator::add_transposed(const double *const factor,
                                     la::Vector &force) const
  {
    add_entries(
        factor, [](const double b) { return b; }, force);
  }

  void PointOperator::add_squares(const double *const factor,
                                  la::Vector &d) const
  {
    add_entries(
        factor, [](const double b) { return b * b; }, d);
  }

  void PointOperator::add_counts(const std::uint8_t *const wanted,
                                 la::Vector &d) const
  {
    const std::vector<double> factor(wanted, wanted + n_rows());
    add_entries(
        factor.data(), [](const double b) { return b == 0. ? 0. : 1.; }, d);
  }

  void PointOperator::add_group_counts(const std::uint8_t *const wanted,
                                       const std::vector<int> &first,
                                       la::Vector &d) const
  {
    double *const out = la::data(d);
    clear_ghosts();
    std::vector<int> columns;
    for (std::size_t group = 0; group + 1 < first.size(); ++group)
    {
      columns.clear();
      for (int i = first[group]; i < first[group + 1]; ++i)
        if (wanted[i])
          columns.insert(columns.end(), this->columns() + begin(i),
                         this->columns() + end(i));
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
      for (const int j : columns)
        (j < n_owned_ ? out[j] : values_[j]) += 1.;
    }
    export_values(d);
  }

  std::vector<double> PointOperator::squares(const la::Vector &d) const
  {
    const double *const values = import(d), *const b = coefficients();
    std::vector<double> result(n_rows(), 0.);
    for (int i = 0; i < n_rows(); ++i)
      for (std::int64_t e = begin(i); e < end(i); ++e)
        result[i] += b[e] * b[e] * values[column(e)];
    return result;
  }

  std::vector<std::uint8_t> rows_with_columns(const abut_points_view &points,
                                              const NodeMap &nodes)
  {
    std::vector<std::uint8_t> result(points.n_components);
    Line line;
    for (int i = 0; i < points.n_points; ++i)
      for (int row = points.component_start[i];
           row < points.component_start[i + 1]; ++row)
      {
        gather(points, i, row, nodes, line);
        result[row] = line.has_columns();
      }
    return result;
  }
} // namespace abut::solve

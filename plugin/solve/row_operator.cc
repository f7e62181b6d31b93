// SPDX-License-Identifier: LGPL-2.1-or-later
#include "row_operator.h"

#include <algorithm>

namespace abut::solve
{
  using dealii::make_array_view;
  using dealii::types::global_dof_index;

  RowOperator::RowOperator(const dealii::IndexSet &owned,
                           const abut_rows_view &rows,
                           const MPI_Comm communicator)
      : rows_(rows), n_owned_(static_cast<int>(owned.n_elements()))
  {
    const std::int64_t n_entries =
        rows.n_rows > 0 ? rows.row_start[rows.n_rows] : 0;
    std::vector<global_dof_index> others;
    for (std::int64_t e = 0; e < n_entries; ++e)
    {
      const auto column = static_cast<global_dof_index>(rows.column[e]);
      if (!owned.is_element(column))
        others.push_back(column);
    }
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    dealii::IndexSet ghosts(owned.size());
    ghosts.add_indices(others.begin(), others.end());
    partitioner_ = std::make_shared<dealii::Utilities::MPI::Partitioner>(
        owned, ghosts, communicator);

    column_.resize(n_entries);
    for (std::int64_t e = 0; e < n_entries; ++e)
      column_[e] = static_cast<int>(partitioner_->global_to_local(
          static_cast<global_dof_index>(rows.column[e])));
    values_.resize(n_columns());
    buffer_.resize(partitioner_->n_import_indices());
  }

  global_dof_index RowOperator::global_column(const int column) const
  {
    return partitioner_->local_to_global(static_cast<unsigned int>(column));
  }

  const double *RowOperator::import(const la::Vector &vector) const
  {
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

  void RowOperator::times(const la::Vector &u, double *const result) const
  {
    const double *const values = import(u);
    for (int i = 0; i < n_rows(); ++i)
    {
      double sum = 0.;
      for (std::int64_t e = begin(i); e < end(i); ++e)
        sum += rows_.coefficient[e] * values[column_[e]];
      result[i] = sum;
    }
  }

  void RowOperator::gap(const la::Vector &u, double *const result) const
  {
    times(u, result);
    for (int i = 0; i < n_rows(); ++i)
      result[i] += rows_.initial_gap[i];
  }

  template <typename Function>
  void RowOperator::add_entries(const double *const factor,
                                const Function &function,
                                la::Vector &vector) const
  {
    double *const out = la::data(vector);
    std::fill(values_.begin() + n_owned_, values_.end(), 0.);
    for (int i = 0; i < n_rows(); ++i)
    {
      if (factor[i] == 0.)
        continue;
      for (std::int64_t e = begin(i); e < end(i); ++e)
      {
        const double value = factor[i] * function(rows_.coefficient[e]);
        const int j = column_[e];
        (j < n_owned_ ? out[j] : values_[j]) += value;
      }
    }
    const std::size_t n_ghosts = values_.size() - n_owned_;
    const dealii::ArrayView<double> ghosts(values_.data() + n_owned_, n_ghosts);
    std::vector<MPI_Request> requests;
    partitioner_->import_from_ghosted_array_start(
        dealii::VectorOperation::add, 0, ghosts, make_array_view(buffer_),
        requests);
    partitioner_->import_from_ghosted_array_finish(
        dealii::VectorOperation::add,
        dealii::ArrayView<const double>(buffer_.data(), buffer_.size()),
        dealii::ArrayView<double>(out, n_owned_), ghosts, requests);
  }

  void RowOperator::add_transposed(const double *const factor,
                                   la::Vector &force) const
  {
    add_entries(
        factor, [](const double b) { return b; }, force);
  }

  void RowOperator::add_squares(const double *const factor, la::Vector &d) const
  {
    add_entries(
        factor, [](const double b) { return b * b; }, d);
  }

  void RowOperator::add_counts(const std::uint8_t *const wanted,
                               la::Vector &d) const
  {
    const std::vector<double> factor(wanted, wanted + n_rows());
    add_entries(
        factor.data(), [](const double b) { return b == 0. ? 0. : 1.; }, d);
  }

  std::vector<double> RowOperator::squares(const la::Vector &d) const
  {
    const double *const values = import(d);
    std::vector<double> result(n_rows(), 0.);
    for (int i = 0; i < n_rows(); ++i)
      for (std::int64_t e = begin(i); e < end(i); ++e)
        result[i] +=
            rows_.coefficient[e] * rows_.coefficient[e] * values[column_[e]];
    return result;
  }
} // namespace abut::solve

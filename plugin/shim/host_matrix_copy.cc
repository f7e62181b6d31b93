// SPDX-License-Identifier: LGPL-2.1-or-later
#include "host_matrix_copy.h"

#include "agree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::shim
{
  using Index = la::HostMatrix::Index;

  namespace
  {
    void refuse_lacking(const Index row, const std::string &name,
                        const MPI_Comm communicator)
    {
      refuse_row(row, name,
                 "no entry on the diagonal, which eliminated rows need, too,",
                 communicator);
    }

    void refuse_value(const Index row, const std::string &name,
                      const MPI_Comm communicator)
    {
      refuse_row(row, name, "a value that is not finite", communicator);
    }

    /** Global columns of a row of @p matrix, and where their values are. */
    std::vector<std::pair<Index, int>> places_of_row(const la::Matrix &matrix,
                                                     const la::LocalRows &rows,
                                                     const int row)
    {
      std::vector<std::pair<Index, int>> result;
      for (int k = rows.start[row]; k < rows.start[row + 1]; ++k)
        result.emplace_back(la::global_column(matrix, rows.column[k]), k);
      std::sort(result.begin(), result.end());
      return result;
    }
  } // namespace

  void refuse_row(const Index row, const std::string &name,
                  const std::string &what, const MPI_Comm communicator)
  {
    const Index first = dealii::Utilities::MPI::min(row, communicator);
    AssertThrow(first == dealii::numbers::invalid_dof_index,
                dealii::ExcMessage("The " + name + " has " + what + " in row "
                                   + std::to_string(first) + "."));
  }

  void check_sent(const la::Matrix &matrix, const std::string &name,
                  const MPI_Comm communicator)
  {
    AssertThrow(
        !dealii::Utilities::MPI::logical_or(!matrix.is_compressed(),
                                            communicator),
        dealii::ExcMessage(
            "The " + name
            + " has entries in rows of other ranks that were not sent to them. "
              "Call its compress(VectorOperation::add) after assembly."));
  }

  void check_assembled(const la::Matrix &matrix,
                       const dealii::AffineConstraints<double> &constraints,
                       const std::string &name, const MPI_Comm communicator)
  {
    const la::LocalRows rows = la::local_rows(matrix);
    const dealii::IndexSet owned = la::owned_rows(matrix);
    bool has_free = false, is_zero = true;
    for (int r = 0; r < rows.n_rows && is_zero; ++r)
    {
      if (constraints.is_constrained(owned.nth_index_in_set(r)))
        continue;
      has_free = true;
      is_zero = std::all_of(rows.value + rows.start[r],
                            rows.value + rows.start[r + 1],
                            [](const double value) { return value == 0.; });
    }
    const bool any_free =
        dealii::Utilities::MPI::logical_or(has_free, communicator);
    AssertThrow(
        !any_free || dealii::Utilities::MPI::logical_or(!is_zero, communicator),
        dealii::ExcMessage("The " + name
                           + " is zero in all rows that the constraints do not "
                             "eliminate. Assemble it before this call."));
  }

  void check_values(const la::Matrix &matrix, const std::string &name,
                    const MPI_Comm communicator)
  {
    la::LocalRows rows;
    run_everywhere<dealii::ExcMessage>(communicator,
                                       [&] { rows = la::local_rows(matrix); });
    Index bad = dealii::numbers::invalid_dof_index;
    Index lacking = dealii::numbers::invalid_dof_index;
    int place = 0; // of the last row's diagonal entry, mostly this one's, too
    for (int r = rows.n_rows - 1; r >= 0; --r)
    {
      const int begin = rows.start[r], end = rows.start[r + 1];
      // Sums that do not wait for each other.
      constexpr int n_sums = 4;
      double zero[n_sums] = {};
      int k = begin;
      for (; k + n_sums <= end; k += n_sums)
        for (int s = 0; s < n_sums; ++s)
          zero[s] += 0. * rows.value[k + s];
      for (; k < end; ++k)
        zero[0] += 0. * rows.value[k];
      if (zero[0] + zero[1] + zero[2] + zero[3] != 0.)
        bad = la::global_column(matrix, r);
      if (begin + place < end && rows.column[begin + place] == r)
        continue;
      const int *const at =
          std::find(rows.column + begin, rows.column + end, r);
      if (at == rows.column + end)
        lacking = la::global_column(matrix, r);
      else
        place = static_cast<int>(at - rows.column) - begin;
    }
    refuse_lacking(lacking, name, communicator);
    refuse_value(bad, name, communicator);
  }

  void check_eliminated(const la::Matrix &matrix,
                        const dealii::AffineConstraints<double> &constraints,
                        const std::string &name, const MPI_Comm communicator)
  {
    const double visible = 1e-10; // off the diagonal
    const la::LocalRows rows = la::local_rows(matrix);
    Index bad = dealii::numbers::invalid_dof_index;
    const dealii::IndexSet owned = la::owned_rows(matrix);
    for (const auto &line : constraints.get_lines())
    {
      if (!owned.is_element(line.index))
        continue;
      const auto r = static_cast<int>(owned.index_within_set(line.index));
      double diagonal = 0., other = 0.;
      for (int k = rows.start[r]; k < rows.start[r + 1]; ++k)
        (rows.column[k] == r ? diagonal : other) += std::abs(rows.value[k]);
      if (other > visible * diagonal)
        bad = std::min(bad, line.index);
    }
    refuse_row(bad, name,
               "off-diagonal entries, although the constraints given to "
               "reinit() eliminate it (assemble with "
               "AffineConstraints::distribute_local_to_global(), or apply "
               "boundary values to the matrix),",
               communicator);
  }

  std::set<Index>
  lone_rows(const la::Matrix &matrix,
            const dealii::AffineConstraints<double> &constraints,
            const MPI_Comm communicator)
  {
    const la::LocalRows rows = la::local_rows(matrix);
    const dealii::IndexSet owned = la::owned_rows(matrix);
    std::set<Index> result;
    bool is_diagonal = true; // a lumped mass is no elimination
    for (int r = 0; r < rows.n_rows; ++r)
    {
      const int begin = rows.start[r], end = rows.start[r + 1];
      int k = begin;
      while (k < end && (rows.column[k] == r || rows.value[k] == 0.))
        ++k;
      is_diagonal = is_diagonal && k == end;
      if (k == end && !constraints.is_constrained(owned.nth_index_in_set(r)))
        result.insert(owned.nth_index_in_set(r));
    }
    if (dealii::Utilities::MPI::min(int(is_diagonal), communicator) == 1)
      result.clear();
    return result;
  }

  void refuse_lone_row(const Index row, const std::string &name,
                       const MPI_Comm communicator)
  {
    refuse_row(row, name,
               "nothing but a diagonal, as if it was eliminated, although the "
               "constraints given to reinit() do not have it (give reinit() "
               "those that the matrix is assembled with),",
               communicator);
  }

  void HostMatrixCopy::clear()
  {
    matrix_.clear();
    start_.clear();
  }

  void HostMatrixCopy::build(const la::HostMatrix &host,
                             const std::string &name,
                             const dealii::IndexSet &owned,
                             const MPI_Comm communicator)
  {
    host.pattern(start_, column_);
    n_host_rows_ = static_cast<int>(start_.size()) - 1;
    dealii::DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
    Index lacking = dealii::numbers::invalid_dof_index;
    for (std::size_t r = 0; r < owned.n_elements(); ++r)
    {
      const Index row = owned.nth_index_in_set(r);
      if (r >= std::size_t(n_host_rows_))
      {
        pattern.add(row, row);
        continue;
      }
      const auto begin = column_.begin() + start_[r];
      const auto end = column_.begin() + start_[r + 1];
      pattern.add_entries(row, begin, end);
      if (lacking == dealii::numbers::invalid_dof_index
          && std::find(begin, end, row) == end)
        lacking = row;
    }
    refuse_lacking(lacking, name, communicator);
    matrix_.clear();
    matrix_.reinit(owned, owned, pattern, communicator);
    const la::LocalRows rows = la::local_rows(matrix_);
    place_.resize(column_.size());
    for (int r = 0; r < n_host_rows_; ++r)
    {
      const auto places = places_of_row(matrix_, rows, r);
      for (std::size_t k = start_[r]; k < start_[r + 1]; ++k)
        place_[k] = std::lower_bound(places.begin(), places.end(),
                                     std::make_pair(column_[k], 0))
                        ->second;
    }
  }

  void HostMatrixCopy::fill_rest(const la::LocalRows &rows) const
  {
    if (n_host_rows_ == rows.n_rows)
      return;
    double mean = 0.;
    const std::vector<double> diagonal = la::diagonal(rows);
    for (int r = 0; r < n_host_rows_; ++r)
      mean += std::abs(diagonal[r]) / n_host_rows_;
    for (int r = n_host_rows_; r < rows.n_rows; ++r)
      rows.value[rows.start[r]] = mean;
  }

  const la::Matrix &HostMatrixCopy::copy(const la::HostMatrix &host,
                                         const std::string &name,
                                         const dealii::IndexSet &owned,
                                         const MPI_Comm communicator)
  {
    la::HostMatrix::Pass pass;
    pass.fits = matrix_.m() == owned.size();
    for (int attempt = 0; attempt < 2; ++attempt)
    {
      la::LocalRows rows;
      if (pass.fits)
      {
        rows = la::local_rows(matrix_);
        pass = host.values(start_, column_, place_, rows.value);
      }
      if (dealii::Utilities::MPI::min(int(pass.fits), communicator) == 1)
      {
        fill_rest(rows);
        break;
      }
      build(host, name, owned, communicator);
      pass.fits = true;
    }
    refuse_value(pass.row, name, communicator);
    return matrix_;
  }
} // namespace abut::shim

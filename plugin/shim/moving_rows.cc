// SPDX-License-Identifier: LGPL-2.1-or-later
#include "moving_rows.h"

#include <algorithm>

namespace abut::shim
{
  void MovingRows::clear()
  {
    has_geometry_ = has_moved_ = false;
    geometry_ = solve::MatrixLines();
    moved_.reset();
    substitution_.reset();
    increment_ = la::Vector();
    changes_ = PartnerChanges();
  }

  void MovingRows::set_geometry(const std::vector<MatrixLine> &lines,
                                const la::Vector &start)
  {
    for (const MatrixLine &line : lines)
      geometry_.add(line.row, line.column, line.value);
    has_geometry_ = true;
    start_ = present_ = start;
  }

  void MovingRows::set_substitution(const solve::PointOperator &rows,
                                    const std::vector<solve::GapLine> &lines)
  {
    const bool any = std::any_of(lines.begin(), lines.end(),
                                 [](const solve::GapLine &line)
                                 { return !line.column.empty(); });
    if (!dealii::Utilities::MPI::logical_or(any, start_.get_mpi_communicator()))
      return;
    substitution_ = std::make_unique<solve::GapSubstitution>(rows, lines);
    substituted_ = start_;
  }

  const la::Matrix &MovingRows::with_geometry(const la::Matrix &matrix)
  {
    if (!has_geometry_)
      return matrix;
    sum_.set(matrix);
    sum_.add(geometry_);
    if (substitution_ != nullptr)
      sum_.add(substitution_->product(sum_.matrix()));
    return sum_.matrix();
  }

  la::Vector MovingRows::with_geometry(const la::Vector &residual)
  {
    if (!has_moved_)
      return residual;
    if (moved_ == nullptr)
    {
      const dealii::IndexSet owned = start_.locally_owned_elements();
      dealii::IndexSet ghosts(owned.size());
      for (const auto row : geometry_.row)
        if (!owned.is_element(row))
          ghosts.add_index(row);
      ghosts.compress();
      moved_ = std::make_unique<la::Matrix>(
          la::assemble(owned, ghosts, start_.get_mpi_communicator(),
                       [&](const auto &visit) { geometry_.for_each(visit); }));
    }
    la::Vector way(present_), result(residual);
    way -= start_;
    moved_->vmult_add(result, way);
    return result;
  }

  void MovingRows::apply_substitution(la::Vector &increment)
  {
    if (substitution_ == nullptr)
      return;
    increment_ = increment;
    substitution_->apply(increment);
  }

  const la::Vector &
  MovingRows::linear_displacement(const la::Vector &displacement)
  {
    if (increment_.size() == 0) // the host has solved by itself
      return displacement;
    return substituted_ += increment_;
  }

  void MovingRows::add_changes(const PartnerChanges &changes)
  {
    changes_.lost = std::max(changes_.lost, changes.lost);
    changes_.jumped = std::max(changes_.jumped, changes.jumped);
  }
} // namespace abut::shim

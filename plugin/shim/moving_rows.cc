// SPDX-License-Identifier: LGPL-2.1-or-later
#include "moving_rows.h"

#include <algorithm>

namespace abut::shim
{
  void MovingRows::clear()
  {
    geometry_.reset();
    substitution_.reset();
    increment_ = la::Vector();
    changes_ = PartnerChanges();
  }

  void MovingRows::set_geometry(const std::vector<MatrixLine> &lines,
                                const la::Vector &start)
  {
    const dealii::IndexSet owned = start.locally_owned_elements();
    dealii::IndexSet ghosts(owned.size());
    for (const MatrixLine &line : lines)
      if (!owned.is_element(line.row))
        ghosts.add_index(line.row);
    ghosts.compress();
    geometry_ = std::make_unique<la::Matrix>(
        la::assemble(owned, ghosts, start.get_mpi_communicator(),
                     [&](const auto &visit)
                     {
                       for (const MatrixLine &line : lines)
                         visit(line.row, line.column, line.value);
                     }));
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
    if (geometry_ == nullptr)
      return matrix;
    sum_ = std::make_unique<la::Matrix>(la::sum(matrix, *geometry_));
    if (substitution_ != nullptr)
      sum_ = std::make_unique<la::Matrix>(
          la::sum(*sum_, substitution_->product(*sum_)));
    return *sum_;
  }

  la::Vector MovingRows::with_geometry(const la::Vector &residual) const
  {
    if (geometry_ == nullptr)
      return residual;
    la::Vector way(present_), result(residual);
    way -= start_;
    geometry_->vmult_add(result, way);
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

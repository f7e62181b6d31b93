// SPDX-License-Identifier: LGPL-2.1-or-later
#include "condensate_solver.h"

namespace abut::solve
{
  void CondensateSolver::take(const Stiffness &stiffness,
                              const PointOperator &rows)
  {
    rows_ = &rows;
    diagonal_ = stiffness.diagonal();
    matrix_.reinit(stiffness, rows);
  }

  std::vector<double> CondensateSolver::softness() const
  {
    la::Vector springs(rows_->owned(), rows_->communicator());
    rows_->add_squares(matrix_.condensate().stiffness.data(), springs);
    std::vector<double> result(diagonal_.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = diagonal_[i] / (diagonal_[i] + la::data(springs)[i]);
    return result;
  }

  double CondensateSolver::load(const la::Vector &rhs) const
  {
    const std::vector<double> soft = softness();
    la::Vector force(rhs);
    for (std::size_t i = 0; i < soft.size(); ++i)
      la::data(force)[i] *= soft[i] * soft[i];
    return force.l2_norm();
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_problem.h"

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Times that gaps of a step are changed, and those after which they are
     * lowered only, so that there is an end. */
    constexpr unsigned int most_raises = 10, free_raises = 7;

    /** Distances from which on surfaces are apart: of a facet, and of the
     * displacement, whose round-off gaps have. */
    constexpr double apart_part = 1e-6, round_off = 1e-9;

    /** Where a pair touches elsewhere, also of what bodies are deformed by:
     * rows at the rim of contact may be apart by less. */
    constexpr double visible_part = 0.02;

    /** Part of their force that rows keep which are closed rightly. */
    constexpr double kept_part = 0.6;
  } // namespace

  template <int dim> void GapRaises<dim>::clear()
  {
    of_.clear();
    unopened_.clear();
    n_ = 0;
    before_opening_ = la::Vector();
    is_final_ = false;
  }

  template <int dim> bool GapRaises<dim>::raise(const la::Vector &displacement)
  {
    const ContactProblem<dim> &i = problem_;
    if (i.surfaces == nullptr || !i.is_started || !i.surfaces->moves()
        || is_final_)
      return false;
    bool any = !of_.empty();
    for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
      any = any || presses(row);
    return MPI::logical_or(any, i.communicator)
           && (change(displacement) || open(displacement));
  }

  template <int dim> bool GapRaises<dim>::change(const la::Vector &displacement)
  {
    if (n_ == most_raises)
      return false;
    const ContactProblem<dim> &i = problem_;
    const double least = least_clearance(displacement);
    std::vector<int> moving;
    for (const SurfacePair<dim> &pair : i.surfaces->set().pairs())
      moving.push_back(pair.has_current_points());
    const std::vector<double> clearance = clearances(
        i.surfaces->points(),
        i.surfaces->points().displacements_in_reach(displacement), moving);
    const std::vector<int> pair_of = i.surfaces->points().row_pairs();
    std::vector<int> touches(i.input.pairs.size(), 0);
    const int n = i.rows.coefficients.n_rows();
    for (int row = 0; row < n; ++row)
      if (clearance[row] <= least)
        touches[pair_of[row]] = 1;
    MPI::max(touches, i.communicator, touches);
    const double visible =
        std::max(least, visible_part * i.scales.deformation(displacement));
    std::vector<abut_gap_raise> amounts(n);
    std::vector<double> apart(n);
    std::vector<std::uint8_t> pressing(n);
    for (int row = 0; row < n; ++row)
    {
      const auto it = of_.find(i.rows.coefficients.ids()[row]);
      amounts[row] = it == of_.end() ? abut_gap_raise() : it->second;
      apart[row] = touches[pair_of[row]] == 0 ? least : visible;
      pressing[row] = presses(row);
    }
    const abut_raised_rows rows = {sizeof(rows),       n,
                                   clearance.data(),   i.rows.gap.data(),
                                   i.request.pressure, pressing.data(),
                                   apart.data(),       least,
                                   n_ >= free_raises};
    std::int32_t n_changed = 0;
    check(i.context.get(),
          abut_gap_raise_renew(&rows, amounts.data(), &n_changed));
    if (!MPI::logical_or(n_changed > 0, i.communicator))
      return false;
    for (int row = 0; row < n; ++row)
      if (amounts[row].value > 0. || amounts[row].before > 0.)
        of_[i.rows.coefficients.ids()[row]] = amounts[row];
    if (n_++ == 0)
    {
      touches_ = touches;
      force_ = force_without_touch();
    }
    return true;
  }

  template <int dim> double GapRaises<dim>::force_without_touch() const
  {
    const ContactProblem<dim> &i = problem_;
    const std::vector<int> pair_of = i.surfaces->points().row_pairs();
    double sum = 0.;
    for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
      if (presses(row) && touches_[pair_of[row]] == 0)
        sum += i.request.pressure[row];
    return MPI::sum(sum, i.communicator);
  }

  template <int dim> bool GapRaises<dim>::open(const la::Vector &displacement)
  {
    const ContactProblem<dim> &i = problem_;
    if (n_ == 0 || before_opening_.size() > 0)
      return false;
    const double force = force_without_touch();
    if (force == 0. || (force > kept_part * force_ && !has_ended_early()))
      return false;
    unopened_ = of_;
    values_ = i.row_values();
    before_opening_ = displacement;
    const std::vector<int> pair_of = i.surfaces->points().row_pairs();
    for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
      if (presses(row) && touches_[pair_of[row]] == 0)
      {
        abut_gap_raise &amount = of_[i.rows.coefficients.ids()[row]];
        amount = {amount.value + i.surfaces->set().facet_size(), amount.value,
                  0., i.request.pressure[row]};
      }
    n_ = 1;
    return true;
  }

  template <int dim>
  bool GapRaises<dim>::limit(la::Vector &displacement, RowValues &values)
  {
    if (before_opening_.size() == 0 || is_final_)
      return false;
    is_final_ = true;
    of_ = unopened_;
    displacement = before_opening_;
    values = values_;
    return true;
  }

  template <int dim> bool GapRaises<dim>::has_ended_early() const
  {
    return n_ >= free_raises;
  }

  template <int dim>
  double GapRaises<dim>::least_clearance(const la::Vector &displacement) const
  {
    return std::max(apart_part * problem_.surfaces->set().facet_size(),
                    round_off * displacement.linfty_norm());
  }

  template <int dim> bool GapRaises<dim>::presses(const int row) const
  {
    const ContactProblem<dim> &i = problem_;
    return !i.rows.coefficients.is_tangent(row)
           && i.request.state[row] != ABUT_STATE_OPEN
           && i.request.pressure[row] > 0.;
  }

  template <int dim>
  void GapRaises<dim>::add_to(const solve::PointOperator &rows,
                              std::vector<double> &gaps) const
  {
    for (int row = 0; row < rows.n_rows() && !of_.empty(); ++row)
      if (const auto it = of_.find(rows.ids()[row]); it != of_.end())
        gaps[row] += it->second.value;
  }

  template class GapRaises<2>;
  template class GapRaises<3>;
} // namespace abut::shim

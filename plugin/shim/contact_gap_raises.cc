// SPDX-License-Identifier: LGPL-2.1-or-later
// Gaps of rows that press where surfaces are apart: dual functions, negative on
// a part of each facet, make the weighted gap W of mortar less than the least
// gap m around the row. The law of such a row is that of max(W, m), by a
// constant c = max(0, m - W) that is added to W and renewed between solves:
// derivatives, forces and symmetry are those of W. Where a pair touches
// nowhere, W and m at a displacement by false forces are far from those without
// forces: its rows are opened altogether at first, unless nothing else then
// holds a body.
#include "contact_implementation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut
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
  } // namespace

  template <int dim>
  bool ContactAssembler<dim>::Implementation::raise_gaps(
      const la::Vector &displacement)
  {
    if (surfaces == nullptr || !is_started || !surfaces->moves()
        || raises.n == most_raises)
      return false;
    bool any = false;
    for (int row = 0; row < coefficients.n_rows(); ++row)
      any = any || presses(row) || raises.of.count(coefficients.ids()[row]) > 0;
    if (!MPI::logical_or(any, communicator))
      return false;
    const double least = least_clearance(displacement);
    const std::vector<double> clearance = shim::clearances(
        surfaces->points(),
        surfaces->points().displacements_in_reach(displacement), true);
    const std::vector<int> pair_of = surfaces->points().row_pairs();
    std::vector<int> touches(pairs.size(), 0);
    for (int row = 0; row < coefficients.n_rows(); ++row)
      if (clearance[row] <= least)
        touches[pair_of[row]] = 1;
    MPI::max(touches, communicator, touches);
    const double visible =
        std::max(least, visible_part * deformation(displacement));
    bool changed = false, opens = false;
    for (int row = 0; row < coefficients.n_rows(); ++row)
    {
      const double m = clearance[row];
      if (coefficients.is_tangent(row) || !std::isfinite(m))
        continue;
      const auto it = raises.of.find(coefficients.ids()[row]);
      const shim::GapRaise before =
          it == raises.of.end() ? shim::GapRaise() : it->second;
      const bool is_raised = before.value > 0.,
                 is_false =
                     presses(row)
                     && m > (is_raised || touches[pair_of[row]] == 0 ? least
                                                                     : visible),
                 is_late = is_raised && m < -least;
      if (!is_late && !(is_false && raises.n < free_raises))
        continue;
      const double wanted = is_false ? before.more(m, request.pressure[row])
                                     : before.less(m, gap[row], presses(row));
      if (std::abs(wanted - before.value) <= least)
        continue;
      shim::GapRaise &raise = raises.of[coefficients.ids()[row]];
      raise = {wanted, before.value, m, request.pressure[row]};
      if (raises.n == 0)
        raises.unopened[coefficients.ids()[row]] = raise;
      if (raises.n == 0 && touches[pair_of[row]] == 0)
      {
        raise.value += surfaces->set().facet_size();
        opens = true;
      }
      changed = true;
    }
    if (!MPI::logical_or(changed, communicator))
      return false;
    if (raises.n++ == 0)
    {
      raises.before = row_values();
      raises.may_limit = MPI::logical_or(opens, communicator);
    }
    compute_gap(displacement);
    return true;
  }

  template <int dim>
  bool ContactAssembler<dim>::Implementation::limit_raises(
      const la::Vector &displacement)
  {
    if (!std::exchange(raises.may_limit, false))
      return false;
    raises.of = raises.unopened;
    move_rows(displacement, raises.before);
    is_started = false;
    return true;
  }

  template <int dim>
  bool ContactAssembler<dim>::Implementation::raises_end_early() const
  {
    return raises.n >= free_raises;
  }

  template <int dim>
  double ContactAssembler<dim>::Implementation::least_clearance(
      const la::Vector &displacement) const
  {
    return std::max(apart_part * surfaces->set().facet_size(),
                    round_off * displacement.linfty_norm());
  }

  template <int dim>
  bool ContactAssembler<dim>::Implementation::presses(const int row) const
  {
    return !coefficients.is_tangent(row)
           && request.state[row] != ABUT_STATE_OPEN
           && request.pressure[row] > 0.;
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::add_raises(
      const solve::PointOperator &rows, std::vector<double> &gaps) const
  {
    for (int row = 0; row < rows.n_rows() && !raises.of.empty(); ++row)
      if (const auto it = raises.of.find(rows.ids()[row]);
          it != raises.of.end())
        gaps[row] += it->second.value;
  }

  template <int dim>
  bool
  ContactAssembler<dim>::raise_gaps(const la::VectorView &given_displacement)
  {
    Implementation &i = *implementation;
    i.check_rows("raise_gaps()");
    return i.raise_gaps(
        i.host.vector("raise_gaps()", "displacement", given_displacement));
  }

  template <int dim>
  bool
  ContactAssembler<dim>::limit_raises(const la::VectorView &given_displacement)
  {
    Implementation &i = *implementation;
    i.check_rows("limit_raises()");
    return i.limit_raises(
        i.host.vector("limit_raises()", "displacement", given_displacement));
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template bool ContactAssembler<dim>::Implementation::raise_gaps(             \
      const la::Vector &);                                                     \
  template bool ContactAssembler<dim>::Implementation::limit_raises(           \
      const la::Vector &);                                                     \
  template bool ContactAssembler<dim>::Implementation::presses(int) const;     \
  template bool ContactAssembler<dim>::Implementation::raises_end_early()      \
      const;                                                                   \
  template double ContactAssembler<dim>::Implementation::least_clearance(      \
      const la::Vector &) const;                                               \
  template void ContactAssembler<dim>::Implementation::add_raises(             \
      const solve::PointOperator &, std::vector<double> &) const;              \
  template bool ContactAssembler<dim>::raise_gaps(const la::VectorView &);     \
  template bool ContactAssembler<dim>::limit_raises(const la::VectorView &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut

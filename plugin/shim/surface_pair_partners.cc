// SPDX-License-Identifier: LGPL-2.1-or-later
// Reference of slips of mortar that moves: the points that were opposite each
// other at the last commit(). With their coefficients c, tangent t and places x
// at that time and t', x' now, the slip is
//
//     s = t' . sum c x' - t . sum c x ,
//
// which is 0 where both bodies rotate as one, and whose derivative is t' . sum
// c v where the bodies are opposite each other. Coefficients of now would
// change with the opposite points of what is not in contact yet, where a facet
// is next to a corner.
//
// They are found by making the points at that place once more, so that nothing
// need be kept by a checkpoint or sent where cells go.
#include "surface_pair_rows.h"

#include <utility>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  template <int dim>
  bool SurfacePairRows<dim>::has_partners(const Pair &pair) const
  {
    return pair.has_current_directions() && pair.data.friction != nullptr
           && discretisation_info(pair.discretisation).is_weighted;
  }

  template <int dim>
  void SurfacePairRows<dim>::find_partners(const std::vector<Direction> &u)
  {
    if (std::none_of(pairs_.begin(), pairs_.end(),
                     [&](const Pair &pair) { return has_partners(pair); }))
      return;
    if (!MPI::logical_or(u != partners_place_, communicator_))
      return;
    const SavedPoints kept = save_points();
    const Handle<abut_points> there = create_points(context_, dim);
    const auto find_there = [&]
    {
      points_ = there.get();
      places_.clear();
      checks_.clear();
      record_place(u);
      check(context_, abut_points_get(points_, &view_));
      find_pairs(motions(u));
      // Components are known by their place among those that stay.
      std::vector<std::uint8_t> components(view_.n_components, 1);
      drop_needless(components);
      filter(components);
      record_partners();
    };
    try
    {
      find_there();
    }
    catch (...)
    {
      restore_points(kept);
      throw;
    }
    restore_points(kept);
    partners_place_ = u;
  }

  template <int dim> void SurfacePairRows<dim>::record_partners()
  {
    partners_.clear();
    for_each_row(
        [&](const Component &row)
        {
          if (!is_tangent(row) || !has_partners(pairs_[row.place.pair]))
            return;
          Partners &partners = partners_[view_.component_id[row.row]];
          const auto add = [&](const Node node, const double c)
          {
            partners.stencil.emplace_back(node, c);
            partners.offset += c * (Direction(present_[node]) * row.direction);
          };
          for_each_secondary(row.point, add);
          for_each_primary(row.point, add);
        });
  }

  template <int dim>
  const typename SurfacePairRows<dim>::Partners *
  SurfacePairRows<dim>::partners_of(const Component &row) const
  {
    if (!has_partners(pairs_[row.place.pair]))
      return nullptr;
    const auto found = partners_.find(view_.component_id[row.row]);
    return found == partners_.end() ? nullptr : &found->second;
  }

  template <int dim>
  double SurfacePairRows<dim>::reference_of_slip(const Component &row,
                                                 const Partners &partners) const
  {
    double sum = 0.;
    for (const auto &[node, c] : partners.stencil)
      sum += c * (Direction(present_[node]) * row.direction);
    return sum - partners.offset;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template bool SurfacePairRows<dim>::has_partners(const Pair &) const;        \
  template void SurfacePairRows<dim>::find_partners(                           \
      const std::vector<Direction> &);                                         \
  template void SurfacePairRows<dim>::record_partners();                       \
  template const typename SurfacePairRows<dim>::Partners *                     \
  SurfacePairRows<dim>::partners_of(const Component &) const;                  \
  template double SurfacePairRows<dim>::reference_of_slip(                     \
      const Component &, const Partners &) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

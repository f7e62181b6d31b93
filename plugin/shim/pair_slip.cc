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
#include "pair_slip.h"

#include "pair_detection.h"
#include "pair_friction.h"

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    template <int dim> bool has_partners(const SurfacePair<dim> &pair)
    {
      return pair.has_current_directions() && pair.data.friction != nullptr
             && discretisation_info(pair.discretisation).is_weighted;
    }

    /** The value of a tangent's row that is no slip since then, or since nodes
     * were displaced by @p u, but for obstacles. */
    template <int dim>
    double reference_of_slip(const PairPoints<dim> &points,
                             const PointRow<dim> &row,
                             const CommittedPartners &partners)
    {
      double sum = 0.;
      for (const auto &[node, c] : partners.stencil)
        sum += c * (Direction<dim>(points.present()[node]) * row.direction);
      return sum - partners.offset;
    }

    template <int dim>
    double reference_of_slip(const PairPoints<dim> &points,
                             const PointRow<dim> &row,
                             const std::vector<Direction<dim>> &u)
    {
      // Slips of points that stand elsewhere are 0 there.
      const bool elsewhere = points.pairs()[row.place.pair].is_displaced();
      double sum = 0.;
      points.for_each_node(row.point,
                           [&](const NodeIndex node, const double c)
                           {
                             const Direction<dim> from =
                                 elsewhere ? points.made_at(node)
                                           : Direction<dim>();
                             sum -= c * ((u[node] - from) * row.direction);
                           });
      return sum;
    }

    /** How far supports take a point along a tangent since nodes were displaced
     * by @p u. */
    template <int dim>
    double prescribed_slip(const ContactSurface<dim> &surface,
                           const PointRow<dim> &row, const NodeIndex opposite,
                           const std::vector<Direction<dim>> &u)
    {
      const auto way = [&](const NodeIndex node)
      {
        Direction<dim> now;
        for (unsigned int d = 0; d < dim; ++d)
          now[d] = surface.map.constant(node, d);
        return (now - u[node]) * row.direction;
      };
      return (opposite < 0 ? 0. : way(opposite))
             - way(static_cast<NodeIndex>(row.place.node));
    }
  } // namespace

  template <int dim>
  void PairSlip<dim>::find_partners(PairPoints<dim> &points,
                                    const std::vector<Direction<dim>> &u)
  {
    if (std::none_of(set_.pairs().begin(), set_.pairs().end(),
                     [](const auto &pair) { return has_partners(pair); }))
      return;
    const MPI_Comm communicator = set_.host().communicator;
    if (partners_gathering_ != set_.n_gatherings())
      partners_place_.reset();
    if (!MPI::logical_or(u != partners_place_, communicator))
      return;
    points.origins.clear();
    const Handle<abut_points> core = create_points(set_.host().context, dim);
    PairPoints<dim> then(set_);
    then.start(core.get(), u);
    then.update_view();
    // Bodies are where they were then, whatever supports prescribe by now.
    std::vector<double> motions = set_.motions(u);
    for (std::size_t p = 0; p < motions.size(); ++p)
      if (has_partners(set_.pairs()[p]) && !set_.pairs()[p].data.obstacle)
        motions[p] = 0.;
    PairDetection<dim>(then, false).find(motions);
    // Components are known by their place among those that stay.
    std::vector<std::uint8_t> components(then.view().n_components, 1);
    drop_needless(then, components);
    then.filter(components);
    record_partners(then);
    partners_place_ = u;
    partners_gathering_ = set_.n_gatherings();
  }

  template <int dim>
  void PairSlip<dim>::record_partners(const PairPoints<dim> &then)
  {
    partners_.clear();
    then.for_each_row(
        [&](const PointRow<dim> &row)
        {
          if (!then.is_tangent(row)
              || !has_partners(then.pairs()[row.place.pair]))
            return;
          CommittedPartners &partners =
              partners_[then.view().component_id[row.row]];
          then.for_each_node(
              row.point,
              [&](const NodeIndex node, const double c)
              {
                partners.stencil.emplace_back(node, c);
                partners.offset +=
                    c * (Direction<dim>(then.present()[node]) * row.direction);
              });
        });
  }

  template <int dim>
  const CommittedPartners *
  PairSlip<dim>::partners_of(const PairPoints<dim> &points,
                             const PointRow<dim> &row) const
  {
    if (!has_partners(points.pairs()[row.place.pair]))
      return nullptr;
    const auto found = partners_.find(points.view().component_id[row.row]);
    return found == partners_.end() ? nullptr : &found->second;
  }

  template <int dim>
  RowSource::SlipReference PairSlip<dim>::reference(PairPoints<dim> &points,
                                                    const la::Vector &committed)
  {
    const std::vector<SurfacePair<dim>> &pairs = set_.pairs();
    std::vector<Direction<dim>> u(set_.surface().nodes.size());
    if (committed.size() > 0)
      u = set_.displacements_as_given(committed);
    set_.obstacles().refuse_large_rotations();
    const std::vector<RigidPose<dim>> now = set_.obstacles().now(),
                                      then = set_.obstacles().before(true),
                                      &slide = set_.obstacles().slide();
    find_partners(points, u);
    const std::size_t n = points.view().n_components;
    RowSource::SlipReference result = {std::vector<double>(n, 0.),
                                       std::vector<std::uint8_t>(n, 0)};
    std::vector<std::vector<Direction<dim>>> approach(pairs.size());
    for (std::size_t p = 0; p < approach_.size(); ++p)
      if (approach_[p].size() > 0)
        approach[p] = set_.displacements_as_given(approach_[p]);
    points.for_each_row(
        [&](const PointRow<dim> &row)
        {
          if (!points.is_tangent(row))
            return;
          const std::size_t p = row.place.pair;
          const CommittedPartners *const partners = partners_of(points, row);
          const TangentSupport support = support_of(points, row);
          const bool is_prescribed =
              row.place.node >= 0 && support.kind == ABUT_TANGENT_PRESCRIBED;
          result.is_prescribed[row.row] = is_prescribed;
          result.value[row.row] =
              is_prescribed
                  ? -prescribed_slip(set_.surface(), row, support.opposite, u)
              : partners != nullptr ? reference_of_slip(points, row, *partners)
                                    : reference_of_slip(points, row, u);
          if (!approach[p].empty() && !is_prescribed)
            points.for_each_node(row.point,
                                 [&](const NodeIndex node, const double c) {
                                   result.value[row.row] -=
                                       c * (approach[p][node] * row.direction);
                                 });
          if (pairs[p].data.obstacle == nullptr)
            return;
          dealii::Tensor<1, dim> way = ObstaclePoses<dim>::displacement(
              row.place.position, then[p], now[p]);
          if (p < slide.size())
            way -= ObstaclePoses<dim>::displacement(row.place.position,
                                                    slide[p], then[p]);
          result.value[row.row] -= way * row.direction;
        });
    return result;
  }

  template class PairSlip<2>;
  template class PairSlip<3>;
} // namespace abut::shim

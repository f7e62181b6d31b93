// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether gaps that are added to those of the geometry leave anything that can
// be touched: what is thinner than its gap lets everything through.
#include "pair_set.h"

#include "agree.h"
#include "bodies.h"
#include "self_contact.h"

#include <abut/dealii/rigid_obstacle.h>

#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    std::string nothing_left(const double gap, const std::string &of,
                             const double depth)
    {
      std::ostringstream text;
      text.precision(4);
      text << "its gap of " << gap << " leaves nothing of " << of
           << ", but no point can be deeper than " << depth
           << ": bodies would pass through each other without contact. Make "
              "the gap smaller.";
      return text.str();
    }

    /** How far the bodies of a side reach along its mean normal, in the
     * reference configuration; infinite where a surface has no such normal.
     * Collective. */
    template <int dim>
    double extent_behind(const abut_context *context,
                         const dealii::Mapping<dim> &mapping,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const SurfaceSide<dim> &side,
                         const std::set<dealii::types::boundary_id> &ids)
    {
      constexpr double one_sided = 0.7;
      const MPI_Comm communicator = versions::communicator(dof_handler);
      // Normals of nodes that several ranks know count several times.
      std::vector<double> sum(dim + 1, 0.);
      const double *normal = nullptr;
      check(context, abut_surface_normals(side.surface.get(), &normal));
      for (int n = 0; n < side.n_nodes(); ++n)
      {
        sum[dim] += 1.;
        for (unsigned int d = 0; d < dim; ++d)
          sum[d] += normal[n * dim + d];
      }
      MPI::sum(sum, communicator, sum);
      dealii::Tensor<1, dim> mean;
      for (unsigned int d = 0; d < dim && sum[dim] > 0.; ++d)
        mean[d] = sum[d] / sum[dim];
      if (mean.norm() < one_sided)
        return INFINITY;
      mean /= mean.norm();
      const BodyNumbers<dim> bodies(dof_handler.get_triangulation());
      const std::vector<int> is_meant = bodies_with(dof_handler, bodies, ids);
      double low = INFINITY, high = -INFINITY;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && is_meant[bodies.of(cell)] != 0)
          for (const auto &vertex : mapping.get_vertices(cell))
          {
            low = std::min(low, mean * vertex);
            high = std::max(high, mean * vertex);
          }
      return MPI::max(high, communicator) - MPI::min(low, communicator);
    }

    /** Throw where the gap of a pair leaves nothing of an obstacle or a body.
     * Collective. */
    template <int dim>
    void check_gap(const PairHost<dim> &host, const SurfacePair<dim> &pair)
    {
      const ContactPair<dim> &data = pair.data;
      const auto refuse = [&](const std::string &of, const double depth)
      {
        throw ContactError(about_pair(
            data.name, nothing_left(data.gap, of, depth), PairField::gap));
      };
      if (!(data.gap > 0.) || !data.geometric_gap || data.tied)
        return;
      if (data.obstacle)
      {
        const double depth = data.obstacle->depth();
        if (data.gap >= depth)
          refuse("the obstacle", depth);
        return;
      }
      // Nodes deeper than half of a thin body belong to its other side.
      if (pair.thickness > 0. && data.gap >= pair.thickness / 2.)
        refuse("the thinnest part of the primary's body", pair.thickness / 2.);
      // Parts of one surface have one body, which reaches around what they meet
      // in.
      if (SelfContact<dim>::is_split(data))
        return;
      for (const bool is_primary : {true, false})
      {
        const SurfaceSide<dim> &side =
            is_primary ? pair.primary : pair.secondary;
        const double extent =
            extent_behind(host.context, host.mapping, host.dof_handler, side,
                          is_primary ? data.primary : data.secondary);
        if (data.gap >= extent)
          refuse(is_primary ? "the primary's body" : "the secondary's body",
                 extent);
      }
    }
  } // namespace

  template <int dim> void PairSet<dim>::check_gaps()
  {
    checked_gaps_.resize(pairs_.size(), 0.);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (checked_gaps_[p] != pairs_[p].data.gap)
      {
        check_gap(host_, pairs_[p]);
        checked_gaps_[p] = pairs_[p].data.gap;
      }
  }

  template void PairSet<2>::check_gaps();
  template void PairSet<3>::check_gaps();
} // namespace abut::shim

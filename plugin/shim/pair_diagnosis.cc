// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pair_diagnosis.h"

#include "agree.h"
#include <abut/dealii/coded.h>
#include <abut/pair_checks.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace
  {
    /** A pass over all nodes with a reach that no body exceeds. */
    struct Nearest
    {
      double above = INFINITY; ///< smallest distance of an open node
      double below = INFINITY; ///< smallest depth of a node inside
    };

    template <int dim>
    Nearest nearest(abut_context *context, const SurfaceSide<dim> &secondary,
                    const SurfaceSide<dim> &primary,
                    const SearchParameters &search, const double cosine,
                    const MPI_Comm communicator)
    {
      Nearest result;
      abut_detection_options options = search.detection;
      options.normal_cosine = cosine;
      options.search.reach =
          10. * (secondary.everywhere.extent + primary.everywhere.extent)
          + 1e-30;
      check_everywhere(communicator, context,
                       abut_surface_nearest(context, secondary.surface.get(),
                                            primary.surface.get(), &options,
                                            &result.above, &result.below));
      result.above = dealii::Utilities::MPI::min(result.above, communicator);
      result.below = dealii::Utilities::MPI::min(result.below, communicator);
      return result;
    }

    /** A sentence where sizes show that meshes may have different units. */
    template <int dim>
    std::string other_unit(const SurfaceSide<dim> &secondary,
                           const SurfaceSide<dim> &primary)
    {
      constexpr double different = 100.;
      const double one = secondary.everywhere.extent,
                   other = primary.everywhere.extent;
      const double ratio = std::max(one, other) / std::min(one, other);
      if (!(ratio >= different))
        return "";
      std::ostringstream text;
      text << " The " << (one > other ? "secondary" : "primary")
           << " surface is " << ratio
           << " times as large as the other one: both meshes need the same "
              "unit of length (Mesh/Scale).";
      return text.str();
    }
  } // namespace

  template <int dim>
  Message why_no_rows(abut_context *context, const SurfaceSide<dim> &secondary,
                      const SurfaceSide<dim> &primary,
                      const SearchParameters &search, const double reach,
                      const MPI_Comm communicator)
  {
    const double facing = search.detection.normal_cosine;
    const Nearest opposed =
        nearest(context, secondary, primary, search, facing, communicator);
    abut_failure failure = ABUT_FAILURE_NO_PARTNER;
    std::ostringstream text;
    if (opposed.above <= reach && opposed.above <= opposed.below)
      text << "the surfaces are near each other, the smallest distance is "
           << opposed.above
           << ", but no part of one lies opposite the other: they meet at an "
              "edge or a corner alone. Check the boundary ids and the position "
              "of the bodies.";
    else if (opposed.above < INFINITY && opposed.above <= opposed.below)
      text << "the surfaces are too far apart: the smallest distance is "
           << opposed.above << ", the reach is " << reach
           << ". Move the bodies together, or give the pair a larger reach."
           << other_unit(secondary, primary);
    else if (opposed.below < INFINITY)
    {
      failure = ABUT_FAILURE_OVERLAP;
      text << "the bodies overlap by at least " << opposed.below
           << (opposed.below > reach
                   ? ", more than the reach of "
                   : ", more than half of the body's thickness, or at an edge "
                     "or a corner only, within the reach of ")
           << reach
           << ". Check the boundary ids, as the far sides of two bodies look "
              "like this. If they do overlap, move them apart, or give the "
              "pair a larger reach if that is meant as interference."
           << other_unit(secondary, primary);
    }
    else
    {
      const Nearest any =
          nearest(context, secondary, primary, search, 1., communicator);
      if (std::min(any.above, any.below) < INFINITY)
      {
        failure = ABUT_FAILURE_WRONG_SIDE;
        text << "the outward normals of the two surfaces point in the same "
                "direction. Use the sides that face each other, or repair the "
                "mesh with inverted cells.";
      }
      else
        text << "no point of one surface lies opposite the other. Check the "
                "boundary ids and the position of the bodies."
             << other_unit(secondary, primary);
    }
    return coded(failure, text.str());
  }

  template Message why_no_rows(abut_context *, const SurfaceSide<2> &,
                               const SurfaceSide<2> &, const SearchParameters &,
                               double, MPI_Comm);
  template Message why_no_rows(abut_context *, const SurfaceSide<3> &,
                               const SurfaceSide<3> &, const SearchParameters &,
                               double, MPI_Comm);
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// The table of what is measured of a pair.
#include "pair_measures.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace abut
{
  template <int dim> const std::vector<PairMeasure<dim>> &pair_measures()
  {
    using R = PairResult<dim>;
    constexpr auto sum = Reduction::sum, maximum = Reduction::maximum,
                   minimum = Reduction::minimum;
    constexpr auto all = ReportedOf::all_pairs, friction = ReportedOf::friction,
                   none = ReportedOf::none;
    static const std::vector<PairMeasure<dim>> table = {
        {"rows", &R::n_rows, sum, all, "", "constraint rows"},
        {"active", &R::n_active, sum, all, "", "points in contact"},
        {"covered_area", &R::covered_area, sum, all, "area",
         "covered part of the secondary surface"},
        {"contact_area", &R::contact_area, sum, all, "area",
         "part of the surface in contact"},
        {"force", &R::secondary_force, sum, all, "force",
         "resultant on the secondary"},
        {"primary_force", &R::primary_force, sum, all, "force",
         "resultant on the primary"},
        {"initial_gap_work", &R::initial_gap_work, sum, all, "energy",
         "work of the contact forces on the gaps at displacement 0"},
        {"pressure", &R::pressure, maximum, all, "pressure",
         "largest pressure"},
        {"least_pressure", &R::least_pressure, minimum, all, "pressure",
         "smallest pressure of the closed points"},
        {"largest_tension", &R::largest_tension, maximum, all, "pressure",
         "largest tension"},
        {"penetration", &R::penetration, maximum, all, "length",
         "largest penetration"},
        {"between_rows", &R::between_rows, maximum, all, "length",
         "depth of the other body between constraints"},
        {"held_inside", &R::held_inside, maximum, all, "length",
         "depth of nodes with prescribed displacement inside the other body"},
        {"slip", &R::slip, maximum, all, "length",
         "largest relative tangential displacement of an active constraint"},
        {"gap_error", &R::gap_error, maximum, all, "length",
         "largest difference between the gap of an active constraint and the "
         "distance of its node"},
        {"turn", &R::rotation, maximum, all, "radian",
         "mean rotation of the normals at constraints with pressure"},
        {"oscillation", &R::oscillation, maximum, all, "",
         "part of the pressure that alternates from node to node"},
        {"slipping", &R::n_slipping, sum, friction, "", "rows that slip"},
        {"normal_force", &R::normal_force, sum, friction, "force",
         "sum of the pressures"},
        {"late_force", &R::late_force, sum, friction, "force",
         "pressures of slipping points that were open at the start of the "
         "step"},
        {"friction_force", &R::friction_force, sum, friction, "force",
         "sum of the magnitudes of the tangential tractions"},
        {"friction", &R::secondary_friction, sum, friction, "force",
         "resultant of the tangential tractions on the secondary"},
        {"traction", &R::traction, maximum, friction, "pressure",
         "largest tangential traction"},
        {"dissipation", &R::dissipation, sum, friction, "energy",
         "dissipated by friction in the last step"},
        {"prescribed_nodes", &R::n_prescribed, sum, friction, "",
         "nodes with a prescribed normal displacement"},
        {"shared_stick_force", &R::shared_stick_force, sum, none, "force",
         "pressures of sticking points that share their node with another "
         "contact"},
        {"largest_turn", &R::largest_rotation, maximum, none, "radian",
         "largest rotation of the normals"},
        {"missed_depth", &R::missed_depth, maximum, none, "length",
         "depth of the obstacle in facets without contact"},
        {"secondary_moment", &R::secondary_moment, sum, none, "moment",
         "moment on the secondary about the origin"},
        {"primary_moment", &R::primary_moment, sum, none, "moment",
         "moment on the primary"},
        {"present_moment", &R::present_moment, sum, none, "moment",
         "moment on the secondary in the current configuration"},
        {"present_primary_moment", &R::present_primary_moment, sum, none,
         "moment", "moment on the primary in the current configuration"}};
    return table;
  }

  namespace
  {
    /** Calls @p visit for each number of a quantity. */
    template <int dim, typename Result, typename Visit>
    void visit_numbers(const PairMeasure<dim> &measure, Result &result,
                       const Visit &visit)
    {
      std::visit(
          [&](const auto member)
          {
            auto &value = result.*member;
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_arithmetic_v<Value>)
              visit(value);
            else
              for (unsigned int d = 0; d < Value::dimension; ++d)
                visit(value[d]);
          },
          measure.value);
    }
  } // namespace

  template <int dim>
  void shim::reduce(std::vector<PairResult<dim>> &results,
                    const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    const auto visit_all = [&](const auto &visit)
    {
      for (PairResult<dim> &result : results)
        for (const PairMeasure<dim> &measure : pair_measures<dim>())
          visit_numbers(measure, result,
                        [&](auto &value) { visit(value, measure.reduction); });
    };
    // The minimum is minus the maximum of the negative.
    const auto sign = [](const Reduction reduction)
    { return reduction == Reduction::minimum ? -1. : 1.; };
    std::vector<double> sums, maxima;
    visit_all(
        [&](const auto &value, const Reduction reduction)
        {
          auto &list = reduction == Reduction::sum ? sums : maxima;
          list.push_back(sign(reduction) * static_cast<double>(value));
        });
    MPI::sum(sums, communicator, sums);
    MPI::max(maxima, communicator, maxima);
    auto sum = sums.cbegin();
    auto maximum = maxima.cbegin();
    visit_all(
        [&](auto &value, const Reduction reduction)
        {
          auto &next = reduction == Reduction::sum ? sum : maximum;
          value = static_cast<std::decay_t<decltype(value)>>(sign(reduction)
                                                             * *next++);
        });
  }

  template const std::vector<PairMeasure<2>> &pair_measures<2>();
  template const std::vector<PairMeasure<3>> &pair_measures<3>();
  template void shim::reduce(std::vector<PairResult<2>> &, MPI_Comm);
  template void shim::reduce(std::vector<PairResult<3>> &, MPI_Comm);
} // namespace abut

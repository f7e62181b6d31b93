// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mass_row.h"

#include "shim/handles.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>

namespace abut::app
{
  namespace
  {
    /** Springs along the row and, of a bar, consistent masses. */
    void add_element(MassSystem &system, const MassRow &row,
                     const std::size_t first, const double spring)
    {
      const unsigned int dim = row.dimension;
      const std::size_t size = system.size();
      // Along the plane in the directions that lie in it, or upright.
      const unsigned int n_along = dim == 1 ? 1 : dim - 1;
      for (std::size_t i = first; i < first + 2 && i < row.n; ++i)
        for (std::size_t j = first; j < first + 2 && j < row.n; ++j)
          for (unsigned int d = 0; d < dim; ++d)
          {
            const std::size_t at = (i * dim + d) * size + j * dim + d;
            if (d < n_along)
              system.stiffness[at] += i == j ? spring : -spring;
            if (row.is_bar)
              system.mass[at] += row.mass * (i == j ? 2. : 1.) / 6.;
          }
    }

    /** Of a fixed end's element, the part of the free node. */
    double share_of_elements(const MassRow &row, const std::size_t i)
    {
      const double left = i > 0 ? 0.5 : 0.,
                   right = i + 1 < row.n || row.fixed_end ? 0.5 : 0.;
      return row.is_bar ? (left + right) * row.mass : row.mass;
    }
  } // namespace

  void declare_row(dealii::ParameterHandler &prm, const std::string &spring)
  {
    parameter::declare(prm, "Spacing", "1", NumberPattern::positive(),
                       parameter::basic("length", "0.5"),
                       "Distance between neighbours. Formulas see mass i, "
                       "counted from 0, at x = i times this distance.");
    parameter::declare(prm, "Spring", spring, NumberPattern::from(0),
                       parameter::basic("force/length", "100"),
                       "Stiffness of the springs between neighbours along the "
                       "row, in 3D the same along x and y; linear.");
    parameter::declare(prm, "Wall spring", "0", NumberPattern::from(0),
                       parameter::advanced("force/length", "10"),
                       "Stiffness of the spring between the last mass and a "
                       "wall, along the row. 0: no spring.");
  }

  MassSystem::MassSystem(const MassRow &row)
      : dimension(row.dimension),
        n(row.n),
        is_bar(row.is_bar),
        stiffness(size() * size(), 0.),
        mass(size() * size(), 0.),
        massless(size(), 0)
  {
    for (std::size_t i = 0; i + 1 < n; ++i)
      add_element(*this, row, i, row.spring);
    if (row.fixed_end)
      add_element(*this, row, n - 1, row.spring);
    for (std::size_t i = 0; i < n; ++i)
      share.push_back(share_of_elements(row, i));
    for (unsigned int d = 0; d < (dimension == 1 ? 1 : dimension - 1); ++d)
    {
      const std::size_t last = (n - 1) * dimension + d;
      stiffness[last * size() + last] += row.wall_spring;
    }
    if (!is_bar)
      lump();
    for (std::size_t i = 0; i < (dimension == 1 ? 1 : n); ++i)
      candidates.push_back(i);
  }

  void MassSystem::lump()
  {
    mass.assign(size() * size(), 0.);
    for (std::size_t k = 0; k < size(); ++k)
      mass[k * (size() + 1)] = share[k / dimension];
  }

  std::string MassSystem::hand_on(const abut_mass_rule rule)
  {
    // A bar, one unknown for each node.
    std::vector<std::int64_t> start = {0};
    std::vector<std::int32_t> column;
    std::vector<double> value, place;
    for (std::size_t i = 0; i < n; ++i)
    {
      place.push_back(static_cast<double>(i));
      for (std::size_t j = i > 0 ? i - 1 : 0; j < n && j <= i + 1; ++j)
      {
        column.push_back(static_cast<std::int32_t>(j));
        value.push_back(mass[i * n + j]);
      }
      start.push_back(static_cast<std::int64_t>(column.size()));
    }
    std::vector<std::uint8_t> candidate(n, 0);
    for (const std::size_t i : candidates)
      massless[i] = candidate[i] = 1;
    const abut_mass_matrix matrix = {sizeof(matrix),
                                     static_cast<std::int32_t>(n),
                                     1,
                                     start.data(),
                                     column.data(),
                                     value.data(),
                                     place.data()};
    const auto context = shim::create_context();
    const abut_status status =
        abut_mass_modify(context.get(), &matrix, candidate.data(), rule);
    if (status != ABUT_SUCCESS)
      return shim::core_message(context.get());
    for (std::size_t i = 0; i < n; ++i)
      for (std::int64_t e = start[i]; e < start[i + 1]; ++e)
        mass[i * n + column[e]] = value[e];
    return "";
  }

  std::string MassSystem::use_mass(const abut_time_mass kind,
                                   const abut_mass_rule rule)
  {
    if (kind == ABUT_TIME_MASS_LUMPED)
      lump();
    if (kind == ABUT_TIME_MASS_MODIFIED && !is_bar)
      return "every mass of this row may touch the plane, and no neighbour can "
             "receive its mass";
    return kind == ABUT_TIME_MASS_MODIFIED ? hand_on(rule) : "";
  }
} // namespace abut::app

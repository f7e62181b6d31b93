// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flag_fraction.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_refinement.h>

namespace abut::app
{
  namespace
  {
    /** A value of each own cell, of all cells. Collective. */
    template <int dim, class Value>
    std::vector<double> gather_values(const dealii::Triangulation<dim> &mesh,
                                      const Value &value)
    {
      std::vector<double> mine(mesh.n_active_cells(), 0.), all(mine);
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          mine[cell->active_cell_index()] = value(cell);
      dealii::Utilities::MPI::sum(mine, versions::communicator(mesh), all);
      return all;
    }
  } // namespace

  template <int dim>
  void flag_fraction(const dealii::Vector<float> &values, const double fraction,
                     dealii::Triangulation<dim> &mesh)
  {
    const std::vector<double> all =
        gather_values(mesh, [&](const auto &cell)
                      { return double(values(cell->active_cell_index())); });
    dealii::GridRefinement::refine_and_coarsen_fixed_fraction(
        mesh, dealii::Vector<float>(all.begin(), all.end()), fraction, 0.);
  }

  template <int dim>
  std::vector<bool> gather_flags(const dealii::Triangulation<dim> &mesh)
  {
    const std::vector<double> all =
        gather_values(mesh, [](const auto &cell)
                      { return cell->refine_flag_set() ? 1. : 0.; });
    std::vector<bool> result;
    for (const double flag : all)
      result.push_back(flag > 0.);
    return result;
  }

  template void flag_fraction(const dealii::Vector<float> &, double,
                              dealii::Triangulation<2> &);
  template void flag_fraction(const dealii::Vector<float> &, double,
                              dealii::Triangulation<3> &);
  template std::vector<bool> gather_flags(const dealii::Triangulation<2> &);
  template std::vector<bool> gather_flags(const dealii::Triangulation<3> &);
} // namespace abut::app

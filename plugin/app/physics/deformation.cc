// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation.h"

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace abut::app
{
  namespace
  {
    /** The largest value and the largest negative one, by body and component,
     * one after the other. */
    template <int dim>
    std::vector<double> ranges(const dealii::DoFHandler<dim> &dof_handler,
                               const unsigned int n_bodies, const la::Vector &u)
    {
      const auto &fe = dof_handler.get_fe();
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      const double *values = la::data(u);
      std::vector<double> result(2 * dim * n_bodies,
                                 -std::numeric_limits<double>::infinity());
      std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
      // An unknown of this rank may lie on ghost cells only.
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (owned.is_element(dofs[i]))
          {
            const double value = values[owned.index_within_set(dofs[i])];
            double *range = result.data()
                            + 2
                                  * (dim * cell->material_id()
                                     + fe.system_to_component_index(i).first);
            range[0] = std::max(range[0], value);
            range[1] = std::max(range[1], -value);
          }
      }
      return result;
    }
  } // namespace

  template <int dim>
  double deformation(const dealii::DoFHandler<dim> &dof_handler,
                     const unsigned int n_bodies, const la::Vector &u)
  {
    std::vector<double> range = ranges(dof_handler, n_bodies, u);
    dealii::Utilities::MPI::max(range, dof_handler.get_communicator(), range);
    double sum = 0.;
    for (unsigned int body = 0; body < n_bodies; ++body)
    {
      double square = 0.;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double *ends = range.data() + 2 * (dim * body + d);
        square += (ends[0] + ends[1]) * (ends[0] + ends[1]);
      }
      sum += std::sqrt(square);
    }
    return std::min(sum, u.linfty_norm());
  }

  template double deformation(const dealii::DoFHandler<2> &, unsigned int,
                              const la::Vector &);
  template double deformation(const dealii::DoFHandler<3> &, unsigned int,
                              const la::Vector &);
} // namespace abut::app

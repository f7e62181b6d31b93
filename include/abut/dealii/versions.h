/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_DEALII_VERSIONS_H
#define ABUT_DEALII_VERSIONS_H

/** @file
 * Differences between the versions of deal.II from 9.4 to 9.8. Everything else
 * calls these functions, so that nothing deprecated is called where a successor
 * exists.
 */

#include <abut/dealii/solution_transfer.h>

#include <deal.II/base/config.h>
#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <map>
#include <vector>

/** Functions that depend on the version of deal.II. */
namespace abut::versions
{
  /** Communicator of a Triangulation or DoFHandler. */
  template <typename Mesh> MPI_Comm communicator(const Mesh &mesh)
  {
#if DEAL_II_VERSION_GTE(9, 7, 0)
    return mesh.get_mpi_communicator();
#else
    return mesh.get_communicator();
#endif
  }

  /** Make constraints empty, with lines for the unknowns @p relevant. */
  inline void reinit(dealii::AffineConstraints<double> &constraints,
                     const dealii::IndexSet &owned,
                     const dealii::IndexSet &relevant)
  {
#if DEAL_II_VERSION_GTE(9, 6, 0)
    constraints.reinit(owned, relevant);
#else
    (void)owned;
    constraints.reinit(relevant);
#endif
  }

  /** The numbers in a set, ascending. */
  inline std::vector<dealii::types::global_dof_index>
  indices(const dealii::IndexSet &set)
  {
#if DEAL_II_VERSION_GTE(9, 5, 0)
    return set.get_index_vector();
#else
    std::vector<dealii::types::global_dof_index> result;
    set.fill_index_vector(result);
    return result;
#endif
  }

  /** Support points of the unknowns that this rank knows. */
  template <int dim>
  std::map<dealii::types::global_dof_index, dealii::Point<dim>>
  support_points(const dealii::Mapping<dim> &mapping,
                 const dealii::DoFHandler<dim> &dof_handler)
  {
#if DEAL_II_VERSION_GTE(9, 5, 0)
    return dealii::DoFTools::map_dofs_to_support_points(mapping, dof_handler);
#else
    std::map<dealii::types::global_dof_index, dealii::Point<dim>> result;
    dealii::DoFTools::map_dofs_to_support_points(mapping, dof_handler, result);
    return result;
#endif
  }
} // namespace abut::versions

#endif

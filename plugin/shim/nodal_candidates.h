/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SHIM_NODAL_CANDIDATES_H
#define ABUT_SHIM_NODAL_CANDIDATES_H

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <set>
#include <vector>

namespace abut::shim
{
  /** The unknowns of a scalar field on this rank that may come into contact:
   * owned support points in the domain or on given boundary ids. */
  template <int dim> struct NodalCandidates
  {
    /** An unknown with its place. */
    struct Node
    {
      dealii::types::global_dof_index dof;
      dealii::Point<dim> point;
      /** Integral of the shape function over domain or boundary; hanging
       * nodes hand theirs to their parents. */
      double weight;
    };

    /** Unconstrained nodes, sorted by unknown. */
    std::vector<Node> free;

    /** Nodes with a prescribed value, sorted by unknown; their rows are left
     * out, their values must respect the obstacle. */
    std::vector<Node> prescribed;
  };

  /** Collect the candidates. @p boundary_ids empty: the whole domain.
   * Collective; one pass over the locally owned cells. */
  template <int dim>
  NodalCandidates<dim> collect_nodal_candidates(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints,
      const std::set<dealii::types::boundary_id> &boundary_ids);
} // namespace abut::shim

#endif

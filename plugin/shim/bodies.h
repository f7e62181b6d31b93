// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_BODIES_H
#define ABUT_SHIM_BODIES_H

#include "solve/near_null_space.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <set>
#include <vector>

namespace abut::shim
{
  /** The connected parts of a mesh, in the order of its coarse cells; the same
   * on all ranks. */
  template <int dim> class BodyNumbers
  {
  public:
    using Cell = typename dealii::Triangulation<dim>::cell_iterator;

    /** Collective for meshes of which ranks know some coarse cells only. */
    explicit BodyNumbers(const dealii::Triangulation<dim> &triangulation);

    unsigned int n_bodies() const
    {
      return n_bodies_;
    }

    /** Number of the body of a cell of any level. */
    unsigned int of(Cell cell) const;

  private:
    /** From parts of the coarse cells of this rank to those of all. */
    void unite_ranks(const dealii::Triangulation<dim> &triangulation);

    std::vector<unsigned int> body_; ///< by index of the coarse cell
    unsigned int n_bodies_ = 0;
  };

  /** [bodies] 1: it has a face of these boundary ids, on any rank. Collective.
   */
  template <int dim>
  std::vector<int> bodies_with(const dealii::DoFHandler<dim> &dof_handler,
                               const BodyNumbers<dim> &bodies,
                               const std::set<dealii::types::boundary_id> &ids);

  /** Least extent along an axis of the bodies with faces of these boundary ids,
   * of their vertices, before anything is displaced; infinite without one. One
   * pass over the cells. Collective. */
  template <int dim>
  double least_extent(const dealii::Mapping<dim> &mapping,
                      const dealii::DoFHandler<dim> &dof_handler,
                      const std::set<dealii::types::boundary_id> &ids);

  /** Bodies are the connected parts of the mesh. Component, body and place of
   * each owned unknown of a field with support points. One pass over the
   * cells. Collective. */
  template <int dim>
  solve::NearNullSpace
  make_near_null_space(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler);
} // namespace abut::shim

#endif

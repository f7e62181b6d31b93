// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_VERTEX_TRANSFER_H
#define ABUT_APP_VERTEX_TRANSFER_H

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace abut::app
{
  /** Fields of linear elements on a mesh that is only refined, on one rank:
   * values at vertices stay, and new vertices get the mean of those that they
   * are in the middle of. A fifth of the time of deal.II's SolutionTransfer,
   * which can do all else. */
  template <int dim> class VertexTransfer
  {
  public:
    /** Whether the element, the ranks and the flags of the mesh, prepared for
     * refinement, are such. */
    static bool is_possible(const dealii::DoFHandler<dim> &dof_handler);

    /** Keep values of @p fields (ghosted) on the mesh before it is refined. */
    VertexTransfer(const dealii::DoFHandler<dim> &dof_handler,
                   const std::vector<la::Vector> &fields);

    /** On the refined mesh, whose unknowns are numbered: the same fields. */
    std::vector<la::Vector> interpolate();

  private:
    void keep(const la::Vector &field, std::vector<double> &values) const;
    void fill_new_vertices();

    const dealii::DoFHandler<dim> &dof_handler_;
    const unsigned int n_components_;
    std::vector<std::vector<double>> values_; ///< [fields][vertices*components]
    std::vector<bool> is_known_;              ///< [vertices]
  };
} // namespace abut::app

#endif

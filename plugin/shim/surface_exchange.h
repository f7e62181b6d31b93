// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_EXCHANGE_H
#define ABUT_SHIM_SURFACE_EXCHANGE_H

#include "contact_surface.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <set>

namespace abut::shim
{
  /** Makes the boundary facets of all ranks known where rows need them. Each
   * rank gets all facets; this class is the only place that knows. */
  template <int dim> class SurfaceExchange
  {
  public:
    /** @p hanging holds the hanging nodes alone. All references must outlive
     * this object. Throws if the displacement is not continuous and of degree
     * 1 or 2 on lines and quadrilaterals. */
    SurfaceExchange(const dealii::Mapping<dim> &mapping,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    const dealii::AffineConstraints<double> &hanging);

    /** The facets with these boundary ids. One pass over the cells.
     * Collective. */
    ContactSurface<dim>
    gather(const std::set<dealii::types::boundary_id> &boundary_ids) const;

    /** Make a mark that any rank has set known to all. Collective. */
    void merge_marks(std::vector<std::uint8_t> &marks) const;

  private:
    using Index = dealii::types::global_dof_index;

    /** What one rank sends. Nodes are named by their first unknown. */
    struct Message
    {
      std::vector<std::int64_t> facets, nodes;
      std::vector<double> values;
    };

    void tabulate();
    Message
    collect(const std::set<dealii::types::boundary_id> &boundary_ids) const;
    void add_node(Message &message, const dealii::Point<dim> &point,
                  const std::array<Index, dim> &dof) const;
    void add_parents(Message &message, std::set<Index> &known) const;
    ContactSurface<dim> arrange(const Message &all) const;

    const dealii::Mapping<dim> &mapping_;
    const dealii::DoFHandler<dim> &dof_handler_;
    const dealii::AffineConstraints<double> &constraints_;
    const dealii::AffineConstraints<double> &hanging_;
    const MPI_Comm communicator_;
    abut_facet_kind kind_;
    /** [faces of a cell][nodes of a facet][component] unknown of the cell. */
    std::vector<std::vector<std::array<unsigned int, dim>>> cell_dof_;
  };
} // namespace abut::shim

#endif

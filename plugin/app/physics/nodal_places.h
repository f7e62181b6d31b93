// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PHYSICS_NODAL_PLACES_H
#define ABUT_APP_PHYSICS_NODAL_PLACES_H

#include <deal.II/fe/fe.h>

#include <array>
#include <vector>

namespace abut::app
{
  /** Which of a cell's unknowns are those of a node, for loops over the cells:
   * FiniteElement::component_to_system_index() looks through all of them each
   * time that it is asked. */
  template <int dim> class NodalPlaces
  {
  public:
    explicit NodalPlaces(const dealii::FiniteElement<dim> &fe)
        : places_(fe.base_element(0).n_dofs_per_cell())
    {
      for (unsigned int node = 0; node < places_.size(); ++node)
        for (unsigned int c = 0; c < dim; ++c)
          places_[node][c] = fe.component_to_system_index(c, node);
    }

    unsigned int operator()(const unsigned int component,
                            const unsigned int node) const
    {
      return places_[node][component];
    }

    unsigned int n_nodes() const
    {
      return places_.size();
    }

  private:
    std::vector<std::array<unsigned int, dim>> places_;
  };
} // namespace abut::app

#endif

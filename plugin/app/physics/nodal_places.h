// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PHYSICS_NODAL_PLACES_H
#define ABUT_APP_PHYSICS_NODAL_PLACES_H

#include <deal.II/fe/fe.h>

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
        : n_components_(fe.n_components())
    {
      const unsigned int n_nodes = fe.base_element(0).n_dofs_per_cell();
      for (unsigned int node = 0; node < n_nodes; ++node)
        for (unsigned int c = 0; c < n_components_; ++c)
          places_.push_back(fe.component_to_system_index(c, node));
    }

    unsigned int operator()(const unsigned int component,
                            const unsigned int node) const
    {
      return places_[node * n_components_ + component];
    }

    unsigned int n_nodes() const
    {
      return places_.size() / n_components_;
    }

  private:
    unsigned int n_components_;
    std::vector<unsigned int> places_;
  };

  /** Those of an element, for shim::ByElement. */
  template <int dim>
  NodalPlaces<dim> nodal_places(const dealii::FiniteElement<dim> &fe)
  {
    return NodalPlaces<dim>(fe);
  }
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SELF_CONTACT_H
#define ABUT_SHIM_SELF_CONTACT_H

#include "handles.h"

#include <abut/dealii/contact_pair.h>
#include <abut/dealii/search_parameters.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/cell_id.h>

#include <map>
#include <set>
#include <vector>

namespace abut::shim
{
  /** Pairs whose two surfaces are the same: their facets are put on two sides
   * (abut/self_contact.h), and the primary side gets boundary ids that no mesh
   * has. Everything else then sees pairs of two surfaces.
   *
   * All ranks know these facets, by their corners in the reference
   * configuration: the sides hang together over the whole surface. */
  template <int dim> class SelfContact
  {
  public:
    using BoundaryId = dealii::types::boundary_id;
    using Cell = dealii::CellId::binary_type;

    /** @p pairs with ids for the primary sides of surfaces that touch
     * themselves. Throws ContactError where ids do not fit together. */
    static std::vector<ContactPair<dim>>
    with_sides(const std::vector<ContactPair<dim>> &pairs);

    /** Put the facets of such pairs on their sides. Costs nothing without any.
     * Throws ContactError on all ranks. Collective. */
    SelfContact(const dealii::Mapping<dim> &mapping,
                const dealii::DoFHandler<dim> &dof_handler,
                const std::vector<ContactPair<dim>> &pairs,
                const SearchParameters &search, abut_context *context);

    /** Boundary id that pairs know a facet of this rank by. */
    BoundaryId id(const Cell &cell, unsigned int face,
                  BoundaryId of_mesh) const;

    /** Whether a pair, as with_sides() makes it, is a surface that touches
     * itself. */
    static bool is_split(const ContactPair<dim> &pair);

    /** Thickness of the thinnest part of the body between facets of a pair, as
     * far as it matters; 0: no such part, or two surfaces. */
    double thickness(const ContactPair<dim> &pair) const;

  private:
    struct Facets;

    void split(const ContactPair<dim> &pair, const Facets &facets,
               const SearchParameters &search, abut_context *context);

    std::set<std::pair<Cell, unsigned int>> primary_;
    std::map<BoundaryId, double> thickness_;
  };
} // namespace abut::shim

#endif

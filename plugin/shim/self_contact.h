// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SELF_CONTACT_H
#define ABUT_SHIM_SELF_CONTACT_H

#include "handles.h"

#include <abut/dealii/contact_pair.h>
#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/search_parameters.h>
#include <abut/self_contact.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/cell_id.h>

#include <iosfwd>
#include <map>
#include <set>
#include <vector>

namespace abut::shim
{
  /** Pairs whose two surfaces are the same: their facets are put on two sides
   * (abut/self_contact.h), and the primary side gets boundary ids that no mesh
   * has. Everything else then sees pairs of two surfaces.
   *
   * Sides are those of the reference configuration at first, and follow the
   * bodies: where facets of one side meet, renew() splits the surface again.
   *
   * All ranks know these facets, by their corners, while the surface is split:
   * the sides hang together over the whole surface. */
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

    /** Whether there is any such surface. */
    bool any() const
    {
      return !pairs_.empty();
    }

    /** Split surfaces again where the bodies are, displaced by @p displacement
     * (owned), if facets of one side face each other there within @p near
     * (length). Facets that touch keep their sides. Returns whether any facet
     * has another one; then ids are others. Collective. */
    bool renew(const la::Vector &displacement, double near,
               abut_context *context);

    /** Boundary id of a facet of this rank for pairs. */
    BoundaryId id(const Cell &cell, unsigned int face,
                  BoundaryId of_mesh) const;

    /** Sides as a part of a checkpoint; nothing without surfaces that touch
     * themselves. After load() facets have other ids, if it returns true.
     * Collective. */
    void save(std::ostream &stream) const;
    bool load(std::istream &stream);

    /** Boundary id of the mesh from that of id(). */
    static BoundaryId of_mesh(BoundaryId id);

    /** Whether a pair, as with_sides() makes it, is a surface that touches
     * itself. */
    static bool is_split(const ContactPair<dim> &pair);

    /** Thickness of the thinnest part of the body between facets of a pair, as
     * far as it matters; 0: no such part, or two surfaces. */
    double thickness(const ContactPair<dim> &pair) const;

  private:
    struct Facets;
    struct Part;

    abut_split_options options(const ContactPair<dim> &pair) const;
    void split(const ContactPair<dim> &pair, const Facets &facets,
               abut_context *context);
    void find_thinnest(const ContactPair<dim> &pair, const Facets &facets,
                       abut_context *context);
    std::set<BoundaryId> all_ids() const;
    void split_again(const ContactPair<dim> &pair, const Facets &facets,
                     double near, abut_context *context);
    /** Note the sides of the facets of a part; returns whether they differ. */
    bool set_primary(const Part &part, const std::vector<std::uint8_t> &side);
    /** Call function(pair) for surfaces that touch themselves; what it throws
     * is thrown on all ranks. */
    template <typename Function> void for_each(const Function &function) const;

    const dealii::Mapping<dim> *mapping_;
    const dealii::DoFHandler<dim> *dof_handler_;
    std::vector<ContactPair<dim>> pairs_; ///< that touch themselves
    SearchParameters search_;
    std::set<std::pair<Cell, unsigned int>> primary_;
    std::map<BoundaryId, double> thickness_;
    /** Thickness of the thinnest part anywhere in reach of renew(), in the
     * reference configuration; by the first id. */
    std::map<BoundaryId, double> thinnest_;
    bool has_changed_ = false; ///< by the present renew()
  };
} // namespace abut::shim

#endif

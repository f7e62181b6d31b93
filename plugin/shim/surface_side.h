// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_SIDE_H
#define ABUT_SHIM_SURFACE_SIDE_H

#include "contact_surface.h"
#include "handles.h"

#include <abut/dealii/search_parameters.h>

#include <set>

namespace abut::shim
{
  /** Measures of a side on all ranks together. */
  struct SideMeasures
  {
    std::int64_t n_facets = 0;
    double area = 0.;                                ///< of all facets
    double smallest = 0., median = 0., largest = 0.; ///< sizes of facets
    double extent = 0.; ///< longest side of the box of all nodes, length
  };

  /** One side of a pair as the core wants it: the facets of some boundary ids
   * with a numbering of their own, in the order of the numbers in the whole
   * of what this rank knows. */
  template <int dim> struct SurfaceSide
  {
    std::vector<std::int32_t> facet; ///< [facets] number in the whole
    std::vector<std::int32_t> node;  ///< [nodes] number in the whole
    std::vector<double> position;    ///< [nodes * dim], read by the core
    /** Hanging nodes as in abut_coupling_nodes. */
    std::vector<std::int32_t> hanging_node, hanging_start, hanging_parent;
    std::vector<double> hanging_weight;
    Handle<abut_surface> surface;

    int n_facets() const
    {
      return static_cast<int>(facet.size());
    }

    int n_nodes() const
    {
      return static_cast<int>(node.size());
    }

    /** Number here of a node of the whole, or -1. O(log n). */
    int local_node(std::int32_t number) const;

    SideMeasures everywhere;
  };

  /** Take the facets with these boundary ids. Throws what the core finds wrong
   * with them, but perhaps on this rank only. Not collective. */
  template <int dim>
  SurfaceSide<dim> make_side(abut_context *context,
                             const ContactSurface<dim> &whole,
                             const std::set<dealii::types::boundary_id> &ids,
                             const SearchParameters &search);

  /** Least thickness that `Search/Thickness` gives to bodies with these ids,
   * length; 0: none. */
  double given_thickness(const SearchParameters &search,
                         const std::set<dealii::types::boundary_id> &ids);

  /** The least depth at which facets of a side lie behind each other, as the
   * two skins of a thin body do, as far as this rank knows it; infinity: none
   * within reach. Sides whose facets all look one way cost nothing. Not
   * collective. */
  template <int dim>
  double found_thickness(abut_context *context, const SurfaceSide<dim> &side,
                         const SearchParameters &search, double reach);

  /** Measure a side from the facets that ranks have of their own. Collective.
   */
  template <int dim>
  SideMeasures measure_everywhere(const SurfaceSide<dim> &side,
                                  const ContactSurface<dim> &whole,
                                  MPI_Comm communicator);
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_OBSTACLE_IN_BODIES_H
#define ABUT_SHIM_OBSTACLE_IN_BODIES_H

#include <abut/dealii/contact_pair.h>
#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <string>

namespace abut::shim
{
  /** How deep deformed bodies are in an obstacle. */
  template <int dim> struct ObstacleInBodies
  {
    /** At samples of the secondary surface: length, < 0 if none is inside. */
    double at_surface = 0.;
    /** Anywhere else in the bodies of that surface, likewise. */
    double elsewhere = 0.;
    /** Where that is deepest. */
    dealii::Point<dim> place;

    /** Whether it is deeper there than the surface could hold it off, and by
     * more than the round-off of facets of size @p facet. */
    bool is_inside(double facet) const;

    /** Whether the surface meets the obstacle at all. */
    bool is_met(double facet) const;

    /** The fault and the remedy, with the depth in words. */
    std::string text(const std::string &depth) const;

    /** The same of an obstacle that nodes have missed; the remedy is left to
     * the caller. */
    std::string between_nodes(const std::string &depth) const;
  };

  /** Look for the obstacle of @p pair in the bodies that its secondary surface
   * belongs to, everywhere and not only where that surface would meet it. Only
   * shapes that are bounded are looked for: of them all of the material is
   * known, while planes and formulas are often meant for a part of the body
   * alone; and others, such as functions, whose thickness is unknown, if the
   * pair has a gap that may be more than that. Depths are without the gap
   * there. One pass over the cells, and more of those near the obstacle.
   * Collective. */
  template <int dim>
  ObstacleInBodies<dim>
  find_obstacle_in_bodies(const dealii::Mapping<dim> &mapping,
                          const dealii::DoFHandler<dim> &dof_handler,
                          const la::Vector &displacement,
                          const ContactPair<dim> &pair);
} // namespace abut::shim

#endif

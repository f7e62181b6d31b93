// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_NEAR_NULL_SPACE_H
#define ABUT_SOLVE_NEAR_NULL_SPACE_H

#include "common_array.h"
#include "mesh_hierarchy.h"

#include <deal.II/base/point.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace abut::solve
{
  /** A rigid motion: the displacement of a point is translation +
   * rotation x point. */
  struct RigidMotion
  {
    dealii::Tensor<1, 3> translation, rotation;
  };

  struct KeptParts;

  /** None. */
  std::shared_ptr<KeptParts> make_kept_parts();

  /** At the end of a step: the next one has the same digits in a run that
   * begins there. */
  void forget_factors(KeptParts &kept);

  /** Which unknown is what: the motions that a stiffness barely resists. By
   * default the field is scalar and in one piece. */
  struct NearNullSpace
  {
    /** Components of the field; more than one: a displacement, beside which
     * there may be other fields. */
    unsigned int n_components = 1;
    /** Bodies, the connected parts of the mesh over all ranks. */
    unsigned int n_bodies = 1;
    /** [owned] component of each unknown, n_components where it is of another
     * field; empty for a scalar field. */
    CommonArray<std::uint8_t> component;
    /** [owned] body of each unknown from 0; empty: all in body 0. */
    CommonArray<int> body;
    /** [owned] where each unknown sits, from which rotations are known;
     * planes have z = 0. Empty: only translations are known. */
    CommonArray<dealii::Point<3>> point;
    /** [owned] nonzero where the value is prescribed; empty: not known. */
    CommonArray<std::uint8_t> prescribed;
    /** [owned] part of the volume of the mesh that belongs to the node of each
     * unknown; empty: the same for all. */
    CommonArray<double> share;
    /** [n_bodies] for messages; those without one: body 1, body 2, ... */
    std::vector<std::string> names;
    /** The coarser meshes, for geometric multigrid; null: not known. */
    std::shared_ptr<const MeshHierarchy> meshes;
    /** Parts of solvers on this mesh, common to all copies; not null. */
    std::shared_ptr<KeptParts> kept = make_kept_parts();
    /** Whether factors and patterns of earlier systems may be used. Answers
     * then depend on these systems, by round-off: not where a solve that is
     * repeated must have the same digits. */
    bool reuses_factors = false;

    /** Room for the owned unknowns of a displacement. */
    void resize(const std::size_t n)
    {
      component.change().resize(n);
      body.change().resize(n);
      point.change().resize(n);
      share.change().resize(n);
    }

    /** Set the component and the position of owned unknown @p k. */
    template <int dim>
    void set(const std::size_t k, const unsigned int its_component,
             const int its_body, const dealii::Point<dim> &place)
    {
      component.change()[k] = static_cast<std::uint8_t>(its_component);
      body.change()[k] = its_body;
      for (unsigned int d = 0; d < dim; ++d)
        point.change()[k][d] = place[d];
    }
  };
} // namespace abut::solve

#endif

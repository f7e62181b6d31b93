// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_FUNCTIONS_H
#define ABUT_APP_SOLID_FUNCTIONS_H

#include "app/mesh/bodies.h"
#include "app/physics/elasticity.h"
#include "app/physics/mass.h"
#include "solid_parameters.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace abut::app
{
  /** All formulas of a scene `solid`, and the data of Elasticity made from
   * them. */
  template <int dim> class SolidFunctions
  {
  public:
    /** Read the formulas; throws InputError. */
    explicit SolidFunctions(const SolidParameters &parameters);

    /** The data of the bodies; @p surfaces are boundaries that `*` does not
     * mean, because something else happens there. Must be called after the
     * bodies have been created, and outlived by both. Throws InputError for
     * ids that a body does not have. */
    ElasticData<dim>
    data(const Bodies<dim> &bodies,
         const std::set<dealii::types::boundary_id> &surfaces) const;

    /** The density of the bodies, of bodies of revolution that of the whole
     * turn. @p materials must outlive it. */
    typename MassData<dim>::Density
    density(const Materials<dim> &materials) const;

    /** Displacement and velocity that a motion begins with, at the nodes of the
     * bodies (owned); hanging nodes as the formulas say. Throws InputError for
     * values that are not finite. Collective. */
    std::pair<la::Vector, la::Vector>
    initial_motion(const DiscreteProblem<dim> &problem) const;

    /** Time of all formulas. */
    void set_time(double time);

    /** Whether supports change with time. */
    bool supports_move() const;

  private:
    struct OfBody
    {
      BoundaryExpressions<dim> support, traction, pressure;
      std::unique_ptr<VolumeForce<dim>> force;
      /** Null: 0. */
      std::unique_ptr<Expression<dim>> displacement, velocity;
    };

    /** Throw InputError for a load of a body where its support holds it. */
    void require_effect(const Bodies<dim> &bodies, unsigned int body,
                        const ElasticData<dim> &data) const;

    const SolidParameters &parameters;
    std::unique_ptr<Expression<dim>> gravity;
    std::vector<OfBody> of_body;
  };
} // namespace abut::app

#endif

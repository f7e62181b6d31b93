// SPDX-License-Identifier: LGPL-2.1-or-later
// What bodies have of their own when they move: pairs of surfaces.
#include "app/input/short_number.h"
#include "app/physics/components.h"
#include "solid_model.h"

#include <abut/dealii/coded.h>

#include <cmath>

namespace abut::app
{
  namespace
  {
    /** How far surfaces in contact may go in a step, whose points are those of
     * its beginning: parts of a facet, and radian. */
    constexpr double largest_slip = 0.5, largest_rotation = 5. * M_PI / 180.;

    /** Moment about the origin of a force at @p place. */
    template <int dim>
    dealii::Tensor<1, 3> moment(const dealii::Point<dim> &place,
                                const dealii::Tensor<1, dim> &force)
    {
      dealii::Tensor<1, 3> arm, there;
      for (unsigned int d = 0; d < dim; ++d)
      {
        arm[d] = place[d];
        there[d] = force[d];
      }
      return cross_product_3d(arm, there);
    }
  } // namespace

  template <int dim> MotionWords SolidModel<dim>::motion_words() const
  {
    MotionWords words;
    for (unsigned int d = 0; d < dim; ++d)
      words.components.push_back(std::string("_") + "xyz"[d]);
    for (std::size_t p = 1; p <= parameters.pairs.size(); ++p)
      words.sides.push_back("pair_" + std::to_string(p));
    return words;
  }

  template <int dim>
  std::vector<ContactAction> SolidModel<dim>::contact_actions() const
  {
    if (pairs->empty())
      return {};
    const auto obstacles = pairs->moved_obstacles();
    const auto results = run.contact.results().pairs(run.u);
    std::vector<ContactAction> actions(results.size());
    for (std::size_t p = 0; p < results.size(); ++p)
    {
      actions[p].force = components(results[p].secondary_force);
      actions[p].friction = results[p].friction_force;
      actions[p].dissipation = results[p].dissipation;
      for (const auto &obstacle : obstacles)
        if (obstacle.shape == pairs->pairs()[p].obstacle)
        {
          actions[p].place = components(obstacle.motion);
          actions[p].moment = results[p].present_moment
                              - moment(obstacle.centre + obstacle.motion,
                                       results[p].secondary_force);
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e < dim; ++e)
              actions[p].rotation[d][e] = obstacle.rotation[d][e];
        }
      // What forces move takes the work of contact from its own energy.
      if (const auto number = pairs->obstacle_of(p))
        for (unsigned int d = 0; d < dim; ++d)
          if (driven.is_free(*number, d))
            actions[p].place[d] = 0.;
    }
    return actions;
  }

  template <int dim> Message SolidModel<dim>::leaves_points() const
  {
    const std::vector<StepMotion> motions =
        run.contact.checks().step_motion(run.u);
    for (std::size_t p = 0; p < motions.size(); ++p)
    {
      const StepMotion &pair = motions[p];
      if (pair.stays)
        continue;
      // The normals of the two sides of an obstacle, or of one that has gone
      // by.
      if (pair.rotation > M_PI / 2. && pairs->obstacle_of(p))
        return coded(ABUT_FAILURE_NO_PARTNER,
                     parameters.pairs[p].section
                         + ": in this time step the obstacle passes the middle "
                           "of the body, or the body that of the obstacle, and "
                           "contact would be with the far side. Within a step "
                           "the motion must be below half of the smaller "
                           "thickness. Use a smaller Time stepping/Step size, "
                           "or a slower obstacle (Motion, velocity, forces).");
      const bool slides =
          pair.facet > 0. && pair.slip > largest_slip * pair.facet;
      if (!slides && pair.rotation <= largest_rotation)
        continue;
      return coded(
          ABUT_FAILURE_SLIDING,
          parameters.pairs[p].section
              + (slides
                     ? ": in this time step the surfaces in contact slide on "
                       "each other by "
                           + short_number(pair.slip / pair.facet, 3) + " facets"
                     : ": in this time step the contact normals rotate by "
                           + short_number(pair.rotation * 180. / M_PI, 3)
                           + " degrees")
              + ", but contact is evaluated at its start. Use a smaller Time "
                "stepping/Step size.");
    }
    return "";
  }

  template MotionWords SolidModel<2>::motion_words() const;
  template MotionWords SolidModel<3>::motion_words() const;
  template std::vector<ContactAction> SolidModel<2>::contact_actions() const;
  template std::vector<ContactAction> SolidModel<3>::contact_actions() const;
  template Message SolidModel<2>::leaves_points() const;
  template Message SolidModel<3>::leaves_points() const;
} // namespace abut::app

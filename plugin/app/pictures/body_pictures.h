// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BODY_PICTURES_H
#define ABUT_APP_BODY_PICTURES_H

/** @file
 * Pictures of plane elastic bodies.
 */

#include "app/physics/material.h"
#include "app/report/report.h"
#include "contact_line.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/rigid_obstacle.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** A contact boundary in a picture. */
  struct PressureCurve
  {
    std::string label;
    std::vector<ContactLine> lines; /**< on rank 0 */
    bool has_friction = false;      /**< draw that, too */
  };

  /** A rigid obstacle in a picture, at its present place. */
  struct DrawnObstacle
  {
    std::shared_ptr<const RigidObstacle<2>> shape;
    dealii::Tensor<1, 2> motion; /**< how far it has been moved */
  };

  /** `<name>.svg`: the deformed bodies coloured by von Mises' stress with
   * their outlines, and the surfaces of rigid obstacles; below, the contact
   * pressure along each contact line.
   *
   * @param displacement ghosted. Where it is less than a fiftieth of the
   * bodies' size it is drawn larger, by a round factor that the title tells;
   * motions of obstacles are, too.
   * @return whether the picture was made (rank 0). Collective. */
  bool draw_bodies(Report &report, const std::filesystem::path &folder,
                   const std::string &name, const dealii::Mapping<2> &mapping,
                   const dealii::DoFHandler<2> &dof_handler,
                   const la::Vector &displacement,
                   const Materials<2> &materials,
                   const std::vector<PressureCurve> &pressures,
                   const std::vector<DrawnObstacle> &obstacles,
                   const std::string &title);
} // namespace abut::app

#endif

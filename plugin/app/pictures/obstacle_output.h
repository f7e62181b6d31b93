// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_OBSTACLE_OUTPUT_H
#define ABUT_APP_OBSTACLE_OUTPUT_H

/** @file
 * Surfaces of rigid obstacles for output files.
 */

#include <abut/dealii/rigid_obstacle.h>
#include <deal.II/base/bounding_box.h>
#include <deal.II/base/tensor.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace abut::app
{
  /** A rigid obstacle at its current position. */
  template <int dim> struct PlacedObstacle
  {
    std::shared_ptr<const RigidObstacle<dim>> shape;
    dealii::Point<dim> centre;       /**< of its rotation, at time 0 */
    dealii::Tensor<1, dim> motion;   /**< of the centre since time 0 */
    dealii::Tensor<2, dim> rotation; /**< since time 0 */
  };

  /** Write the surfaces of obstacles inside of @p box as a VTU file of lines or
   * triangles, with the fields `obstacle`, a number from 1, and `motion_x` and
   * so on. Distances are linear between the points of a grid. Not collective.
   */
  template <int dim>
  void write_obstacles(const std::filesystem::path &file,
                       const std::vector<PlacedObstacle<dim>> &obstacles,
                       const dealii::BoundingBox<dim> &box);
} // namespace abut::app

#endif

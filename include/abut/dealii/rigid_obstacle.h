// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_RIGID_OBSTACLE_H
#define ABUT_DEALII_RIGID_OBSTACLE_H

/** @file
 * Rigid obstacles for deal.II programs: shapes, functions and surfaces of
 * facets, and their motion in time.
 */

#include <abut/obstacle.h>
#include <abut/obstacle_surface.h>

#include <deal.II/base/function.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace abut
{
  /** Where an obstacle is: a point X of its own frame is at R X + T. */
  template <int dim> struct RigidPose
  {
    dealii::Tensor<2, dim> rotation;    /**< R */
    dealii::Tensor<1, dim> translation; /**< T */

    /** Turned by @p angle (radian) about @p centre and, in 3D, the direction
     * @p axis (of any length but zero), then moved by @p translation. */
    static RigidPose turned(double angle, const dealii::Point<dim> &centre,
                            const dealii::Tensor<1, 3> &axis,
                            const dealii::Tensor<1, dim> &translation);
  };

  /** The shape of a half space: its surface goes through @p point, and
   * @p normal, of any length but zero, points out of its material. */
  template <int dim>
  abut_obstacle_shape plane(const dealii::Point<dim> &point,
                            const dealii::Tensor<1, dim> &normal)
  {
    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = dim;
    for (int d = 0; d < 3; ++d)
    {
      shape.point[d] = d < dim ? point[d] : 0.;
      shape.axis[d] = d < dim ? normal[d] : 0.;
    }
    return shape;
  }

  /** The shape of a ball, in 2D of a disc; for a hole set `hollow`. */
  template <int dim>
  abut_obstacle_shape sphere(const dealii::Point<dim> &centre,
                             const double radius)
  {
    abut_obstacle_shape shape =
        plane<dim>(centre, dealii::Point<dim>::unit_vector(dim - 1));
    shape.kind = ABUT_OBSTACLE_SPHERE;
    shape.radius = radius;
    return shape;
  }

  /** The shape of a cylinder without ends about the line through @p point along
   * @p axis, of any length but zero; in 2D a disc, and the axis is not read. */
  template <int dim>
  abut_obstacle_shape cylinder(const dealii::Point<dim> &point,
                               const dealii::Tensor<1, dim> &axis,
                               const double radius)
  {
    abut_obstacle_shape shape = plane<dim>(point, axis);
    shape.kind = dim == 2 ? ABUT_OBSTACLE_SPHERE : ABUT_OBSTACLE_CYLINDER;
    shape.radius = radius;
    return shape;
  }

  /** A surface given as height over the plane orthogonal to a coordinate axis.
   */
  template <int dim> struct HeightObstacle
  {
    /** Height as a function of the point; its coordinate along the axis is
     * zero. Gradients are evaluated only if along_axis is false, or if points
     * move (ABUT_KINEMATICS_CURRENT). */
    std::shared_ptr<dealii::Function<dim>> height;
    unsigned int axis = dim - 1; /**< 0 .. dim - 1 */
    /** The material is above the height, seen along the axis: a die. */
    bool material_above = false;
    /** The gap is measured along the axis, and its gradient is the axis: an
     * obstacle in the sense of a height above each point. Otherwise, and of
     * points that move in any case, it is measured normal to the surface, to
     * first order in the gap. */
    bool along_axis = true;
  };

  /** A rigid obstacle: signed distances of points, positive outside its
   * material.
   *
   * No function is collective: in parallel each rank has its own object, all
   * made from the same data. One thread at a time. Programs that load Abut at
   * run time get obstacles from Registry::make_obstacle(). */
  template <int dim> class RigidObstacle
  {
  public:
    /** A shape; its dimension must be dim. Throws dealii::ExceptionBase with
     * the core's message for a number out of range, as all constructors. */
    explicit RigidObstacle(const abut_obstacle_shape &shape);

    /** A height. */
    explicit RigidObstacle(const HeightObstacle<dim> &height);

    /** The material is where @p value is negative (@p hollow: positive). Value
     * and gradient are divided by the length of the gradient: a signed distance
     * stays what it is, any other function becomes one to first order near the
     * surface. */
    explicit RigidObstacle(std::shared_ptr<dealii::Function<dim>> value,
                           bool hollow = false);

    /** A surface of facets, which is copied. */
    RigidObstacle(const abut_surface_data &surface,
                  const abut_obstacle_surface &options);

    virtual ~RigidObstacle();
    RigidObstacle(const RigidObstacle &) = delete;
    RigidObstacle &operator=(const RigidObstacle &) = delete;

    /** Put the obstacle in a place. */
    virtual void set_pose(const RigidPose<dim> &pose);

    /** The place as a function of time, for set_time(). */
    virtual void set_motion(std::function<RigidPose<dim>(double)> motion);

    /** Hand the time to the function of the obstacle, if it has one, and put
     * the obstacle where its motion, if it has one, prescribes. */
    virtual void set_time(double time);

    /** Signed distances and, unless NULL, gradients of points; resized. */
    virtual void
    distance(const std::vector<dealii::Point<dim>> &points,
             std::vector<double> &distances,
             std::vector<dealii::Tensor<1, dim>> *gradients = nullptr) const;

    /** The core's obstacle, for abut_coupling_create_obstacle(); owned. */
    virtual abut_obstacle *handle() const;

    /** Its description, pose and statistics. */
    virtual abut_obstacle_view view() const;

    /** Why the last call of the core with handle() failed: the message of
     * what a function threw, or the core's. */
    virtual std::string failure() const;

    /** Where it is. */
    virtual RigidPose<dim> pose() const;

    /** How wide a bounded shape is for a surface with this unit @p normal,
     * length > 0: the least length of it through its centre along the surface.
     * Facets larger than that see it at single nodes. Infinite for planes,
     * cones, holes, functions and surfaces of facets. */
    virtual double width(const dealii::Tensor<1, dim> &normal) const;

    /** How deep a point can be in a bounded shape, length > 0: half of what it
     * is thick. A gap of a pair that is not smaller leaves nothing of it.
     * Infinite for planes, cones, holes, functions and surfaces of facets. */
    virtual double depth() const;

    /** The time of the last set_time(), 0 before. */
    virtual double time() const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace abut

#endif

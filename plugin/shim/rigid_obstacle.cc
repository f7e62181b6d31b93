// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shim/coordinates.h"
#include "shim/handles.h"

#include <abut/dealii/rigid_obstacle.h>

#include <cmath>
#include <exception>
#include <utility>

namespace abut
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    template <int dim>
    std::vector<Point<dim>> to_points(const std::int32_t n,
                                      const double *numbers)
    {
      std::vector<Point<dim>> points(static_cast<std::size_t>(n));
      for (Point<dim> &point : points)
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = *numbers++;
      return points;
    }

    /** A function of the host behind the core's callback. An exception must not
     * pass through C: it is kept. */
    template <int dim> class HostFunction
    {
    public:
      explicit HostFunction(const bool has_derivative = false)
          : has_derivative(has_derivative)
      {
      }

      virtual ~HostFunction() = default;

      virtual void set_time(double time) = 0;

      static int evaluate(void *user, const std::int32_t n,
                          const double *numbers, double *value,
                          double *gradient) noexcept
      {
        auto &self = *static_cast<HostFunction *>(user);
        self.thrown = nullptr;
        try
        {
          self.fill(to_points<dim>(n, numbers), value, gradient);
          return 0;
        }
        catch (...)
        {
          self.thrown = std::current_exception();
          return 1;
        }
      }

      /** The derivative of the value, where it is not the gradient. */
      static int derive(void *user, const std::int32_t n, const double *numbers,
                        double *derivative) noexcept
      {
        auto &self = *static_cast<HostFunction *>(user);
        self.thrown = nullptr;
        try
        {
          self.fill_derivative(to_points<dim>(n, numbers), derivative);
          return 0;
        }
        catch (...)
        {
          self.thrown = std::current_exception();
          return 1;
        }
      }

      const bool has_derivative;
      /** Exception of the last evaluation, or null. */
      std::exception_ptr thrown;

    protected:
      virtual void fill(const std::vector<Point<dim>> &points, double *value,
                        double *gradient) = 0;
      virtual void fill_derivative(const std::vector<Point<dim>> &, double *)
      {
      }
    };

    template <int dim> class DistanceFunction : public HostFunction<dim>
    {
    public:
      explicit DistanceFunction(std::shared_ptr<dealii::Function<dim>> function)
          : function(std::move(function))
      {
      }

      void set_time(const double time) override
      {
        function->set_time(time);
      }

    protected:
      void fill(const std::vector<Point<dim>> &points, double *value,
                double *gradient) override
      {
        std::vector<double> values(points.size());
        std::vector<Tensor<1, dim>> gradients(points.size());
        function->value_list(points, values);
        function->gradient_list(points, gradients);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          value[i] = values[i];
          for (unsigned int d = 0; d < dim; ++d)
            gradient[dim * i + d] = gradients[i][d];
        }
      }

    private:
      const std::shared_ptr<dealii::Function<dim>> function;
    };

    /** +-(x_axis - h), with the gradient +-(e_axis - grad h) or +-e_axis. */
    template <int dim> class HeightFunction : public HostFunction<dim>
    {
    public:
      explicit HeightFunction(const HeightObstacle<dim> &parameters)
          : HostFunction<dim>(parameters.along_axis), parameters(parameters)
      {
      }

      void set_time(const double time) override
      {
        parameters.height->set_time(time);
      }

    protected:
      void fill_derivative(const std::vector<Point<dim>> &points,
                           double *derivative) override
      {
        const std::vector<Tensor<1, dim>> slopes = find_slopes(feet_of(points));
        for (std::size_t i = 0; i < points.size(); ++i)
          put_slope(slopes[i], derivative + dim * i);
      }

      void fill(const std::vector<Point<dim>> &points, double *value,
                double *gradient) override
      {
        const unsigned int axis = parameters.axis;
        const std::vector<Point<dim>> feet = feet_of(points);
        std::vector<double> heights(points.size());
        parameters.height->value_list(feet, heights);
        const std::vector<Tensor<1, dim>> slopes =
            parameters.along_axis ? std::vector<Tensor<1, dim>>(points.size())
                                  : find_slopes(feet);
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          value[i] = sign() * (points[i][axis] - heights[i]);
          put_slope(slopes[i], gradient + dim * i);
        }
      }

    private:
      double sign() const
      {
        return parameters.material_above ? -1. : 1.;
      }

      std::vector<Point<dim>> feet_of(std::vector<Point<dim>> points) const
      {
        for (Point<dim> &point : points)
          point[parameters.axis] = 0.;
        return points;
      }

      std::vector<Tensor<1, dim>>
      find_slopes(const std::vector<Point<dim>> &feet) const
      {
        std::vector<Tensor<1, dim>> slopes(feet.size());
        parameters.height->gradient_list(feet, slopes);
        return slopes;
      }

      void put_slope(const Tensor<1, dim> &slope, double *gradient) const
      {
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d] = d == parameters.axis ? sign() : -sign() * slope[d];
      }

      const HeightObstacle<dim> parameters;
    };
  } // namespace

  template <int dim>
  RigidPose<dim> RigidPose<dim>::turned(const double angle,
                                        const Point<dim> &centre,
                                        const Tensor<1, 3> &axis,
                                        const Tensor<1, dim> &translation)
  {
    // in 2D about the direction out of the plane
    Tensor<1, 3> u = axis;
    if (dim == 2)
      u = Tensor<1, 3>({0., 0., 1.});
    AssertThrow(u.norm() > 0 && std::isfinite(u.norm()),
                dealii::ExcMessage("the axis of a rotation is zero"));
    u /= u.norm();
    const double c = std::cos(angle), s = std::sin(angle);
    const double cross[3][3] = {
        {0., -u[2], u[1]}, {u[2], 0., -u[0]}, {-u[1], u[0], 0.}};
    RigidPose<dim> pose;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        pose.rotation[i][j] =
            (i == j ? c : 0.) + (1. - c) * u[i] * u[j] + s * cross[i][j];
    const Tensor<1, dim> from_origin = centre - Point<dim>();
    pose.translation = translation + from_origin - pose.rotation * from_origin;
    return pose;
  }

  template <int dim> class RigidObstacle<dim>::Implementation
  {
  public:
    explicit Implementation(const abut_obstacle_shape &shape)
        : context(shim::create_context())
    {
      AssertThrow(shape.dimension == dim,
                  dealii::ExcMessage(
                      "shape.dimension is " + std::to_string(shape.dimension)
                      + " in a RigidObstacle<" + std::to_string(dim) + ">"));
      abut_obstacle *made = nullptr;
      shim::check(context.get(),
                  abut_obstacle_create_shape(context.get(), &shape, &made));
      obstacle.reset(made);
    }

    Implementation(std::unique_ptr<HostFunction<dim>> host, const bool hollow)
        : context(shim::create_context()), function(std::move(host))
    {
      abut_obstacle_function data = abut_obstacle_function_defaults();
      data.dimension = dim;
      data.user = function.get();
      data.evaluate = &HostFunction<dim>::evaluate;
      data.hollow = hollow;
      if (function->has_derivative)
        data.derivative = &HostFunction<dim>::derive;
      abut_obstacle *made = nullptr;
      shim::check(context.get(),
                  abut_obstacle_create_function(context.get(), &data, &made));
      obstacle.reset(made);
    }

    Implementation(const abut_surface_data &data,
                   const abut_obstacle_surface &options)
        : context(shim::create_context())
    {
      AssertThrow(data.dimension == dim,
                  dealii::ExcMessage("the surface is of another dimension"));
      abut_surface_data copied = data;
      copied.borrow = false;
      surface = shim::create_surface(context.get(), copied);
      abut_obstacle *made = nullptr;
      shim::check(context.get(),
                  abut_obstacle_create_surface(context.get(), surface.get(),
                                               &options, &made));
      obstacle.reset(made);
    }

    // destroyed in the opposite order
    shim::Handle<abut_context> context;
    shim::Handle<abut_surface> surface;
    std::unique_ptr<HostFunction<dim>> function;
    shim::Handle<abut_obstacle> obstacle;
    std::function<RigidPose<dim>(double)> motion;
    double time = 0.;
  };

  template <int dim>
  RigidObstacle<dim>::RigidObstacle(const abut_obstacle_shape &shape)
      : implementation(std::make_unique<Implementation>(shape))
  {
  }

  template <int dim>
  RigidObstacle<dim>::RigidObstacle(const HeightObstacle<dim> &height)
  {
    AssertThrow(height.height != nullptr && height.axis < dim,
                dealii::ExcMessage("a height needs a function and an axis"));
    implementation = std::make_unique<Implementation>(
        std::make_unique<HeightFunction<dim>>(height), false);
  }

  template <int dim>
  RigidObstacle<dim>::RigidObstacle(
      std::shared_ptr<dealii::Function<dim>> value, const bool hollow)
  {
    AssertThrow(value != nullptr, dealii::ExcMessage("there is no function"));
    implementation = std::make_unique<Implementation>(
        std::make_unique<DistanceFunction<dim>>(std::move(value)), hollow);
  }

  template <int dim>
  RigidObstacle<dim>::RigidObstacle(const abut_surface_data &surface,
                                    const abut_obstacle_surface &options)
      : implementation(std::make_unique<Implementation>(surface, options))
  {
  }

  template <int dim> RigidObstacle<dim>::~RigidObstacle() = default;

  template <int dim> RigidPose<dim> RigidObstacle<dim>::pose() const
  {
    const abut_obstacle_view present = view();
    RigidPose<dim> result;
    for (unsigned int i = 0; i < dim; ++i)
    {
      result.translation[i] = present.translation[i];
      for (unsigned int j = 0; j < dim; ++j)
        result.rotation[i][j] = present.rotation[dim * i + j];
    }
    return result;
  }

  template <int dim>
  void RigidObstacle<dim>::set_pose(const RigidPose<dim> &pose)
  {
    double rotation[dim * dim], translation[dim];
    for (unsigned int i = 0; i < dim; ++i)
    {
      translation[i] = pose.translation[i];
      for (unsigned int j = 0; j < dim; ++j)
        rotation[dim * i + j] = pose.rotation[i][j];
    }
    shim::check(implementation->context.get(),
                abut_obstacle_set_pose(handle(), rotation, translation));
  }

  template <int dim>
  void
  RigidObstacle<dim>::set_motion(std::function<RigidPose<dim>(double)> motion)
  {
    implementation->motion = std::move(motion);
  }

  template <int dim> void RigidObstacle<dim>::set_time(const double time)
  {
    if (implementation->function != nullptr)
      implementation->function->set_time(time);
    implementation->time = time;
    if (implementation->motion)
      set_pose(implementation->motion(time));
  }

  template <int dim> double RigidObstacle<dim>::time() const
  {
    return implementation->time;
  }

  template <int dim>
  void
  RigidObstacle<dim>::distance(const std::vector<Point<dim>> &points,
                               std::vector<double> &distances,
                               std::vector<Tensor<1, dim>> *gradients) const
  {
    const std::vector<double> numbers = shim::coordinates(points);
    std::vector<double> slopes;
    if (implementation->function != nullptr)
      implementation->function->thrown = nullptr;
    distances.resize(points.size());
    slopes.resize(numbers.size());
    if (abut_obstacle_distance(
            handle(), static_cast<std::int32_t>(points.size()), numbers.data(),
            distances.data(), slopes.data(), nullptr)
        != ABUT_SUCCESS)
    {
      if (implementation->function != nullptr
          && implementation->function->thrown != nullptr)
        std::rethrow_exception(implementation->function->thrown);
      throw dealii::ExcMessage(failure());
    }
    if (gradients == nullptr)
      return;
    gradients->resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        (*gradients)[i][d] = slopes[dim * i + d];
  }

  template <int dim> abut_obstacle *RigidObstacle<dim>::handle() const
  {
    return implementation->obstacle.get();
  }

  template <int dim> abut_obstacle_view RigidObstacle<dim>::view() const
  {
    abut_obstacle_view view;
    shim::check(implementation->context.get(),
                abut_obstacle_get(handle(), &view));
    return view;
  }

  template <int dim> std::string RigidObstacle<dim>::failure() const
  {
    if (implementation->function != nullptr
        && implementation->function->thrown != nullptr)
    {
      try
      {
        std::rethrow_exception(implementation->function->thrown);
      }
      catch (const std::exception &error)
      {
        return error.what();
      }
      catch (...)
      {
        return "the function of the obstacle threw an unknown exception";
      }
    }
    return shim::core_message(implementation->context.get());
  }

  template <int dim>
  double RigidObstacle<dim>::width(const Tensor<1, dim> &normal) const
  {
    return abut_obstacle_width(handle(), &normal[0]);
  }

  template <int dim> double RigidObstacle<dim>::depth() const
  {
    return abut_obstacle_depth(handle());
  }

  template struct RigidPose<2>;
  template struct RigidPose<3>;
  template class RigidObstacle<2>;
  template class RigidObstacle<3>;
} // namespace abut

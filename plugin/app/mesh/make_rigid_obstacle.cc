// SPDX-License-Identifier: LGPL-2.1-or-later
#include "make_rigid_obstacle.h"

#include "app/input/dealii_message.h"
#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "app/input/parameters.h"
#include "app/input/short_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace abut::app
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    constexpr double degree = 3.14159265358979323846 / 180;

    /** Numbers of a section, checked. */
    class Numbers
    {
    public:
      explicit Numbers(const RigidObstacleParameters &parameters)
          : parameters(parameters)
      {
      }

      [[noreturn]] void wrong(const std::string &name,
                              const std::string &message) const
      {
        throw InputError(parameters.parameter(name), message);
      }

      /** Number in (lower, upper), or equal to `also`. */
      double
      number(const std::string &name, const double lower, const double upper,
             const std::string &legal,
             const double also = std::numeric_limits<double>::quiet_NaN()) const
      {
        const std::vector<double> values = list(name);
        if (values.size() != 1
            || !((values[0] > lower && values[0] < upper) || values[0] == also))
          wrong(name, "'" + parameters.values.at(name) + "' is not " + legal
                          + misread_hint(parameters.values.at(name)));
        return values[0];
      }

      /** Vector of n components, or the given one if there is none. */
      template <int n>
      Tensor<1, n> vector(const std::string &name,
                          const Tensor<1, n> &otherwise) const
      {
        const std::vector<double> values = list(name);
        if (values.empty())
          return otherwise;
        if (values.size() != n)
          wrong(name, "needs " + std::to_string(n) + " numbers, not "
                          + std::to_string(values.size()) + "."
                          + count_hint(values.size(), n));
        Tensor<1, n> result;
        for (unsigned int d = 0; d < n; ++d)
          result[d] = values[d];
        return result;
      }

      /** The same with any length but zero. */
      template <int n> Tensor<1, n> direction(const std::string &name) const
      {
        Tensor<1, n> last;
        last[n - 1] = 1;
        const Tensor<1, n> result = vector<n>(name, last);
        if (!(result.norm() > 0))
          wrong(name, "a direction must not be zero.");
        return result;
      }

      std::vector<double> list(const std::string &name) const
      {
        return parse_numbers(parameters.values.at(name),
                             parameters.parameter(name));
      }

    private:
      const RigidObstacleParameters &parameters;
    };

    template <int dim>
    abut_obstacle_shape make_shape(const RigidObstacleParameters &parameters)
    {
      const Numbers numbers(parameters);
      const double infinity = std::numeric_limits<double>::infinity();
      abut_obstacle_shape shape = abut_obstacle_shape_defaults();
      shape.dimension = dim;
      shape.hollow = parameters.hollow;
      if (abut_obstacle_find(parameters.kind.c_str(), &shape.kind)
          != ABUT_SUCCESS)
        numbers.wrong("Kind", "'" + parameters.kind + "' is no shape.");
      const Tensor<1, dim> point = numbers.vector<dim>(
          parameters.has("Point") ? "Point" : "Centre", Tensor<1, dim>());
      const Tensor<1, dim> axis =
          numbers.direction<dim>(parameters.has("Normal") ? "Normal" : "Axis");
      std::vector<double> size = numbers.list("Size");
      if (size.size() == 1)
        size.resize(dim, size[0]);
      if (size.size() != dim)
        numbers.wrong("Size", "needs one number or " + std::to_string(dim) + "."
                                  + count_hint(size.size(), dim));
      for (unsigned int d = 0; d < dim; ++d)
      {
        shape.point[d] = point[d];
        shape.axis[d] = axis[d];
        shape.size[d] = size[d];
        if (!(size[d] > 0))
          numbers.wrong("Size", "lengths must be positive.");
      }
      shape.radius =
          numbers.number("Radius", 0, infinity, "a positive number.");
      shape.length = numbers.number("Length", 0, infinity,
                                    "a positive number, or infinite.", 0);
      shape.angle =
          degree * numbers.number("Angle", 0, 90, "a number between 0 and 90.");
      return shape;
    }

    /** Values and gradients of a formula; what is not finite is an error that
     * names the parameter and the point. */
    template <int dim> class CheckedFormula : public dealii::Function<dim>
    {
    public:
      CheckedFormula(const RigidObstacleParameters &parameters,
                     std::shared_ptr<const double> half_extent)
          : value_formula(parameters.values.at("Expression"),
                          parameters.parameter("Expression")),
            gradient_name(parameters.parameter("Gradient")),
            half_extent(std::move(half_extent))
      {
        const std::string &text = parameters.values.at("Gradient");
        if (!text.empty())
          gradient_formula =
              std::make_unique<Expression<dim>>(text, gradient_name, dim);
      }

      void set_time(const double time) override
      {
        dealii::Function<dim>::set_time(time);
        value_formula.set_time(time);
        if (gradient_formula)
          gradient_formula->set_time(time);
      }

      void value_list(const std::vector<Point<dim>> &points,
                      std::vector<double> &values,
                      const unsigned int = 0) const override
      {
        values = value_formula.evaluate(points);
      }

      void gradient_list(const std::vector<Point<dim>> &points,
                         std::vector<Tensor<1, dim>> &gradients,
                         const unsigned int = 0) const override
      {
        for (unsigned int d = 0; d < dim && gradient_formula; ++d)
        {
          const std::vector<double> values =
              gradient_formula->evaluate(points, d);
          for (std::size_t i = 0; i < points.size(); ++i)
            gradients[i][d] = values[i];
        }
        if (half_extent)
          value_formula.set_length(*half_extent);
        if (gradient_formula)
        {
          if (!is_compared)
            compare(points, gradients);
          return;
        }
        for (std::size_t i = 0; i < points.size(); ++i)
          gradients[i] = value_formula.gradient(points[i]);
      }

    private:
      /** Gradients that most points say are none of the values; of kinks and
       * ends of formulas single points do. */
      void compare(const std::vector<Point<dim>> &points,
                   const std::vector<Tensor<1, dim>> &gradients) const
      {
        is_compared = !points.empty();
        double largest = 0.;
        for (const Tensor<1, dim> &gradient : gradients)
          largest = std::max(largest, gradient.norm());
        std::size_t n_wrong = 0, n_compared = 0, last = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
          try
          {
            const Tensor<1, dim> other = value_formula.gradient(points[i]);
            ++n_compared;
            if ((gradients[i] - other).norm()
                <= 1e-2
                       * std::max(
                           {gradients[i].norm(), other.norm(), 1e-2 * largest}))
              continue;
            ++n_wrong;
            last = i;
          }
          catch (const InputError &)
          {
            // The formula ends beside this point.
          }
        if (2 * n_wrong > n_compared)
        {
          std::ostringstream place, given, found;
          place << points[last];
          given << gradients[last];
          found << value_formula.gradient(points[last]);
          throw InputError(
              gradient_name,
              "Gradient is (" + given.str() + ") at (" + place.str()
                  + "), where Expression changes by (" + found.str()
                  + "). Correct it, or leave it out for finite differences.");
        }
      }

      mutable Expression<dim> value_formula;
      std::unique_ptr<Expression<dim>> gradient_formula;
      const std::string gradient_name;
      mutable bool is_compared = false;
      const std::shared_ptr<const double> half_extent;
    };

    template <int dim>
    std::shared_ptr<RigidObstacle<dim>>
    make_height(const RigidObstacleParameters &parameters,
                const std::shared_ptr<const double> &half_extent)
    {
      const Numbers numbers(parameters);
      const Tensor<1, dim> axis = numbers.direction<dim>("Axis");
      HeightObstacle<dim> height;
      unsigned int n_used = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (axis[d] != 0)
        {
          ++n_used;
          height.axis = d;
          height.material_above = axis[d] < 0;
        }
      if (n_used != 1)
        numbers.wrong("Axis", "the axis of a height must be a coordinate axis, "
                              "along it or against it.");
      const char *const names[] = {"x", "y", "z"};
      for (const char *formula : {"Expression", "Gradient"})
        if (names_in(parameters.values.at(formula)).count(names[height.axis])
            > 0)
          numbers.wrong(formula, "'" + parameters.values.at(formula)
                                     + "' depends on "
                                     + std::string(names[height.axis])
                                     + ", the coordinate along the axis: a "
                                       "height is a function of the others.");
      if (parameters.hollow)
        height.material_above = !height.material_above;
      height.along_axis = parameters.along_axis;
      height.height =
          std::make_shared<CheckedFormula<dim>>(parameters, half_extent);
      return std::make_shared<RigidObstacle<dim>>(height);
    }

    template <int dim>
    std::shared_ptr<RigidObstacle<dim>>
    make_surface_obstacle(const RigidObstacleParameters &parameters,
                          const RunOptions &options)
    {
      const SurfaceArrays arrays =
          make_surface<dim>(parameters.surface, options);
      abut_surface_data data = abut_surface_data_defaults();
      data.dimension = dim;
      data.n_nodes = arrays.n_nodes();
      data.n_facets = arrays.n_facets();
      data.kind = arrays.kind;
      data.connectivity = arrays.connectivity.data();
      data.position = arrays.position.data();
      abut_obstacle_surface how = abut_obstacle_surface_defaults();
      how.open = parameters.open;
      how.hollow = parameters.hollow;
      how.limit =
          Numbers(parameters)
              .number("Limit", 0, std::numeric_limits<double>::infinity(),
                      "a positive number, or infinite.", 0);
      try
      {
        return std::make_shared<RigidObstacle<dim>>(data, how);
      }
      catch (const dealii::ExceptionBase &error)
      {
        throw InputError(arrays.parameter,
                         arrays.origin + " is not a surface of an obstacle: "
                             + dealii_message(error)
                             + (parameters.open ? ""
                                                : " (`Open surface = true` "
                                                  "allows borders.)"));
      }
    }

    /** Where Rotate and Move put the obstacle before any motion; surfaces have
     * been put there node by node. */
    template <int dim>
    RigidPose<dim> first_pose(const RigidObstacleParameters &parameters)
    {
      RigidPose<dim> pose = RigidPose<dim>::turned(
          0, Point<dim>(), Tensor<1, 3>({0, 0, 1}), Tensor<1, dim>());
      if (parameters.kind == "surface")
        return pose;
      const Placement<dim> placement =
          make_placement<dim>(parameters.surface.mesh);
      for (unsigned int j = 0; j < dim; ++j)
      {
        const Tensor<1, dim> column =
            placement.place_direction(Point<dim>::unit_vector(j));
        for (unsigned int i = 0; i < dim; ++i)
          pose.rotation[i][j] = column[i];
      }
      pose.translation = placement.place(Point<dim>()) - Point<dim>();
      return pose;
    }

    /** Formulas in t alone. */
    template <int dim> class TimeFormula
    {
    public:
      TimeFormula(const RigidObstacleParameters &parameters,
                  const std::string &name, const unsigned int n_components)
          : n_components(n_components)
      {
        const std::string &text = parameters.values.at(name);
        if (text.empty())
          return;
        expression = std::make_unique<Expression<dim>>(
            text, parameters.parameter(name), n_components);
        Point<dim> elsewhere;
        for (unsigned int d = 0; d < dim; ++d)
          elsewhere[d] = 0.37 + 0.11 * d;
        expression->set_time(0.59);
        for (unsigned int c = 0; c < n_components; ++c)
          if (expression->value(Point<dim>(), c)
              != expression->value(elsewhere, c))
            throw InputError(parameters.parameter(name),
                             "'" + text
                                 + "' depends on x, y or z; a rigid motion is "
                                   "a formula in t only.");
      }

      bool is_present() const
      {
        return expression != nullptr;
      }

      /** Values at a time; throws InputError if they are not finite. */
      std::vector<double> at(const double time)
      {
        std::vector<double> values(n_components, 0.);
        if (!expression)
          return values;
        expression->set_time(time);
        for (unsigned int c = 0; c < n_components; ++c)
          values[c] = expression->evaluate({Point<dim>()}, c)[0];
        return values;
      }

    private:
      const unsigned int n_components;
      std::unique_ptr<Expression<dim>> expression;
    };

    /** The motion that follows the first pose. */
    template <int dim> class Motion
    {
    public:
      explicit Motion(const RigidObstacleParameters &parameters)
          : parameters(parameters),
            first(first_pose<dim>(parameters)),
            translation(parameters, "Motion", dim),
            angle(parameters, "Rotation angle", 1)
      {
        const Numbers numbers(parameters);
        centre = centre_of_rotation<dim>(parameters);
        axis = numbers.direction<3>("Rotation axis");
      }

      RigidPose<dim> at(const double time)
      {
        const std::vector<double> shift = translation.at(time);
        Tensor<1, dim> moved;
        for (unsigned int d = 0; d < dim; ++d)
          moved[d] = shift[d];
        const RigidPose<dim> motion = RigidPose<dim>::turned(
            degree * angle.at(time)[0], centre, axis, moved);
        const Tensor<1, dim> place =
            motion.rotation * first.translation + motion.translation;
        if (!(place.norm() <= ABUT_FACET_LIMIT))
          throw InputError(
              parameters.parameter(
                  moved.norm() > first.translation.norm() ? "Motion" : "Move"),
              "at time " + short_number(time)
                  + " it moves the obstacle farther than 1e40.");
        return {motion.rotation * first.rotation, place};
      }

    private:
      const RigidObstacleParameters parameters;
      const RigidPose<dim> first;
      TimeFormula<dim> translation, angle;
      Point<dim> centre;
      Tensor<1, 3> axis;
    };

    template <int dim>
    std::shared_ptr<RigidObstacle<dim>>
    make_unplaced(const RigidObstacleParameters &parameters,
                  const RunOptions &options,
                  const std::shared_ptr<const double> &half_extent)
    {
      if (parameters.kind == "surface")
        return make_surface_obstacle<dim>(parameters, options);
      if (parameters.kind == "height")
        return make_height<dim>(parameters, half_extent);
      if (parameters.kind == "distance")
        return std::make_shared<RigidObstacle<dim>>(
            std::make_shared<CheckedFormula<dim>>(parameters, half_extent),
            parameters.hollow);
      const abut_obstacle_shape shape = make_shape<dim>(parameters);
      try
      {
        return std::make_shared<RigidObstacle<dim>>(shape);
      }
      catch (const dealii::ExceptionBase &error)
      {
        throw InputError(parameters.parameter("Kind"),
                         "'" + parameters.kind
                             + "' cannot be made: " + dealii_message(error));
      }
    }
  } // namespace

  template <int dim>
  Point<dim> centre_of_rotation(const RigidObstacleParameters &parameters)
  {
    return Point<dim>(
        Numbers(parameters).vector<dim>("Rotation centre", Tensor<1, dim>()));
  }

  template <int dim>
  std::shared_ptr<RigidObstacle<dim>>
  make_rigid_obstacle(const RigidObstacleParameters &parameters,
                      const RunOptions &options,
                      const std::shared_ptr<const double> half_extent)
  {
    const auto motion = std::make_shared<Motion<dim>>(parameters);
    std::shared_ptr<RigidObstacle<dim>> obstacle =
        make_unplaced<dim>(parameters, options, half_extent);
    obstacle->set_motion([motion](const double time)
                         { return motion->at(time); });
    obstacle->set_time(0);
    return obstacle;
  }

  template Point<2> centre_of_rotation<2>(const RigidObstacleParameters &);
  template Point<3> centre_of_rotation<3>(const RigidObstacleParameters &);
  template std::shared_ptr<RigidObstacle<2>>
  make_rigid_obstacle<2>(const RigidObstacleParameters &, const RunOptions &,
                         std::shared_ptr<const double>);
  template std::shared_ptr<RigidObstacle<3>>
  make_rigid_obstacle<3>(const RigidObstacleParameters &, const RunOptions &,
                         std::shared_ptr<const double>);
} // namespace abut::app

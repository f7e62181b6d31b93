// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_functions.h"

#include "app/input/input_error.h"
#include "app/physics/nodal_interpolation.h"

#include <algorithm>

namespace abut::app
{
  using dealii::types::boundary_id;

  template <int dim>
  SolidFunctions<dim>::SolidFunctions(const SolidParameters &parameters)
      : parameters(parameters)
  {
    if (!parameters.gravity.empty())
      gravity = std::make_unique<Expression<dim>>(parameters.gravity,
                                                  "Solid/Gravity", dim);
    const auto initial =
        [](const std::string &text, const std::string &parameter)
    {
      std::unique_ptr<Expression<dim>> made;
      if (!text.empty())
        made = std::make_unique<Expression<dim>>(text, parameter, dim);
      if (made && made->depends_on_time())
        throw InputError(parameter,
                         "'" + text
                             + "' depends on t; it is the state at time 0.");
      return made;
    };
    for (const BodyParameters &body : parameters.bodies)
      of_body.push_back(
          {BoundaryExpressions<dim>(body.support,
                                    body.parameter("Prescribed displacement"),
                                    dim, true),
           BoundaryExpressions<dim>(body.traction, body.parameter("Traction"),
                                    dim),
           BoundaryExpressions<dim>(body.pressure, body.parameter("Pressure")),
           std::make_unique<VolumeForce<dim>>(body.density, gravity.get(),
                                              body.body_force,
                                              body.parameter("Body force")),
           initial(body.initial_displacement,
                   body.parameter("Initial displacement")),
           initial(body.initial_velocity, body.parameter("Initial velocity"))});
  }

  template <int dim>
  ElasticData<dim>
  SolidFunctions<dim>::data(const Bodies<dim> &bodies,
                            const std::set<boundary_id> &surfaces) const
  {
    ElasticData<dim> result;
    result.name = [&bodies](const boundary_id id) { return bodies.name(id); };
    for (unsigned int body = 0; body < bodies.size(); ++body)
    {
      std::set<boundary_id> taken;
      for (const boundary_id id : bodies.ids(body))
        if (surfaces.count(bodies.number(body, id)) > 0)
          taken.insert(id);
      const auto add = [&](const BoundaryExpressions<dim> &list, auto &to)
      {
        for (const auto &[id, condition] :
             list.conditions(bodies.names(body), taken))
        {
          to[bodies.number(body, id)] = condition;
        }
      };
      const OfBody &own = of_body[body];
      add(own.traction, result.tractions);
      add(own.pressure, result.pressures);
      for (const auto &list :
           {own.traction.conditions(bodies.names(body), taken),
            own.pressure.conditions(bodies.names(body), taken)})
        for (const auto &entry : list)
          taken.insert(entry.first);
      add(own.support, result.supports);
      require_effect(bodies, body, result);
      if (own.force->is_present())
        result.body_force[body] = own.force.get();
      const BodyParameters &given = parameters.bodies[body];
      result.materials[body] = given.material->make<dim>(
          {given.numbers, parameters.plane, given.volume});
    }
    return result;
  }

  template <int dim>
  void SolidFunctions<dim>::require_effect(const Bodies<dim> &bodies,
                                           const unsigned int body,
                                           const ElasticData<dim> &data) const
  {
    // Whether a support of the id holds all components that the load moves.
    const auto is_held =
        [&](const boundary_id id, const std::vector<bool> &moves)
    {
      const auto support = data.supports.find(bodies.number(body, id));
      bool held = support != data.supports.end();
      for (unsigned int c = 0; held && c < dim; ++c)
        held = !moves[c] || support->second.components[c];
      return held;
    };
    const auto require = [&](const BoundaryExpressions<dim> &loads,
                             const auto &given, const std::string &name)
    {
      for (const boundary_id id : loads.named(bodies.names(body)))
      {
        const Expression<dim> &load =
            *given.at(bodies.number(body, id)).function;
        std::vector<bool> moves(dim, true);
        for (unsigned int c = 0; load.n_components == dim && c < dim; ++c)
          moves[c] = !load.is_zero(c);
        if (is_held(id, moves))
          throw InputError(
              parameters.bodies[body].parameter(name),
              "the load on boundary " + std::to_string(id) + " has no effect: "
                  + parameters.bodies[body].parameter("Prescribed displacement")
                  + " fixes it there.");
      }
    };
    require(of_body[body].traction, data.tractions, "Traction");
    require(of_body[body].pressure, data.pressures, "Pressure");
  }

  template <int dim>
  typename MassData<dim>::Density
  SolidFunctions<dim>::density(const Materials<dim> &materials) const
  {
    return [this, &materials](const dealii::types::material_id body,
                              const std::vector<dealii::Point<dim>> &points)
    {
      const double density = parameters.bodies[body].density;
      std::vector<double> result;
      for (const dealii::Point<dim> &point : points)
        result.push_back(density * materials.at(body)->measure(point));
      return result;
    };
  }

  template <int dim>
  std::pair<la::Vector, la::Vector>
  SolidFunctions<dim>::initial_motion(const DiscreteProblem<dim> &problem) const
  {
    const auto at_nodes =
        [&](const std::unique_ptr<Expression<dim>> OfBody::*formula)
    {
      return values_at_nodes<dim>(problem,
                                  [&](const dealii::types::material_id body)
                                  { return (of_body[body].*formula).get(); });
    };
    return {at_nodes(&OfBody::displacement), at_nodes(&OfBody::velocity)};
  }

  template <int dim> void SolidFunctions<dim>::set_time(const double time)
  {
    if (gravity)
      gravity->set_time(time);
    for (OfBody &body : of_body)
    {
      for (BoundaryExpressions<dim> *list :
           {&body.support, &body.traction, &body.pressure})
        list->set_time(time);
      body.force->set_time(time);
    }
  }

  template <int dim> bool SolidFunctions<dim>::supports_move() const
  {
    return std::any_of(of_body.begin(), of_body.end(),
                       [](const OfBody &body)
                       { return body.support.depends_on_time(); });
  }

  template class SolidFunctions<2>;
  template class SolidFunctions<3>;
} // namespace abut::app

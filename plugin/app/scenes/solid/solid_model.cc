// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_model.h"

#include "app/adapt/elastic_estimator.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "app/physics/contact_traction.h"
#include "app/physics/elastic_traction.h"
#include "app/physics/load_resultants.h"
#include "app/pictures/contact_output.h"
#include "app/pictures/outline.h"
#include "app/restart/archive.h"
#include "app/scenes/common_parameters.h"
#include "app/scenes/method_words.h"
#include "shim/bodies.h"
#include "solid_report.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace abut::app
{
  using dealii::types::boundary_id;

  namespace
  {
    template <int dim> bool is_of_revolution(const SolidParameters &parameters)
    {
      return dim == 2 && parameters.plane == PlaneModel::axisymmetric;
    }

    template <int dim>
    CellDegrees degrees_of(const SolidParameters &parameters,
                           const BodyMeshes<dim> &coarse)
    {
      return {coarse.has_cubes() ? parameters.degree : 0,
              coarse.has_simplices() ? parameters.simplex_degree : 0};
    }

    /** Column of levels.csv with a component of the force on a pair's
     * secondary side. */
    std::string force_column(const std::size_t pair, const unsigned int d)
    {
      return "pair_" + std::to_string(pair + 1) + "_force_" + "xyz"[d];
    }
  } // namespace

  template <int dim>
  SolidModel<dim>::SolidModel(const SolidParameters &parameters,
                              ContactRunState<dim> &run,
                              const SearchParameters &search,
                              BodyMeshes<dim> coarse)
      : MovingModel<dim>(run, coarse.has_simplices()),
        parameters(parameters),
        bodies(parameters.bodies, is_of_revolution<dim>(parameters)),
        elasticity(this->triangulation, degrees_of(parameters, coarse),
                   coarse.middles),
        driven(parameters),
        search(search),
        coarse(std::move(coarse)),
        assembler(run.contact),
        output(*this)
  {
    run.contact.set_axisymmetric(is_of_revolution<dim>(parameters));
    if (parameters.time.is_on)
      motion = std::make_unique<ModelMotion<dim>>(
          parameters.time, motion_words(), run, elasticity);
  }

  template <int dim> void SolidModel<dim>::create_functions()
  {
    functions = std::make_unique<SolidFunctions<dim>>(parameters);
    pairs = std::make_unique<SolidPairs<dim>>(parameters, run.options);
    if (parameters.bodies.size() > 1 && parameters.pairs.empty())
      run.report.warn("Solid/Pairs is 0: nothing keeps the "
                      + std::to_string(parameters.bodies.size())
                      + " bodies from passing through each other. Add a pair "
                        "for surfaces that can touch.");
    driven.create_functions();
    const abut_time_scheme &scheme = parameters.time.scheme;
    if (motion && scheme.projects != 0 && scheme.contact_in_step != 0
        && pairs->has_friction())
      throw InputError("Time stepping/Scheme",
                       std::string(scheme.name)
                           + " has two contact problems in a step and no slip "
                             "of the step: use hht for friction.");
    if (!parameters.exact_displacement.empty())
      exact = std::make_unique<ExactSolution<dim>>(
          parameters.exact_displacement, "Exact solution/Displacement",
          parameters.exact_gradient, "Exact solution/Gradient", dim);
  }

  template <int dim> void SolidModel<dim>::create_mesh()
  {
    bodies.create(coarse, run.options, degrees_of(parameters, coarse),
                  parameters.refinement.level, this->triangulation);
    coarse = BodyMeshes<dim>();
    for (const std::string &warning : bodies.warnings())
      run.report.warn(warning);
    for (const std::vector<bool> &marked : bisections)
      bodies.refine(marked, this->triangulation);
    if (run.options.output_folder.empty())
      return;
    write_outline<dim>(
        run.options.output_folder, run.communicator, this->triangulation,
        [this](const boundary_id number)
        {
          const unsigned int body = bodies.body_of(number);
          const boundary_id id = bodies.user_id(number);
          return SurfaceName{body + 1, id, bodies.names(body).names_of(id)};
        });
    output.write_obstacle_surfaces(0.);
  }

  template <int dim>
  std::vector<unsigned int>
  SolidModel<dim>::bisect(const std::vector<bool> &marked)
  {
    bisections.push_back(marked);
    std::vector<unsigned int> origin =
        bodies.refine(marked, this->triangulation);
    elasticity.dof_handler.reinit(this->triangulation);
    if (chords)
      look_for_chords();
    return origin;
  }

  template <int dim> SearchParameters SolidModel<dim>::numbered_search() const
  {
    SearchParameters result = search;
    result.thickness.clear();
    for (const auto &[id, length] : search.thickness)
    {
      bool found = false;
      for (unsigned int body = 0; body < bodies.size(); ++body)
      {
        const auto &ids = bodies.ids(body);
        if (std::find(ids.begin(), ids.end(), boundary_id(id)) == ids.end())
          continue;
        result.thickness[bodies.number(body, boundary_id(id))] = length;
        found = true;
      }
      if (!found)
        throw InputError("Search/Thickness", "no body has a boundary id "
                                                 + std::to_string(id) + ".");
    }
    return result;
  }

  template <int dim> void SolidModel<dim>::set_data()
  {
    assembler.set_search_parameters(numbered_search());
    const double length = half_extent(this->triangulation);
    pairs->set_length(length);
    if (exact)
      exact->set_length(length);
    pairs->find_surfaces(bodies);
    data = functions->data(bodies, pairs->surfaces());
    pairs->require_free(bodies, data.supports);
    points = read_points(parameters.points, bodies);
    double stiffness = 0.;
    for (const auto &[body, material] : data.materials)
      stiffness = stiffness > 0. ? std::min(stiffness, material->stiffness())
                                 : material->stiffness();
    driven.set_sizes(stiffness, length);
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
      if (driven.is_driven(o))
        pairs->let_come(o);
  }

  template <int dim> void SolidModel<dim>::check_setup()
  {
    std::map<boundary_id, dealii::ComponentMask> held;
    for (const auto &[id, support] : data.supports)
      held[id] = support.components;
    const shim::BodyNumbers<dim> numbers(this->triangulation);
    parts = find_parts(this->triangulation);
    std::vector<std::string> names;
    for (BodyPart<dim> &part : parts)
    {
      part.given_name = bodies.given_name(part.body);
      names.push_back(part.name());
    }
    assembler.set_body_names(std::move(names));
    freedom = rigid_freedom<dim>(
        elasticity.mapping, elasticity.dof_handler, parts.size(),
        [&numbers](const auto &cell) { return numbers.of(cell); },
        parameters.plane, held);
    const std::set<boundary_id> touched = pairs->surfaces();
    if (motion)
      pairs->let_fly();
    for (unsigned int k = 0; k < parts.size() && !motion; ++k)
    {
      if (freedom[k].n_modes == 0)
        continue;
      const std::set<boundary_id> &ids = parts[k].ids;
      if (std::none_of(ids.begin(), ids.end(),
                       [&](const boundary_id id)
                       { return touched.count(id) > 0; }))
        throw InputError(
            bodies[parts[k].body].parameter("Prescribed displacement"),
            coded(ABUT_FAILURE_FLOATING_BODY,
                  parts[k].name() + " has too few supports: they allow "
                      + freedom[k].description
                      + ", and it is in no contact pair."));
      pairs->hold(ids, parts[k].n_parts > 1);
    }
    check_points(points, elasticity);
    look_for_chords();
  }

  template <int dim>
  std::string SolidModel<dim>::text_of_bend(const Bend<dim> &bend,
                                            const std::string &effect) const
  {
    std::ostringstream message;
    message << "facets of the mesh file of " << bodies.name(bend.id)
            << " meet at an angle of " << short_number(bend.degrees, 3)
            << " degrees at (" << bend.place
            << "), and refinement keeps them straight: " << effect
            << ". Name the circle, cylinder or sphere in "
            << bodies[bodies.body_of(bend.id)].mesh.section
            << "/Curved sides; 'flat' there marks a corner.";
    return message.str();
  }

  template <int dim> void SolidModel<dim>::look_for_chords()
  {
    std::set<dealii::types::material_id> from_files;
    for (unsigned int body = 0; body < bodies.size(); ++body)
      if (!bodies[body].mesh.file.empty() && !bodies.is_curved(body)
          && bodies[body].refinements + parameters.refinement.last_mesh() > 0)
        from_files.insert(body);
    if (from_files.empty())
      return;
    chords.emplace(this->triangulation, from_files, pairs->surfaces());
    // Smaller angles are told of where they matter, once there are pressures.
    constexpr double visible = 2.;
    const Bend<dim> bend = chords->largest();
    if (bend.degrees <= visible)
      return;
    chords.reset();
    run.report.warn(
        coded(ABUT_FAILURE_COARSE_CURVE,
              "A round side may be a polygon: "
                  + text_of_bend(bend, "finer meshes will converge to the "
                                       "contact of a polygon")));
  }

  template <int dim> void SolidModel<dim>::setup_mesh()
  {
    {
      SectionTimes::Scope scope(run.report.times, "unknowns and pattern");
      elasticity.renumber = parameters.refinement.renumber;
      elasticity.setup(data);
      elasticity.vertex_origins = bodies.vertex_origins();
    }
    SectionTimes::Scope scope(run.report.times, "assembly");
    elasticity.assemble_stiffness();
    if (motion)
      motion->setup(functions->density(data.materials),
                    pairs->touching(bodies));
  }

  template <int dim> void SolidModel<dim>::assemble()
  {
    SectionTimes::Scope scope(run.report.times, "assembly");
    elasticity.assemble_load(data);
  }

  template <int dim> la::Vector SolidModel<dim>::unbalanced_forces() const
  {
    return motion ? motion->bodies().unbalanced_forces()
                  : elasticity.unbalanced_forces(run.u);
  }

  template <int dim> void SolidModel<dim>::write_fields()
  {
    output.write_fields();
  }

  template <int dim> void SolidModel<dim>::set_time(const double time)
  {
    functions->set_time(time);
    driven.set_time(time);
    if (exact)
      exact->set_time(time);
    // The first mesh gets its supports with its unknowns.
    if (functions->supports_move() && elasticity.dof_handler.has_active_dofs())
      elasticity.set_supports(data);
  }

  template <int dim>
  void SolidModel<dim>::set_contact(ContactAssembler<dim> &contact,
                                    const double time)
  {
    if (motion && time > run.load_steps.time())
      pairs->refuse_jumps(run.load_steps.time(), time);
    if (!driven.empty())
      pairs->set_driven(driven_places(time));
    pairs->set_time(time);
    contact.set_pairs(pairs->pairs());
    contact.set_surface_traction(std::make_shared<ElasticTraction<dim>>(
        elasticity.mapping, data.materials));
    this->renew_tangent(contact);
  }

  template <int dim>
  void SolidModel<dim>::prepare_contact(ContactAssembler<dim> &contact)
  {
    MovingModel<dim>::prepare_contact(contact);
    // Nor by that of deformed bodies: they must not change on the way.
    if (has_large_strain())
      contact.set_reference_stiffness(elasticity.undeformed_stiffness());
  }

  template <int dim> std::string SolidModel<dim>::save_state() const
  {
    return to_bytes(std::make_pair(
        std::make_pair(std::make_pair(to_bytes(output), this->motion_state()),
                       std::make_pair(to_bytes(driven), has_warned)),
        bisections));
  }

  template <int dim> void SolidModel<dim>::load_state(const std::string &bytes)
  {
    std::pair<std::pair<std::pair<std::string, std::string>,
                        std::pair<std::string, bool>>,
              std::vector<std::vector<bool>>>
        all;
    from_bytes(bytes, all);
    bisections = all.second;
    const auto &parts = all.first;
    from_bytes(parts.first.first, output);
    this->load_motion(parts.first.second);
    from_bytes(parts.second.first, driven);
    has_warned = parts.second.second;
  }

  template <int dim>
  std::string SolidModel<dim>::support_of(const Message &message) const
  {
    return message.body < 0 ? ""
                            : bodies[parts.at(message.body).body].parameter(
                                "Prescribed displacement");
  }

  template <int dim> void SolidModel<dim>::look_at_rows(const bool is_last)
  {
    if (has_warned || !is_last)
      return;
    has_warned = true;
    for (const PairCheck &check : run.contact.checks().pairs())
      for (const Message &warning : check.warnings)
        run.report.warn(about(check.name, warning));
  }

  template <int dim>
  bool
  SolidModel<dim>::is_held(const BodyPart<dim> &part,
                           const std::vector<PairResult<dim>> &results) const
  {
    bool held = false;
    for (std::size_t i = 0; i < results.size(); ++i)
    {
      const ContactPair<dim> &pair = pairs->pairs()[i];
      // nobody holds itself, but parts may hold each other
      if (pair.secondary == pair.primary && part.n_parts == 1)
        continue;
      for (const auto *side : {&pair.secondary, &pair.primary})
        for (const boundary_id id : *side)
          held = held || (part.ids.count(id) > 0 && results[i].n_active > 0);
    }
    return held;
  }

  template <int dim> Message SolidModel<dim>::refuse() const
  {
    if (motion && has_large_strain()
        && !std::isfinite(elasticity.stored_energy(run.u)))
      return coded(ABUT_FAILURE_NOT_FINITE,
                   "At the end of this time step a cell is inverted. Use a "
                   "smaller Time stepping/Step size.");
    // A step that cannot be shortened is told of at the end.
    if (motion && parameters.load_steps.cut_back)
      return leaves_points();
    // Others have found out in each linear system what supports the bodies.
    const abut_law &law = *run.method.options.law;
    if (!abut_law_is_interior(&law) && !abut_law_needs_stress(&law))
      return "";
    for (unsigned int k = 0; k < parts.size() && !motion; ++k)
      if (freedom[k].n_modes > 0
          && !is_held(parts[k], run.contact.results().pairs()))
        return coded(
            ABUT_FAILURE_FLOATING_BODY,
            "Nothing holds " + parts[k].name() + ": its supports allow "
                + freedom[k].description
                + ", and it has no contact. Press it against another body, or "
                  "give it a support ("
                + bodies[parts[k].body].parameter("Prescribed displacement")
                + ").");
    return "";
  }

  namespace
  {
    /** Part of a direction that supports must leave free. */
    constexpr double unstopped = 0.99;

    template <int dim>
    dealii::Tensor<1, dim> free_part(const FreeBody<dim> &body,
                                     const dealii::Tensor<1, dim> &direction)
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = direction[d] * body.free[d];
      return result;
    }

    /** The load on pair @p p by the body @p k and all that rest on it and are
     * free along this direction: forces between them need not be in balance.
     * @p loads of those bodies that may be among them; others push by the
     * forces of their pairs. */
    template <int dim>
    dealii::Tensor<1, dim> load_on_pair(
        const std::size_t p, const unsigned int k,
        const dealii::Tensor<1, dim> &along,
        const std::vector<FreeBody<dim>> &bodies,
        const std::vector<std::optional<dealii::Tensor<1, dim>>> &loads,
        const std::vector<PairResult<dim>> &pairs)
    {
      dealii::Tensor<1, dim> force;
      std::vector<std::size_t> inside = {k};
      for (std::size_t n = 0; n < inside.size(); ++n)
      {
        const std::vector<double> &sides = bodies[inside[n]].sides;
        force += *loads[inside[n]];
        for (std::size_t q = 0; q < pairs.size(); ++q)
        {
          if (q == p || sides[q] == 0.)
            continue;
          std::size_t other = 0;
          while (other < loads.size()
                 && !(loads[other] && bodies[other].sides[q] == -sides[q]
                      && (other == k || bodies[other].sides[p] == 0.)
                      && free_part(bodies[other], along).norm() >= unstopped))
            ++other;
          if (std::find(inside.begin(), inside.end(), other) != inside.end())
            continue;
          if (other < loads.size())
            inside.push_back(other);
          else
            force += sides[q] * pairs[q].secondary_force;
        }
      }
      return force;
    }
  } // namespace

  /* All points of the pair slip one way, which nothing else stops: then the
   * loads and the other contacts of the body balance the friction. */
  template <int dim> Message SolidModel<dim>::sliding() const
  {
    constexpr double one_way = 0.9, reached = 0.99;
    if (motion || !pairs->has_friction())
      return "";
    const auto results = run.contact.results().pairs();
    const auto loads = load_resultants(elasticity, bodies.size());
    const std::vector<FreeBody<dim>> free = free_bodies();
    std::vector<std::optional<dealii::Tensor<1, dim>>> load_of(parts.size());
    for (unsigned int k = 0; k < parts.size(); ++k)
      if (parts[k].n_parts == 1)
        load_of[k] = loads[parts[k].body].force;
    for (unsigned int k = 0; k < parts.size(); ++k)
      for (std::size_t p = 0; p < results.size(); ++p)
      {
        const PairResult<dim> &pair = results[p];
        const double side = free[k].sides[p],
                     limit = pair.secondary_friction.norm();
        if (parts[k].n_parts > 1 || std::abs(side) != 1. || pair.n_active == 0
            || pair.n_slipping < pair.n_active
            || !(limit > one_way * pair.friction_force))
          continue;
        const dealii::Tensor<1, dim> against =
            side / limit * pair.secondary_friction;
        const dealii::Tensor<1, dim> along = free_part(free[k], -against);
        const auto force = load_on_pair(p, k, along, free, load_of, results);
        // Of an iterate out of balance the slip may be the other way.
        const double load = std::abs(force * along);
        if (along.norm() < unstopped || !(load > reached * limit))
          continue;
        return coded(
            ABUT_FAILURE_FREE_SLIDING,
            pair.name + ": all points slip, and nothing but friction supports "
                + parts[k].name() + ": the load along the surface is "
                + short_number(load, 3) + ", the friction at most "
                + short_number(limit, 3)
                + ". Support the body in that direction, load it less along "
                  "the surface, press it more, or give the pair a larger "
                  "coefficient of friction.",
            {{"load", load}, {"friction", limit}});
      }
    return "";
  }

  template <int dim>
  std::vector<std::string> SolidModel<dim>::rigid_motions() const
  {
    std::vector<std::string> lines;
    for (unsigned int k = 0; k < parts.size(); ++k)
      lines.push_back(parts[k].name() + ": "
                      + (freedom[k].n_modes == 0
                             ? "its supports leave no rigid motion"
                             : "its supports leave " + freedom[k].description
                                   + ", which contact must support"));
    return lines;
  }

  template <int dim>
  bool SolidModel<dim>::may_rotate(const unsigned int body) const
  {
    for (unsigned int k = 0; k < parts.size(); ++k)
    {
      const auto &free = freedom[k].translations;
      if (parts[k].body == body
          && freedom[k].n_modes > std::count(free.begin(), free.end(), true))
        return true;
    }
    return false;
  }

  template <int dim>
  std::vector<FreeBody<dim>> SolidModel<dim>::free_bodies() const
  {
    using Ids = std::set<boundary_id>;
    const auto part_of = [](const Ids &side, const Ids &surface)
    {
      const auto n = std::count_if(side.begin(), side.end(),
                                   [&](const boundary_id id)
                                   { return surface.count(id) > 0; });
      return n == 0 ? 0. : n == std::ptrdiff_t(side.size()) ? 1. : NAN;
    };
    std::vector<FreeBody<dim>> result;
    for (unsigned int k = 0; k < parts.size(); ++k)
    {
      FreeBody<dim> body{"supports leave " + parts[k].name() + " "
                             + freedom[k].description,
                         {},
                         {}};
      for (unsigned int d = 0; d < dim; ++d)
        body.free[d] = freedom[k].translations[d] ? 1. : 0.;
      for (const ContactPair<dim> &pair : pairs->pairs())
      {
        const double secondary = part_of(pair.secondary, parts[k].ids);
        const double primary = part_of(pair.primary, parts[k].ids);
        body.sides.push_back(secondary * primary != 0. ? NAN
                                                       : secondary - primary);
      }
      result.push_back(std::move(body));
    }
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
    {
      FreeBody<dim> body{
          "forces drive obstacle " + std::to_string(o + 1), {}, {}};
      for (unsigned int d = 0; d < dim; ++d)
        body.free[d] = driven.is_driven(o) && driven.is_free(o, d) ? 1. : 0.;
      for (std::size_t i = 0; i < pairs->pairs().size(); ++i)
        body.sides.push_back(pairs->obstacle_of(i) == o ? -1. : 0.);
      result.push_back(std::move(body));
    }
    return result;
  }

  template <int dim>
  std::string SolidModel<dim>::why_force_is_prescribed() const
  {
    if (motion)
      return "";
    const std::vector<FreeBody<dim>> bodies = free_bodies();
    std::string text;
    for (const FreeBody<dim> *body :
         bodies_in_balance(bodies, run.contact.results().pairs(),
                           run.contact.results().measures().force))
      text += (text.empty() ? "" : ", ") + body->name;
    return text;
  }

  template <int dim> bool SolidModel<dim>::tells_friction_apart() const
  {
    return pairs->has_friction()
           && !abut_law_needs_stress(run.method.options.law);
  }

  template <int dim> ContactFields SolidModel<dim>::contact_fields() const
  {
    if (pairs->empty())
      return {};
    const la::Vector status = run.contact.results().status();
    const auto per_area = [&](const la::Vector &force)
    {
      return contact_traction(elasticity.mapping, elasticity.dof_handler,
                              elasticity.constraints, elasticity.hanging,
                              data.materials, pairs->surfaces(), force,
                              &status);
    };
    // Those of the pressures have none of what solvers leave over, which would
    // pull at open nodes.
    const bool by_pressures =
        !motion && !abut_law_needs_stress(run.method.options.law);
    la::Vector forces =
        by_pressures ? elasticity.vector() : unbalanced_forces();
    if (by_pressures)
      run.contact.results().add_forces(forces);
    const la::Vector traction = per_area(forces);
    la::Vector normal(traction), along;
    if (tells_friction_apart())
    {
      la::Vector pressures = elasticity.vector();
      run.contact.results().add_forces(pressures, ForcePart::of_pressures);
      normal = per_area(pressures);
      forces -= pressures;
      along = per_area(forces);
    }
    return {traction,
            normal,
            along,
            elasticity.ghosted_field(run.contact.results().pressure()),
            elasticity.ghosted_field(mark_rows(
                elasticity.dof_handler, run.contact.results().gap(), status)),
            elasticity.ghosted_field(status),
            elasticity.ghosted_field(run.contact.results().slip())};
  }

  template <int dim>
  double SolidModel<dim>::estimate(dealii::Vector<float> &squared) const
  {
    const la::Vector displacement = elasticity.ghosted(run.u);
    const ContactFields fields = contact_fields();
    ElasticEstimatorInput<dim> input{elasticity.mapping, elasticity.dof_handler,
                                     displacement, data.materials};
    for (const auto &[body, force] : data.body_force)
      input.body_force[body] = force;
    for (const auto &[id, traction] : data.tractions)
      input.traction[id] = traction.function;
    for (const auto &[id, pressure] : data.pressures)
      input.pressure_load[id] = pressure.function;
    for (const auto &[id, support] : data.supports)
      input.supports[id] = support.components;
    if (!pairs->empty())
    {
      input.contact = pairs->surfaces();
      input.contact_traction = &fields.traction;
      input.secondary = pairs->secondary();
      input.pressure = &fields.pressure;
      // With a target, what the law leaves open is an error of its own; what a
      // user's own law leaves open is none.
      const bool exact_law = abut_law_is_exact(run.method.options.law)
                             || abut_law_needs_stress(run.method.options.law);
      const bool is_error =
          run.method.user_law == nullptr && (exact_law || !run.control.is_on());
      input.gap = is_error ? &fields.row_gap : nullptr;
    }
    return estimate_elastic_error(input, squared);
  }

  template <int dim> double SolidModel<dim>::solution_norm() const
  {
    // What the energy is without loads: what is stored, 1/2 |u|^2.
    const double twice =
        2. * (elasticity.energy(run.u) + elasticity.external * run.u);
    return std::sqrt(std::max(0., twice));
  }

  template <int dim>
  std::optional<double> SolidModel<dim>::work_on_gaps(const la::Vector &,
                                                      double work) const
  {
    if (pairs->has_friction())
      return {};
    for (const PairResult<dim> &pair : run.contact.results().pairs())
      work += pair.initial_gap_work;
    return work;
  }

  template <int dim> std::optional<ErrorNorms> SolidModel<dim>::errors() const
  {
    if (!exact)
      return {};
    return error_norms(elasticity.mapping, elasticity.dof_handler,
                       elasticity.ghosted(run.u), *exact, &data.materials);
  }

  template <int dim> void SolidModel<dim>::flag_more_cells()
  {
    if (pairs->empty())
      return;
    flag_contact_border(
        elasticity.dof_handler,
        elasticity.ghosted_field(run.contact.results().status()),
        pairs->secondary());
    limit_size_ratio(this->triangulation, pairs->sides());
  }

  template <int dim> void SolidModel<dim>::declare_tables()
  {
    std::vector<std::string> columns = {"load_step",
                                        "time",
                                        "level",
                                        "cells",
                                        "dofs",
                                        "constraints",
                                        "active",
                                        "steps",
                                        "linear_iterations",
                                        "matvecs",
                                        "setups",
                                        "energy",
                                        "contact_force",
                                        "penetration",
                                        "slipping",
                                        "friction_force",
                                        "dissipation",
                                        "gained",
                                        "lost",
                                        "exchanged",
                                        "searches",
                                        "reuses",
                                        "detection_seconds",
                                        "l2_error",
                                        "h1_error",
                                        "energy_norm_error",
                                        "estimate",
                                        "estimated_error",
                                        "setup_seconds",
                                        "krylov_seconds",
                                        "seconds"};
    if (has_large_strain())
    {
      columns.push_back("linearisations");
      // A motion has forces of its own, of all problems of a step.
      for (std::size_t p = 0; p < parameters.pairs.size() && !motion; ++p)
        for (unsigned int d = 0; d < dim; ++d)
          columns.push_back(force_column(p, d));
    }
    if (motion)
      for (const std::string &column : motion->columns())
        columns.push_back(column);
    for (const std::string &column : driven.columns())
      columns.push_back(column);
    run.report.declare_columns(columns);
  }

  template <int dim>
  void SolidModel<dim>::add_to_row(ContactResult &result,
                                   std::map<std::string, double> &row) const
  {
    if (pairs->has_friction())
    {
      for (const PairResult<dim> &pair : run.contact.results().pairs())
      {
        result.dissipation += pair.dissipation;
        result.friction_force += pair.friction_force;
        result.late_force.push_back(pair.late_force);
        result.stick_force.push_back(
            pair.n_active > 0
                ? pair.normal_force * double(pair.n_active - pair.n_slipping)
                      / double(pair.n_active)
                : 0.);
      }
      row["slipping"] = static_cast<double>(result.progress.n_slipping);
      row["friction_force"] = result.friction_force;
      row["dissipation"] = result.dissipation;
    }
    const DetectionReport &detection = result.detection;
    row["gained"] = static_cast<double>(detection.gained);
    row["lost"] = static_cast<double>(detection.lost);
    row["exchanged"] = static_cast<double>(detection.exchanged);
    row["searches"] = static_cast<double>(detection.searches);
    row["reuses"] = static_cast<double>(detection.reuses);
    row["detection_seconds"] = detection.seconds;
    if (has_large_strain())
    {
      row["linearisations"] = result.linearisations;
      const auto results = run.contact.results().pairs();
      for (std::size_t p = 0; p < results.size() && !motion; ++p)
        for (unsigned int d = 0; d < dim; ++d)
          row[force_column(p, d)] = results[p].secondary_force[d];
    }
    if (motion)
      motion->add_to_row(row);
    driven.add_to_row(row);
    row["load_step"] = result.load_step;
    row["time"] = result.time;
    if (result.errors)
      row["energy_norm_error"] = *result.errors->energy;
  }

  template <int dim>
  std::string SolidModel<dim>::line_of(const ContactResult &result) const
  {
    const bool has_steps = parameters.load_steps.steps > 1;
    return (has_steps ? "time " + short_number(result.time, 6) + ", " : "")
           + "mesh " + std::to_string(result.level) + ": "
           + std::to_string(result.dofs) + " unknowns, "
           + (has_contact()
                  ? counted(result.active, "point", "points") + " in contact, "
                  : "")
           + (result.linear.n_iterations > 0
                  ? std::to_string(result.linear.n_iterations)
                        + " linear iterations, "
                  : "")
           + "energy " + short_number(result.energy, 8);
  }

  template <int dim> std::string SolidModel<dim>::discretisations() const
  {
    const bool is_quadratic = dim == 3 && parameters.simplex_degree == 2;
    std::set<std::string> names;
    for (const ContactPair<dim> &pair : pairs->pairs())
    {
      const bool has_simplices =
          std::any_of(pair.secondary.begin(), pair.secondary.end(),
                      [this](const boundary_id id)
                      { return bodies.are_simplices(bodies.body_of(id)); });
      names.insert(discretisation_name(run.method.discretisation_of(
          pair.obstacle != nullptr, is_quadratic && has_simplices)));
    }
    return joined({names.begin(), names.end()}, " and ");
  }

  template <int dim> std::string SolidModel<dim>::description() const
  {
    std::string text = counted(bodies.size(), "body", "bodies");
    if (!parameters.obstacles.empty())
      text += ", "
              + counted(parameters.obstacles.size(), "rigid obstacle",
                        "rigid obstacles");
    if (has_contact())
    {
      text += ", "
              + counted(pairs->pairs().size(), "contact pair", "contact pairs")
              + "; " + law_in_words(run.method) + ", " + discretisations();
      if (pairs->has_friction())
        text += ", friction";
      if (has_large_strain() || motion)
        text += ", kinematics "
                + std::string(kinematics_info(run.method.kinematics).name);
    }
    if (has_large_strain())
      text += ", finite strain";
    if (motion)
      text += std::string(", in time by ") + parameters.time.scheme.name;
    return text + (parameters.fields ? parameters.field_steps.in_words() : "");
  }

  template <int dim> void SolidModel<dim>::report_check()
  {
    SolidReport<dim>(*this).check();
  }

  template <int dim> void SolidModel<dim>::report_result(const bool converged)
  {
    SolidReport<dim>(*this).result(converged);
  }

  template <int dim> void SolidModel<dim>::report_model()
  {
    SolidReport<dim>(*this).model_lines();
  }

  template class SolidModel<2>;
  template class SolidModel<3>;
} // namespace abut::app

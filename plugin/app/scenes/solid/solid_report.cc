// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run of the scene `solid` leaves behind.
#include "solid_report.h"
#include "app/input/short_number.h"
#include "app/mesh/boundary_parts.h"
#include "app/mesh/nearest_node.h"
#include "app/physics/components.h"
#include "app/physics/linear_stiffness.h"
#include "app/physics/load_resultants.h"
#include "app/physics/locking.h"
#include "app/physics/negative_curvature.h"
#include "app/physics/nodal_error.h"
#include "app/physics/nodal_places.h"
#include "app/scenes/diagnosis.h"
#include "app/scenes/left_out.h"
#include "app/scenes/modelled.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"
#include "shim/examination_limits.h"
#include "shim/pair_friction.h"

#include <abut/dealii/pair_measures.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    constexpr const char *plane_names[] = {"strain", "stress", "axisymmetric"};

    /** Part of the normal force that friction carries where it counts. */
    constexpr double visible_friction = 1e-3;

    /** Part of a pressure that goes astray. */
    constexpr double visible_transfer_error = 1e-3;

    /** Part of the largest pressure that straight facets may make, and that
     * from which on a facet counts as pressed. */
    constexpr double visible_chords = 0.1, pressed = 0.05;

    /** Part of the stress in the bodies below which pressures are what solvers
     * leave of 0. */
    constexpr double round_off_of_pressures = 1e-8;

    /** Poisson ratio from which on locking is looked for, and the part of the
     * strain energy that is worth a word. */
    constexpr double least_locking_ratio = 0.45, visible_locking = 0.1;

    /** Part of the energy that linear elements may add by being too stiff. */
    constexpr double visible_stiffness = 0.05;

    /** Least and largest value on any rank. Collective. */
    std::vector<double> range_over_ranks(const double value,
                                         const MPI_Comm communicator)
    {
      return {MPI::min(value, communicator), MPI::max(value, communicator)};
    }

    template <int dim>
    void set(Report &report, const std::string &key,
             const PairMeasure<dim> &measure, const PairResult<dim> &pair)
    {
      std::visit(
          [&](const auto member)
          {
            const auto &value = pair.*member;
            if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
              report.set(key, value);
            else
              report.set(key, components(value));
          },
          measure.value);
    }
  } // namespace

  template <int dim>
  SolidReport<dim>::SolidReport(const SolidModel<dim> &model)
      : model(model),
        run(model.run),
        parameters(model.parameters),
        elasticity(model.elasticity),
        bodies(model.bodies),
        pairs(*model.pairs),
        contact(run.contact),
        method(run.method),
        u(run.u),
        communicator(run.communicator),
        report(run.report)
  {
  }

  template <int dim> void SolidReport<dim>::check() const
  {
    for (const BoundaryPart<dim> &part :
         boundary_parts(model.triangulation, communicator))
      report.print("  " + bodies.name(part.id) + ": " + in_words(part));
    if (!model.motion)
      for (const std::string &line : model.rigid_motions())
        report.print("  " + line);
    for (const RigidObstacleParameters &obstacle : parameters.obstacles)
      report.print("  obstacle " + obstacle.section.substr(9) + ": "
                   + obstacle.kind
                   + (obstacle.free.empty() ? "" : ", driven by forces"));
    report_loads();
    if (!pairs.empty())
      report_checks();
    report_shares();
    report.set("bodies", bodies.size());
  }

  template <int dim> void SolidReport<dim>::report_loads() const
  {
    const bool rings = dim == 2 && parameters.plane == PlaneModel::axisymmetric;
    const std::string at =
        parameters.load_steps.steps > 1
            ? " at time " + short_number(run.load_steps.target(), 6)
            : "";
    const auto resultants = load_resultants(elasticity, bodies.size());
    for (unsigned int body = 0; body < bodies.size(); ++body)
    {
      Resultant<dim> loads = resultants[body];
      // Radial forces balance each other around the axis.
      if (rings)
        loads.force[0] = 0.;
      report.print("  " + bodies.name_of_body(body) + ": loads" + at + ": "
                   + in_words(loads, !rings && model.may_rotate(body)));
      report.set("load_" + std::to_string(body + 1), components(loads.force));
    }
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
    {
      if (!model.driven.is_driven(o))
        continue;
      Resultant<dim> loads;
      loads.force = model.driven.driving_force(o);
      loads.magnitude = loads.force.norm();
      report.print("  obstacle " + std::to_string(o + 1) + ": loads" + at + ": "
                   + in_words(loads, false));
    }
    diagnose_data(report, elasticity.load_error(model.data),
                  elasticity.support_error(model.data));
  }

  template <int dim> void SolidReport<dim>::report_points() const
  {
    const la::Vector displacement = elasticity.ghosted(u);
    unsigned int number = 0;
    for (const OutputPoint<dim> &point : model.points)
    {
      const NodalValue<dim> node =
          nearest_node(elasticity.mapping, elasticity.dof_handler, displacement,
                       point.body, point.place);
      const std::string key = "point_" + std::to_string(++number);
      report.set(key, components(node.value));
      report.set(key + "_node", components(node.position));
    }
  }

  template <int dim> la::Vector SolidReport<dim>::reactions() const
  {
    la::Vector forces = model.unbalanced_forces();
    if (!pairs.empty())
    {
      la::Vector contact_there = elasticity.vector();
      contact.results().add_forces(contact_there, ForcePart::at_prescribed);
      forces -= contact_there;
    }
    return forces;
  }

  template <int dim> void SolidReport<dim>::report_reactions() const
  {
    const la::Vector forces = reactions();
    const dealii::IndexSet &owned = elasticity.dof_handler.locally_owned_dofs();
    std::vector<bool> seen(owned.n_elements(), false);
    std::vector<double> sums(dim * bodies.size(), 0.);
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : elasticity.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      shim::get_dofs(cell, dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (!owned.is_element(dofs[i])
            || !elasticity.constraints.is_constrained(dofs[i]))
          continue;
        const auto local = owned.index_within_set(dofs[i]);
        if (seen[local])
          continue;
        seen[local] = true;
        sums[cell->material_id() * dim
             + cell->get_fe().system_to_component_index(i).first] +=
            forces(dofs[i]);
      }
    }
    MPI::sum(sums, communicator, sums);
    for (unsigned int body = 0; body < bodies.size(); ++body)
      report.set("reaction_" + std::to_string(body + 1),
                 std::vector<double>(sums.begin() + body * dim,
                                     sums.begin() + (body + 1) * dim));
  }

  template <int dim> void SolidReport<dim>::report_checks() const
  {
    unsigned int number = 0;
    for (const PairCheck &check : contact.checks().pairs())
    {
      const std::string key = "pair_" + std::to_string(++number);
      report.set(key + "_facets",
                 std::vector<double>{double(check.secondary_facets),
                                     double(check.primary_facets)});
      report.set(key + "_rows", check.n_rows);
      report.set(key + "_area", check.area);
      report.set(key + "_covered_area", check.covered_area);
      report.set(key + "_overlap", check.overlap);
      report.set(key + "_dropped", check.n_dropped);
      report.set(key + "_reversed", check.n_reversed);
      // A run moves bodies without supports across clearances.
      const ContactPair<dim> &pair = pairs.pairs().at(number - 1);
      report.print(
          "  pair " + std::to_string(number) + ": " + sides_of(pair) + ", "
          + std::to_string(check.secondary_facets) + " facets"
          + (pair.obstacle ? "" : " on " + std::to_string(check.primary_facets))
          + (dim == 2 ? ", length " : ", area ") + short_number(check.area, 6)
          + ", of which " + short_number(check.covered_area, 6)
          + " has a partner"
          + (check.overlap > 0.
                 ? ", initial overlap " + short_number(check.overlap, 3)
                 : ""));
      const bool may_come = pair.holds_body && pair.obstacle;
      for (const Message &warning : check.warnings)
        if (may_come && warning.failure == ABUT_FAILURE_NO_PARTNER)
          report.print(
              "  " + check.name
              + ": not within reach of the obstacle; a run moves the body, "
                "which has no support in that direction, into contact.");
        else
          report.warn(about(check.name, warning));
    }
    report.set("constraints", contact.results().measures().n_rows);
  }

  template <int dim> void SolidReport<dim>::report_transfer() const
  {
    unsigned int number = 0;
    for (const double error : contact.checks().transfer_errors(u))
    {
      const std::string key = "pair_" + std::to_string(++number);
      report.set(key + "_transfer_error", error);
      report.examined(key + "_transfer_error", error, visible_transfer_error,
                      no_limit, ABUT_FAILURE_TRANSFER);
      if (error > visible_transfer_error)
        report.warn(coded(
            ABUT_FAILURE_TRANSFER,
            "Pair " + std::to_string(number) + " hands "
                + short_number(100. * error, 2)
                + " % of a uniform pressure to wrong nodes of its primary "
                  "surface, because the meshes do not match. This part does "
                  "not vanish on finer meshes, and pressures at single points "
                  "may have larger errors. Use "
                  "Method/Discretisation = mortar or dual mortar.",
            {{"transfer error", error}, {"limit", visible_transfer_error}}));
    }
  }

  template <int dim> void SolidReport<dim>::report_chords() const
  {
    if (!model.chords)
      return;
    const la::Vector traction = model.contact_fields().traction;
    unsigned int number = 0;
    for (const PairResult<dim> &result : contact.results().pairs())
    {
      const ContactPair<dim> &pair = pairs.pairs().at(number++);
      if (!(result.pressure > 0.))
        continue;
      std::set<dealii::types::boundary_id> ids = pair.secondary;
      ids.insert(pair.primary.begin(), pair.primary.end());
      const std::set<CoarseFacet> facets = coarse_facets_above(
          elasticity.dof_handler, ids, traction, pressed * result.pressure);
      const Bend<dim> bend = model.chords->largest(&facets);
      if (bend.degrees == 0.)
        continue;
      // A blunt wedge on a half-space has E*/pi times half of the angle times
      // arcosh(a/x) at x from its tip (Johnson, Contact Mechanics, 5.2): E*/pi
      // times the angle at a quarter of its half width, and more nearer to it.
      double compliance = 0.;
      std::set<unsigned int> seen;
      for (const auto id : ids)
        if (const unsigned int body = bodies.body_of(id);
            seen.insert(body).second)
          compliance += 1. / model.data.materials.at(body)->stiffness();
      const double part = bend.degrees / 180. / (compliance * result.pressure);
      const double stress =
          std::get<double>(run.report.get("largest_strain")) / compliance;
      if (part > visible_chords
          && result.pressure > round_off_of_pressures * stress)
        report.warn(coded(
            ABUT_FAILURE_COARSE_CURVE,
            "Pair " + std::to_string(number) + ": in contact, "
                + model.text_of_bend(
                    bend,
                    "the pressure there may have an error of "
                        + (part < 0.5 ? "some " + short_number(100. * part, 2)
                                            + " % of its largest value"
                                      : std::string("half of it and more"))
                        + ", more on finer meshes")));
    }
  }

  template <int dim>
  std::string SolidReport<dim>::sides_of(const ContactPair<dim> &pair) const
  {
    const auto bodies_of =
        [&](const std::set<dealii::types::boundary_id> &surface)
    {
      std::set<unsigned int> numbers;
      for (const auto id : surface)
        numbers.insert(bodies.body_of(id));
      std::string text;
      for (const unsigned int body : numbers)
        text += (text.empty() ? "" : " and ") + bodies.name_of_body(body);
      return text;
    };
    const std::string secondary = bodies_of(pair.secondary);
    if (pair.obstacle)
    {
      const std::size_t index = &pair - pairs.pairs().data();
      return secondary + " on obstacle "
             + std::to_string(parameters.pairs.at(index).obstacle);
    }
    return secondary + (pair.tied ? " tied to " : " on ")
           + (pair.secondary == pair.primary ? "itself"
                                             : bodies_of(pair.primary));
  }

  template <int dim>
  std::pair<double, double> SolidReport<dim>::report_pairs() const
  {
    unsigned int number = 0;
    double force_imbalance = 0., moment_imbalance = 0.;
    const bool is_large = model.has_large_strain();
    const std::vector<PairCheck> checks = contact.checks().pairs();
    for (const PairResult<dim> &pair : contact.results().pairs())
    {
      const std::string key = "pair_" + std::to_string(++number);
      report.set(key + "_sides", sides_of(pairs.pairs().at(number - 1)));
      const bool has_friction =
          pairs.pairs().at(number - 1).friction != nullptr;
      for (const PairMeasure<dim> &measure : pair_measures<dim>())
        if (measure.reported == ReportedOf::all_pairs
            || (measure.reported == ReportedOf::friction && has_friction))
          set(report, key + "_" + measure.name, measure, pair);
      report.set(key + "_moment", components(is_large ? pair.present_moment
                                                      : pair.secondary_moment));
      const double facet = checks.at(number - 1).facet_size;
      if (facet > 0.)
        report.set(key + "_penetration_by_facet", pair.penetration / facet);
      report.set(key + "_turned_force",
                 components(dealii::Tensor<1, dim>(pair.secondary_force
                                                   + pair.rotated_force)));
      if (has_friction)
      {
        report_exceptions(key, pair);
        report.set(key + "_friction_ratio",
                   pair.normal_force > 0.
                       ? pair.secondary_friction.norm() / pair.normal_force
                       : 0.);
      }
      examine_pair(number, pair, facet);
      force_imbalance = std::max(force_imbalance, pair.force_imbalance);
      moment_imbalance =
          std::max(moment_imbalance, is_large ? pair.present_moment_imbalance
                                              : pair.moment_imbalance);
    }
    return {force_imbalance, moment_imbalance};
  }

  /* The measures of a pair that have simple limits. */
  template <int dim>
  void SolidReport<dim>::examine_pair(const unsigned int number,
                                      const PairResult<dim> &result,
                                      const double facet) const
  {
    const ContactPair<dim> &pair = pairs.pairs().at(number - 1);
    const std::string key = "pair_" + std::to_string(number) + "_";
    // An iteration without an answer is not examined.
    const Report::Value found = report.get("deformation");
    const auto *deformation = std::get_if<double>(&found);
    if (deformation == nullptr)
      return;
    const shim::DepthScale scale{*deformation, u.linfty_norm(),
                                 shim::round_off_of_places * facet};
    const double large = scale.limit(shim::useless);
    const double closed = std::max(0., result.penetration);
    if (method.user_law == nullptr)
      report.examined(key + "penetration", result.penetration, no_limit,
                      contact.results().measures().allowed_penetration + large,
                      ABUT_FAILURE_PENALTY);
    report.examined(key + "held_inside", result.held_inside, no_limit, large,
                    ABUT_FAILURE_HELD_NODES);
    report.examined(key + "between_rows", result.between_rows,
                    pair.obstacle ? closed + large : no_limit,
                    pair.obstacle ? no_limit : closed + large,
                    pair.obstacle ? ABUT_FAILURE_UNSEEN
                                  : ABUT_FAILURE_COARSE_SECONDARY);
    if (pair.obstacle)
      report.examined(key + "gap_error", result.gap_error,
                      scale.limit(shim::visible_gap_error), large,
                      ABUT_FAILURE_SLIDING);
    report.examined(key + "turn", result.rotation, shim::visible_rotation,
                    model.allows_large_strain() ? no_limit : shim::useless,
                    ABUT_FAILURE_SLIDING);
    report.examined(key + "oscillation", result.oscillation,
                    shim::visible_oscillation, no_limit,
                    ABUT_FAILURE_OSCILLATION);
    examine_zone(number, result);
  }

  /* Whether a surface of a pair is curved by its geometry: then contact begins
   * in a point or a line, and grows with the force. Collective. */
  template <int dim>
  bool SolidReport<dim>::is_curved(const unsigned int number) const
  {
    const unsigned int obstacle = parameters.pairs[number - 1].obstacle;
    if (obstacle > 0 && parameters.obstacles[obstacle - 1].is_curved())
      return true;
    const ContactPair<dim> &pair = pairs.pairs().at(number - 1);
    const auto is_side = [&pair](const auto &face)
    {
      return face->manifold_id() != dealii::numbers::flat_manifold_id
             && (pair.secondary.count(face->boundary_id()) > 0
                 || pair.primary.count(face->boundary_id()) > 0);
    };
    bool found = false;
    for (const auto &cell : model.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          found = found || (cell->at_boundary(f) && is_side(cell->face(f)));
    return MPI::logical_or(found, communicator);
  }

  /* Contact of curved surfaces with few points on it: width and pressure are
   * those of the mesh. In motion contact begins and ends so. */
  template <int dim>
  void SolidReport<dim>::examine_zone(const unsigned int number,
                                      const PairResult<dim> &result) const
  {
    const double few = std::pow(3., dim - 1);
    if (pairs.pairs().at(number - 1).tied || model.has_inertia()
        || result.n_active == 0 || result.n_active == result.n_rows
        || result.n_active > few || !is_curved(number))
      return;
    report.warn(coded(
        ABUT_FAILURE_FEW_POINTS,
        result.name + ": "
            + (result.n_active == 1
                   ? std::string("only 1 point is")
                   : "only " + std::to_string(result.n_active) + " points are")
            + " in contact: pressure and size of the contact "
              "zone are those of the mesh. Refine it there: "
              "Refinement/Adaptive cycles, or a larger "
              "Refinement/Level.",
        {{"points", result.n_active}, {"limit", few}}));
  }

  /* Parts of the normal force, with that on prescribed nodes, which have no
   * friction or share it with another contact of their node. */
  template <int dim>
  void SolidReport<dim>::report_exceptions(const std::string &key,
                                           const PairResult<dim> &pair) const
  {
    double on_nodes = 0.;
    if (pair.n_prescribed > 0)
    {
      const la::Vector forces = reactions();
      for (const auto &[unknown, component] : pair.prescribed_normal)
        on_nodes -= component * forces(unknown);
      on_nodes = std::max(0., MPI::sum(on_nodes, communicator));
    }
    const double whole = pair.normal_force + on_nodes;
    const auto part = [whole](const double force)
    { return whole > 0. ? force / whole : 0.; };
    report.set(key + "_prescribed_share", part(on_nodes));
    report.set(key + "_shared_stick_share", part(pair.shared_stick_force));
  }

  template <int dim> void SolidReport<dim>::report_friction() const
  {
    double dissipation = 0.;
    // Friction of points that closed late lasts as long as points stick.
    std::vector<double> late(pairs.pairs().size(), 0.);
    for (std::size_t i = 0; i < run.results.size(); ++i)
    {
      const ContactResult &result = run.results[i];
      // The first load step is solved on several meshes.
      if (i + 1 < run.results.size()
          && run.results[i + 1].load_step == result.load_step)
        continue;
      dissipation += result.dissipation;
      for (std::size_t p = 0; p < late.size(); ++p)
        late[p] = std::max(std::min(late[p], result.stick_force[p]),
                           result.late_force[p]);
    }
    report.set("dissipation", dissipation);
    report.set("friction_rung", run.results.back().progress.friction_rung);
    const auto results = contact.results().pairs();
    for (std::size_t p = 0; p < late.size(); ++p)
      examine_friction_data(p);
    for (std::size_t p = 0; p < late.size() && !model.has_inertia(); ++p)
      if (pairs.pairs()[p].friction != nullptr)
        examine_late(p, late[p], results[p].normal_force);
  }

  template <int dim>
  void SolidReport<dim>::examine_friction_data(const std::size_t p) const
  {
    dealii::ComponentMask first(dim, false);
    first.set(0, true);
    std::vector<dealii::VectorFunctionFromScalarFunctionObject<dim>> fields;
    for (const Expression<dim> *formula : pairs.varying_friction(p))
      fields.emplace_back([formula](const dealii::Point<dim> &x)
                          { return formula->value(x); },
                          0, dim);
    std::vector<OnBoundary<dim>> functions;
    for (const auto &field : fields)
      functions.push_back({&field, first, pairs.pairs()[p].secondary});
    diagnose_friction_data(
        report, "pair_" + std::to_string(p + 1) + "_friction_error",
        pairs.pairs()[p].name, nodal_error(elasticity, functions));
  }

  template <int dim>
  void SolidReport<dim>::examine_late(const std::size_t p, const double late,
                                      const double normal) const
  {
    const std::string key = "pair_" + std::to_string(p + 1) + "_late_share";
    const double share = normal > 0. ? late / normal : 0.;
    report.set(key, share);
    report.examined(key, share, shim::visible_late_share, no_limit,
                    ABUT_FAILURE_LATE_CONTACT);
    if (const Message text =
            shim::late_contact(pairs.pairs()[p].name, late, normal);
        !text.empty())
      report.warn(text);
  }

  template <int dim> void SolidReport<dim>::report_detection() const
  {
    DetectionReport all;
    for (const ContactResult &result : run.results)
      all += result.detection;
    report.set("searches", all.searches);
    report.set("search_reuses", all.reuses);
    report.set("bucket_rebuilds", all.rebuilds);
    report.set("bucket_refits", all.refits);
    report.set("facet_gatherings", all.gatherings);
    report.set("detection_seconds", all.seconds);
    report.set("elements_gained", all.gained);
    report.set("elements_lost", all.lost);
    report.set("elements_exchanged", all.exchanged);
  }

  template <int dim> void SolidReport<dim>::report_contact() const
  {
    const auto [force_imbalance, moment_imbalance] = report_pairs();
    report_chords();
    if (pairs.has_friction() && !run.results.empty())
      report_friction();
    if ((method.discretisation
         && !discretisation_info(*method.discretisation).is_weighted)
        || abut_law_needs_stress(method.options.law))
      report_transfer();
    report.set("search_rebuilds", run.n_repeated_searches);
    report_detection();
    report.set("force_imbalance", force_imbalance);
    report.set("moment_imbalance", moment_imbalance);
    report.set("method", method.options.law->name);
    report.set("discretisation", discretisation_name(method.discretisation));
    const ContactMeasures measures = contact.results().measures();
    report.set("contact_force", measures.force);
    report.set("max_penetration", measures.penetration);
    report.set("allowed_penetration", measures.allowed_penetration);
    report.set("max_complementarity", measures.complementarity);
  }

  template <int dim> void SolidReport<dim>::report_driven() const
  {
    const DrivenObstacles<dim> &driven = model.driven;
    const auto set = [&](const std::string &key, const auto &vector)
    { report.set(key, components(vector)); };
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
    {
      if (!driven.is_driven(o))
        continue;
      const std::string key = "obstacle_" + std::to_string(o + 1);
      set(key + "_displacement",
          driven.displacement(o, run.results.back().time));
      if (model.motion)
        set(key + "_velocity", driven.velocity(o));
      set(key + "_force", driven.contact_force(o));
    }
    report.set("obstacle_imbalance", driven.imbalance());
    report.set("obstacle_places", driven.n_places());
  }

  template <int dim>
  std::optional<double> SolidReport<dim>::relative_error() const
  {
    const ContactResult &last = run.results.back();
    if (!last.errors
        || parameters.refinement.target_quantity != TargetQuantity::energy_norm)
      return {};
    return *last.errors->energy / model.solution_norm();
  }

  template <int dim> void SolidReport<dim>::report_shares() const
  {
    const auto share = [&](const std::string &key, const double value)
    { report.set(key + "_on_rank", range_over_ranks(value, communicator)); };
    share("cells", model.triangulation.n_locally_owned_active_cells());
    share("dofs", elasticity.dof_handler.n_locally_owned_dofs());
    if (pairs.empty())
      return;
    const CommunicationReport sent = contact.results().effort().communication;
    share("constraints", contact.results().measures().n_own_rows);
    share("facets", sent.own_facets);
    share("ghost_facets", sent.ghost_facets);
    report.set("communicated_bytes", MPI::max(sent.bytes, communicator));
    report.set("communicated_messages", MPI::max(sent.messages, communicator));
    report.set("gathered_bytes", MPI::max(sent.gathered_bytes, communicator));
  }

  template <int dim> void SolidReport<dim>::result(const bool converged) const
  {
    SectionTimes::Scope scope(report.times, "results");
    report.set("converged", converged);
    report.set("bodies", bodies.size());
    if (dim == 2)
      report.set("plane", plane_names[static_cast<int>(parameters.plane)]);
    report.set("load_steps", run.load_steps.n_accepted());
    report.set("load_steps_cut_back", run.load_steps.n_rejected());
    if (run.results.empty())
      return;
    const ContactResult &last = run.results.back();
    report.set("time", last.time);
    report.set("cells", last.cells);
    report.set("dofs", last.dofs);
    report.set("constraints", last.rows);
    report.set("active", last.active);
    report.set("energy", last.energy);
    report.set("steps_on_last_level", last.steps);
    report.set("linear_iterations_on_last_level", last.linear.n_iterations);
    if (last.errors)
    {
      report.set("l2_error", last.errors->l2);
      report.set("h1_error", last.errors->h1_seminorm);
      report.set("energy_norm_error", *last.errors->energy);
      report.set("nodal_error", last.errors->largest_node);
    }
    if (last.estimate)
      report_estimate(report, *last.estimate,
                      run.control.is_on() ? 0. : model.solution_norm());
    if (last.estimate && last.errors)
      report.set("effectivity", *last.estimate / *last.errors->energy);
    if (!std::isnan(parameters.exact_energy))
    {
      report.set("energy_error",
                 std::abs(last.energy - parameters.exact_energy));
      report.expect("energy", parameters.exact_energy);
    }
    if (run.control.is_on())
      run.control.report(report, relative_error());
    report_points();
    report_reactions();
    report_shares();
    if (model.motion)
      model.motion->report();
    if (!pairs.empty())
      report_contact();
    if (model.places_obstacles())
      report_driven();
    if (converged)
      report_numerics();
  }

  template <int dim> void SolidReport<dim>::report_numerics() const
  {
    std::vector<double> energies;
    double condition = 0., penalty = 0.;
    for (const ContactResult &state : run.results)
    {
      condition = std::max(condition, state.linear.condition);
      penalty = state.progress.penalty;
      if (state.load_step == 1 && state.level <= parameters.refinement.level)
        energies.push_back(state.energy);
    }
    if (!parameters.refinement.has_target()
        && parameters.refinement.adaptive_cycles == 0)
      diagnose_order(report, energies);
    diagnose_condition(report, condition, penalty);
    report_locking();
    diagnose_data(report, elasticity.load_error(model.data),
                  elasticity.support_error(model.data));
    if (model.has_large_strain() && !model.motion)
      report_stability();
  }

  /* Of all directions but those that contact may resist. */
  template <int dim> void SolidReport<dim>::report_stability() const
  {
    la::Vector forces = elasticity.vector();
    if (!pairs.empty())
      contact.results().add_forces(forces, ForcePart::of_pressures);
    const double pressed = round_off_of_pressures * forces.linfty_norm();
    const dealii::IndexSet &owned = elasticity.dof_handler.locally_owned_dofs();
    std::vector<std::uint8_t> at_rest(owned.n_elements());
    for (std::size_t i = 0; i < at_rest.size(); ++i)
      at_rest[i] =
          elasticity.constraints.is_constrained(owned.nth_index_in_set(i))
          || std::abs(la::data(forces)[i]) > pressed;
    if (pairs.has_friction())
      hold_whole_nodes(at_rest);
    const double curvature = negative_curvature(elasticity.stiffness, at_rest);
    report.set("negative_curvature", curvature);
    report.examined("negative_curvature", -curvature, 0., no_limit,
                    ABUT_FAILURE_UNSTABLE);
    if (curvature < 0.)
      report.warn(coded(
          ABUT_FAILURE_UNSTABLE,
          "The equilibrium is unstable: along a displacement the stored energy "
          "has the curvature "
              + short_number(curvature, 2)
              + ", divided by that of the stiffness' diagonal (limit 0). The "
                "bodies buckle under a smaller load. Disturb them, for "
                "instance by a small Body N/Body force across, and compare; or "
                "compute the motion with Time stepping/Scheme = hht.",
          {{"curvature", curvature}, {"limit", 0.}}));
  }

  template <int dim>
  void
  SolidReport<dim>::hold_whole_nodes(std::vector<std::uint8_t> &at_rest) const
  {
    const dealii::IndexSet &owned = elasticity.dof_handler.locally_owned_dofs();
    const shim::ByElement places_of(elasticity.dof_handler, nodal_places<dim>);
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : elasticity.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      shim::get_dofs(cell, dofs);
      const NodalPlaces<dim> &places = places_of.of(cell);
      for (unsigned int node = 0; node < places.n_nodes(); ++node)
        // A node's unknowns are all of the same rank.
        if (owned.is_element(dofs[places(0, node)]))
        {
          const auto entry = [&](const unsigned int c) -> std::uint8_t &
          { return at_rest[owned.index_within_set(dofs[places(c, node)])]; };
          bool held = false;
          for (unsigned int c = 0; c < dim; ++c)
            held = held || entry(c);
          for (unsigned int c = 0; c < dim; ++c)
            entry(c) = held;
        }
    }
  }

  template <int dim> void SolidReport<dim>::report_locking() const
  {
    // What moves and is not deformed has the strains of the solver's tolerance.
    constexpr double undeformed = 1e-6;
    if (model.motion)
    {
      const abut_time_energy &energy = model.motion->bodies().record().energy;
      if (energy.strain <= undeformed * energy.kinetic)
        return;
    }
    double locked = -1.; // not known
    if (model.has_simplices())
      locked = report_linear_simplices();
    if (elasticity.elements.size() > 1
        || !shim::is_simplex(elasticity.elements[0]))
      locked = std::max(locked, report_cell_locking());
    if (locked >= 0.)
      report.set("locked_energy", locked);
  }

  template <int dim> double SolidReport<dim>::report_cell_locking() const
  {
    if (parameters.degree > 1)
      return -1.;
    double poisson_ratio = 0.;
    for (const auto &material : model.data.materials)
      if (material.second->cell_volume() == nullptr)
        poisson_ratio =
            std::max(poisson_ratio, material.second->poisson_ratio());
    const Locking found = locking(elasticity.mapping, elasticity.dof_handler,
                                  elasticity.ghosted(u), model.data.materials,
                                  parameters.has_large_strain());
    report.examined("shear_locking", found.shear, visible_stiffness, no_limit,
                    ABUT_FAILURE_LOCKING);
    if (found.shear > visible_stiffness)
      report.warn(coded(
          ABUT_FAILURE_LOCKING,
          short_number(100. * found.shear, 3)
              + " % of the strain energy is spurious shear of linear "
                "elements, which cannot bend (limit "
              + short_number(100. * visible_stiffness, 2)
              + " %): displacements under loads are too small by up to this "
                "part, or forces at prescribed "
                "displacements too large. Set Solid/Degree = 2, or refine: "
                "cells must be short against the thickness in bending.",
          {{"part of the energy", found.shear}, {"limit", visible_stiffness}}));
    if (parameters.plane == PlaneModel::stress
        || poisson_ratio < least_locking_ratio)
      return found.shear;
    report.examined("volumetric_locking", found.volumetric, visible_locking,
                    no_limit, ABUT_FAILURE_LOCKING);
    if (found.volumetric > visible_locking)
      report.warn(coded(ABUT_FAILURE_LOCKING,
                        short_number(100. * found.volumetric, 2)
                            + " % of the strain energy is spurious volume "
                              "change of linear elements: with Poisson ratio "
                            + short_number(poisson_ratio, 6)
                            + " they lock; displacements are too small and "
                              "contact forces too large. Set Body N/Element = "
                              "mean dilatation, or Solid/Degree = 2.",
                        {{"part of the energy", found.volumetric},
                         {"limit", visible_locking}}));
    return std::max(found.volumetric, found.shear);
  }

  template <int dim> double SolidReport<dim>::report_linear_simplices() const
  {
    if (parameters.simplex_degree > 1)
      return -1.;
    const double locked = linear_stiffness_error(
        elasticity.mapping, elasticity.dof_handler, elasticity.ghosted(u),
        model.data.materials, parameters.has_large_strain());
    report.examined("linear_stiffness_error", locked, visible_stiffness,
                    no_limit, ABUT_FAILURE_LOCKING);
    if (locked <= visible_stiffness)
      return locked;
    const std::string cells = dim == 2 ? "triangles" : "tetrahedra";
    report.warn(coded(
        ABUT_FAILURE_LOCKING,
        short_number(100. * locked, 2)
            + " % of the strain energy is an error (estimate, low on coarse "
              "meshes): linear "
            + cells
            + " have constant strain in each cell and are too stiff. "
              "Displacements under loads are too small by this part, or forces "
              "at prescribed displacements too large. Set Solid/Degree = 2.",
        {{"part of the energy", locked}, {"limit", visible_stiffness}}));
    return locked;
  }

  template <int dim> void SolidReport<dim>::model_lines() const
  {
    report.model("contact", !pairs.empty(),
                 pairs.empty()
                     ? "no pairs were given"
                     : "between " + std::to_string(pairs.pairs().size())
                           + " pairs of surfaces",
                 {"contact rows"});
    report.model("meshes", true, "with unknowns and pattern of each",
                 {"mesh", "unknowns and pattern", "transfer"});
    report.model("stiffness", true,
                 model.has_large_strain() ? "assembled for each linearisation"
                                          : "assembled once on each mesh",
                 {"assembly"});
    const bool searches = std::any_of(
        pairs.pairs().begin(), pairs.pairs().end(),
        [](const ContactPair<dim> &pair) { return pair.obstacle == nullptr; });
    report.model(
        "search", searches,
        searches
            ? "facets of bodies for each other: "
                  + std::to_string(run.n_searches) + " times, of which "
                  + std::to_string(run.contact.results().effort().points.kept)
                  + " moved too little for new pairs, and a check after each "
                    "solve"
            : "gaps to obstacles are formulas: there is no search");
    if (method.law_is_automatic && !pairs.empty())
      report.model("automatic law", true, method.options.law->name);
    report.model("friction", pairs.has_friction(),
                 pairs.has_friction()
                     ? std::to_string(contact.iteration().progress.n_slipping)
                           + " of the points in contact slip, the rest sticks"
                     : "surfaces slide freely on each other");
    const RefinementParameters &refinement = parameters.refinement;
    model_meshes(report, refinement);
    report.model("load steps", parameters.load_steps.steps > 1,
                 std::to_string(run.load_steps.n_accepted()) + " of "
                     + std::to_string(parameters.load_steps.steps)
                     + " asked for");
    report.model("inertia", model.has_inertia(),
                 model.has_inertia()
                     ? std::string("scheme ") + parameters.time.scheme.name
                     : "each load step is in equilibrium");
    report.model("obstacles driven by forces", model.places_obstacles(),
                 model.places_obstacles()
                     ? std::to_string(model.driven.n_places())
                           + " positions were tried, each a contact problem"
                     : "obstacles follow their Motion");
    report.model("large strain", model.has_large_strain(),
                 model.has_large_strain()
                     ? "strains and rotations of any size"
                     : "strains are linear in the displacement");
    unsigned int n_steps = 0;
    for (const ContactResult &state : run.results)
      n_steps += state.steps;
    model_linear_systems(report, std::to_string(n_steps) + " in all states",
                         run.results.empty() ? LinearReport()
                                             : run.results.back().linear);
    model_files(report, parameters.fields || run.options.pictures);
    explain_accuracy(report, refinement, run.control);
    explain_steps(report, refinement, method, n_steps,
                  static_cast<unsigned int>(run.results.size()));
    explain_pairs();
    explain_output(report);
  }

  template <int dim> void SolidReport<dim>::explain_pairs() const
  {
    if (run.load_steps.n_accepted() > 1 && !pairs.has_friction()
        && !model.has_inertia())
      report.leave_out(
          parameters.refinement.adaptive_cycles > 0
              ? "load steps: without friction the last result depends on the "
                "steps before by the mesh, which is adapted to the first "
                "one; Time stepping/Number of steps = 1 adapts it to the last."
          : run.contact.points_move()
              ? "load steps: without friction the last result depends on the "
                "steps before by Pair N/Reach = auto alone, which follows the "
                "motion in a step. Set a length, and Time stepping/Number of "
                "steps = 1 gives the same."
              : "load steps: without friction the last result does not depend "
                "on the steps before; Time stepping/Number of steps = 1 gives "
                "the same.");
    if (pairs.empty() || run.results.empty())
      return;
    for (const PairResult<dim> &pair : contact.results().pairs())
      if (pair.n_active == 0)
        report.leave_out(pair.name + ": none of its "
                         + std::to_string(pair.n_rows)
                         + " constraints is in contact.");
    if (pairs.has_friction())
      explain_friction();
  }

  template <int dim> void SolidReport<dim>::explain_friction() const
  {
    double part = 0.;
    for (const ContactResult &state : run.results)
      if (state.force > 0.)
        part = std::max(part, state.friction_force / state.force);
    if (part < visible_friction)
      report.leave_out(
          "friction, unless it supports a body: it never carried more than "
          + short_number(100. * part, 2)
          + " % of the normal force, and it makes linear systems "
            "nonsymmetric.");
  }

  template class SolidReport<2>;
  template class SolidReport<3>;
} // namespace abut::app

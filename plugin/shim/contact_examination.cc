// SPDX-License-Identifier: LGPL-2.1-or-later
// Quality of an answer: measures first, then the faults that they are a sign
// of.
#include "contact_problem.h"

#include "agree.h"
#include "deformation.h"
#include "examination_limits.h"
#include "obstacle_in_bodies.h"
#include "obstacle_width.h"
#include "pair_friction.h"
#include "short_text.h"

#include <abut/dealii/coded.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Collects what is found. */
    class Findings
    {
    public:
      explicit Findings(ContactExamination &result) : result_(result)
      {
      }

      /** Set the pair of the findings that follow. */
      void begin_pair(const std::size_t number, const std::string &name)
      {
        number_ = number;
        name_ = name;
      }

      void add(const abut_failure failure, const bool is_error,
               const std::string &text, Message::Numbers numbers = {},
               const double between_nodes = 0.)
      {
        add(ContactFinding(coded(failure, text, std::move(numbers)), is_error),
            between_nodes);
      }

      void add(ContactFinding finding, const double between_nodes = 0.)
      {
        finding.between_nodes = between_nodes;
        finding.pair_number = number_;
        finding.pair = name_;
        result_.findings.push_back(finding);
      }

    private:
      ContactExamination &result_;
      std::size_t number_ = 0;
      std::string name_;
    };

    template <int dim>
    void judge_residual(const ResidualCheck<dim> &seen, Findings &findings)
    {
      if (!seen.finding().empty())
        findings.add(ABUT_FAILURE_UNBALANCED,
                     seen.finding().numbers.front().second <= 0.,
                     seen.finding().text, seen.finding().numbers);
      if (seen.lost_displacement() > 0.)
        findings.add(
            ABUT_FAILURE_UNBALANCED, true,
            "Displacements of up to " + three_digits(seen.lost_displacement())
                + " are prescribed, but the residual R has no forces of them. "
                  "Assemble K and the loads in one call of "
                  "distribute_local_to_global() per cell, as K is without the "
                  "columns of prescribed unknowns, or R from the whole u.",
            {{"prescribed displacement", seen.lost_displacement()}});
    }

    /** How far @p u is from constraints that it must have: hanging nodes and
     * others between unknowns, and prescribed values but 0, which hosts may
     * have for increments. Collective. */
    template <int dim>
    void judge_constraints(const ContactHost<dim> &host, const la::Vector &u,
                           Findings &findings)
    {
      la::Vector constrained(u);
      host.constraints().distribute(constrained);
      const double size = std::max(u.linfty_norm(), constrained.linfty_norm());
      constrained -= u;
      double off[2] = {0., 0.}; // prescribed values, values of other unknowns
      const dealii::IndexSet &owned = host.owned();
      for (const auto &line : host.constraints().get_lines())
        if (owned.is_element(line.index)
            && (!line.entries.empty() || line.inhomogeneity != 0.))
        {
          double &largest = off[line.entries.empty() ? 0 : 1];
          largest = std::max(
              largest, std::abs(la::data(
                           constrained)[owned.index_within_set(line.index)]));
        }
      MPI::max(off, versions::communicator(host.dof_handler()), off);
      const double largest = std::max(off[0], off[1]);
      if (largest <= visible_violation * size)
        return;
      findings.add(
          ABUT_FAILURE_UNBALANCED, off[1] > useless_violation * size,
          "The displacement differs from the constraints given to reinit() by "
          "up to "
              + three_digits(largest) + ", where displacements are at most "
              + three_digits(size)
              + (off[1] > visible_violation * size
                     ? ", at hanging nodes or other constraints between "
                       "unknowns"
                     : ", at prescribed values")
              + ". Call distribute() of the constraints before the first step "
                "and after each.",
          {{"largest difference", largest}, {"largest displacement", size}});
    }

    /** Whether small-strain theory is of no use, by its largest error and the
     * mean of a body. */
    bool is_useless(const double largest, const double mean)
    {
      return largest >= useless_strain || mean >= useless_mean_strain;
    }

    void judge_strain(const ContactExamination &seen, const bool allow,
                      const bool lacks_prescribed, Findings &findings)
    {
      if (seen.strain <= visible_strain)
        return;
      const bool is_error = !allow && is_useless(seen.strain, seen.mean_strain);
      findings.add(
          ABUT_FAILURE_LARGE_STRAIN, is_error,
          "The largest strain is " + percent(seen.strain) + ", "
              + percent(seen.mean_strain)
              + " in the mean; linear theory is valid up to about "
              + percent(visible_strain)
              + (lacks_prescribed
                     ? ". Next to displacements that the residual has no "
                       "forces of, this is a jump"
                     : ". Check the units of loads and stiffness")
              + (seen.strain > 3. * seen.mean_strain
                     ? ", or for a singular corner, where the largest strain "
                       "grows with refinement and the mean does not"
                     : "")
              + ".",
          {{"largest strain", seen.strain},
           {"mean strain", seen.mean_strain},
           {"warning limit", visible_strain},
           {"error limit", useless_strain}});
    }

    /** Bodies that contact alone supports have left it at smaller rotations. */
    void judge_rotation(const ContactExamination &seen, const bool allow,
                        Findings &findings)
    {
      const double stretch = rotation_stretch(seen.rotation);
      const bool is_too_large =
          is_useless(stretch, rotation_stretch(seen.mean_rotation));
      std::string alone;
      int body = -1;
      for (const BodyMotion &motion : seen.motions)
        if (std::min(motion.rotation.norm(), seen.rotation) > visible_rotation)
        {
          alone += motion.text + ". ";
          body = static_cast<int>(motion.body);
        }
      // Strains that are larger are reported as such.
      if (stretch <= std::max(visible_strain, seen.strain) && !is_too_large
          && (allow || alone.empty()))
        return;
      ContactFinding finding(
          coded(ABUT_FAILURE_LARGE_STRAIN,
                alone + "Rotations are up to " + three_digits(seen.rotation)
                    + " radian, " + three_digits(seen.mean_rotation)
                    + " in the mean of a body. Strains are linear in the "
                      "displacement, which stretches a body that rotates so "
                      "far by "
                    + percent(stretch)
                    + (alone.empty()
                           ? " (limit " + percent(visible_strain)
                                 + "). Use a material of finite strain, or "
                                   "check the units of loads and stiffness."
                           : ", and contact has moved away from where it was. "
                             "Apply loads without a moment about the contact, "
                             "support the rotation, or use a material of "
                             "finite strain."),
                {{"largest rotation", seen.rotation},
                 {"mean rotation", seen.mean_rotation},
                 {"stretch", stretch},
                 {"warning limit", rotation_with(visible_strain)},
                 {"error limit", rotation_with(useless_strain)}}),
          is_too_large && !allow);
      finding.body = body;
      findings.add(finding);
    }

    void judge_balance(const double imbalance, Findings &findings)
    {
      if (imbalance > visible_imbalance)
        findings.add(ABUT_FAILURE_UNBALANCED, imbalance > useless,
                     "Forces are out of balance by " + percent(imbalance)
                         + " of the load (limit " + percent(visible_imbalance)
                         + "). Check the sign of the residual: internal "
                           "minus external forces, at the last displacement.",
                     {{"imbalance", imbalance},
                      {"warning limit", visible_imbalance},
                      {"error limit", useless}});
    }

    /** A depth with what it is compared with. */
    std::string compared(const DepthScale &scale, const double depth)
    {
      if (scale.way == 0.)
        return three_digits(depth) + " without deformation";
      return three_digits(depth) + ", where "
             + (scale.way < scale.far ? "deformation is at most "
                                      : "displacements are at most ")
             + three_digits(scale.way);
    }

    template <int dim>
    void judge_sliding(const PairResult<dim> &pair, const PairCheck &check,
                       const dealii::Point<dim> &worst, const bool is_obstacle,
                       const bool touches_itself, const bool is_mortar,
                       const DepthScale &scale, Findings &findings)
    {
      const double facet =
          check.size_ratio > 0.
              ? check.facet_size / std::min(1., check.size_ratio)
              : check.facet_size;
      // Surfaces that slide by their own length do not meet any more.
      const double length = std::pow(pair.covered_area, 1. / (dim - 1));
      if (!is_obstacle && pair.slip > facet)
        findings.add(
            ABUT_FAILURE_SLIDING, pair.slip > length,
            pair.name + ": the surfaces slide on each other by "
                + three_digits(pair.slip) + ", more than a facet, "
                + three_digits(facet)
                + ", but contact is evaluated at the positions before sliding, "
                  "so the pressure does not move with it. With "
                + (touches_itself ? "boundary ids and a pair of their own for "
                                    "the two parts, and "
                                  : "")
                + "Method/Contact geometry = current it follows.",
            {{"slip", pair.slip}, {"facet", facet}, {"error limit", length}});
      if (is_obstacle && scale.is_more(pair.gap_error, visible_gap_error))
        findings.add(
            ABUT_FAILURE_SLIDING, scale.is_more(pair.gap_error, useless),
            pair.name + ": nodes in contact slide by up to "
                + three_digits(pair.slip)
                + ", and their distance from the obstacle, which is curved or "
                  "has a corner, has an error of "
                + compared(scale, pair.gap_error) + ", at "
                + numbers(dealii::Tensor<1, dim>(worst))
                + ". Gaps are evaluated in the reference configuration, and a "
                  "node in a concave corner sees one side only. Give each side "
                  "of a corner its own obstacle and pair"
                + (is_mortar ? ". On curved obstacles use Method/Contact "
                               "geometry = current, with Method/Discretisation "
                               "= node to segment or quadrature point."
                             : "."),
            {{"slip", pair.slip},
             {"gap error", pair.gap_error},
             {"compared with", scale.way}});
    }

    /** Whether turned forces have a resultant with a component that is another
     * by more than a tenth. */
    template <int dim> bool has_other_force(const PairResult<dim> &pair)
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double change = std::abs(pair.rotated_force[d]);
        if (change > useless * std::abs(pair.secondary_force[d])
            && change > visible_side_force * pair.secondary_force.norm())
          return true;
      }
      return false;
    }

    template <int dim>
    void judge_rotation(const PairResult<dim> &pair, const bool allow,
                        Findings &findings)
    {
      if (pair.rotation <= visible_rotation && !has_other_force(pair))
        return;
      const double degrees = 180. / dealii::numbers::PI;
      findings.add(
          ABUT_FAILURE_SLIDING, !allow && pair.rotation > useless,
          pair.name + ": contact normals have rotated since pairing by "
              + three_digits(degrees * pair.rotation)
              + " degrees in their mean, "
              + three_digits(degrees * pair.largest_rotation)
              + " at most: " + percent(pair.rotation)
              + " of the force differs from the current directions, and the "
                "resultant "
              + numbers(pair.secondary_force) + " would be about "
              + numbers(dealii::Tensor<1, dim>(pair.secondary_force
                                               + pair.rotated_force))
              + ". Use Method/Contact geometry = current where possible, or "
                "smaller motions.",
          {{"mean rotation", pair.rotation},
           {"largest rotation", pair.largest_rotation},
           {"warning limit", visible_rotation},
           {"error limit", useless}});
    }

    template <int dim>
    void judge_oscillation(const PairResult<dim> &pair, const bool is_tied,
                           const bool is_obstacle, Findings &findings)
    {
      if (!(pair.oscillation > visible_oscillation))
        return;
      findings.add(
          ABUT_FAILURE_OSCILLATION, false,
          pair.name + ": " + percent(pair.oscillation) + " of the "
              + (is_tied ? "traction" : "pressure")
              + " alternates from node to node (limit "
              + percent(visible_oscillation)
              + "): its mean is that of the bodies, its values at single nodes "
                "are those of the meshes. "
              + (is_obstacle
                     ? "Use smaller facets or quadratic elements there, or "
                       "Element = mean dilatation where the body is nearly "
                       "incompressible."
                     : "Take the softer body as the secondary side, with "
                       "dual mortar, let facets of curved surfaces match, or "
                       "use quadratic elements."),
          {{"alternating part", pair.oscillation},
           {"limit", visible_oscillation}});
    }

    template <int dim>
    void judge_depths(const PairResult<dim> &pair, const double soft,
                      const bool has_penalty, const DepthScale &scale,
                      Findings &findings)
    {
      if (scale.is_more(soft, useless))
        findings.add(ABUT_FAILURE_PENALTY, true,
                     pair.name + ": the bodies penetrate each other by "
                         + compared(scale, soft)
                         + (has_penalty
                                ? ". The contact is far too soft: use a larger "
                                  "Method/Penalty factor, or "
                                  "Method/Enforcement = augmented lagrangian "
                                  "or lagrange."
                                : ". The iteration has not come to its end, or "
                                  "displacements were changed after it."),
                     {{"penetration", soft}, {"compared with", scale.way}});
      if (scale.is_more(pair.held_inside, useless))
        findings.add(
            ABUT_FAILURE_HELD_NODES, true,
            pair.name
                + ": prescribed displacements keep nodes of the secondary "
                  "surface inside the other body by up to "
                + compared(scale, pair.held_inside)
                + ". Contact cannot move them: leave these nodes free along "
                  "the normal, or change the prescribed displacement.",
            {{"depth", pair.held_inside}, {"compared with", scale.way}});
      if (pair.n_prescribed > 0)
        findings.add(
            ABUT_FAILURE_HELD_NODES, false,
            pair.name
                + ": the normal displacement is prescribed at nodes of the "
                  "secondary surface in or next to the contact zone ("
                + std::to_string(pair.n_prescribed)
                + "). Forces there are reactions of supports, without "
                  "friction. Leave these nodes free along the normal if "
                  "contact is to carry them.",
            {{"nodes", pair.n_prescribed}});
    }

    /** Facets that rotate by a large angle: polygons that are in each other. */
    template <int dim>
    void judge_corners(const PairResult<dim> &pair, const PairCheck &check,
                       const double depth, const DepthScale &scale,
                       Findings &findings)
    {
      const bool turns =
          std::any_of(check.warnings.begin(), check.warnings.end(),
                      [](const Message &warning)
                      { return warning.failure == ABUT_FAILURE_COARSE_CURVE; });
      if (turns
          && scale.is_more(depth - std::max(0., pair.penetration), useless))
        findings.add(
            ABUT_FAILURE_COARSE_CURVE, true,
            pair.name
                + ": corners of the secondary surface are inside the other "
                  "body, which weighted gaps see in the mean only, by up to "
                + compared(scale, depth)
                + ". Refine the surfaces; if they are meant to fit, set Use "
                  "mesh gap = false.",
            {{"depth", depth}, {"compared with", scale.way}});
    }

    /** Straight facets whose distance from their curve is as large as all that
     * is pressed in: the pressure has no accuracy left. */
    void judge_chords(const std::string &pair, const double error,
                      const DepthScale &scale, Findings &findings)
    {
      if (error > 0.)
        findings.add(
            ABUT_FAILURE_COARSE_CURVE, true,
            pair
                + ": straight facets in contact differ from their curve, at "
                  "nodes of the other surface, by up to "
                + compared(scale, error)
                + ", since gaps are those of polygons. Refine the surfaces; if "
                  "they are meant to fit, set Use mesh gap = false.",
            {{"distance", error}, {"compared with", scale.way}});
    }

    template <int dim>
    void judge_between(const PairResult<dim> &pair, const bool is_obstacle,
                       const double peak, const double size,
                       const double size_ratio, const DepthScale &scale,
                       Findings &findings)
    {
      // Rows that are soft have a report of their own.
      const double between = pair.between_rows - std::max(0., pair.penetration);
      // Distance of a round side from facets that are small compared with its
      // radius.
      const auto if_flat = [&](const double depth)
      { return pair.between_rows <= missed_part * size ? depth : 0.; };
      if (!is_obstacle)
      {
        if (scale.is_more(between, useless))
          findings.add(
              ABUT_FAILURE_COARSE_SECONDARY, true,
              pair.name
                  + ": nodes of the primary surface are inside the "
                    "secondary, between its constraints, by up to "
                  + compared(scale, pair.between_rows)
                  + (size_ratio > 1.
                         ? ". Exchange the two sides, or refine the secondary."
                         : ". Refine the secondary."),
              {{"depth", pair.between_rows}, {"compared with", scale.way}},
              if_flat(between));
        return;
      }
      const bool missed = pair.missed_depth > missed_part * size
                          && scale.is_more(pair.missed_depth, useless);
      // Means over facets may be open where a node of them is inside.
      const bool presses = pair.n_rows == 0 || pair.secondary_force.norm() > 0.;
      const double unknown = presses ? std::min(peak, between) : between;
      const bool hidden = scale.is_more(unknown, useless);
      if (missed || scale.is_more(between, useless))
        findings.add(
            ABUT_FAILURE_UNSEEN, missed || hidden,
            pair.name + ": the obstacle penetrates between nodes by up to "
                + compared(scale, pair.between_rows)
                + (!hidden   ? std::string()
                   : presses ? ", undetected by nodes: " + three_digits(unknown)
                             : ", and no constraint is active")
                + (missed ? ". Facets without any contact are penetrated by "
                            "up to "
                                + three_digits(pair.missed_depth)
                          : std::string())
                + ". Refine the surface there; smaller load steps do not help.",
            {{"depth", pair.between_rows},
             {"undetected depth", unknown},
             {"missed depth", pair.missed_depth},
             {"compared with", scale.way}},
            if_flat(hidden ? unknown : between));
    }

    void judge_separated_rows(const std::string &pair,
                              const SeparatedRows &apart, const bool follows,
                              const DepthScale &scale, Findings &findings)
    {
      if (apart.force > 0.)
        findings.add(ABUT_FAILURE_SLIDING, false,
                     pair
                         + ": constraints are active where the surfaces are "
                           "apart, by up to "
                         + compared(scale, apart.gap) + ", with "
                         + percent(apart.force / apart.all) + " of the force. "
                         + (follows
                                ? "Gaps of dual mortar are too small on convex "
                                  "surfaces: refine the surfaces, or use "
                                  "Method/Discretisation = mortar."
                                : "Gaps are evaluated where the points were "
                                  "paired: use Method/Contact geometry = "
                                  "current, or smaller motions."),
                     {{"gap", apart.gap},
                      {"part of the force", apart.force / apart.all},
                      {"compared with", scale.way}});
    }

    void judge_width(const std::string &pair, const ObstacleWidth &narrowest,
                     Findings &findings)
    {
      if (narrowest.width < 2. * narrowest.facet)
        findings.add(ABUT_FAILURE_UNSEEN, false, pair + ": " + narrowest.text(),
                     {{"width", narrowest.width}, {"facet", narrowest.facet}});
    }

    /** Bodies in the obstacle elsewhere than at the surface of the pair: the
     * depth there is no more than that at the surface if that stops the
     * obstacle. */
    template <int dim>
    void judge_inside(const std::string &pair,
                      const ObstacleInBodies<dim> &found,
                      const ObstacleWidth &passed, const double facet,
                      const double strain, const DepthScale &scale,
                      Findings &findings)
    {
      // Cells that are compressed by all of their length are inside out: what
      // is behind a surface that touches is no place of the body.
      constexpr double inside_out = 1.;
      if (!found.is_inside(facet)
          || (found.is_met(facet) && strain >= inside_out))
        return;
      const bool is_error =
          !found.is_met(facet) || scale.is_more(found.elsewhere, useless);
      const std::string depth = compared(scale, found.elsewhere);
      if (is_error && passed.is_below_facets())
        findings.add(ABUT_FAILURE_UNSEEN, true,
                     pair + ": " + found.between_nodes(depth) + passed.text(),
                     {{"depth", found.elsewhere},
                      {"compared with", scale.way},
                      {"width", passed.width},
                      {"facet", passed.facet}});
      else if (is_error || scale.is_more(found.elsewhere, visible_inside))
        findings.add(
            ABUT_FAILURE_WRONG_SIDE, is_error, pair + ": " + found.text(depth),
            {{"depth", found.elsewhere}, {"compared with", scale.way}});
    }

    /** How deep nodes of a surface without constraints are in the obstacle, and
     * how far nodes have moved since detect(), length. */
    struct OutOfReach
    {
      double depth = 0., motion = 0.;

      /** Whether the motion and not a side is the cause. */
      bool is_certain(const double facet) const
      {
        constexpr double round_off = 1e-6;
        return depth > round_off * facet && motion >= depth;
      }
    };

    /** Collective. */
    template <int dim>
    OutOfReach find_out_of_reach(const ContactProblem<dim> &i,
                                 const std::size_t number,
                                 const la::Vector &displacement)
    {
      PairSet<dim> &set = i.surfaces->set();
      const SurfacePair<dim> &pair = set.pairs()[number];
      const auto now = set.displacements(displacement);
      const auto then = set.displacements(i.start_displacement);
      OutOfReach result;
      std::vector<dealii::Point<dim>> places;
      for (const NodeIndex node : pair.secondary.node)
        if (set.is_owned(node))
        {
          places.push_back(set.surface().nodes[node].point + now[node]);
          result.motion =
              std::max(result.motion, (now[node] - then[node]).norm());
        }
      std::vector<double> distance;
      run_everywhere<ContactError>(
          i.communicator,
          [&] { pair.data.obstacle->distance(places, distance); });
      for (const double value : distance)
        result.depth = std::max(result.depth, -value - pair.data.gap);
      for (double *value : {&result.depth, &result.motion})
        *value = MPI::max(*value, i.communicator);
      return result;
    }

    void judge_reach(const std::string &pair, const OutOfReach &found,
                     const DepthScale &scale, Findings &findings)
    {
      findings.add(ABUT_FAILURE_NO_PARTNER, true,
                   pair
                       + ": nodes of the surface are inside the obstacle by up "
                         "to "
                       + compared(scale, found.depth)
                       + ", and no constraint stops them: the obstacle was out "
                         "of reach in detect(), and nodes have moved by "
                       + three_digits(found.motion)
                       + " since. Give the pair at least that reach, or call "
                         "detect() at this displacement and solve again.",
                   {{"depth", found.depth}, {"motion", found.motion}});
    }

    /** Surfaces in an obstacle that they have no constraint with: a small one
     * may have come through them in one step, so that they face its far side.
     */
    void judge_unconstrained(const std::string &pair, const double depth,
                             const double facet, const DepthScale &scale,
                             Findings &findings)
    {
      constexpr double round_off = 1e-6;
      if (depth > round_off * facet && scale.is_more(depth, useless))
        findings.add(ABUT_FAILURE_UNSEEN, true,
                     pair + ": the surface is in the obstacle by "
                         + compared(scale, depth)
                         + ", without a constraint. Refine the surface there, "
                           "or use smaller load steps.",
                     {{"depth", depth}, {"compared with", scale.way}});
    }

    /** The deepest of all ranks. */
    struct Deepest
    {
      double missed = 0., peak = 0., any = 0.;

      /** The deepest of the cells or of the facets of a @p pair. Collective. */
      Deepest(const std::vector<FacetPenetration> &facet_penetrations,
              const std::size_t pair, const MPI_Comm communicator)
      {
        for (const FacetPenetration &found : facet_penetrations)
        {
          if (found.pair != pair)
            continue;
          any = std::max(any, found.depth);
          peak = std::max(peak, found.peak);
          if (found.is_missed)
            missed = std::max(missed, found.depth);
        }
        for (double *value : {&missed, &peak, &any})
          *value = MPI::max(*value, communicator);
      }
    };
    /** Penetration that the law is meant to have, length. */
    template <int dim> double soft_on_purpose(const ContactProblem<dim> &i)
    {
      // A user's own law is as soft as it is meant to be.
      if (i.input.method.user_law != nullptr)
        return INFINITY;
      return abut_law_has_penalty(i.input.method.options.law)
                 ? i.input.method.options.allowed_penetration
                       * i.input.method.options.length_scale
                 : 0.;
    }

    /** Bodies of which nothing is prescribed and no rigid motion determined. */
    template <int dim>
    std::vector<unsigned int> unsupported_bodies(const ContactProblem<dim> &i)
    {
      constexpr unsigned int n_motions = dim == 2 ? 3 : 6;
      std::map<unsigned int, unsigned int> count;
      for (const solve::FreeMotion &motion : i.system.undetermined)
        ++count[motion.body];
      std::vector<unsigned int> result;
      for (const auto &[body, n] : count)
        if (n == n_motions)
          result.push_back(body);
      return result;
    }

    template <int dim>
    void examine_membrane(const ContactProblem<dim> &i,
                          const la::Vector &displacement,
                          ContactExamination &result)
    {
      const Deepest deepest(
          i.source->facet_penetrations(displacement, i.row_states().data()), 0,
          i.communicator);
      result.deformation = i.scales.deformation(displacement);
      result.missed_depth = deepest.missed;
      double cell = 0.;
      for (const auto &some : i.host.dof_handler().active_cell_iterators())
        cell = std::max(cell, some->diameter());
      const DepthScale scale{result.deformation, result.deformation,
                             round_off_of_places
                                 * MPI::max(cell, i.communicator)};
      const bool missed = scale.is_more(deepest.missed, missed_part);
      const double between = deepest.any - i.results->measures().penetration;
      const double peak = std::min(deepest.peak, between);
      const bool hidden = scale.is_more(peak, useless);
      if (missed || scale.is_more(between, useless))
        Findings(result).add(
            ABUT_FAILURE_UNSEEN, missed || hidden,
            "The obstacle penetrates the membrane between nodes by up to "
                + compared(scale, deepest.any)
                + (hidden ? ", undetected by nodes: " + three_digits(peak)
                          : std::string())
                + (missed ? ". Cells without any contact are penetrated by up "
                            "to "
                                + three_digits(deepest.missed)
                          : std::string())
                + ". Refine the mesh there.",
            {{"depth", deepest.any},
             {"undetected depth", peak},
             {"missed depth", deepest.missed},
             {"compared with", scale.way}});
    }
  } // namespace

  template <int dim>
  ContactExamination
  examine(ContactProblem<dim> &i, const la::VectorView &given_displacement,
          const la::VectorView &residual, const bool allow_large_strain)
  {
    const bool can_touch = !i.input.pairs.empty()
                           || i.input.obstacle.lower != nullptr
                           || i.input.obstacle.upper != nullptr;
    if (can_touch)
      i.check_rows("examine()");
    else
      i.host.check_mesh("examine()");
    const la::Vector &displacement =
        i.host.vector("examine()", "displacement", given_displacement);
    ContactExamination result;
    Findings findings(result);
    if (i.is_started && i.request.action != ABUT_ACTION_STOP)
    {
      // Other findings would be about a displacement that is no answer.
      findings.add(ABUT_FAILURE_STEP_LIMIT, true,
                   "The contact iteration has not ended: update() returned "
                   "true. Call solve() and update() until update() returns "
                   "false.");
      return result;
    }
    judge_constraints(i.host, displacement, findings);
    if (residual)
    {
      result.imbalance = i.checks->imbalance(residual);
      judge_balance(result.imbalance, findings);
    }
    judge_residual(i.residual_check, findings);
    if (can_touch && i.surfaces == nullptr)
    {
      examine_membrane(i, displacement, result);
      return result;
    }
    const Strains strain = strains(i.host.mapping(), i.host.dof_handler(),
                                   displacement, i.input.axisymmetric);
    result.strain = strain.largest;
    result.mean_strain = strain.mean;
    result.rotation = strain.largest_rotation;
    result.mean_rotation = strain.mean_rotation;
    result.motions = i.system.solver != nullptr
                         ? i.system.solver->rigid_motions(displacement)
                         : i.system.followed_motions;
    judge_strain(result, allow_large_strain,
                 i.residual_check.lost_displacement() > 0., findings);
    judge_rotation(result, allow_large_strain, findings);
    if (!can_touch)
      return result;
    const std::vector<unsigned int> alone = unsupported_bodies(i);
    for (const unsigned int body : alone)
      findings.add(ABUT_FAILURE_FLOATING_BODY, false,
                   "Nothing supports "
                       + (body < i.input.body_names.size()
                              ? i.input.body_names[body]
                              : "body " + std::to_string(body + 1))
                       + ", and loads and contact do not determine where it "
                         "is: are its boundary values in the constraints?");
    for (const solve::FreeMotion &motion : i.system.undetermined)
      if (std::find(alone.begin(), alone.end(), motion.body) == alone.end())
        findings.add(
            ABUT_FAILURE_FLOATING_BODY, false,
            "Loads and contact do not determine a rigid body mode: "
                + motion.description
                + " without resistance or load. The result has the "
                  "smallest such motion in the mean square. Support the "
                  "body in that direction if the motion matters.");
    const std::vector<FacetPenetration> facet_penetrations =
        i.source->facet_penetrations(displacement, i.row_states().data());
    i.surfaces->examination().examine(displacement, i.row_pressures().data(),
                                      i.rows.gap.data(), i.row_states().data(),
                                      facet_penetrations);
    result.deformation = i.scales.deformation(displacement);
    const std::vector<PairCheck> checks = i.checks->pairs();
    const std::vector<PairResult<dim>> pairs = i.results->pairs();
    const std::vector<SurfacePair<dim>> &surface_pairs =
        i.surfaces->set().pairs();
    std::vector<DepthScale> scales;
    std::vector<double> visible;
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      scales.push_back({result.deformation,
                        largest_displacement(i.near_null_space(), displacement,
                                             i.communicator),
                        round_off_of_places * checks[p].facet_size});
      // Where raising gaps has not come to its end, anything that is left.
      visible.push_back(i.raises.has_ended_early()
                            ? i.raises.least_clearance(displacement)
                            : scales[p].limit(useless));
    }
    const std::vector<SeparatedRows> apart = i.surfaces->examination().apart(
        visible, i.row_pressures().data(), i.rows.gap.data(),
        i.row_states().data());
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      findings.begin_pair(p, pairs[p].name);
      const bool is_obstacle = i.input.pairs[p].obstacle != nullptr;
      const DepthScale &scale = scales[p];
      const bool follows = kinematics_info(i.input.method.kinematics).points
                               == ABUT_CONFIGURATION_CURRENT
                           && !i.input.pairs[p].tied && !is_obstacle;
      if (!follows)
        judge_sliding(pairs[p], checks[p], surface_pairs[p].gap_error_place,
                      is_obstacle,
                      i.input.pairs[p].secondary == i.input.pairs[p].primary,
                      surface_pairs[p].has_mean_gaps(), scale, findings);
      judge_rotation(pairs[p], allow_large_strain, findings);
      judge_oscillation(pairs[p], i.input.pairs[p].tied, is_obstacle, findings);
      judge_depths(pairs[p], pairs[p].penetration - soft_on_purpose(i),
                   abut_law_has_penalty(i.input.method.options.law), scale,
                   findings);
      const auto &narrowest = surface_pairs[p].narrowest;
      const bool is_alone =
          pairs[p].n_rows == 0 && is_obstacle && i.input.pairs[p].geometric_gap;
      const OutOfReach missed =
          is_alone ? find_out_of_reach(i, p, displacement) : OutOfReach();
      const bool is_out_of_reach = missed.is_certain(checks[p].facet_size);
      if (is_out_of_reach)
        judge_reach(pairs[p].name, missed, scale, findings);
      else
        judge_between(pairs[p], is_obstacle,
                      Deepest(facet_penetrations, p, i.communicator).peak,
                      std::min(checks[p].facet_size, narrowest.width),
                      checks[p].size_ratio, scale, findings);
      result.touches.push_back(pairs[p].secondary_force.norm() > 0.
                               || pairs[p].between_rows > 0.);
      judge_separated_rows(pairs[p].name, apart[p], follows, scale, findings);
      judge_width(pairs[p].name, narrowest, findings);
      if (const Message late = late_contact(pairs[p].name, pairs[p].late_force,
                                            pairs[p].normal_force);
          !late.empty())
        findings.add(ContactFinding(late, false));
      // Bodies with pressure may be deformed by bending alone: compared
      // with all motion.
      const DepthScale motion{scale.far, scale.far, scale.least};
      judge_chords(pairs[p].name,
                   chord_error(i.surfaces->points(), p, i.row_states().data(),
                               motion.limit(useless_chord)),
                   motion, findings);
      if (!is_obstacle)
        judge_corners(pairs[p], checks[p], surface_pairs[p].held_in_the_mean,
                      scale, findings);
      for (const Message &refused : surface_pairs[p].refused)
        findings.add(
            refused.failure, true,
            pairs[p].name
                + " is normally rejected; this result is for study only.");
      if (is_obstacle && i.input.pairs[p].geometric_gap && !is_out_of_reach)
      {
        const auto inside =
            find_obstacle_in_bodies(i.host.mapping(), i.host.dof_handler(),
                                    displacement, i.input.pairs[p]);
        judge_inside(pairs[p].name, inside,
                     inside.is_inside(checks[p].facet_size)
                         ? passed_between(i.surfaces->points(), p, inside.place)
                         : ObstacleWidth(),
                     checks[p].facet_size, result.strain, scale, findings);
        const bool is_prescribed =
            std::any_of(checks[p].warnings.begin(), checks[p].warnings.end(),
                        [](const Message &warning)
                        { return warning.failure == ABUT_FAILURE_HELD_NODES; });
        if (pairs[p].n_rows == 0 && !is_prescribed)
          judge_unconstrained(pairs[p].name, inside.at_surface,
                              checks[p].facet_size, scale, findings);
      }
      result.missed_depth =
          std::max(result.missed_depth, pairs[p].missed_depth);
    }
    return result;
  }

  template ContactExamination examine(ContactProblem<2> &,
                                      const la::VectorView &,
                                      const la::VectorView &, bool);
  template ContactExamination examine(ContactProblem<3> &,
                                      const la::VectorView &,
                                      const la::VectorView &, bool);
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <abut/dealii/coded.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include "user_law.h"

#include <deal.II/base/exceptions.h>

#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace abut
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    const char automatic_word[] = "auto";

    /** Words for abut_friction_iteration, by its numbers. */
    const char *const iteration_words[] = {"primal-dual", "radial return",
                                           "tresca"};

    /** Names of all discretisations, separated by bars. */
    std::string discretisation_names()
    {
      std::string names = automatic_word;
      for (int i = 0; i < ABUT_DISCRETISATION_N; ++i)
        names +=
            std::string("|")
            + abut_discretisation_name(static_cast<abut_discretisation>(i));
      return names;
    }

    /** "`mortar`: gaps in weighted mean. " and so on. */
    std::string discretisation_texts()
    {
      std::string text;
      for (int i = 0; i < ABUT_DISCRETISATION_N; ++i)
      {
        const auto discretisation = static_cast<abut_discretisation>(i);
        text += std::string("`") + abut_discretisation_name(discretisation)
                + "`: " + discretisation_info(discretisation).help + ". ";
      }
      return text;
    }

    void declare_discretisation(ParameterHandler &prm)
    {
      parameter::declare(
          prm, "Discretisation", automatic_word,
          Patterns::Selection(discretisation_names()), parameter::advanced(),
          "Discretisation of contact between surfaces. "
              + discretisation_texts()
              + "`auto`: dual mortar between bodies, node to segment against "
                "rigid obstacles. A membrane's obstacle always acts at nodes.");
      parameter::declare(prm, "Multiplier degree", "auto",
                         OrWord(Patterns::Integer(1, 1), "auto"),
                         parameter::expert("1", "1"),
                         "Degree of the multipliers of `mortar` on quadratic "
                         "elements. auto: that of the elements.");
      parameter::declare(prm, "Quadrature degree", "auto",
                         OrWord(Patterns::Integer(1, 8), "auto"),
                         parameter::expert("1", "4"),
                         "Degree of polynomials that are integrated exactly on "
                         "each common part of two facets, or on each facet "
                         "with `Segments = false`. auto: by the elements.");
      parameter::declare(
          prm, "Segments", "true", Patterns::Bool(), parameter::expert(),
          "Whether integrals between bodies run over the common parts of "
          "facets, cut exactly. false: over the points of a rule on each "
          "secondary facet; faster, with an error of about 1e-2 of a constant "
          "pressure. Without effect for node to segment and obstacles.");
    }

    /** Names of all laws, separated by bars. */
    std::string law_names()
    {
      std::string names;
      for (std::int32_t i = 0; abut_law_get(i) != nullptr; ++i)
        names += std::string(abut_law_get(i)->name) + "|";
      return names + shim::user_law_word;
    }

    Patterns::Map user_parameters()
    {
      return Patterns::Map(Patterns::Anything(), Patterns::Double(), 0, 1000,
                           ",", ":");
    }

    void declare_user_law(ParameterHandler &prm)
    {
      parameter::declare(
          prm, "Law file", "", TextPattern::file(),
          parameter::advanced("", "liblaw.so"),
          "Shared object of your own contact law, for `Enforcement = user`. A "
          "relative name is looked up in the folder of the scene file, then in "
          "the working folder. See doc/your-own-law.md.");
      parameter::declare(
          prm, "Law parameters", "", user_parameters(),
          parameter::advanced("", "stiffness: 100, power: 1.5"),
          "Parameters of your own contact law, in the units of the scene.");
    }

    void declare_user_friction(ParameterHandler &prm)
    {
      parameter::declare(prm, "Friction file", "", TextPattern::file(),
                         parameter::advanced("", "libfriction.so"),
                         "Shared object of your own friction law, for all "
                         "pairs with friction; looked up like `Law file`. "
                         "Empty: Coulomb friction. See doc/your-own-law.md.");
      parameter::declare(
          prm, "Friction parameters", "", user_parameters(),
          parameter::advanced("", "mu: 0.3, decay: 2"),
          "Parameters of your own friction law, in the units of the scene.");
      parameter::declare(
          prm, "Friction iteration", iteration_words[0],
          Patterns::Selection(std::string(iteration_words[0]) + "|"
                              + iteration_words[1] + "|" + iteration_words[2]),
          parameter::expert(),
          "Iteration for stick and slip. primal-dual: Newton's method for "
          "pressures, tractions and displacements, with protection against "
          "cycles. For comparison only: radial return (Newton's method on the "
          "return map), tresca (friction limits frozen, then updated from the "
          "pressures).");
    }

    std::map<std::string, double> parse_user_parameters(const std::string &text)
    {
      return Patterns::Tools::Convert<std::map<std::string, double>>::to_value(
          text, user_parameters());
    }

    /** The law that suits a discretisation, whatever the problem: quadrature
     * points have more rows than the surface has unknowns, which exact
     * contact cannot satisfy. */
    const char *
    automatic_law(const std::optional<abut_discretisation> discretisation)
    {
      return discretisation
                     && discretisation_info(*discretisation).row_per_point
                 ? "penalty"
                 : "lagrange";
    }

    /** The core's range of a field of the options. */
    NumberPattern range_of(const char *field)
    {
      const abut_limit *limit = abut_strategy_limit(field);
      AssertThrow(limit != nullptr, dealii::ExcInternalError());
      return NumberPattern(*limit);
    }

    void declare_number(ParameterHandler &prm, const std::string &name,
                        const double value, const char *field,
                        const parameter::Note &note, const std::string &text)
    {
      parameter::declare(prm, name, Patterns::Tools::to_string(value),
                         range_of(field), note, text);
    }

    void declare_penalty(ParameterHandler &prm, const abut_strategy_options &d)
    {
      parameter::declare(
          prm, "Penalty factor", "auto", OrWord(range_of("penalty"), "auto"),
          parameter::basic("local stiffness", "100"),
          "Stiffness of the contact springs relative to the stiffness of the "
          "contact surface (nitsche: gamma). auto: penalty 50, augmented "
          "lagrangian 20, nitsche 10, quadratic penalty 1 at the start. "
          "Larger: less penetration, harder linear systems. Point masses: "
          "relative to sum_j B_j^2 K_jj / (sum_j B_j^2)^2 of the constraint.");
      parameter::declare(
          prm, "Nitsche theta", "0", NumberPattern::between(-1, 1),
          parameter::expert("1", "1"),
          "Variant of nitsche. 1: symmetric, needs larger penalties. 0: fewest "
          "terms. -1: converges for all penalties.");
      declare_number(prm, "Penalty growth", d.penalty_growth, "penalty_growth",
                     parameter::expert("1", "5"),
                     "Factor of the penalty in each outer iteration of "
                     "quadratic penalty.");
      declare_number(
          prm, "Penalty cap", d.penalty_cap, "penalty_cap",
          parameter::expert("local stiffness", "1e6"),
          "Largest penalty of quadratic penalty and augmented lagrangian.");
      parameter::declare(prm, "Adaptive penalty",
                         d.adaptive_penalty ? "true" : "false",
                         Patterns::Bool(), parameter::expert(),
                         "Whether augmented lagrangian raises the penalty "
                         "where the penetration decreases too slowly.");
      declare_number(prm, "Allowed penetration", d.allowed_penetration,
                     "allowed_penetration",
                     parameter::expert("length of the scene", "1e-4"),
                     "Penetration at which penalty starts to act.");
      declare_number(
          prm, "Complementarity parameter", d.complementarity,
          "complementarity", parameter::expert("local stiffness", "10"),
          "Weight of the gap relative to the pressure in the choice of active "
          "constraints. The result does not depend on it.");
    }

    void declare_barrier(ParameterHandler &prm, const abut_strategy_options &d)
    {
      declare_number(
          prm, "Barrier start", d.barrier_start, "barrier_start",
          parameter::expert("pressure times length of the scene", "1e-2"),
          "First product of pressure and gap of barrier, where no coarser mesh "
          "gives a start; later starts are not larger.");
      declare_number(prm, "Barrier factor", d.barrier_factor, "barrier_factor",
                     parameter::expert("1", "0.2"),
                     "Factor of the barrier in each step of the continuation.");
      declare_number(
          prm, "Barrier end", d.barrier_end, "barrier_end",
          parameter::expert("pressure times length of the scene", "1e-10"),
          "Last product of pressure and gap.");
    }

    void declare_stopping(ParameterHandler &prm, const abut_strategy_options &d)
    {
      declare_number(prm, "Gap tolerance", d.gap_tolerance, "gap_tolerance",
                     parameter::advanced("length of the scene", "1e-8"),
                     "Largest penetration of a converged solution.");
      declare_number(prm, "Pressure tolerance", d.pressure_tolerance,
                     "pressure_tolerance", parameter::advanced("1", "1e-4"),
                     "Largest relative change of the pressure in the last "
                     "outer iteration.");
      declare_number(prm, "Linear tolerance", d.linear_tolerance,
                     "linear_tolerance", parameter::expert("1", "1e-3"),
                     "Relative tolerance of the linear solver while the active "
                     "set changes.");
      declare_number(prm, "Final linear tolerance", d.final_linear_tolerance,
                     "final_linear_tolerance",
                     parameter::advanced("1", "1e-12"),
                     "Relative tolerance of the last linear solve.");
      parameter::declare(prm, "Maximum linear systems",
                         std::to_string(d.max_steps), Patterns::Integer(1),
                         parameter::advanced("1", "500"),
                         "Largest number of linear systems in one solve.");
      parameter::declare(prm, "Maximum outer iterations",
                         std::to_string(d.max_outer), Patterns::Integer(1),
                         parameter::advanced("1", "100"),
                         "Largest number of outer iterations (multiplier "
                         "updates, penalties or barriers) in one solve.");
    }

    void parse_numbers(ParameterHandler &prm, abut_strategy_options &o,
                       double &nitsche_theta)
    {
      const std::map<std::string, double *> fields = {
          {"Penalty growth", &o.penalty_growth},
          {"Penalty cap", &o.penalty_cap},
          {"Nitsche theta", &nitsche_theta},
          {"Allowed penetration", &o.allowed_penetration},
          {"Complementarity parameter", &o.complementarity},
          {"Barrier start", &o.barrier_start},
          {"Barrier factor", &o.barrier_factor},
          {"Barrier end", &o.barrier_end},
          {"Gap tolerance", &o.gap_tolerance},
          {"Pressure tolerance", &o.pressure_tolerance},
          {"Linear tolerance", &o.linear_tolerance},
          {"Final linear tolerance", &o.final_linear_tolerance}};
      for (const auto &[name, value] : fields)
        *value = prm.get_double(name);
      o.penalty = parameter::number_or_zero(prm, "Penalty factor");
      o.adaptive_penalty = prm.get_bool("Adaptive penalty");
      o.max_steps =
          static_cast<std::int32_t>(prm.get_integer("Maximum linear systems"));
      o.max_outer = static_cast<std::int32_t>(
          prm.get_integer("Maximum outer iterations"));
    }
  } // namespace

  std::string
  discretisation_name(const std::optional<abut_discretisation> discretisation)
  {
    return discretisation ? abut_discretisation_name(*discretisation)
                          : automatic_word;
  }

  abut_discretisation_info
  discretisation_info(const abut_discretisation discretisation)
  {
    abut_discretisation_info info = {};
    if (abut_discretisation_describe(discretisation, &info) != ABUT_SUCCESS)
      throw std::invalid_argument("there is no such discretisation");
    return info;
  }

  Message refusal(const abut_law &law, const abut_discretisation discretisation,
                  const System system, const bool tied)
  {
    const abut_discretisation_info info = discretisation_info(discretisation);
    const bool hard = abut_law_is_exact(&law);
    const bool interior = abut_law_is_interior(&law);
    const std::string with = "Method/Enforcement = " + std::string(law.name);
    if (tied && abut_law_find(law.name) == nullptr)
      return "The law '" + std::string(law.name)
             + "' is for contact, not for tied surfaces. Use lagrange, penalty "
               "or augmented lagrangian.";
    if (tied && interior)
      return with
             + " cannot tie surfaces. Use lagrange, penalty or augmented "
               "lagrangian.";
    if (abut_law_needs_stress(&law) && (tied || !info.row_per_point))
      return with
             + (tied ? " is for contact, not for tied surfaces. Use lagrange, "
                       "penalty or augmented lagrangian."
                     : " takes the stress at quadrature points: set "
                       "Method/Discretisation = auto or quadrature point.");
    if (info.row_per_point && (tied || hard || abut_law_is_primal_dual(&law)))
      return coded(
          ABUT_FAILURE_RICH_MULTIPLIERS,
          (tied ? "Tied surfaces" : with) + " with Method/Discretisation = "
              + abut_discretisation_name(discretisation)
              + " has more constraints than the surface has unknowns: it "
                "locks. Use dual mortar, penalty or augmented lagrangian.");
    if (info.couples_rows && hard && system == System::condensed)
      return with + " with Method/Discretisation = "
             + abut_discretisation_name(discretisation)
             + " couples all multipliers, which cannot be eliminated one by "
               "one. Use Method/System = saddle point, or dual mortar.";
    return "";
  }

  std::string friction_refusal(const abut_law &law,
                               const abut_discretisation discretisation,
                               const MethodParameters &method, const bool tied,
                               const bool has_obstacle)
  {
    const abut_discretisation_info info = discretisation_info(discretisation);
    const std::string with = "Method/Enforcement = " + std::string(law.name);
    if (tied)
      return "tied surfaces do not slide: remove the friction.";
    if (abut_law_is_interior(&law))
      return with
             + " has no friction. Use lagrange, penalty, quadratic penalty, "
               "augmented lagrangian or nitsche.";
    if (abut_law_needs_stress(&law) && method.nitsche_theta != 0.)
      return with + " has friction with Method/Nitsche theta = 0 only.";
    if (info.row_per_point && method.segments && !has_obstacle
        && kinematics_info(method.kinematics).points
               != ABUT_CONFIGURATION_CURRENT)
      return "friction needs Method/Segments = false or dual mortar: points on "
             "common parts of facets change with the pairs.";
    return "";
  }

  namespace
  {
    /** Words of Method/Contact geometry. */
    struct SlidingWord
    {
      const char *word;
      abut_kinematics kinematics;
    };
    constexpr SlidingWord sliding_words[] = {
        {"reference", ABUT_KINEMATICS_REFERENCE},
        {"start of step", ABUT_KINEMATICS_UPDATED},
        {"current", ABUT_KINEMATICS_CURRENT}};

    std::optional<abut_kinematics> kinematics_of(const std::string &word)
    {
      for (const SlidingWord &each : sliding_words)
        if (word == each.word)
          return each.kinematics;
      return {};
    }

    /** The parameter's value, as messages name it. */
    std::string sliding_text(const abut_kinematics kinematics)
    {
      for (const SlidingWord &each : sliding_words)
        if (kinematics == each.kinematics)
          return std::string("Method/Contact geometry = ") + each.word + " ";
      return "Corotational kinematics ";
    }
  } // namespace

  const abut_kinematics_info &
  kinematics_info(const std::optional<abut_kinematics> kinematics)
  {
    const abut_kinematics_info *found =
        abut_kinematics_get(kinematics.value_or(ABUT_KINEMATICS_REFERENCE));
    if (found == nullptr)
      throw std::invalid_argument("there is no such kinematics");
    return *found;
  }

  std::string kinematics_refusal(const abut_kinematics kinematics,
                                 const abut_law &law,
                                 const abut_discretisation discretisation,
                                 const KinematicsPair &pair)
  {
    const bool is_weighted = discretisation_info(discretisation).is_weighted;
    const abut_kinematics_info &info = kinematics_info(kinematics);
    const std::string why = sliding_text(kinematics);
    if (info.points != ABUT_CONFIGURATION_REFERENCE && !pair.has_geometric_gap)
      return why
             + "needs the gaps of the meshes: set Use mesh gap = true, or use "
               "reference.";
    if (info.bodies_only && (!is_weighted || pair.has_obstacle))
      return why
             + "is for mortar between bodies only. Use Method/Contact geometry "
               "= current.";
    if (is_weighted && pair.has_obstacle && !info.weighted_obstacle)
      return why
             + "against an obstacle is for nodes and quadrature points, not "
               "for Method/Discretisation = "
             + abut_discretisation_name(discretisation)
             + (pair.has_nodal_weights
                    ? ". Use node to segment or quadrature point."
                    : ". Nodes of quadratic triangles have no weight: use "
                      "quadrature point with penalty, quadratic penalty or "
                      "augmented lagrangian, linear elements, or reference.");
    if (abut_law_needs_stress(&law) && !info.stress_laws)
      return why
             + "does not go with Method/Enforcement = " + std::string(law.name)
             + ", whose stress belongs to the reference configuration. Use "
               "lagrange, penalty, quadratic penalty or augmented lagrangian, "
               "or reference.";
    if (abut_law_is_interior(&law) && !info.interior_laws)
      return why
             + "does not go with Method/Enforcement = " + std::string(law.name)
             + ". Use lagrange, penalty, quadratic penalty or augmented "
               "lagrangian.";
    return "";
  }

  abut_discretisation
  MethodParameters::discretisation_of(const bool has_obstacle,
                                      const bool has_quadratic_triangles) const
  {
    const abut_law &law = *options.law;
    if (discretisation)
      return *discretisation;
    if (abut_law_needs_stress(&law))
      return ABUT_DISCRETISATION_QUADRATURE_POINT;
    // The corners of quadratic triangles have no weight.
    if (has_quadratic_triangles)
      return has_obstacle && !kinematics_info(kinematics).weighted_obstacle
                     && !abut_law_is_exact(&law)
                     && !abut_law_is_primal_dual(&law)
                 ? ABUT_DISCRETISATION_QUADRATURE_POINT
                 : ABUT_DISCRETISATION_MORTAR;
    return has_obstacle ? ABUT_DISCRETISATION_NODE_TO_SEGMENT
                        : ABUT_DISCRETISATION_DUAL_MORTAR;
  }

  void MethodParameters::declare_parameters(ParameterHandler &prm)
  {
    const abut_strategy_options defaults = abut_strategy_defaults();
    prm.enter_subsection("Method");
    parameter::declare(
        prm, "Enforcement", "lagrange",
        Patterns::Selection("auto|" + law_names()), parameter::basic(),
        "Enforcement of contact. lagrange: exact, by multipliers and an active "
        "set. penalty: stiff springs, error of the order 1/penalty. quadratic "
        "penalty: the same with a growing penalty. augmented lagrangian: "
        "springs and multiplier updates, exact in the limit. barrier: interior "
        "points with a barrier that goes to zero. interior point: primal-dual, "
        "from any start. nitsche: by the stress of elastic bodies, at "
        "quadrature points. user: your own law of pressure and gap. auto: "
        "lagrange; with `quadrature point` nitsche (programs of your own: "
        "penalty); interior point for membranes on fine meshes without nested "
        "iteration.");
    declare_user_law(prm);
    declare_user_friction(prm);
    declare_discretisation(prm);
    declare_penalty(prm, defaults);
    declare_barrier(prm, defaults);
    declare_stopping(prm, defaults);
    parameter::declare(
        prm, "Contact geometry", "auto",
        Patterns::Selection("auto|reference|start of step|current"),
        parameter::basic(),
        "Configuration in which contact is evaluated. reference: gaps are "
        "linear in the displacement (small sliding); mortar at finite strain "
        "updates normals and gaps, which allows large rotation without "
        "sliding. start of step: that at the start of the load or time step. "
        "current: points follow the deformation (large sliding). auto: current "
        "at finite strain where possible, start of step in dynamics, else "
        "reference.");
    parameter::declare(prm, "Geometric contact tangent", "true",
                       Patterns::Bool(), parameter::expert(),
                       "Whether the tangent has the derivatives of normals and "
                       "partners, for `Contact geometry = current`. false: "
                       "linear convergence or failure, for comparison only.");
    parameter::declare(prm, "System", "auto",
                       Patterns::Selection("auto|condensed|saddle point"),
                       parameter::expert(),
                       "Linear system. condensed: pressures are eliminated "
                       "constraint by constraint. saddle point: pressures are "
                       "unknowns. auto: chosen, and reported.");
    parameter::declare_old_names(prm, "Method");
    prm.leave_subsection();
  }

  void MethodParameters::set_law(abut_strategy_friction &friction) const
  {
    if (user_friction == nullptr)
      return;
    friction.law = &user_friction->law;
    friction.parameters = user_friction->parameters.data();
  }

  void MethodParameters::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Method");
    parse_numbers(prm, options, nitsche_theta);
    const std::string word = prm.get("System");
    system = word == "condensed"      ? System::condensed
             : word == "saddle point" ? System::saddle_point
                                      : System::automatic;
    abut_discretisation way;
    if (abut_discretisation_find(prm.get("Discretisation").c_str(), &way)
        == ABUT_SUCCESS)
      discretisation = way;
    else
      discretisation.reset();
    kinematics = kinematics_of(prm.get("Contact geometry"));
    const std::string law = prm.get("Enforcement");
    law_is_automatic = law == "auto";
    options.law = abut_law_find(law_is_automatic ? automatic_law(discretisation)
                                                 : law.c_str());
    if (law == shim::user_law_word)
    {
      user_law =
          shim::load_user_law(prm.get("Law file"),
                              parse_user_parameters(prm.get("Law parameters")));
      options.law = &user_law->law;
      options.law_parameters = user_law->parameters.data();
    }
    if (!prm.get("Friction file").empty())
      user_friction = shim::load_user_friction(
          prm.get("Friction file"),
          parse_user_parameters(prm.get("Friction parameters")));
    for (int i = ABUT_FRICTION_PRIMAL_DUAL; i <= ABUT_FRICTION_TRESCA; ++i)
      if (prm.get("Friction iteration") == iteration_words[i])
        options.friction_iteration = static_cast<abut_friction_iteration>(i);
    multiplier_degree = static_cast<unsigned int>(
        parameter::number_or_zero(prm, "Multiplier degree"));
    quadrature_degree = static_cast<unsigned int>(
        parameter::number_or_zero(prm, "Quadrature degree"));
    segments = prm.get_bool("Segments");
    turning_terms = prm.get_bool("Geometric contact tangent");
    prm.leave_subsection();
    AssertThrow(
        system != System::saddle_point || abut_law_is_exact(options.law),
        dealii::ExcMessage(
            std::string("Method/System = saddle point goes with "
                        "Method/Enforcement = lagrange: with '")
            + options.law->name
            + "' each pressure follows from its gap. Use auto or condensed."));
    AssertThrow(options.barrier_end <= options.barrier_start,
                dealii::ExcMessage("Method/Barrier end is larger than "
                                   "Method/Barrier start."));
  }
} // namespace abut

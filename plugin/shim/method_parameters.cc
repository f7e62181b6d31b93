// SPDX-License-Identifier: LGPL-2.1-or-later
#include <abut/dealii/coded.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/number_pattern.h>

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
      prm.declare_entry(
          "Discretisation", automatic_word,
          Patterns::Selection(discretisation_names()),
          "How contact between surfaces of bodies is written down. "
              + discretisation_texts()
              + "`auto`: dual mortar between two bodies, node to segment "
                "against rigid obstacles. A membrane's obstacle always acts at "
                "nodes.");
      prm.declare_entry("Multiplier degree", "0", Patterns::Integer(0, 1),
                        "Degree of the multipliers of `mortar` on quadratic "
                        "elements: 1, or 0 for that of the elements.");
      prm.declare_entry("Quadrature degree", "0", Patterns::Integer(0, 8),
                        "Degree up to which polynomials are integrated exactly "
                        "on each common part of two facets, or on each facet "
                        "without `Segments`. 0: chosen by the elements.");
      prm.declare_entry("Segments", "true", Patterns::Bool(),
                        "Integrate over the common parts of the facets of the "
                        "two bodies, cut exactly. If not, at the points of a "
                        "rule on each facet of the secondary surface: faster, "
                        "but a constant pressure is wrong by some 1e-2. Does "
                        "not matter to `node to segment` and against "
                        "obstacles.");
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
      prm.declare_entry("Law file", "", Patterns::Anything(),
                        "Shared object of your own law, for `user`; a relative "
                        "name is looked up beside the scene's file, then in "
                        "the working folder. See doc/your-own-law.md.");
      prm.declare_entry("Law parameters", "", user_parameters(),
                        "Parameters of your own law: `name: number, ...`, in "
                        "the units of the scene.");
    }

    void declare_user_friction(ParameterHandler &prm)
    {
      prm.declare_entry("Friction file", "", Patterns::Anything(),
                        "Shared object of your own friction law, for all that "
                        "has friction; looked up like `Law file`. Empty: "
                        "Coulomb's law. See doc/your-own-law.md.");
      prm.declare_entry("Friction parameters", "", user_parameters(),
                        "Parameters of your own friction law, written like "
                        "`Law parameters`.");
      prm.declare_entry("Friction iteration", iteration_words[0],
                        Patterns::Selection(std::string(iteration_words[0])
                                            + "|" + iteration_words[1] + "|"
                                            + iteration_words[2]),
                        "How points that stick and slip are found. "
                        "`primal-dual`: Newton's method for pressures, "
                        "tractions and displacements, with cures where states "
                        "come back. The others are the textbooks', there to "
                        "see where they fail (doc/failures.md). `radial "
                        "return`: Newton's method on the return map. `tresca`: "
                        "the bounds of friction are frozen, then made anew "
                        "from the pressures, and so on.");
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

    /** A number of the options: its range is the core's for this field. */
    void declare_number(ParameterHandler &prm, const std::string &name,
                        const double value, const char *field,
                        const std::string &text)
    {
      const abut_limit *limit = abut_strategy_limit(field);
      AssertThrow(limit != nullptr, dealii::ExcInternalError());
      prm.declare_entry(name, Patterns::Tools::to_string(value),
                        NumberPattern(*limit), text);
    }

    void declare_penalty(ParameterHandler &prm, const abut_strategy_options &d)
    {
      declare_number(prm, "Penalty", d.penalty, "penalty",
                     "Stiffness of the contact as a multiple of the local "
                     "stiffness of the contact surface. 0 takes the method's "
                     "own: penalty 50, augmented lagrangian 20, nitsche "
                     "10, quadratic penalty starts at 1.");
      prm.declare_entry("Nitsche theta", "0", NumberPattern::between(-1, 1),
                        "Variant of `nitsche`: 1 is symmetric and needs the "
                        "larger penalties, 0 has the fewest terms, -1 "
                        "converges for all penalties.");
      declare_number(prm, "Penalty growth", d.penalty_growth, "penalty_growth",
                     "Factor by which `quadratic penalty` raises the penalty "
                     "in each outer step.");
      declare_number(prm, "Penalty cap", d.penalty_cap, "penalty_cap",
                     "Largest penalty that `quadratic penalty` and `augmented "
                     "lagrangian` grow to, as a multiple of the local "
                     "stiffness.");
      prm.declare_entry("Adaptive penalty",
                        d.adaptive_penalty ? "true" : "false", Patterns::Bool(),
                        "Whether `augmented lagrangian` raises the penalty "
                        "where the penetration falls too slowly.");
      declare_number(prm, "Allowed penetration", d.allowed_penetration,
                     "allowed_penetration",
                     "Penetration at which `penalty` begins to push, as a "
                     "multiple of the scene's length scale.");
      declare_number(prm, "Complementarity parameter", d.complementarity,
                     "complementarity",
                     "Weight of the gap against the pressure when active rows "
                     "are chosen, as a multiple of the local stiffness. The "
                     "result does not depend on it.");
    }

    void declare_barrier(ParameterHandler &prm, const abut_strategy_options &d)
    {
      const std::string unit = ", as a multiple of the scene's pressure scale "
                               "times its length scale.";
      declare_number(prm, "Barrier start", d.barrier_start, "barrier_start",
                     "First product of pressure and gap of `barrier` where "
                     "there is no coarser mesh to start from; no later start "
                     "is above it"
                         + unit);
      declare_number(prm, "Barrier factor", d.barrier_factor, "barrier_factor",
                     "Factor of the barrier in each step of the continuation.");
      declare_number(prm, "Barrier end", d.barrier_end, "barrier_end",
                     "Last product of pressure and gap" + unit);
    }

    void declare_stopping(ParameterHandler &prm, const abut_strategy_options &d)
    {
      declare_number(prm, "Gap tolerance", d.gap_tolerance, "gap_tolerance",
                     "Largest penetration of a converged solution, as a "
                     "multiple of the scene's length scale.");
      declare_number(prm, "Pressure tolerance", d.pressure_tolerance,
                     "pressure_tolerance",
                     "Largest relative change of the pressure in the last "
                     "outer step.");
      declare_number(prm, "Linear tolerance", d.linear_tolerance,
                     "linear_tolerance",
                     "Relative tolerance of the linear solver while the "
                     "active set still changes.");
      declare_number(prm, "Final linear tolerance", d.final_linear_tolerance,
                     "final_linear_tolerance",
                     "Relative tolerance of the linear solver in the last "
                     "step.");
      prm.declare_entry("Maximum steps", std::to_string(d.max_steps),
                        Patterns::Integer(1),
                        "Largest number of linear systems in one solve.");
      prm.declare_entry("Maximum outer steps", std::to_string(d.max_outer),
                        Patterns::Integer(1),
                        "Largest number of outer steps (multiplier updates, "
                        "penalties or barriers) in one solve.");
    }

    void parse_numbers(ParameterHandler &prm, abut_strategy_options &o,
                       double &nitsche_theta)
    {
      const std::map<std::string, double *> fields = {
          {"Penalty", &o.penalty},
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
      o.adaptive_penalty = prm.get_bool("Adaptive penalty");
      o.max_steps = static_cast<std::int32_t>(prm.get_integer("Maximum steps"));
      o.max_outer =
          static_cast<std::int32_t>(prm.get_integer("Maximum outer steps"));
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
             + " cannot glue surfaces: an equality has no interior. Use "
               "lagrange, penalty or augmented lagrangian.";
    if (abut_law_needs_stress(&law) && (tied || !info.row_per_point))
      return with
             + (tied ? " is for contact, not for tied surfaces. Use lagrange, "
                       "penalty or augmented lagrangian."
                     : " takes the stress at quadrature points: leave "
                       "Method/Discretisation = auto, or say quadrature "
                       "point.");
    if (info.row_per_point && (tied || hard || abut_law_is_primal_dual(&law)))
      return coded(ABUT_FAILURE_RICH_MULTIPLIERS,
                   (tied ? "Tied surfaces" : with)
                       + " with Method/Discretisation = "
                       + abut_discretisation_name(discretisation)
                       + " has "
                         "more conditions than the surface has unknowns: it "
                         "locks. Use dual mortar, or penalty or augmented "
                         "lagrangian.");
    if (info.couples_rows && hard && system == System::condensed)
      return with + " with Method/Discretisation = "
             + abut_discretisation_name(discretisation)
             + " couples all multipliers: "
               "they cannot be eliminated row by row. Use Method/System = "
               "saddle point, or dual mortar.";
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
      return "surfaces that are tied do not slide: leave out its friction.";
    if (abut_law_is_interior(&law))
      return with
             + " has no friction. Use lagrange, penalty, quadratic penalty, "
               "augmented lagrangian or nitsche.";
    if (abut_law_needs_stress(&law) && method.nitsche_theta != 0.)
      return with
             + " has friction with Method/Nitsche theta = 0 only: the other "
               "variants act on the stress of the body, too, so that tractions "
               "are no balance of forces along the surface.";
    if (info.row_per_point && method.segments && !has_obstacle
        && kinematics_info(method.kinematics).points
               != ABUT_CONFIGURATION_CURRENT)
      return "friction needs points that last: on the common parts of facets "
             "they change with the pairs. Use Method/Segments = false, or dual "
             "mortar.";
    return "";
  }

  namespace
  {
    /** Words of Method/Sliding. */
    struct SlidingWord
    {
      const char *word;
      abut_kinematics kinematics;
    };
    constexpr SlidingWord sliding_words[] = {
        {"small", ABUT_KINEMATICS_REFERENCE},
        {"step", ABUT_KINEMATICS_UPDATED},
        {"large", ABUT_KINEMATICS_CURRENT}};

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
          return std::string("Method/Sliding = ") + each.word + " ";
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
             + "measures gaps where the surfaces are: they must count (leave "
               "out the gap that stands for them), or use small.";
    if (info.bodies_only && (!is_weighted || pair.has_obstacle))
      return why + "is for mortar between bodies only. Use Sliding = large.";
    if (is_weighted && pair.has_obstacle && !info.weighted_obstacle)
      return why
             + "follows nodes and quadrature points against an obstacle, not "
               "Method/Discretisation = "
             + abut_discretisation_name(discretisation)
             + (pair.has_nodal_weights
                    ? ". Use node to segment or quadrature point."
                    : ". Nodes of quadratic triangles have no weight: use "
                      "quadrature point with penalty, quadratic penalty or "
                      "augmented lagrangian, linear elements, or small.");
    if (abut_law_needs_stress(&law) && !info.stress_laws)
      return why
             + "does not go with Method/Enforcement = " + std::string(law.name)
             + ", whose stress is that of the undeformed bodies. Use lagrange, "
               "penalty, quadratic penalty or augmented lagrangian, or small.";
    if (abut_law_is_interior(&law) && !info.interior_laws)
      return why
             + "does not go with Method/Enforcement = " + std::string(law.name)
             + ". Use lagrange, penalty, quadratic penalty or augmented "
               "lagrangian.";
    return "";
  }

  void MethodParameters::declare_parameters(ParameterHandler &prm)
  {
    const abut_strategy_options defaults = abut_strategy_defaults();
    prm.enter_subsection("Method");
    prm.declare_entry("Enforcement", "lagrange",
                      Patterns::Selection("auto|" + law_names()),
                      "How contact is enforced. `lagrange`: exactly, by "
                      "multipliers and an active set. `penalty`: by stiff "
                      "springs, with an error that falls as one over the "
                      "penalty. `quadratic penalty`: the same with a penalty "
                      "that grows. `augmented lagrangian`: by springs and "
                      "multiplier updates, exact in the limit at a moderate "
                      "penalty. `barrier`: from inside the feasible set, with "
                      "a barrier that goes to zero. `interior point`: the "
                      "same with primal-dual steps from any start. `nitsche`: "
                      "by the bodies' own stress, at quadrature points; for "
                      "elastic bodies, not for membranes and point masses. "
                      "`user`: by your own law of pressure and gap. "
                      "`auto`: lagrange; nitsche (penalty in programs of "
                      "your own) with `quadrature point`; interior point for "
                      "membranes on fine meshes without nested iteration.");
    declare_user_law(prm);
    declare_user_friction(prm);
    declare_discretisation(prm);
    declare_penalty(prm, defaults);
    declare_barrier(prm, defaults);
    declare_stopping(prm, defaults);
    prm.declare_entry(
        "Sliding", "auto", Patterns::Selection("auto|small|step|large"),
        "Where contact is looked at. `small`: on the undeformed "
        "bodies; gaps are linear in the displacement, but for "
        "mortar between bodies of large strain, whose partners and "
        "weights are those, and gaps and directions those of the present "
        "places. "
        "`step`: "
        "on the bodies where they were at the beginning of the "
        "load or time step. `large`: "
        "where the bodies are; points move, and their gaps, "
        "directions and derivatives of these are made anew at "
        "each linearisation. For nodes and quadrature points, "
        "and for mortar between bodies. `auto`: large for "
        "bodies of large strain where that can be, step for "
        "bodies that move by inertia, else small.");
    prm.declare_entry("Turning terms", "true", Patterns::Bool(),
                      "Whether the tangent has what forces and gaps of points "
                      "that move change by because directions and partners "
                      "do. Without, Newton's method is of first order, or "
                      "finds no way: there to see that (doc/failures.md).");
    prm.declare_entry("System", "auto",
                      Patterns::Selection("auto|condensed|saddle point"),
                      "Linear system: `condensed` eliminates the pressures "
                      "row by row, `saddle point` keeps them as unknowns, "
                      "`auto` chooses and says which.");
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
    kinematics = kinematics_of(prm.get("Sliding"));
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
    multiplier_degree = prm.get_integer("Multiplier degree");
    quadrature_degree = prm.get_integer("Quadrature degree");
    segments = prm.get_bool("Segments");
    turning_terms = prm.get_bool("Turning terms");
    prm.leave_subsection();
    AssertThrow(system != System::saddle_point
                    || abut_law_is_exact(options.law),
                dealii::ExcMessage(
                    std::string("Method/System = saddle point goes with "
                                "Method/Enforcement = lagrange: with '")
                    + options.law->name
                    + "' each pressure follows from its gap, and unknowns of "
                      "its own would only enlarge the system. Use auto or "
                      "condensed."));
    AssertThrow(options.barrier_end <= options.barrier_start,
                dealii::ExcMessage("Method/Barrier end is larger than "
                                   "Method/Barrier start."));
  }
} // namespace abut

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include "app/input/input_error.h"
#include "app/scenes/automatic_law.h"
#include "app/scenes/contact_scene.h"
#include "solid_effects.h"
#include "solid_model.h"
#include "solid_pairs.h"

#include <abut/coupling.h>

#include <algorithm>

namespace abut::app
{
  namespace
  {
    struct CubeParameter
    {
      const char *path, *reason;
    };

    /** Parameters that have no effect on triangles and tetrahedra. */
    constexpr CubeParameter of_cubes[] = {
        {"Refinement/Nested iteration",
         "all their levels are created at once."},
        {"Refinement/Coarsest level",
         "there is no nested iteration, all their levels are created at once."},
        {"Refinement/Coarsen fraction", "they cannot be coarsened."}};

    /** Whether points can move in this way in all pairs that may slide.
     * @param tri6 [pairs] whether secondary facets are quadratic triangles */
    bool can_move(const abut_kinematics kinematics,
                  const MethodParameters &method,
                  const std::vector<PairParameters> &pairs,
                  const std::vector<bool> &tri6)
    {
      std::size_t number = 0;
      return std::all_of(
          pairs.begin(), pairs.end(),
          [&](const PairParameters &pair)
          {
            const bool has_tri6 = tri6[number++];
            // Between bodies a uniform pressure is worth more, unless asked
            // for.
            const abut_discretisation discretisation =
                method.discretisation.value_or(
                    has_tri6            ? ABUT_DISCRETISATION_MORTAR
                    : pair.obstacle > 0 ? ABUT_DISCRETISATION_NODE_TO_SEGMENT
                                        : ABUT_DISCRETISATION_DUAL_MORTAR);
            return pair.tied
                   || kinematics_refusal(kinematics, *method.options.law,
                                         discretisation,
                                         {pair.obstacle > 0, pair.mesh_gap})
                          .empty();
          });
    }

    /** The kinematics that suit bodies, the better ones first, where the
     * parameter file says @p given; the last one is always possible. */
    std::vector<abut_kinematics>
    suitable(const std::optional<abut_kinematics> given,
             const bool has_large_strain, const bool in_time)
    {
      std::vector<abut_kinematics> result;
      if (!given && has_large_strain)
        result.push_back(ABUT_KINEMATICS_CURRENT);
      if (!given && in_time)
        result.push_back(ABUT_KINEMATICS_UPDATED);
      if (has_large_strain
          && kinematics_info(given).directions == ABUT_CONFIGURATION_REFERENCE)
        result.push_back(ABUT_KINEMATICS_COROTATIONAL);
      result.push_back(given.value_or(ABUT_KINEMATICS_REFERENCE));
      return result;
    }

    template <int dim> class SolidScene : public ContactScene<dim>
    {
    public:
      void count(const ParameterFile &file) override
      {
        counts = SolidCounts::read(file);
        for (const CubeParameter &each : of_cubes)
          if (!file.get(each.path, "").empty())
            given_of_cubes.push_back(each);
        const std::string degree = file.get("Method/Multiplier degree", "");
        has_quadratic_multipliers = degree == "auto" || degree == "0";
      }

    private:
      void declare_model(dealii::ParameterHandler &prm) const override
      {
        SolidParameters::declare(prm, counts);
      }

      void parse_model(dealii::ParameterHandler &prm) override
      {
        parameters.parse(prm, counts);
        search.parse_parameters(prm);
        choose_law_of_bodies(
            this->method,
            std::any_of(parameters.pairs.begin(), parameters.pairs.end(),
                        [](const auto &pair) { return pair.tied; }),
            parameters.has_large_strain());
        if (parameters.has_large_strain()
            && abut_law_needs_stress(this->method.options.law))
          throw InputError("Method/Enforcement",
                           "nitsche needs a stress that is linear in the "
                           "displacement, and Body 1/Material is at finite "
                           "strain: use lagrange or augmented lagrangian.");
        this->method.solve_known_failures = parameters.solve_known_failures;
        given_kinematics = this->method.kinematics;
        choose_kinematics(std::vector<bool>(parameters.pairs.size(), false));
      }

      /** @param tri6 as of can_move() */
      void choose_kinematics(const std::vector<bool> &tri6)
      {
        const std::vector<abut_kinematics> possible =
            suitable(given_kinematics, parameters.has_large_strain(),
                     parameters.time.is_on);
        this->method.kinematics = *std::find_if(
            possible.begin(), possible.end() - 1,
            [&](const abut_kinematics each)
            { return can_move(each, this->method, parameters.pairs, tri6); });
      }

      void prepare(const RunOptions &options) override
      {
        meshes = create_body_meshes<dim>(parameters.bodies, options);
        if (!meshes.has_simplices())
          return;
        for (const CubeParameter &each : given_of_cubes)
          if (!parameters.refinement.has_target()
              || std::string(each.path) != "Refinement/Coarsest level")
            throw InputError(each.path,
                             "has no effect on triangles and tetrahedra: "
                                 + std::string(each.reason));
        std::vector<bool> of_simplices;
        for (std::size_t body = 0; body < meshes.meshes.size(); ++body)
          of_simplices.push_back(meshes.are_simplices(body));
        parameters.begin_simplices(dim, of_simplices);
        if (parameters.simplex_degree == 1)
          meshes.straighten("Solid/Degree = 1");
        check_refinement();
        std::vector<bool> tri6;
        for (const PairParameters &pair : parameters.pairs)
          tri6.push_back(
              dim == 3 && parameters.simplex_degree == 2
              && meshes.may_have_simplices(pair.secondary, parameters.bodies));
        if (has_quadratic_multipliers && !tri6.empty()
            && std::count(tri6.begin(), tri6.end(), false) == 0)
          throw InputError("Method/Multiplier degree",
                           "auto is degree 2 here, and the shape functions of "
                           "quadratic triangles have no weight at the corners: "
                           "leave it out for degree 1.");
        const char *why = nullptr;
        if (std::count(tri6.begin(), tri6.end(), true) > 0
            && this->method.discretisation
            && abut_coupling_check(*this->method.discretisation, 1,
                                   ABUT_FACET_TRI6, &why)
                   != ABUT_SUCCESS
            && abut_coupling_check(*this->method.discretisation, 0,
                                   ABUT_FACET_TRI6, &why)
                   != ABUT_SUCCESS)
          throw InputError("Method/Discretisation",
                           std::string(why)
                               + ": Method/Discretisation = auto.");
        choose_kinematics(tri6);
      }

      /** Of meshes with triangles or tetrahedra. */
      void check_refinement() const
      {
        const RefinementParameters &refinement = parameters.refinement;
        const auto refuse =
            [&](const std::string &why, const std::string &other)
        {
          throw InputError(refinement.has_target()
                               ? "Refinement/Target error"
                               : "Refinement/Adaptive cycles",
                           why
                               + ": set it to 0, and refine by "
                                 "Refinement/Level or Body N/Refinements, or "
                               + other);
        };
        if (!refinement.has_target() && refinement.adaptive_cycles == 0)
          return;
        if (meshes.middles)
          refuse("meshes with curved edges are refined in all cells only",
                 "write the file with straight edges.");
        if (meshes.has_cubes())
          refuse(std::string("bodies of ")
                     + (dim == 2 ? "triangles together with quadrilaterals"
                                 : "tetrahedra together with hexahedra")
                     + " are refined in all cells only",
                 "mesh all bodies with the same kind of cells.");
      }

      std::vector<EffectRule> effects() const override
      {
        return solid_effects();
      }

      ContactRunSettings settings() const override
      {
        return {parameters.refinement, this->method,
                this->solver,          parameters.load_steps,
                parameters.all_levels, parameters.field_steps.every,
                parameters.extrapolate};
      }

      std::unique_ptr<ContactModel<dim>>
      create_model(ContactRunState<dim> &state) override
      {
        return std::make_unique<SolidModel<dim>>(parameters, state, search,
                                                 std::move(meshes));
      }

    protected:
      SolidCounts counts;
      SolidParameters parameters;
      SearchParameters search;
      std::optional<abut_kinematics> given_kinematics;
      std::vector<CubeParameter> given_of_cubes;
      bool has_quadratic_multipliers = false; ///< given by the file
      BodyMeshes<dim> meshes;
    };
  } // namespace

  std::unique_ptr<Scene> create_solid_scene(const unsigned int dimension)
  {
    if (dimension == 3)
      return std::make_unique<SolidScene<3>>();
    return std::make_unique<SolidScene<2>>();
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "search_scene.h"

#include <abut/dealii/parameter_entry.h>

#include "app/input/input_error.h"
#include "app/scenes/method_effects.h"
#include "search_run.h"

namespace abut::app
{
  namespace
  {
    EffectRules search_effects()
    {
      const auto has_primary = [](const SceneValues &values)
      { return !values.is_true("Search/Self contact"); };
      const auto has_sweep = [](const SceneValues &values)
      { return !values("Sweep/Bucket sizes").empty(); };
      const std::string no_sweep = "Sweep/Bucket sizes is empty.";
      return joined(
          {{effective_if("Primary/*", Weight::setting, has_primary,
                         "with Search/Self contact the secondary surface "
                         "touches itself."),
            effective_if("Sweep/Repeats", Weight::setting, has_sweep, no_sweep),
            effective_if("Sweep/Maximum tests", Weight::setting, has_sweep,
                         no_sweep)},
           bucket_effects(),
           mesh_effects("Secondary"),
           mesh_effects("Primary")});
    }

    template <int dim> class SearchScene : public Scene
    {
    public:
      void declare(dealii::ParameterHandler &prm) const override
      {
        SearchSceneParameters::declare(prm);
      }

      void parse(dealii::ParameterHandler &prm) override
      {
        parameters.parse(prm);
      }

      std::vector<EffectRule> effects() const override
      {
        return search_effects();
      }

      void check(const RunOptions &options, Report &report) override
      {
        SearchRun(parameters, options, report).check<dim>();
      }

      Outcome run(const RunOptions &options, Report &report) override
      {
        SearchRun(parameters, options, report).run<dim>();
        return Outcome::converged;
      }

    private:
      SearchSceneParameters parameters;
    };
  } // namespace

  void SearchSceneParameters::declare(dealii::ParameterHandler &prm)
  {
    for (const char *section : {"Secondary", "Primary"})
    {
      prm.enter_subsection(section);
      SurfaceParameters::declare(prm);
      prm.leave_subsection();
    }
    SearchParameters::declare_parameters(prm);
    SweepParameters::declare(prm);
    prm.enter_subsection("Output");
    parameter::declare(
        prm, "Fields", "true", dealii::Patterns::Bool(), parameter::basic(),
        "Whether both surfaces are written as VTU files for ParaView, the "
        "secondary one with gap, distance, status (0 not paired, 1 paired, 2 "
        "overlapping) and number of the facet.");
    prm.leave_subsection();
  }

  void SearchSceneParameters::parse(dealii::ParameterHandler &prm)
  {
    const auto surface = [&prm](const char *section, SurfaceParameters &side)
    {
      prm.enter_subsection(section);
      side.parse(prm, section);
      prm.leave_subsection();
    };
    surface("Secondary", secondary);
    surface("Primary", primary);
    search.parse_parameters(prm);
    sweep.parse(prm);
    prm.enter_subsection("Output");
    fields = prm.get_bool("Fields");
    prm.leave_subsection();
  }

  std::unique_ptr<Scene> create_search_scene(const unsigned int dimension)
  {
    if (dimension == 2)
      return std::make_unique<SearchScene<2>>();
    return std::make_unique<SearchScene<3>>();
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include "app/scenes/automatic_law.h"
#include "app/scenes/contact_run.h"
#include "solid_model.h"

#include <algorithm>

namespace abut::app
{
  namespace
  {
    template <int dim> class SolidScene : public Scene
    {
    public:
      void count(const ParameterFile &file) override
      {
        counts = SolidCounts::read(file);
      }

      void declare(dealii::ParameterHandler &prm) const override
      {
        SolidParameters::declare(prm, counts);
        CheckpointParameters::declare(prm);
        ContactAssembler<dim>::declare_parameters(prm);
      }

      void parse(dealii::ParameterHandler &prm) override
      {
        parameters.parse(prm, counts);
        checkpoint.parse(prm);
        method.parse_parameters(prm);
        solver.parse_parameters(prm);
        search.parse_parameters(prm);
        choose_law_of_bodies(method, std::any_of(parameters.pairs.begin(),
                                                 parameters.pairs.end(),
                                                 [](const auto &pair)
                                                 { return pair.tied; }));
      }

      const CheckpointParameters *checkpoints() const override
      {
        return &checkpoint;
      }

      void check(const RunOptions &options, Report &report) override
      {
        with_run(options, report, [](auto &run) { run.check(); });
      }

      Outcome run(const RunOptions &options, Report &report) override
      {
        Outcome outcome = Outcome::unusable;
        with_run(options, report, [&](auto &run) { outcome = run.run(); });
        return outcome;
      }

    private:
      template <typename Action>
      void with_run(const RunOptions &options, Report &report,
                    const Action &action)
      {
        ContactRunState<dim> state({parameters.refinement, method, solver,
                                    parameters.load_steps,
                                    parameters.all_levels},
                                   options, report);
        SolidModel<dim> model(parameters, state, search);
        ContactRun<dim> run(state, model);
        action(run);
      }

      SolidCounts counts;
      SolidParameters parameters;
      CheckpointParameters checkpoint;
      MethodParameters method;
      SolverParameters solver;
      SearchParameters search;
    };
  } // namespace

  std::unique_ptr<Scene> create_solid_scene(const unsigned int dimension)
  {
    if (dimension == 3)
      return std::make_unique<SolidScene<3>>();
    return std::make_unique<SolidScene<2>>();
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_scene.h"

#include "app/scenes/common_parameters.h"
#include "app/scenes/contact_run.h"
#include "membrane_model.h"

namespace abut::app
{
  namespace
  {
    template <int dim> class ObstacleScene : public Scene
    {
    public:
      void declare(dealii::ParameterHandler &prm) const override
      {
        ObstacleParameters::declare(prm);
        CheckpointParameters::declare(prm);
        ContactAssembler<dim>::declare_parameters(prm);
      }

      void parse(dealii::ParameterHandler &prm) override
      {
        parameters.parse(prm);
        checkpoint.parse(prm);
        method.parse_parameters(prm);
        require_law_without_stress(method);
        solver.parse_parameters(prm);
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
        LoadStepOptions one_step;
        one_step.cut_back = false;
        ContactRunState<dim> state({parameters.refinement, method, solver,
                                    one_step, parameters.all_levels},
                                   options, report);
        MembraneModel<dim> model(parameters, state);
        ContactRun<dim> run(state, model);
        action(run);
      }

      ObstacleParameters parameters;
      CheckpointParameters checkpoint;
      MethodParameters method;
      SolverParameters solver;
    };
  } // namespace

  std::unique_ptr<Scene> create_obstacle_scene(const unsigned int dimension)
  {
    if (dimension == 3)
      return std::make_unique<ObstacleScene<3>>();
    return std::make_unique<ObstacleScene<2>>();
  }
} // namespace abut::app

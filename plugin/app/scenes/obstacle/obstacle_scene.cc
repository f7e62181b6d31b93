// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_scene.h"

#include "app/scenes/common_parameters.h"
#include "obstacle_run.h"

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
        ContactAssembler<dim>::declare_parameters(prm);
      }

      void parse(dealii::ParameterHandler &prm) override
      {
        parameters.parse(prm);
        method.parse_parameters(prm);
        require_law_without_stress(method);
        solver.parse_parameters(prm);
      }

      void check(const RunOptions &options, Report &report) override
      {
        ObstacleRun<dim>(parameters, method, solver, options, report).check();
      }

      Outcome run(const RunOptions &options, Report &report) override
      {
        return ObstacleRun<dim>(parameters, method, solver, options, report)
            .run();
      }

    private:
      ObstacleParameters parameters;
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

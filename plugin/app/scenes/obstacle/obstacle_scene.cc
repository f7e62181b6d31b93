// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_scene.h"

#include "app/scenes/common_parameters.h"
#include "app/scenes/contact_scene.h"
#include "membrane_effects.h"
#include "membrane_model.h"

namespace abut::app
{
  namespace
  {
    template <int dim> class ObstacleScene : public ContactScene<dim>
    {
      void declare_model(dealii::ParameterHandler &prm) const override
      {
        ObstacleParameters::declare(prm);
      }

      void parse_model(dealii::ParameterHandler &prm) override
      {
        parameters.parse(prm);
        require_law_without_stress(this->method);
      }

      std::vector<EffectRule> effects() const override
      {
        return membrane_effects();
      }

      ContactRunSettings settings() const override
      {
        return {parameters.refinement,
                this->method,
                this->solver,
                parameters.load_steps,
                parameters.all_levels,
                parameters.field_steps.every,
                false};
      }

      std::unique_ptr<ContactModel<dim>>
      create_model(ContactRunState<dim> &state) override
      {
        return std::make_unique<MembraneModel<dim>>(parameters, state);
      }

      ObstacleParameters parameters;
    };
  } // namespace

  std::unique_ptr<Scene> create_obstacle_scene(const unsigned int dimension)
  {
    if (dimension == 3)
      return std::make_unique<ObstacleScene<3>>();
    return std::make_unique<ObstacleScene<2>>();
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <abut/dealii/registry.h>

#include "user_law.h"

namespace abut
{
  namespace
  {
    /** This copy of Abut. */
    template <int dim> class Library : public ContactLibrary<dim>
    {
    public:
      std::vector<std::string> methods() const override
      {
        std::vector<std::string> names;
        for (std::int32_t i = 0; abut_law_get(i) != nullptr; ++i)
          names.emplace_back(abut_law_get(i)->name);
        names.emplace_back(shim::user_law_word);
        return names;
      }

      void declare_parameters(dealii::ParameterHandler &prm) const override
      {
        ContactAssembler<dim>::declare_parameters(prm);
      }

      std::unique_ptr<ContactAssembler<dim>>
      create(const MPI_Comm communicator) const override
      {
        return std::make_unique<ContactAssembler<dim>>(communicator);
      }

      std::shared_ptr<RigidObstacle<dim>>
      make_obstacle(const abut_obstacle_shape &shape) const override
      {
        return std::make_shared<RigidObstacle<dim>>(shape);
      }

      std::shared_ptr<RigidObstacle<dim>>
      make_obstacle(const HeightObstacle<dim> &height) const override
      {
        return std::make_shared<RigidObstacle<dim>>(height);
      }

      std::shared_ptr<RigidObstacle<dim>>
      make_obstacle(std::shared_ptr<dealii::Function<dim>> value,
                    const bool hollow) const override
      {
        return std::make_shared<RigidObstacle<dim>>(std::move(value), hollow);
      }

      std::shared_ptr<RigidObstacle<dim>>
      make_obstacle(const abut_surface_data &surface,
                    const abut_obstacle_surface &options) const override
      {
        return std::make_shared<RigidObstacle<dim>>(surface, options);
      }
    };
  } // namespace

  template <int dim> void register_all(Registry<dim> &registry)
  {
    registry.add(std::make_shared<Library<dim>>());
  }

  template void register_all(Registry<2> &);
  template void register_all(Registry<3> &);
} // namespace abut

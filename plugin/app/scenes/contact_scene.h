// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_SCENE_H
#define ABUT_APP_CONTACT_SCENE_H

#include "app/restart/checkpoint_parameters.h"
#include "contact_run.h"
#include "scene.h"

#include <memory>

namespace abut::app
{
  /** A kind of scene that a ContactRun solves: what kinds share of their
   * parameters, and the run itself. A kind adds its own parameters and makes
   * the model. */
  template <int dim> class ContactScene : public Scene
  {
  public:
    void declare(dealii::ParameterHandler &prm) const override
    {
      declare_model(prm);
      CheckpointParameters::declare(prm);
      ContactAssembler<dim>::declare_parameters(prm);
    }

    void parse(dealii::ParameterHandler &prm) override
    {
      checkpoint.parse(prm);
      method.parse_parameters(prm);
      solver.parse_parameters(prm);
      parse_model(prm);
    }

    const CheckpointParameters *checkpoints() const override
    {
      return &checkpoint;
    }

    void check(const RunOptions &options, Report &report) override
    {
      prepare(options);
      ContactRunState<dim> state(settings(), options, report);
      const auto model = create_model(state);
      ContactRun<dim>(state, *model).check();
    }

    Outcome run(const RunOptions &options, Report &report) override
    {
      prepare(options);
      ContactRunState<dim> state(settings(), options, report);
      const auto model = create_model(state);
      return ContactRun<dim>(state, *model).run();
    }

  protected:
    virtual void declare_model(dealii::ParameterHandler &prm) const = 0;
    /** After the shared ones, which it may change or refuse. */
    virtual void parse_model(dealii::ParameterHandler &prm) = 0;
    /** Read what parameters depend on, before settings(). Throws InputError on
     * all ranks alike. Collective. */
    virtual void prepare(const RunOptions &)
    {
    }
    virtual ContactRunSettings settings() const = 0;
    virtual std::unique_ptr<ContactModel<dim>>
    create_model(ContactRunState<dim> &state) = 0;

    CheckpointParameters checkpoint;
    MethodParameters method;
    SolverParameters solver;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SCENE_H
#define ABUT_APP_SCENE_H

/** @file
 * Scenes: what the program can run.
 */

#include "app/input/effect_rules.h"
#include "app/input/parameters.h"
#include "app/input/run_options.h"
#include "app/report/report.h"
#include "app/restart/checkpoint_parameters.h"

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <vector>

namespace abut::app
{
  /** How a run ended. */
  enum class Outcome
  {
    converged,
    unusable, /**< exit code 3; the report's warnings say why */
    stopped   /**< exit code 4: asked to, after a checkpoint */
  };

  /** A kind of scene. One object serves one run:
   * declare, parse, then check or run. Constructing one is cheap. */
  class Scene
  {
  public:
    virtual ~Scene() = default;

    /** Take from the file what decides which parameters there are, such as
     * the number of bodies. Called before declare(), and not at all for the
     * reference, which shows one section of each kind. Throws InputError. Not
     * collective. */
    virtual void count(const ParameterFile &)
    {
    }

    /** Declare all parameters of this kind. `Scene`, `Dimension`, `Title` and
     * the section `Output` with `Pictures` are declared by the program (a
     * scene may declare more in `Output`). Not collective. */
    virtual void declare(dealii::ParameterHandler &prm) const = 0;

    /** Read the parameters; throw InputError for what is wrong in itself
     * (an expression, two values that contradict each other). Called inside
     * collective(), so that it must not communicate. */
    virtual void parse(dealii::ParameterHandler &prm) = 0;

    /** When its parameters have an effect; what is set and has none is told or
     * refused. */
    virtual std::vector<EffectRule> effects() const = 0;

    /** How often the run writes checkpoints; null for kinds of scenes that
     * cannot go on from one. After parse(). */
    virtual const CheckpointParameters *checkpoints() const
    {
      return nullptr;
    }

    /** Check what can be found out without solving: files, mesh, data that
     * contradict each other; report sizes. run() must check the same itself.
     * Collective; errors that only some ranks see are agreed by collective().
     */
    virtual void check(const RunOptions &options, Report &report) = 0;

    /** Solve, fill the report, write output files. Collective, errors as
     * above. The program writes the report afterwards, also when the outcome
     * is unusable. */
    virtual Outcome run(const RunOptions &options, Report &report) = 0;
  };

  /** An entry of the list of scenes. */
  struct SceneKind
  {
    const char *name;        /**< word in the file: `set Scene = name` */
    const char *description; /**< one line */
    /** Dimensions in which it exists; the first is the default. */
    std::vector<unsigned int> dimensions;
    std::unique_ptr<Scene> (*create)(unsigned int dimension);
  };

  /** All kinds of scenes. */
  const std::vector<SceneKind> &scene_kinds();
} // namespace abut::app

#endif

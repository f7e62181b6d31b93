// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHAIN_MODEL_H
#define ABUT_APP_CHAIN_MODEL_H

#include "shim/handles.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dense_model.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** Masses in a row above a rigid plane. Each has `dimension` unknowns: the
   * displacements along the plane, then the height. */
  struct Chain
  {
    unsigned int dimension;
    std::size_t n;        /**< masses */
    double spring;        /**< between neighbours, the same in all directions */
    double end_spring;    /**< between the first mass and the driven end */
    double wall_spring;   /**< between the last mass and a wall */
    double normal_spring; /**< of each mass, against its height */
    std::vector<double> gap; /**< [n] height over the plane at rest */

    std::size_t n_unknowns() const
    {
      return n * dimension;
    }
    unsigned int n_tangents() const
    {
      return dimension - 1;
    }

    /** [n_unknowns^2] */
    std::vector<double> stiffness() const;
  };

  /** What acts on a chain at some time. */
  struct ChainLoad
  {
    std::vector<double> force;       /**< [n_unknowns], with the driven end's */
    std::vector<double> coefficient; /**< [n] of friction */
    std::vector<double> cap;         /**< [n] of the traction; empty: none */
  };

  /** Where a chain is after a step. */
  struct ChainState
  {
    std::vector<double> displacement; /**< [n_unknowns] */
    std::vector<double> pressure; /**< [n * dimension] contact force, then the
                                     friction on the mass along the plane */
    std::vector<double> slip;     /**< [n * n_tangents] of this step */
    std::vector<std::uint8_t> state; /**< [n] abut_state */
    double dissipated = 0;           /**< by friction in all steps */
  };

  /** A chain on its way from step to step. */
  class ChainSteps
  {
  public:
    /** @param has_friction without it, only contact is solved for */
    ChainSteps(const Chain &chain, bool has_friction);

    /** Solve for a load, from the last accepted step. Returns why there is no
     * answer, with a code; empty if there is one, which then waits for
     * accept() or reject(). */
    Message solve(const ChainLoad &load, const MethodParameters &method);

    /** The answer is where the next step begins. */
    void accept();

    /** As before solve(). */
    void reject();

    /** The last answer. */
    const ChainState &state() const
    {
      return trial;
    }

    /** Of the last solve(). */
    const abut_progress &progress() const
    {
      return last_progress;
    }

    /** 1/2 u'Ku - f'u of the last answer under @p load. */
    double energy(const ChainLoad &load) const;

  private:
    shim::Handle<abut_points> make_points() const;
    void remember();

    const Chain chain;
    const bool has_friction;
    const std::vector<double> stiffness;
    shim::Handle<abut_context> context;
    shim::Handle<abut_history> history;
    std::vector<std::int64_t> id; /**< of the points' components */
    ChainState trial, committed;
    abut_progress last_progress;
  };
} // namespace abut::app

#endif

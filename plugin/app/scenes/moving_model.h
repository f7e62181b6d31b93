// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MOVING_MODEL_H
#define ABUT_APP_MOVING_MODEL_H

#include "contact_model.h"
#include "model_motion.h"

#include <memory>
#include <utility>
#include <vector>

namespace abut::app
{
  /** A model that may move by inertia: then what a run asks of each step is the
   * matter of its motion. */
  template <int dim> class MovingModel : public ContactModel<dim>
  {
  public:
    /** @p run must outlive it. */
    explicit MovingModel(const ContactRunState<dim> &run,
                         const bool simplices = false)
        : ContactModel<dim>(run.communicator, simplices), run(run)
    {
    }

    bool has_inertia() const override
    {
      return motion != nullptr;
    }
    la::Vector last_place() const override;
    la::Vector first_increment() const override;
    la::Vector start() override;
    bool begin_start(la::Vector &u) override;
    void end_start(la::Vector &u) override;

    bool begin_solve(la::Vector &u) override;
    void residual(const la::Vector &u, la::Vector &result) const override;
    double small_force() const override;
    const la::Matrix &tangent(const la::Vector &u) override;
    bool next_solve(const la::Vector &u) override;
    void end_solve() override;
    Message commit() override;
    bool is_usable() const override;
    double energy(const la::Vector &u) const override;
    void prepare_contact(ContactAssembler<dim> &contact) override;

    std::vector<la::Vector> history() const override;
    unsigned int n_history() const override;
    void resume(std::vector<la::Vector> fields) override;

    const ContactRunState<dim> &run;
    std::unique_ptr<ModelMotion<dim>> motion; ///< or null

  protected:
    /** Displacement and velocity that the motion begins with. Collective. */
    virtual std::pair<la::Vector, la::Vector> initial_motion() const = 0;

    /** What contact does in the problem that has been solved, by side; empty
     * if nothing can touch. Collective. */
    virtual std::vector<ContactAction> contact_actions() const = 0;

    /** Whether any pair has friction. */
    virtual bool has_friction() const
    {
      return false;
    }

    /** Kinetic energy of rigid obstacles at the start. */
    virtual double initial_rigid_energy() const
    {
      return 0.;
    }

    /** The matrix that penalties are measured by. */
    virtual const la::Matrix &reference_stiffness() const = 0;

    /** Tell the assembler of another tangent. */
    void renew_tangent(ContactAssembler<dim> &contact);

    /** What a checkpoint keeps of the motion, as bytes of the archive. */
    std::string motion_state() const;
    void load_motion(const std::string &bytes);

  private:
    /** At prescribed unknowns, at time 0, which is set afterwards. Collective.
     */
    la::Vector velocity_of_supports();
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_COMMITTED_STATE_H
#define ABUT_SHIM_COMMITTED_STATE_H

#include "obstacle_poses.h"
#include "solve/near_null_space.h"

#include <abut/dealii/linear_algebra.h>

#include <optional>

namespace abut::shim
{
  /** The state of the last commit() that slips and updated points refer to, and
   * rigid motions since then before pairs touched. */
  template <int dim> class CommittedState
  {
  public:
    /** Empty: 0, not wanted or not known. */
    const la::Vector &displacement() const
    {
      return displacement_;
    }

    /** Whether the host gave it after load() or reinit(). */
    bool is_given() const
    {
      return is_given_ && displacement_.size() > 0;
    }

    /** Throw if it is not known; @p what needs it. */
    void check(const std::string &what) const;

    /** Record a commit(): the displacement, empty if it is not needed, and the
     * poses of the obstacles of @p pairs. */
    void record(const la::Vector &displacement, bool is_known,
                const std::vector<ContactPair<dim>> &pairs);

    /** Another mesh follows, whose displacement only the host knows. */
    void leave_mesh();

    /** See ContactState::set_slide(). */
    void set_slide(const la::Vector &increment,
                   const std::vector<ContactPair<dim>> &pairs)
    {
      slide_ = increment;
      slide_poses_ = poses_of(pairs);
    }

    /** The displacement recorded is given by the host. */
    void set_given()
    {
      is_given_ = true;
    }

    /** The displacement is that of another run. */
    void lose()
    {
      is_lost_ = true;
    }

    void give_poses(ObstaclePoses<dim> &obstacles) const
    {
      obstacles.set_committed(poses_, times_);
      obstacles.set_slide(slide_poses_);
    }

    /** [pairs] nonzero for those that pressed at the last commit(), whose slips
     * begin there whatever iterates do; no value: not found since. */
    const std::optional<std::vector<std::uint8_t>> &pressed() const
    {
      return pressed_;
    }

    void set_pressed(std::vector<std::uint8_t> pressed)
    {
      pressed_ = std::move(pressed);
    }

    /** Another state has been committed or loaded. */
    void forget_pressed()
    {
      pressed_.reset();
    }

    /** Record what bodies move before pairs touch, which is no slip: [pairs]
     * nonzero for those that are apart and have not pressed(). */
    void add_approach(const std::vector<solve::RigidMotion> &motions,
                      const std::vector<std::uint8_t> &is_apart);

    /** Forget it where @p displacement has not gone that way, as at a new
     * attempt. @p displacement_of makes displacements of motions. Collective.
     */
    template <typename Function>
    void check_approach(const la::Vector &displacement,
                        const Function &displacement_of)
    {
      for (auto &motions : approach_)
        if (!motions.empty())
        {
          const la::Vector way = displacement_of(motions);
          la::Vector moved(displacement);
          if (displacement_.size() > 0)
            moved -= displacement_;
          if (way * moved < 0.5 * (way * way))
            motions.clear();
        }
    }

    /** [pairs] displacements that are no slip (empty: none), or empty: of
     * these motions, less the slide. */
    template <typename Function>
    std::vector<la::Vector> approach(const std::size_t n_pairs,
                                     const Function &displacement_of)
    {
      if (approach_.size() != n_pairs)
        approach_.clear();
      std::vector<la::Vector> result;
      for (const auto &motions : approach_)
        result.push_back(motions.empty() ? la::Vector()
                                         : displacement_of(motions));
      if (slide_.size() == 0)
        return result;
      result.resize(n_pairs);
      for (la::Vector &displacement : result)
      {
        if (displacement.size() == 0)
          displacement.reinit(slide_);
        displacement -= slide_;
      }
      return result;
    }

  private:
    static std::vector<RigidPose<dim>>
    poses_of(const std::vector<ContactPair<dim>> &pairs);

    la::Vector displacement_;
    bool is_lost_ = false;              ///< of another mesh or run
    bool is_given_ = false;             ///< by the host, or by commit()
    std::vector<RigidPose<dim>> poses_; ///< of obstacles; empty: first
    std::vector<double> times_;         ///< of obstacles, likewise
    /** [pairs][bodies] motions before the pair touched; empty: nothing. */
    std::vector<std::vector<solve::RigidMotion>> approach_;
    la::Vector slide_; ///< increment that is slip before it happens; empty: 0
    std::vector<RigidPose<dim>> slide_poses_; ///< likewise, of obstacles
    std::optional<std::vector<std::uint8_t>> pressed_; ///< see pressed()
  };
} // namespace abut::shim

#endif

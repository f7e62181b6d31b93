// SPDX-License-Identifier: LGPL-2.1-or-later
#include "committed_state.h"

namespace abut::shim
{
  template <int dim>
  void CommittedState<dim>::check(const std::string &what) const
  {
    AssertThrow(
        !is_lost_,
        dealii::ExcMessage(
            what
            + " the last commit(), whose displacement is lost after reinit() "
              "or load(). Call set_committed() before detect()."));
  }

  template <int dim>
  void CommittedState<dim>::record(const la::Vector &displacement,
                                   const bool is_known,
                                   const std::vector<ContactPair<dim>> &pairs)
  {
    displacement_ = displacement;
    is_lost_ = !is_known;
    is_given_ = false;
    approach_.clear();
    slide_ = la::Vector();
    slide_poses_.clear();
    poses_ = poses_of(pairs);
    times_.clear();
    for (const ContactPair<dim> &pair : pairs)
      times_.push_back(pair.obstacle == nullptr ? 0. : pair.obstacle->time());
  }

  template <int dim>
  std::vector<RigidPose<dim>>
  CommittedState<dim>::poses_of(const std::vector<ContactPair<dim>> &pairs)
  {
    std::vector<RigidPose<dim>> result;
    for (const ContactPair<dim> &pair : pairs)
      result.push_back(pair.obstacle == nullptr ? RigidPose<dim>()
                                                : pair.obstacle->pose());
    return result;
  }

  template <int dim> void CommittedState<dim>::leave_mesh()
  {
    is_lost_ = is_lost_ || displacement_.size() > 0;
    displacement_ = la::Vector();
  }

  template <int dim>
  void CommittedState<dim>::add_approach(
      const std::vector<solve::RigidMotion> &motions,
      const std::vector<std::uint8_t> &is_apart)
  {
    approach_.resize(is_apart.size());
    for (std::size_t p = 0; p < is_apart.size(); ++p)
    {
      if (is_apart[p] == 0)
        continue;
      approach_[p].resize(motions.size());
      for (std::size_t body = 0; body < motions.size(); ++body)
      {
        approach_[p][body].translation += motions[body].translation;
        approach_[p][body].rotation += motions[body].rotation;
      }
    }
  }

  template class CommittedState<2>;
  template class CommittedState<3>;
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_INTERFACE_H
#define ABUT_SHIM_PAIR_INTERFACE_H

#include "coordinates.h"
#include "pair_set.h"

namespace abut::shim
{
  /** The core's pair number @p number: see abut/interface.h. Its sides stand in
   * the reference configuration. */
  template <int dim>
  Handle<abut_interface>
  make_interface(const PairHost<dim> &host, const SurfacePair<dim> &pair,
                 std::size_t number, abut_discretisation discretisation,
                 abut_kinematics kinematics);

  /** Build the points of a pair. @p dropped: [nodes of the secondary] without a
   * multiplier. Throws on all ranks. Collective. */
  template <int dim>
  void build_points(const PairSet<dim> &set, const SurfacePair<dim> &pair,
                    abut_interface *interface,
                    const std::vector<std::uint8_t> &dropped,
                    abut_interface_target target);

  /** The sides of a pair where the bodies are, until this goes. */
  template <int dim> class DisplacedSides
  {
  public:
    /** Move them to @p positions of the nodes of the whole. */
    DisplacedSides(const PairHost<dim> &host, const SurfacePair<dim> &pair,
                   const std::vector<dealii::Point<dim>> &positions)
        : interface_(pair.interface.get())
    {
      check(host.context,
            abut_interface_move(interface_,
                                static_cast<std::int32_t>(positions.size()),
                                coordinates(positions).data()));
    }

    DisplacedSides(const DisplacedSides &) = delete;
    DisplacedSides &operator=(const DisplacedSides &) = delete;

    ~DisplacedSides()
    {
      abut_interface_move(interface_, 0, nullptr);
    }

  private:
    abut_interface *const interface_;
  };
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "preconditioner_keeper.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace abut::solve
{
  namespace
  {
    /** Part of the entries that may change before a preconditioner is built
     * again, and the factor that counts as a change. */
    constexpr double rebuild_fraction = 0.08;
    constexpr double rebuild_factor = 3.;
  } // namespace

  void PreconditionerKeeper::record_build()
  {
    // How long the last one took to converge stays the measure of patience
    // until this one has been used.
    is_built_ = true;
    is_slow_ = is_kept_ = false;
    speed_when_built_ = 0.;
  }

  void PreconditionerKeeper::record_speed(const double digits,
                                          const unsigned int n_iterations)
  {
    const double speed = digits / std::max(1u, n_iterations);
    if (speed_when_built_ == 0.)
    {
      speed_when_built_ = speed;
      iterations_when_built_ = n_iterations;
    }
    is_slow_ = speed < slow_ * speed_when_built_;
  }

  bool PreconditionerKeeper::is_change(const double ratio, const bool exact)
  {
    const double factor = exact ? 1. : rebuild_factor;
    return ratio > factor || ratio * factor < 1.;
  }

  bool PreconditionerKeeper::are_too_many(const double n_changed,
                                          const double n, const bool exact,
                                          const MPI_Comm communicator)
  {
    double counts[2] = {n_changed, n};
    dealii::Utilities::MPI::sum(counts, communicator, counts);
    return exact ? counts[0] > 0. : counts[0] > rebuild_fraction * counts[1];
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stop_signal.h"

#include <deal.II/base/mpi.h>

#include <csignal>

namespace abut::app
{
  namespace
  {
    constexpr int signals[] = {SIGTERM, SIGINT};
    volatile std::sig_atomic_t is_noted = 0;
    struct sigaction before[2];

    void note(int)
    {
      is_noted = 1;
    }
  } // namespace

  StopSignal::StopSignal()
  {
    is_noted = 0;
    struct sigaction action = {};
    action.sa_handler = note;
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < 2; ++i)
    {
      // Launchers may send SIGTERM more than once; a user who asks again means
      // it.
      action.sa_flags = SA_RESTART;
      if (signals[i] == SIGINT)
        action.sa_flags |= static_cast<int>(SA_RESETHAND);
      sigaction(signals[i], &action, &before[i]);
    }
  }

  StopSignal::~StopSignal()
  {
    for (int i = 0; i < 2; ++i)
      sigaction(signals[i], &before[i], nullptr);
  }

  bool StopSignal::has_come(const MPI_Comm communicator) const
  {
    return dealii::Utilities::MPI::logical_or(is_noted != 0, communicator);
  }
} // namespace abut::app

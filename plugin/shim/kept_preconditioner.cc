// SPDX-License-Identifier: LGPL-2.1-or-later
// The preconditioner of a run that goes on elsewhere: not itself, but what it
// was built for.
#include "agree.h"
#include "contact_implementation.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>

namespace abut
{
  template <int dim>
  void ContactAssembler<dim>::save_preconditioner(std::ostream &stream) const
  {
    const Implementation &i = *implementation;
    std::vector<solve::PreconditionerState> state;
    if (i.solver != nullptr)
      state = i.solver->state();
    boost::archive::binary_oarchive archive(stream);
    archive << i.rows_signature << state;
  }

  template <int dim>
  void ContactAssembler<dim>::load_preconditioner(std::istream &stream)
  {
    Implementation &i = *implementation;
    shim::run_everywhere<HistoryError>(
        i.communicator,
        [&]
        {
          try
          {
            boost::archive::binary_iarchive archive(stream);
            archive >> i.kept_rows >> i.kept_preconditioner;
          }
          catch (const std::exception &error)
          {
            throw HistoryError(std::string("The preconditioner that was saved "
                                           "cannot be read: ")
                               + error.what());
          }
        });
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::restore_preconditioner()
  {
    if (kept_preconditioner.empty())
      return;
    const bool other_rows = kept_rows != rows_signature;
    if (!dealii::Utilities::MPI::logical_or(other_rows, communicator))
      solver->restore(kept_preconditioner);
    kept_preconditioner.clear();
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void ContactAssembler<dim>::save_preconditioner(std::ostream &)     \
      const;                                                                   \
  template void ContactAssembler<dim>::load_preconditioner(std::istream &);    \
  template void ContactAssembler<dim>::Implementation::restore_preconditioner();

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut

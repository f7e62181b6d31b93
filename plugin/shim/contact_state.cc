// SPDX-License-Identifier: LGPL-2.1-or-later
// The state that a solve begins with, on other meshes and in other runs. A
// preconditioner is saved as the data that it was built for.
#include "agree.h"
#include "contact_problem.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>

namespace abut::shim
{
  namespace
  {
    template <int dim> class ProblemState : public ContactState
    {
    public:
      explicit ProblemState(ContactProblem<dim> &problem) : i(problem)
      {
      }

      void set_pressure(const la::VectorView &pressure) override
      {
        i.host.check_mesh("set_pressure()");
        i.start.give_field(
            i.host.vector("set_pressure()", "pressure", pressure));
      }

      void set_committed(const la::VectorView &given) override
      {
        i.host.check_mesh("set_committed()");
        const la::Vector &displacement =
            i.host.vector("set_committed()", "displacement", given);
        if (i.surfaces != nullptr)
          i.surfaces->set().record_commit(displacement);
        i.committed.record(displacement, true, i.input.pairs);
        if (i.rows.are_found)
          i.find_slip_reference();
      }

      void save(std::ostream &stream) override
      {
        i.history.save(stream);
        i.surface_search.elements.save(stream, i.communicator);
        if (i.surfaces != nullptr)
          i.surface_search.exchange->self_contact().save(stream);
        // Who loads has no preconditioner, nor points that were made earlier:
        // then neither should this run.
        i.system.solver.reset();
        if (i.surfaces != nullptr)
          i.surfaces->renew_points();
      }

      void load(std::istream &stream) override
      {
        i.host.check_mesh("load()");
        if (i.source_is_outdated)
          i.create_source();
        const std::uint64_t mesh = i.source->mesh_signature();
        ContactElements elements;
        i.history.load(stream, mesh,
                       [&]
                       {
                         elements.load(stream, i.communicator);
                         if (i.surfaces != nullptr)
                           i.surfaces->load_sides(stream);
                       });
        i.surface_search.elements = std::move(elements);
        // Displacements are the host's to keep: that of the commit() must come
        // from there, or slips would be measured from the reference
        // configuration.
        if (i.committed.displacement().size() == 0
            && i.history.knows(ABUT_HISTORY_COMMITTED, mesh))
          i.committed.lose();
        i.return_to_history();
      }

      void save_preconditioner(std::ostream &stream) const override
      {
        std::vector<solve::PreconditionerState> state;
        if (i.system.solver != nullptr)
          state = i.system.solver->state();
        boost::archive::binary_oarchive archive(stream);
        archive << i.rows.signature << state;
      }

      void load_preconditioner(std::istream &stream) override
      {
        run_everywhere<HistoryError>(
            i.communicator,
            [&]
            {
              try
              {
                boost::archive::binary_iarchive archive(stream);
                archive >> i.system.kept_rows >> i.system.kept_preconditioner;
              }
              catch (const std::exception &error)
              {
                throw HistoryError(std::string("The preconditioner that was "
                                               "saved cannot be read: ")
                                   + error.what());
              }
            });
      }

    private:
      ContactProblem<dim> &i;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContactState> make_state(ContactProblem<dim> &problem)
  {
    return std::make_unique<ProblemState<dim>>(problem);
  }

  template std::unique_ptr<ContactState> make_state(ContactProblem<2> &);
  template std::unique_ptr<ContactState> make_state(ContactProblem<3> &);
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// The state that a solve begins with, on other meshes and in other runs. A
// preconditioner is saved as the data that it was built for.
#include "agree.h"
#include "contact_problem.h"
#include "fnv_hash.h"
#include "saved_words.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>

namespace abut::shim
{
  namespace
  {
    /** Words that identify a pair. */
    enum PairWord
    {
      secondary_ids,
      primary_ids,
      has_obstacle,
      is_tied,
      has_friction,
      n_words
    };

    template <int dim>
    std::vector<std::uint64_t>
    words_of(const std::vector<ContactPair<dim>> &pairs)
    {
      const auto hash_of = [](const auto &ids)
      {
        FnvHash hash;
        for (const auto id : ids)
          hash.mix(id);
        return hash.value;
      };
      std::vector<std::uint64_t> result;
      for (const ContactPair<dim> &pair : pairs)
        for (const std::uint64_t word :
             {hash_of(pair.secondary), hash_of(pair.primary),
              std::uint64_t(pair.obstacle != nullptr), std::uint64_t(pair.tied),
              std::uint64_t(pair.friction != nullptr)})
          result.push_back(word);
      return result;
    }

    /** Throw unless the pairs are those with these words. */
    template <int dim>
    void check_pairs(const std::vector<ContactPair<dim>> &pairs,
                     const std::vector<std::uint64_t> &saved)
    {
      const std::vector<std::uint64_t> here = words_of(pairs);
      if (saved.size() != here.size())
        throw HistoryError("The contact history is of "
                           + std::to_string(saved.size() / n_words)
                           + " pairs, but there are "
                           + std::to_string(pairs.size()) + ".");
      for (std::size_t k = 0; k < here.size(); ++k)
      {
        if (saved[k] == here[k])
          continue;
        static const char *const member[n_words] = {
            "secondary", "primary", "obstacle", "tied", "friction"};
        throw HistoryError("The pair '" + pairs[k / n_words].name
                           + "' is not that of the contact history: its '"
                           + member[k % n_words] + "' differs"
                           + ". Transfer the pressure as a field instead "
                             "(ContactState::set_pressure()).");
      }
    }

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
        i.committed.set_given();
        if (i.rows.are_found)
          i.find_slip_reference();
      }

      void set_slide(const la::VectorView &given) override
      {
        i.host.check_mesh("set_slide()");
        i.committed.set_slide(i.host.vector("set_slide()", "increment", given),
                              i.input.pairs);
        if (i.rows.are_found)
          i.find_slip_reference();
      }

      void save(std::ostream &stream) override
      {
        i.history.save(stream);
        save_words(stream, i.communicator, words_of(i.input.pairs));
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
                         check_pairs(i.input.pairs,
                                     load_words(stream, i.communicator,
                                                "The pairs of the history"));
                         elements.load(stream, i.communicator);
                         if (i.surfaces != nullptr)
                           i.surfaces->load_sides(stream);
                       });
        i.surface_search.elements = std::move(elements);
        i.committed.forget_pressed();
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

// SPDX-License-Identifier: LGPL-2.1-or-later
// From where a run can go on later: after each mesh and each load step. What
// that needs is noted there, and written when a checkpoint is due or, in the
// middle of the next solve, when someone asks the run to stop.
#include "contact_run.h"

#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "app/restart/restart.h"
#include "result_archive.h"

#include <abut/law.h>

#include <sstream>

namespace abut::app
{
  template <int dim>
  template <class Archive>
  void ContactRun<dim>::serialize(Archive &archive, unsigned int)
  {
    std::string law = state.method.options.law->name;
    std::string of_model = model.save_state();
    archive &law &of_model;
    archive &state.control &state.load_steps &state.mesh_number;
    archive &state.results &state.n_searches &state.n_repeated_searches;
    archive &steps &counted_before &light_touches;
    if (!Archive::is_loading::value)
      return;
    // A law that was chosen for the first mesh, or the one of the file.
    if (law != state.method.options.law->name)
      state.method.options.law = abut_law_find(law.c_str());
    state.control.set_law(state.method.options.law);
    model.load_state(of_model);
  }

  template <int dim> void ContactRun<dim>::mark()
  {
    if (state.options.restart == nullptr)
      return;
    marked.run = to_bytes(*this);
    marked.report = to_bytes(report);
    marked_u = state.u;
    marked_pressure = pressure;
    marked.has_contact = resumed || (contact_is_ready && model.has_contact());
    if (!marked.has_contact)
      return;
    if (resumed && state.options.restart->has_same_ranks())
    {
      marked.preconditioner = resumed->preconditioner;
      return;
    }
    std::ostringstream preconditioner(std::ios::binary);
    state.contact.state().save_preconditioner(preconditioner);
    marked.preconditioner = preconditioner.str();
  }

  template <int dim> void ContactRun<dim>::pass()
  {
    if (state.options.restart == nullptr)
      return;
    mark();
    const bool is_due = state.options.restart->is_due();
    const bool stops = state.options.restart->must_stop();
    if (is_due || stops)
      write_checkpoint();
    if (stops)
      throw Stopped();
  }

  template <int dim> void ContactRun<dim>::stop_if_asked()
  {
    Restart *restart = state.options.restart;
    if (restart == nullptr || !restart->must_stop())
      return;
    write_checkpoint();
    throw Stopped();
  }

  template <int dim> void ContactRun<dim>::write_checkpoint()
  {
    SectionTimes::Scope scope(report.times, "checkpoint");
    std::vector<la::Vector> fields = {marked_u};
    marked.has_pressure = marked_pressure != nullptr;
    if (marked.has_pressure)
      fields.push_back(*marked_pressure);
    marked.has_start = state.control.start().size() > 0;
    if (marked.has_start)
      fields.push_back(state.control.start());
    // Not changed since the mark.
    marked.has_increment = last_step.has_value();
    if (last_step)
    {
      fields.push_back(last_step->increment);
      marked.length = last_step->length;
      marked.linearisations = last_step->linearisations;
    }
    for (la::Vector &field : model.history())
      fields.push_back(std::move(field));
    std::ostringstream contact(std::ios::binary);
    if (marked.has_contact)
    {
      state.contact.state().save(contact);
      load_preconditioner(marked);
    }
    marked.contact = contact.str();
    const auto save = [&](const std::filesystem::path &folder)
    {
      marked.mesh = save_mesh<dim>(folder, model.triangulation, mesh_history,
                                   model.problem().dof_handler, fields);
      return to_bytes(marked);
    };
    state.options.restart->write(save);
    marked.mesh = MeshPart();
    report.detail("checkpoint written");
  }

  template <int dim> void ContactRun<dim>::restore()
  {
    const Restart &restart = *state.options.restart;
    Checkpoint saved;
    collective(state.communicator,
               [&]
               {
                 from_bytes(restart.bytes(), saved);
                 from_bytes(saved.run, *this);
                 model.create_functions();
               });
    {
      SectionTimes::Scope scope(report.times, "mesh");
      model.create_mesh();
    }
    const auto setup = [this]
    {
      collective(state.communicator, [this] { model.set_data(); });
      model.set_time(state.load_steps.target());
      setup_mesh();
    };
    std::vector<la::Vector> fields = load_mesh<dim>(
        restart.source(), restart.has_same_ranks() ? &saved.mesh : nullptr,
        1u + saved.has_pressure + saved.has_start + saved.has_increment
            + model.n_history(),
        model.triangulation, mesh_history, model.problem().dof_handler, setup);
    model.check_setup();
    state.u = fields.front();
    const std::size_t n_history = model.n_history();
    model.resume({fields.end() - n_history, fields.end()});
    fields.resize(fields.size() - n_history);
    if (saved.has_increment)
    {
      last_step = {std::move(fields.back()), saved.length,
                   saved.linearisations};
      fields.pop_back();
    }
    if (saved.has_start)
      state.control.restore_start(fields.back());
    if (saved.has_pressure)
      pressure = std::make_shared<const la::Vector>(fields[1]);
    from_bytes(saved.report, report);
    if (saved.has_contact)
      resumed = std::move(saved);
    report.print("resumed from " + restart.source().string());
  }

  template <int dim> void ContactRun<dim>::load_contact()
  {
    std::istringstream stream(resumed->contact, std::ios::binary);
    state.contact.state().load(stream);
    // A step of a motion has taken the displacement on its way. Without one
    // nothing has moved before the first step.
    la::Vector committed(model.has_inertia() ? model.last_place() : marked_u);
    if (state.load_steps.n_accepted() == 0 && !model.has_inertia())
      committed = 0.;
    model.set_contact(state.contact, state.load_steps.time());
    state.contact.state().set_committed(committed);
    model.set_contact(state.contact, state.present.time);
    if (state.options.restart->has_same_ranks())
      load_preconditioner(*resumed);
    resumed.reset();
  }

  template <int dim>
  void ContactRun<dim>::load_preconditioner(const Checkpoint &from)
  {
    std::istringstream stream(from.preconditioner, std::ios::binary);
    state.contact.state().load_preconditioner(stream);
  }

  template void ContactRun<2>::mark();
  template void ContactRun<2>::pass();
  template void ContactRun<2>::stop_if_asked();
  template void ContactRun<2>::restore();
  template void ContactRun<2>::load_contact();
  template void ContactRun<3>::mark();
  template void ContactRun<3>::pass();
  template void ContactRun<3>::stop_if_asked();
  template void ContactRun<3>::restore();
  template void ContactRun<3>::load_contact();
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "saved_mesh.h"

#include "app/input/collective.h"
#include "disk.h"
#include "values_along_mesh.h"

#include <abut/dealii/versions.h>

#include <deal.II/dofs/dof_tools.h>

#include <cstdlib>

namespace abut::app
{
  namespace
  {
    template <int dim>
    using Transfer = versions::SolutionTransfer<dim, la::Vector>;

    template <int dim>
    using SavedByP4est = dealii::parallel::distributed::Triangulation<dim>;

    const char *const mesh_name = "mesh";

    /** Open MPI guards a pointer into files that ranks share, which nobody uses
     * here, by a semaphore with the name of the file: that of a run that was
     * killed while it wrote a checkpoint lets all later ones wait for ever. The
     * variable is read when the first file is opened. */
    void leave_out_shared_pointers()
    {
      setenv("OMPI_MCA_sharedfp", "^sm", 0);
    }

    template <int dim>
    std::vector<la::Vector>
    empty_fields(const unsigned int n,
                 const dealii::DoFHandler<dim> &dof_handler)
    {
      return std::vector<la::Vector>(
          n, la::Vector(dof_handler.locally_owned_dofs(),
                        versions::communicator(dof_handler)));
    }

    template <int dim>
    std::vector<la::Vector>
    with_ghosts(const std::vector<la::Vector> &fields,
                const dealii::DoFHandler<dim> &dof_handler)
    {
      const dealii::IndexSet relevant =
          dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
      std::vector<la::Vector> result;
      for (const la::Vector &field : fields)
      {
        result.emplace_back(dof_handler.locally_owned_dofs(), relevant,
                            versions::communicator(dof_handler));
        result.back() = field;
      }
      return result;
    }

    template <int dim>
    void save_along_mesh(const std::filesystem::path &file,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const std::vector<la::Vector> &fields)
    {
      std::vector<std::vector<double>> values;
      for (const la::Vector &field : fields)
        values.push_back(values_along_mesh(dof_handler, field));
      const MPI_Comm communicator = versions::communicator(dof_handler);
      on_root(communicator, [&] { write_file(file, to_bytes(values)); });
    }

    template <int dim>
    std::vector<la::Vector>
    load_along_mesh(const std::filesystem::path &file,
                    const unsigned int n_fields,
                    const dealii::DoFHandler<dim> &dof_handler)
    {
      std::vector<std::vector<double>> values;
      collective(versions::communicator(dof_handler),
                 [&] { from_bytes(read_from_disk(file), values); });
      std::vector<la::Vector> fields = empty_fields(n_fields, dof_handler);
      for (unsigned int i = 0; i < n_fields; ++i)
        set_values_along_mesh(dof_handler, values.at(i), fields[i]);
      return fields;
    }

    /** p4est ends the program where it cannot write: more bytes than it takes
     * for a cell with its fields must be there. Collective. */
    template <int dim>
    void require_room_for(const std::filesystem::path &folder,
                          const typename MeshHistory<dim>::Mesh &mesh,
                          const dealii::DoFHandler<dim> &dof_handler,
                          const std::size_t n_fields)
    {
      const MPI_Comm communicator = versions::communicator(mesh);
      const std::size_t per_cell =
          128
          + n_fields * 8 * dof_handler.get_fe_collection().max_dofs_per_cell();
      on_root(communicator,
              [&] {
                require_room(folder,
                             65536 + per_cell * mesh.n_global_active_cells());
              });
    }
  } // namespace

  template <int dim>
  MeshPart save_mesh(const std::filesystem::path &folder,
                     typename MeshHistory<dim>::Mesh &mesh,
                     const MeshHistory<dim> &history,
                     const dealii::DoFHandler<dim> &dof_handler,
                     const std::vector<la::Vector> &fields)
  {
    auto *const saved = dynamic_cast<SavedByP4est<dim> *>(&mesh);
    if (saved == nullptr)
      save_along_mesh(folder / mesh_name, dof_handler, fields);
    else
    {
      const std::vector<la::Vector> ghosted = with_ghosts(fields, dof_handler);
      std::vector<const la::Vector *> pointers;
      for (const la::Vector &field : ghosted)
        pointers.push_back(&field);
      Transfer<dim> transfer(dof_handler);
      if (!pointers.empty())
        transfer.prepare_for_serialization(pointers);
      require_room_for<dim>(folder, mesh, dof_handler, fields.size());
      leave_out_shared_pointers();
      saved->save((folder / mesh_name).string());
    }

    MeshPart part{history.is_known(), history.steps(), {}};
    for (const la::Vector &field : fields)
      part.fields.push_back(owned_values(field));
    return part;
  }

  template <int dim>
  std::vector<la::Vector>
  load_mesh(const std::filesystem::path &folder, const MeshPart *part,
            const unsigned int n_fields, typename MeshHistory<dim>::Mesh &mesh,
            MeshHistory<dim> &history,
            const dealii::DoFHandler<dim> &dof_handler,
            const std::function<void()> &setup)
  {
    if (part != nullptr && part->is_known)
    {
      history.replay(part->steps);
      setup();
      std::vector<la::Vector> fields = empty_fields(n_fields, dof_handler);
      for (unsigned int i = 0; i < n_fields; ++i)
        set_owned_values(part->fields.at(i), fields[i]);
      return fields;
    }
    auto *const saved = dynamic_cast<SavedByP4est<dim> *>(&mesh);
    if (saved == nullptr)
    {
      setup();
      return load_along_mesh(folder / mesh_name, n_fields, dof_handler);
    }
    history.forget();
    leave_out_shared_pointers();
    saved->load((folder / mesh_name).string());
    setup();
    std::vector<la::Vector> fields = empty_fields(n_fields, dof_handler);
    std::vector<la::Vector *> pointers;
    for (la::Vector &field : fields)
      pointers.push_back(&field);
    Transfer<dim> transfer(dof_handler);
    if (!pointers.empty())
      transfer.deserialize(pointers);
    return fields;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template MeshPart save_mesh<dim>(                                            \
      const std::filesystem::path &, MeshHistory<dim>::Mesh &,                 \
      const MeshHistory<dim> &, const dealii::DoFHandler<dim> &,               \
      const std::vector<la::Vector> &);                                        \
  template std::vector<la::Vector> load_mesh<dim>(                             \
      const std::filesystem::path &, const MeshPart *, unsigned int,           \
      MeshHistory<dim>::Mesh &, MeshHistory<dim> &,                            \
      const dealii::DoFHandler<dim> &, const std::function<void()> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "saved_mesh.h"

#include "app/input/collective.h"
#include "disk.h"

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

    /** Call @p visit with each unknown that a cell of this rank has and its
     * number along the mesh: by vertices and edges, of which all ranks have
     * all. For elements with nodes nowhere else. */
    template <int dim, class Visit>
    void for_each_unknown(const dealii::DoFHandler<dim> &dof_handler,
                          const Visit &visit)
    {
      const auto &fe = dof_handler.get_fe();
      const std::size_t n_components = fe.n_components(),
                        n_vertices =
                            dof_handler.get_triangulation().n_vertices();
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        for (std::size_t c = 0; c < n_components; ++c)
        {
          for (const unsigned int v : cell->vertex_indices())
            visit(cell->vertex_dof_index(v, c),
                  cell->vertex_index(v) * n_components + c);
          if (fe.n_dofs_per_line() > 0)
            for (unsigned int l = 0; l < cell->n_lines(); ++l)
              visit(cell->line(l)->dof_index(c),
                    (n_vertices + cell->line(l)->index()) * n_components + c);
        }
      }
    }

    /** Values of a field by number along the mesh. Collective. */
    template <int dim>
    std::vector<double>
    values_along_mesh(const dealii::DoFHandler<dim> &dof_handler,
                      const la::Vector &field)
    {
      const auto &mesh = dof_handler.get_triangulation();
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      std::vector<double> mine((mesh.n_vertices() + mesh.n_raw_lines())
                               * dof_handler.get_fe().n_components());
      for_each_unknown(dof_handler,
                       [&](const auto dof, const std::size_t number)
                       {
                         if (owned.is_element(dof))
                           mine[number] =
                               la::data(field)[owned.index_within_set(dof)];
                       });
      std::vector<double> all(mine.size());
      dealii::Utilities::MPI::sum(mine, versions::communicator(dof_handler),
                                  all);
      return all;
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
      collective(communicator,
                 [&]
                 {
                   if (dealii::Utilities::MPI::this_mpi_process(communicator)
                       == 0)
                     write_file(file, to_bytes(values));
                 });
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
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      std::vector<la::Vector> fields = empty_fields(n_fields, dof_handler);
      for (unsigned int i = 0; i < n_fields; ++i)
        for_each_unknown(dof_handler,
                         [&](const auto dof, const std::size_t number)
                         {
                           if (owned.is_element(dof))
                             la::data(fields[i])[owned.index_within_set(dof)] =
                                 values.at(i).at(number);
                         });
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
          128 + n_fields * 8 * dof_handler.get_fe().n_dofs_per_cell();
      collective(
          communicator,
          [&]
          {
            if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_history.h"

#include <deal.II/base/exceptions.h>

namespace abut::app
{
  template <int dim>
  MeshHistory<dim>::MeshHistory(Mesh &mesh)
      : mesh_(mesh),
        connection_(
            mesh.signals.pre_distributed_refinement.connect([this] { note(); }))
  {
  }

  template <int dim> void MeshHistory<dim>::note()
  {
    if (!is_known_)
      return;
    std::string flags;
    for (const auto &cell : mesh_.active_cell_iterators())
      flags += cell->refine_flag_set()    ? '1'
               : cell->coarsen_flag_set() ? '2'
                                          : '0';
    steps_.push_back(std::move(flags));
  }

  template <int dim> void MeshHistory<dim>::forget()
  {
    is_known_ = false;
    steps_.clear();
  }

  template <int dim>
  void MeshHistory<dim>::replay(const std::vector<std::string> &steps)
  {
    // What is noted already, making the mesh has done.
    for (std::size_t step = steps_.size(); step < steps.size(); ++step)
    {
      const std::string &flags = steps[step];
      AssertThrow(flags.size() == mesh_.n_active_cells(),
                  dealii::ExcMessage("The coarse mesh of the checkpoint "
                                     "differs from that of the scene."));
      std::size_t i = 0;
      for (const auto &cell : mesh_.active_cell_iterators())
      {
        const char flag = flags[i++];
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
        if (flag == '1')
          cell->set_refine_flag();
        else if (flag == '2')
          cell->set_coarsen_flag();
      }
      mesh_.execute_coarsening_and_refinement();
    }
  }

  template class MeshHistory<2>;
  template class MeshHistory<3>;
} // namespace abut::app

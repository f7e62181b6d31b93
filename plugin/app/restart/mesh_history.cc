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
    std::vector<bool> refine, coarsen;
    mesh_.save_refine_flags(refine);
    mesh_.save_coarsen_flags(coarsen);
    std::string flags(refine.size(), '0');
    for (std::size_t i = 0; i < flags.size(); ++i)
      flags[i] = refine[i] ? '1' : coarsen[i] ? '2' : '0';
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
                  dealii::ExcMessage("The mesh of the checkpoint has not "
                                     "begun as the scene's mesh does."));
      std::vector<bool> refine(flags.size()), coarsen(flags.size());
      for (std::size_t i = 0; i < flags.size(); ++i)
      {
        refine[i] = flags[i] == '1';
        coarsen[i] = flags[i] == '2';
      }
      mesh_.load_refine_flags(refine);
      mesh_.load_coarsen_flags(coarsen);
      mesh_.execute_coarsening_and_refinement();
    }
  }

  template class MeshHistory<2>;
  template class MeshHistory<3>;
} // namespace abut::app

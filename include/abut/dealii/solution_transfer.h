// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_SOLUTION_TRANSFER_H
#define ABUT_DEALII_SOLUTION_TRANSFER_H

#include <deal.II/base/config.h>

#if DEAL_II_VERSION_GTE(9, 8, 0)
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/la_parallel_vector.h>
#endif
#if DEAL_II_VERSION_GTE(9, 7, 0)
#include <deal.II/numerics/solution_transfer.h>
#else
#include <deal.II/distributed/solution_transfer.h>
#endif

#include <vector>

namespace abut::versions
{
#if DEAL_II_VERSION_GTE(9, 8, 0)
  /** Transfer of fields to a refined distributed mesh, or through a file: the
   * functions of dealii::SolutionTransfer that take several fields. That of
   * deal.II 9.8 writes unknowns of other ranks outside the memory of Tpetra
   * vectors (its issue 18792: internal::ElementAccess::set()); this one
   * transfers copies of deal.II's own type. Fields need no ghosts. */
  template <int dim, typename VectorType> class SolutionTransfer
  {
  public:
    explicit SolutionTransfer(const dealii::DoFHandler<dim> &dof_handler)
        : dof_handler_(dof_handler), transfer_(dof_handler)
    {
    }

    void prepare_for_coarsening_and_refinement(
        const std::vector<const VectorType *> &fields)
    {
      transfer_.prepare_for_coarsening_and_refinement(copy(fields));
    }

    void
    prepare_for_serialization(const std::vector<const VectorType *> &fields)
    {
      transfer_.prepare_for_serialization(copy(fields));
    }

    void interpolate(std::vector<VectorType *> &fields)
    {
      std::vector<Copy *> targets = make(fields.size());
      transfer_.interpolate(targets);
      write(fields);
    }

    void deserialize(std::vector<VectorType *> &fields)
    {
      std::vector<Copy *> targets = make(fields.size());
      transfer_.deserialize(targets);
      write(fields);
    }

  private:
    using Copy = dealii::LinearAlgebra::distributed::Vector<double>;

    std::vector<Copy *> make(const std::size_t n)
    {
      copies_.assign(
          n, Copy(dof_handler_.locally_owned_dofs(),
                  dealii::DoFTools::extract_locally_relevant_dofs(dof_handler_),
                  dof_handler_.get_mpi_communicator()));
      std::vector<Copy *> result;
      for (Copy &one : copies_)
        result.push_back(&one);
      return result;
    }

    std::vector<const Copy *>
    copy(const std::vector<const VectorType *> &fields)
    {
      make(fields.size());
      std::vector<const Copy *> result;
      for (std::size_t k = 0; k < fields.size(); ++k)
      {
        for (const auto i : dof_handler_.locally_owned_dofs())
          copies_[k](i) = (*fields[k])(i);
        copies_[k].update_ghost_values();
        result.push_back(&copies_[k]);
      }
      return result;
    }

    void write(const std::vector<VectorType *> &fields)
    {
      for (std::size_t k = 0; k < fields.size(); ++k)
      {
        for (const auto i : dof_handler_.locally_owned_dofs())
          (*fields[k])(i) = copies_[k](i);
        fields[k]->compress(dealii::VectorOperation::insert);
      }
      copies_.clear();
    }

    const dealii::DoFHandler<dim> &dof_handler_;
    dealii::SolutionTransfer<dim, Copy> transfer_;
    std::vector<Copy> copies_;
  };
#elif DEAL_II_VERSION_GTE(9, 7, 0)
  /** Transfer of fields to a refined distributed mesh. */
  template <int dim, typename VectorType>
  using SolutionTransfer = dealii::SolutionTransfer<dim, VectorType>;
#else
  /** Transfer of fields to a refined distributed mesh. */
  template <int dim, typename VectorType>
  using SolutionTransfer =
      dealii::parallel::distributed::SolutionTransfer<dim, VectorType>;
#endif
} // namespace abut::versions

#endif

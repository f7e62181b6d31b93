// SPDX-License-Identifier: LGPL-2.1-or-later
// Vectors and matrices of a host, of whatever type, as ones of Abut's types.
#include "contact_implementation.h"

#include <deal.II/dofs/dof_tools.h>

namespace abut
{
  using dealii::ExcMessage;
  using dealii::types::global_dof_index;

  template <int dim>
  global_dof_index
  ContactAssembler<dim>::Implementation::displacement_block() const
  {
    const unsigned int n_components = dof_handler->get_fe().n_components();
    if (n_components <= unsigned(dim)
        || dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      return 0;
    dealii::ComponentMask displacement(n_components, false);
    for (int c = 0; c < dim; ++c)
      displacement.set(c, true);
    const dealii::IndexSet block =
        dealii::DoFTools::extract_dofs(*dof_handler, displacement);
    const bool is_first = block.is_contiguous() && block.n_elements() > 0
                          && block.nth_index_in_set(0) == 0;
    return is_first ? block.n_elements() : 0;
  }

  template <int dim>
  const la::Vector &ContactAssembler<dim>::Implementation::checked_vector(
      const std::string &call, const std::string &what,
      const la::VectorView &given) const
  {
    const auto check = [&](const bool is_good, const std::string &text)
    {
      AssertThrow(dealii::Utilities::MPI::min(int(is_good), communicator) == 1,
                  ExcMessage("The " + what + " given to " + call + text));
    };
    const std::string ghosted = " has ghost entries: give it the vector of "
                                "owned entries alone.";
    if (given.native() != nullptr)
    {
      check_size(call, what, given.size());
      AssertThrow(!given.has_ghosts(),
                  ExcMessage("The " + what + " given to " + call + ghosted));
      return *given.native();
    }
    const dealii::IndexSet &owned = dof_handler->locally_owned_dofs();
    const bool is_block = given.size() > 0 && given.size() != n_unknowns
                          && given.size() == displacement_block();
    if (!is_block)
    {
      check_size(call, what, given.size());
      check(given.owned() == owned,
            " is not distributed over the ranks as the unknowns are: make it "
            "with DoFHandler::locally_owned_dofs(). Types without ranks need "
            "one rank, or a mesh and a ContactAssembler of MPI_COMM_SELF.");
    }
    check(!given.has_ghosts(), ghosted);
    return given.copy(owned, communicator);
  }

  template <int dim>
  la::Vector &ContactAssembler<dim>::Implementation::checked_mutable_vector(
      const std::string &call, const std::string &what,
      const la::MutableVectorView &given) const
  {
    // Either is a vector that may be written.
    return const_cast<la::Vector &>(checked_vector(call, what, given));
  }

  template <int dim>
  solve::Stiffness ContactAssembler<dim>::Implementation::stiffness_of(
      const std::string &call, const Tangent &tangent,
      shim::HostMatrixCopy *copy) const
  {
    const dealii::IndexSet &owned = dof_handler->locally_owned_dofs();
    if (!tangent.has_matrix())
      return {tangent, owned, communicator};
    const la::HostMatrix *const other = tangent.other();
    const std::string name = "matrix given to " + call;
    if (other == nullptr)
    {
      check_size(call, "matrix", tangent.matrix().m());
      shim::check_values(tangent.matrix(), name, communicator);
      shim::check_eliminated(tangent.matrix(), *constraints, name,
                             communicator);
      return tangent.matrix();
    }
    const bool is_block = other->m() > 0 && other->m() != n_unknowns
                          && other->m() == displacement_block();
    if (!is_block)
      check_size(call, "matrix", other->m());
    const bool fits =
        other->n() == other->m() && (is_block || other->rows() == owned);
    AssertThrow(dealii::Utilities::MPI::min(int(fits), communicator) == 1,
                ExcMessage("The " + name
                           + " is not square, or its rows are not distributed "
                             "over the ranks as the unknowns are. Types "
                             "without ranks need one rank, or a mesh and a "
                             "ContactAssembler of MPI_COMM_SELF."));
    const la::Matrix &taken = (copy == nullptr ? copied : *copy)
                                  .copy(*other, name, owned, communicator);
    shim::check_eliminated(taken, *constraints, name, communicator);
    return taken;
  }

  template <int dim>
  Tangent ContactAssembler<dim>::copy_of(const Tangent &tangent) const
  {
    const Implementation &i = *implementation;
    i.check_mesh("copy_of()");
    return tangent.other() == nullptr ? tangent
                                      : i.stiffness_of("copy_of()", tangent);
  }

  template <int dim>
  la::Vector ContactAssembler<dim>::copy_of(const la::VectorView &vector) const
  {
    const Implementation &i = *implementation;
    i.check_mesh("copy_of()");
    return i.checked_vector("copy_of()", "vector", vector);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template global_dof_index                                                    \
  ContactAssembler<dim>::Implementation::displacement_block() const;           \
  template const la::Vector &                                                  \
  ContactAssembler<dim>::Implementation::checked_vector(                       \
      const std::string &, const std::string &, const la::VectorView &) const; \
  template la::Vector &                                                        \
  ContactAssembler<dim>::Implementation::checked_mutable_vector(               \
      const std::string &, const std::string &, const la::MutableVectorView &) \
      const;                                                                   \
  template solve::Stiffness                                                    \
  ContactAssembler<dim>::Implementation::stiffness_of(                         \
      const std::string &, const Tangent &, shim::HostMatrixCopy *) const;     \
  template Tangent ContactAssembler<dim>::copy_of(const Tangent &) const;      \
  template la::Vector ContactAssembler<dim>::copy_of(const la::VectorView &)   \
      const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut

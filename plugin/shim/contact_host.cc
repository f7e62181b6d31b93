// SPDX-License-Identifier: LGPL-2.1-or-later
// Vectors and matrices of a host, of whatever type, as ones of Abut's types.
#include "contact_host.h"

#include "agree.h"

#include <abut/dealii/contact_pair.h>

#include <deal.II/dofs/dof_tools.h>

#include <cmath>
#include <sstream>

namespace abut::shim
{
  using dealii::ExcMessage;
  using dealii::types::global_dof_index;

  namespace
  {
    /** Throw unless all ends are vertices of the mesh and of no higher level.
     */
    void check_origins(const std::vector<VertexOrigin> &origins,
                       const std::size_t n_vertices)
    {
      AssertThrow(origins.empty() || origins.size() == n_vertices,
                  ExcMessage("set_vertex_origins() was given "
                             + std::to_string(origins.size())
                             + " vertices of a mesh of "
                             + std::to_string(n_vertices) + "."));
      for (std::size_t v = 0; v < origins.size(); ++v)
        for (const unsigned int end : origins[v].ends)
          AssertThrow(
              origins[v].level == 0
                  || (end < n_vertices && end != v
                      && origins[end].level <= origins[v].level),
              ExcMessage("Vertex " + std::to_string(v)
                         + " was not made between vertices of the same or "
                           "lower levels, as given to set_vertex_origins()."));
    }
  } // namespace

  template <int dim>
  void
  ContactHost<dim>::reinit(const dealii::Mapping<dim> &mapping,
                           const dealii::DoFHandler<dim> &dof_handler,
                           const dealii::AffineConstraints<double> &constraints)
  {
    vertex_origins_ = std::move(next_origins_);
    next_origins_.clear();
    check_origins(vertex_origins_,
                  dof_handler.get_triangulation().n_vertices());
    mapping_ = &mapping;
    dof_handler_ = &dof_handler;
    constraints_ = &constraints;
    n_unknowns_ = dof_handler.n_dofs();
    vertices_ = vertices();
    boundary_unknowns_ = boundary_unknowns();
    reference_.reset();
    copied_.clear();
    copied_reference_.clear();
    constant_.reset();
  }

  template <int dim>
  void ContactHost<dim>::check_mesh(const std::string &call) const
  {
    AssertThrow(dof_handler_ != nullptr,
                ExcMessage("Call reinit() before " + call + "."));
    check_unchanged(call);
  }

  template <int dim>
  void ContactHost<dim>::check_unchanged(const std::string &call) const
  {
    AssertThrow(dof_handler_ == nullptr
                    || dof_handler_->n_dofs() == n_unknowns_,
                ExcMessage("There are " + std::to_string(dof_handler_->n_dofs())
                           + " unknowns in " + call + ", but there were "
                           + std::to_string(n_unknowns_)
                           + " in the last reinit(). Call reinit() and "
                             "detect() after each change of the mesh."));
  }

  template <int dim>
  std::vector<dealii::Point<dim>> ContactHost<dim>::vertices() const
  {
    std::vector<dealii::Point<dim>> result =
        dof_handler_->get_triangulation().get_vertices();
    if (!mapping_->preserves_vertex_locations())
      for (const auto &cell : dof_handler_->active_cell_iterators())
        if (cell->is_locally_owned())
        {
          const auto corners = mapping_->get_vertices(cell);
          for (unsigned int v = 0; v < corners.size(); ++v)
            result[cell->vertex_index(v)] = corners[v];
        }
    return result;
  }

  template <int dim>
  std::vector<dealii::types::global_dof_index>
  ContactHost<dim>::boundary_unknowns() const
  {
    std::vector<dealii::types::global_dof_index> result, of_cell;
    for (const auto &cell : dof_handler_->active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
      {
        of_cell.resize(cell->get_fe().n_dofs_per_cell());
        cell->get_dof_indices(of_cell);
        result.insert(result.end(), of_cell.begin(), of_cell.end());
      }
    return result;
  }

  template <int dim>
  void ContactHost<dim>::check_places(const std::string &call) const
  {
    // A mesh that is moved, written to a file and moved back is the same.
    constexpr double round_off = 1e-12;
    const std::vector<dealii::Point<dim>> now = vertices();
    const std::size_t n = std::min(now.size(), vertices_.size());
    double size = 0., largest = 0.;
    std::size_t farthest = 0;
    for (std::size_t v = 0; v < n; ++v)
    {
      size = std::max(size, vertices_[v].norm_square());
      const double way = now[v].distance_square(vertices_[v]);
      if (!(way <= largest))
      {
        largest = way;
        farthest = v;
      }
    }
    std::ostringstream text;
    if (now.size() != vertices_.size())
      text << "The mesh given to the last reinit() had " << vertices_.size()
           << " vertices, and has " << now.size() << " in " << call
           << ". Distribute the unknowns again and call reinit() and detect() "
              "after each change of the mesh.";
    else if (!(largest <= round_off * round_off * size))
      text << "A vertex of the mesh, moved by the mapping, is at ("
           << now[farthest] << ") in " << call << ", and was at ("
           << vertices_[farthest]
           << ") in the last reinit(): surfaces and gaps are those of the old "
              "positions. Call reinit() and detect() after each motion of the "
              "mesh, or leave the mesh where it is and let the displacement "
              "describe the motion.";
    else if (boundary_unknowns() != boundary_unknowns_)
      text << "The unknowns have other numbers in " << call
           << " than in the last reinit(). Call reinit() and detect() after "
              "unknowns are distributed or renumbered.";
    throw_everywhere<ContactError>(communicator_, text.str());
  }

  template <int dim>
  void ContactHost<dim>::check_size(const std::string &call,
                                    const std::string &what,
                                    const global_dof_index size) const
  {
    AssertThrow(
        size == n_unknowns_,
        ExcMessage("The " + what + " given to " + call + " is of "
                   + std::to_string(size) + " unknowns, but there are "
                   + std::to_string(n_unknowns_)
                   + ". Create it again after each change of the mesh."));
  }

  template <int dim>
  global_dof_index ContactHost<dim>::displacement_block() const
  {
    const unsigned int n_components = dof_handler_->get_fe().n_components();
    if (n_components <= unsigned(dim)
        || dealii::Utilities::MPI::n_mpi_processes(communicator_) > 1)
      return 0;
    dealii::ComponentMask displacement(n_components, false);
    for (int c = 0; c < dim; ++c)
      displacement.set(c, true);
    const dealii::IndexSet block =
        dealii::DoFTools::extract_dofs(*dof_handler_, displacement);
    const bool is_first = block.is_contiguous() && block.n_elements() > 0
                          && block.nth_index_in_set(0) == 0;
    return is_first ? block.n_elements() : 0;
  }

  template <int dim>
  const la::Vector &ContactHost<dim>::vector(const std::string &call,
                                             const std::string &what,
                                             const la::VectorView &given) const
  {
    const auto check = [&](const bool is_good, const std::string &text)
    {
      AssertThrow(dealii::Utilities::MPI::min(int(is_good), communicator_) == 1,
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
    const dealii::IndexSet &owned = dof_handler_->locally_owned_dofs();
    const bool is_block = given.size() > 0 && given.size() != n_unknowns_
                          && given.size() == displacement_block();
    if (!is_block)
    {
      check_size(call, what, given.size());
      check(given.owned() == owned,
            " is not distributed over the ranks like the unknowns: create it "
            "with DoFHandler::locally_owned_dofs(). Serial types need one "
            "rank, or a mesh and a ContactAssembler on MPI_COMM_SELF.");
    }
    check(!given.has_ghosts(), ghosted);
    return given.copy(owned, communicator_);
  }

  template <int dim>
  la::Vector &
  ContactHost<dim>::mutable_vector(const std::string &call,
                                   const std::string &what,
                                   const la::MutableVectorView &given) const
  {
    // Either is a vector that may be written.
    return const_cast<la::Vector &>(vector(call, what, given));
  }

  template <int dim>
  const la::Vector &ContactHost<dim>::residual(const std::string &call,
                                               const la::VectorView &given,
                                               const bool is_first) const
  {
    const double visible = 1e-10; // of the largest force
    const la::Vector &result = vector(call, "residual", given);
    const std::string name = "residual given to " + call;
    const double *const values = la::data(result);
    global_dof_index bad = dealii::numbers::invalid_dof_index;
    double largest = 0.;
    for (int k = la::n_owned(result) - 1; k >= 0; --k)
    {
      largest = std::max(largest, std::abs(values[k]));
      if (!std::isfinite(values[k]))
        bad = owned().nth_index_in_set(k);
    }
    refuse_row(bad, name, "a value that is not finite", communicator_);
    if (is_first && given.native() != nullptr)
    {
      // Values for other ranks are copied, too, as long as they are not sent.
      la::Vector sent(result);
      sent.compress(dealii::VectorOperation::add);
      sent -= result;
      AssertThrow(sent.linfty_norm() == 0.,
                  ExcMessage("The " + name
                             + " has values for unknowns of other ranks that "
                               "were not sent to them. Call its "
                               "compress(VectorOperation::add) after "
                               "assembly."));
    }
    largest = dealii::Utilities::MPI::max(largest, communicator_);
    for (const auto &line : constraints_->get_lines())
      if (owned().is_element(line.index)
          && std::abs(values[owned().index_within_set(line.index)])
                 > visible * largest)
        bad = std::min(bad, line.index);
    refuse_row(bad, name,
               "a force, although the constraints given to reinit() eliminate "
               "it (assemble with AffineConstraints::"
               "distribute_local_to_global(), or call "
               "AffineConstraints::set_zero()),",
               communicator_);
    return result;
  }

  template <int dim>
  void ContactHost<dim>::check_coupled(const la::Matrix &matrix,
                                       const std::string &name) const
  {
    const unsigned int n_components =
        dof_handler_->get_fe_collection().n_components();
    if (n_components != 1 && n_components != dim)
      return;
    std::set<global_dof_index> lone =
        lone_rows(matrix, *constraints_, communicator_);
    std::vector<global_dof_index> dofs;
    for (const auto &cell : dof_handler_->active_cell_iterators())
    {
      if (lone.empty() || cell->is_artificial())
        continue;
      const auto &fe = cell->get_fe();
      dofs.resize(fe.n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      for (unsigned int k = 0; k < dofs.size(); ++k)
        for (unsigned int l = 0; l < dofs.size(); ++l)
          if (constraints_->is_constrained(dofs[l])
              && fe.system_to_component_index(l).first
                     == fe.system_to_component_index(k).first)
            lone.erase(dofs[k]);
    }
    const global_dof_index bad =
        lone.empty() ? dealii::numbers::invalid_dof_index : *lone.begin();
    refuse_lone_row(bad, name, communicator_);
  }

  template <int dim>
  solve::Stiffness ContactHost<dim>::stiffness(const std::string &call,
                                               const Tangent &tangent,
                                               HostMatrixCopy &copy) const
  {
    const dealii::IndexSet &owned = dof_handler_->locally_owned_dofs();
    if (!tangent.has_matrix())
      return {tangent, owned, communicator_};
    const la::HostMatrix *const other = tangent.other();
    const std::string name = "matrix given to " + call;
    if (other == nullptr)
    {
      check_size(call, "matrix", tangent.matrix().m());
      check_sent(tangent.matrix(), name, communicator_);
      check_values(tangent.matrix(), name, communicator_);
      check_assembled(tangent.matrix(), *constraints_, name, communicator_);
      check_eliminated(tangent.matrix(), *constraints_, name, communicator_);
      check_coupled(tangent.matrix(), name);
      return tangent.matrix();
    }
    const bool is_block = other->m() > 0 && other->m() != n_unknowns_
                          && other->m() == displacement_block();
    if (!is_block)
      check_size(call, "matrix", other->m());
    const bool fits =
        other->n() == other->m() && (is_block || other->rows() == owned);
    AssertThrow(
        dealii::Utilities::MPI::min(int(fits), communicator_) == 1,
        ExcMessage("The " + name
                   + " is not square, or its rows are not distributed over the "
                     "ranks like the unknowns. Serial types need one rank, or "
                     "a mesh and a ContactAssembler on MPI_COMM_SELF."));
    const la::Matrix &taken = copy.copy(*other, name, owned, communicator_);
    check_assembled(taken, *constraints_, name, communicator_);
    check_eliminated(taken, *constraints_, name, communicator_);
    if (!is_block)
      check_coupled(taken, name);
    return taken;
  }

  template <int dim>
  solve::Stiffness ContactHost<dim>::constant_stiffness(const std::string &call,
                                                        const Tangent &tangent,
                                                        const bool is_new)
  {
    const bool is_other = is_new || !constant_ || !tangent.has_matrix()
                          || tangent.other() != nullptr
                          || !constant_->has_matrix()
                          || &tangent.matrix() != &constant_->matrix();
    if (dealii::Utilities::MPI::logical_or(is_other, communicator_))
      constant_ = stiffness(call, tangent);
    return *constant_;
  }

  template class ContactHost<2>;
  template class ContactHost<3>;
} // namespace abut::shim

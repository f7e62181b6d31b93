// SPDX-License-Identifier: LGPL-2.1-or-later
#include "host_cells.h"

#include "reference_faces.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>

namespace abut::shim
{
  namespace
  {
    /** Whether a cell of this rank has an edge that a neighbour has cut. */
    template <int dim>
    bool has_cut_edges(const dealii::Triangulation<dim> &triangulation)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int line : cell->line_indices())
            if (cell->line(line)->has_children())
              return true;
      return false;
    }
  } // namespace

  template <int dim>
  Message cell_refusal(const dealii::DoFHandler<dim> &dof_handler)
  {
    const auto &triangulation = dof_handler.get_triangulation();
    if (dof_handler.get_fe_collection().size() > 1)
      return "Contact needs one finite element on cells of one kind: "
             "collections of elements (hp), as for meshes of different cells, "
             "are not possible. Mesh all bodies with the same kind of cells.";
    const dealii::FiniteElement<dim> &fe = dof_handler.get_fe();
    if (fe.reference_cell() == dealii::ReferenceCells::get_hypercube<dim>())
      return "";
    if (!is_simplex(fe))
      return "Contact needs quadrilaterals, hexahedra, triangles or "
             "tetrahedra; wedges and pyramids ("
             + fe.get_name() + ") are not possible.";
    if (dynamic_cast<const dealii::parallel::distributed::Triangulation<dim> *>(
            &triangulation)
        != nullptr)
      return "parallel::distributed::Triangulation (p4est) has no triangles "
             "and tetrahedra. Use parallel::shared::Triangulation, or "
             "parallel::fullydistributed::Triangulation.";
    if (fe.base_element(0).degree > 2)
      return "Contact of triangles and tetrahedra needs FE_SimplexP of degree "
             "1 or 2, not "
             + fe.get_name() + ".";
    if (dim == 3
        && dealii::Utilities::MPI::logical_or(
            has_cut_edges(triangulation), versions::communicator(dof_handler)))
      return "The mesh of tetrahedra has hanging nodes, for which deal.II has "
             "no constraints in space. Refine all cells (refine_global()), or "
             "make a mesh that is conforming.";
    return "";
  }

  template <int dim>
  Message displacement_refusal(const dealii::FiniteElement<dim> &fe)
  {
    const dealii::FiniteElement<dim> &element = fe.base_element(0);
    const unsigned int degree = element.degree;
    unsigned int n_nodes = degree + 1; // of a facet
    if (dim == 3)
      n_nodes =
          is_simplex(fe) ? n_nodes * (n_nodes + 1) / 2 : n_nodes * n_nodes;
    const bool is_usable =
        fe.n_components() >= dim && element.has_support_points()
        && element.n_components() == 1 && fe.element_multiplicity(0) >= dim
        && (degree == 1 || degree == 2) && element.n_dofs_per_vertex() == 1
        && element.n_dofs_per_face(0) == n_nodes;
    if (is_usable)
      return "";
    return "Contact between bodies needs a displacement in the first "
           + std::to_string(dim)
           + " components of the finite element, made of FE_Q or FE_SimplexP "
             "of degree 1 or 2 (FESystem(FE_Q(degree), "
           + std::to_string(dim) + ")), not " + fe.get_name() + ".";
  }

  template <int dim>
  Message obstacle_refusal(const dealii::FiniteElement<dim> &fe,
                           const bool on_boundary)
  {
    const bool on_lines = dim == 2 && on_boundary;
    if (fe.degree == 1 || !is_simplex(fe) || on_lines)
      return "";
    return "Shape functions of " + fe.get_name()
           + " at vertices have no positive weight: obstacles on triangles and "
             "tetrahedra need FE_SimplexP(1).";
  }

  template Message cell_refusal(const dealii::DoFHandler<2> &);
  template Message cell_refusal(const dealii::DoFHandler<3> &);
  template Message displacement_refusal(const dealii::FiniteElement<2> &);
  template Message displacement_refusal(const dealii::FiniteElement<3> &);
  template Message obstacle_refusal(const dealii::FiniteElement<2> &, bool);
  template Message obstacle_refusal(const dealii::FiniteElement<3> &, bool);
} // namespace abut::shim

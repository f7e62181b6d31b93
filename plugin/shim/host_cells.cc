// SPDX-License-Identifier: LGPL-2.1-or-later
#include "host_cells.h"

#include "by_element.h"
#include "cell_quadrature.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>

namespace abut::shim
{
  namespace
  {
    /** Whether a tetrahedron of this rank has an edge that a neighbour has cut.
     */
    template <int dim>
    bool has_cut_edges(const dealii::Triangulation<dim> &triangulation)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned()
            && cell->reference_cell()
                   == dealii::ReferenceCells::get_simplex<dim>())
          for (const unsigned int line : cell->line_indices())
            if (cell->line(line)->has_children())
              return true;
      return false;
    }

    template <int dim> bool is_cube(const dealii::FiniteElement<dim> &fe)
    {
      return fe.reference_cell()
             == dealii::ReferenceCells::get_hypercube<dim>();
    }

    /** Why there is no contact with an element; empty: there is. */
    template <int dim>
    Message element_refusal(const dealii::Mapping<dim> &mapping,
                            const dealii::DoFHandler<dim> &dof_handler,
                            const dealii::FiniteElement<dim> &fe)
    {
      if (!is_cube(fe) && !is_simplex(fe))
        return "Contact needs quadrilaterals, hexahedra, triangles or "
               "tetrahedra; wedges and pyramids ("
               + fe.get_name() + ") are not possible.";
      if (!mapping.is_compatible_with(fe.reference_cell()))
        return "The mapping is not one of the cells of " + fe.get_name()
               + ". Triangles and tetrahedra need MappingFE(FE_SimplexP(1)), "
                 "meshes with cells of two kinds abut::MappingByCell.";
      if (is_cube(fe))
        return "";
      if (dynamic_cast<const dealii::parallel::distributed::Triangulation<dim>
                           *>(&dof_handler.get_triangulation())
          != nullptr)
        return "parallel::distributed::Triangulation (p4est) has no triangles "
               "and tetrahedra. Use parallel::shared::Triangulation, or "
               "parallel::fullydistributed::Triangulation.";
      if (fe.base_element(0).degree > 2)
        return "Contact of triangles and tetrahedra needs FE_SimplexP of "
               "degree 1 or 2, not "
               + fe.get_name() + ".";
      return "";
    }

    /** The same of several elements together. */
    template <int dim>
    Message collection_refusal(const dealii::DoFHandler<dim> &dof_handler)
    {
      const auto fes = elements(dof_handler);
      for (std::size_t i = 0; i < fes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (fes[i]->reference_cell() == fes[j]->reference_cell())
            return "Contact needs one finite element for each kind of cells, "
                   "but the collection has "
                   + fes[j]->get_name() + " and " + fes[i]->get_name()
                   + " for the same kind.";
      return "";
    }

    /** The first of what @p refusal finds of the elements of a field. */
    template <int dim, class Refusal>
    Message first_refusal(const dealii::DoFHandler<dim> &dof_handler,
                          const Refusal &refusal)
    {
      for (const dealii::FiniteElement<dim> *fe : elements(dof_handler))
        if (Message reason = refusal(*fe); !reason.empty())
          return reason;
      return "";
    }
  } // namespace

  template <int dim>
  Message cell_refusal(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler)
  {
    Message reason =
        first_refusal(dof_handler, [&](const dealii::FiniteElement<dim> &fe)
                      { return element_refusal(mapping, dof_handler, fe); });
    if (!reason.empty())
      return reason;
    const auto fes = elements(dof_handler);
    if (fes.size() > 1)
      reason = collection_refusal(dof_handler);
    if (!reason.empty())
      return reason;
    if (dim == 3
        && std::any_of(fes.begin(), fes.end(),
                       [](const auto *fe) { return is_simplex(*fe); })
        && dealii::Utilities::MPI::logical_or(
            has_cut_edges(dof_handler.get_triangulation()),
            versions::communicator(dof_handler)))
      return "The mesh of tetrahedra has hanging nodes, for which deal.II has "
             "no constraints in space. Refine all cells (refine_global()), or "
             "make a mesh that is conforming.";
    return "";
  }

  template <int dim>
  Message displacement_refusal(const dealii::DoFHandler<dim> &dof_handler)
  {
    return first_refusal(
        dof_handler,
        [](const dealii::FiniteElement<dim> &fe) -> Message
        {
          // Others have nodes, but not the shape functions of facets.
          const dealii::FiniteElement<dim> &element = fe.base_element(0);
          const bool is_usable =
              (dynamic_cast<const dealii::FE_Q<dim> *>(&element) != nullptr
               || dynamic_cast<const dealii::FE_SimplexP<dim> *>(&element)
                      != nullptr)
              && fe.element_multiplicity(0) >= dim && element.degree <= 2;
          if (is_usable)
            return "";
          return "Contact between bodies needs a displacement in the first "
                 + std::to_string(dim)
                 + " components of the finite element, made of FE_Q or "
                   "FE_SimplexP of degree 1 or 2 (FESystem(FE_Q(degree), "
                 + std::to_string(dim) + ")), not " + fe.get_name() + ".";
        });
  }

  template <int dim>
  Message obstacle_refusal(const dealii::DoFHandler<dim> &dof_handler,
                           const bool on_boundary)
  {
    const bool on_lines = dim == 2 && on_boundary;
    return first_refusal(
        dof_handler,
        [&](const dealii::FiniteElement<dim> &fe) -> Message
        {
          if (fe.degree == 1 || !is_simplex(fe) || on_lines)
            return "";
          return "Shape functions of " + fe.get_name()
                 + " at vertices have no positive weight: obstacles on "
                   "triangles and tetrahedra need FE_SimplexP(1).";
        });
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template Message cell_refusal(const dealii::Mapping<dim> &,                  \
                                const dealii::DoFHandler<dim> &);              \
  template Message displacement_refusal(const dealii::DoFHandler<dim> &);      \
  template Message obstacle_refusal(const dealii::DoFHandler<dim> &, bool);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

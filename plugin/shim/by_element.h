// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_BY_ELEMENT_H
#define ABUT_SHIM_BY_ELEMENT_H

#include <deal.II/dofs/dof_handler.h>

#include <memory>
#include <type_traits>
#include <vector>

namespace abut::shim
{
  /** The elements of a DoFHandler, in the order of its collection. */
  template <int dim>
  std::vector<const dealii::FiniteElement<dim> *>
  elements(const dealii::DoFHandler<dim> &dof_handler)
  {
    std::vector<const dealii::FiniteElement<dim> *> result;
    for (unsigned int i = 0; i < dof_handler.get_fe_collection().size(); ++i)
      result.push_back(&dof_handler.get_fe(i));
    return result;
  }

  /** An object for each finite element of a DoFHandler, which has one, or one
   * for each kind of cells. */
  template <class Object> class ByElement
  {
  public:
    /** @param make returns the object of an element */
    template <int dim, class Make>
    ByElement(const dealii::DoFHandler<dim> &dof_handler, const Make &make)
    {
      for (const auto &element : elements(dof_handler))
        objects_.emplace_back(new Object(make(*element)));
    }

    /** That of the element of a cell. */
    template <class Cell> Object &of(const Cell &cell) const
    {
      return *objects_[cell->active_fe_index()];
    }

    const std::vector<std::unique_ptr<Object>> &all() const
    {
      return objects_;
    }

  private:
    std::vector<std::unique_ptr<Object>> objects_;
  };

  template <int dim, class Make>
  ByElement(const dealii::DoFHandler<dim> &, const Make &) -> ByElement<
      std::invoke_result_t<Make, const dealii::FiniteElement<dim> &>>;

  /** Put the unknowns of a cell into @p dofs, which takes their number. */
  template <class Cell>
  void get_dofs(const Cell &cell,
                std::vector<dealii::types::global_dof_index> &dofs)
  {
    dofs.resize(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
  }
} // namespace abut::shim

#endif

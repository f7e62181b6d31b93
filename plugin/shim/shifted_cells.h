// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SHIFTED_CELLS_H
#define ABUT_SHIM_SHIFTED_CELLS_H

#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q1.h>

#include <array>
#include <typeinfo>

namespace abut::shim
{
  /** Which of many cells, one after the other, have the shape of the last one
   * that had a new shape: of constant data, integrals over it are theirs. A
   * look at the vertices takes a fraction of FEValues::reinit(). */
  template <int dim> class ShiftedCells
  {
  public:
    explicit ShiftedCells(const dealii::Mapping<dim> &mapping)
        : vertices_say_all_(has_straight_edges(mapping))
    {
    }

    /** Whether @p cell is shifted only; else it is the one to compare with. */
    template <typename Cell> bool is_shifted(const Cell &cell)
    {
      if (!vertices_say_all_)
        return false;
      const dealii::Point<dim> &origin = cell->vertex(0);
      bool same = size_ > 0.;
      for (unsigned int v = 1; v < n_vertices && same; ++v)
        same = (cell->vertex(v) - origin - edge_[v]).norm_square()
               <= round_off * size_;
      if (same)
        return true;
      for (unsigned int v = 1; v < n_vertices; ++v)
        edge_[v] = cell->vertex(v) - origin;
      size_ = edge_[n_vertices - 1].norm_square();
      return false;
    }

  private:
    static constexpr unsigned int n_vertices =
        dealii::GeometryInfo<dim>::vertices_per_cell;
    /** Tolerance of squares; as deal.II compares cells. */
    static constexpr double round_off = 1e-24;

    /** Mappings that are derived from these may move the vertices. */
    static bool has_straight_edges(const dealii::Mapping<dim> &mapping)
    {
      const auto *const by_degree =
          dynamic_cast<const dealii::MappingQ<dim> *>(&mapping);
      return by_degree != nullptr && by_degree->get_degree() == 1
             && (typeid(mapping) == typeid(dealii::MappingQ<dim>)
                 || typeid(mapping) == typeid(dealii::MappingQ1<dim>));
    }

    const bool vertices_say_all_;
    double size_ = 0.; ///< square of a diagonal; 0: no cell yet
    std::array<dealii::Tensor<1, dim>, n_vertices> edge_;
  };
} // namespace abut::shim

#endif

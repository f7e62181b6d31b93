// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_output.h"

#include "app/restart/disk.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <sstream>

namespace abut::app
{
  namespace
  {
    template <int dim>
    using FacetPatch = dealii::DataOutBase::Patch<dim - 1, dim>;

    /** Facets of degree 2 are drawn straight, by their corners. */
    template <int dim>
    FacetPatch<dim> make_patch(const SurfaceArrays &surface,
                               const SurfaceFields &fields,
                               const std::size_t facet, const std::size_t n)
    {
      const auto n_corners =
          static_cast<std::size_t>(abut_facet_n_corners(surface.kind));
      FacetPatch<dim> patch;
      patch.patch_index = static_cast<unsigned int>(facet);
      patch.n_subdivisions = 1;
      patch.reference_cell = dealii::ReferenceCells::get_hypercube<dim - 1>();
      if constexpr (dim == 3)
        if (n_corners == 3)
          patch.reference_cell = dealii::ReferenceCells::Triangle;
      patch.data.reinit(fields.nodal.size() + fields.facets.size(), n_corners);
      for (std::size_t a = 0; a < n_corners; ++a)
      {
        const auto node =
            static_cast<std::size_t>(surface.connectivity[n * facet + a]);
        for (unsigned int d = 0; d < dim; ++d)
          patch.vertices[a][d] = surface.position[dim * node + d];
        std::size_t row = 0;
        for (const auto &field : fields.nodal)
          patch.data(row++, a) = static_cast<float>(field.second[node]);
        for (const auto &field : fields.facets)
          patch.data(row++, a) = static_cast<float>(field.second[facet]);
      }
      return patch;
    }
  } // namespace

  template <int dim>
  void write_surface(const std::filesystem::path &file,
                     const SurfaceArrays &surface, const SurfaceFields &fields)
  {
    const auto n = static_cast<std::size_t>(abut_facet_n_nodes(surface.kind));
    std::vector<FacetPatch<dim>> patches;
    for (std::size_t f = 0; f < surface.group.size(); ++f)
      patches.push_back(make_patch<dim>(surface, fields, f, n));
    std::vector<std::string> names;
    for (const auto *list : {&fields.nodal, &fields.facets})
      for (const auto &field : *list)
        names.push_back(field.first);
    std::ostringstream out;
    // Better compression takes many times as long and saves little.
    dealii::DataOutBase::VtkFlags flags;
    flags.compression_level = decltype(flags.compression_level)::best_speed;
    dealii::DataOutBase::write_vtu(patches, names, {}, flags, out);
    write_file(file, out.str());
  }

  template void write_surface<2>(const std::filesystem::path &,
                                 const SurfaceArrays &, const SurfaceFields &);
  template void write_surface<3>(const std::filesystem::path &,
                                 const SurfaceArrays &, const SurfaceFields &);
} // namespace abut::app

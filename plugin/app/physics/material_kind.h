// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MATERIAL_KIND_H
#define ABUT_APP_MATERIAL_KIND_H

/** @file
 * The table of materials. A material is one file: its class, its numbers and
 * its entry; material_kind.cc lists the entries.
 */

#include "material.h"

#include <abut/limits.h>

#include <functional>
#include <string>

namespace abut::app
{
  /** A number of a material in the section of a body. Materials with a number
   * of the same name share its entry. */
  struct MaterialNumber
  {
    const char *name;
    const char *value; ///< default
    abut_limit range;
    const char *help;
    const char *unit;
    const char *example;
  };

  using MaterialNumbers = std::vector<MaterialNumber>;

  /** Input of a material's constructor. */
  struct MaterialData
  {
    std::vector<double> numbers; ///< in the order of MaterialKind::numbers
    PlaneModel plane = PlaneModel::strain;
    VolumeChange volume = VolumeChange::of_point;
  };

  /** An entry of the table. */
  struct MaterialKind
  {
    template <int dim>
    using Make = std::shared_ptr<const Material<dim>> (*)(const MaterialData &);

    const char *word; ///< of `Body N/Material`
    const char *help; ///< follows the word and a colon
    bool large_strain;
    bool linear; ///< Material::is_linear()
    /** Clause why the material has no mean dilatation; null if it has. */
    const char *without_mean_dilatation;
    /** What happens below Material::least_stretch(); null if that is 0. */
    const char *below_least_stretch;
    const char *instead; ///< word of a material without these limits, or null
    const MaterialNumbers &numbers;
    Make<2> in_plane;
    Make<3> in_space;

    /** Whether numbers have one of this name. */
    bool has(const std::string &name) const;

    template <int dim>
    std::shared_ptr<const Material<dim>> make(const MaterialData &data) const
    {
      if constexpr (dim == 2)
        return in_plane(data);
      else
        return in_space(data);
    }
  };

  /** For MaterialKind::in_plane and in_space. */
  template <template <int> class Law, int dim>
  std::shared_ptr<const Material<dim>> make_material(const MaterialData &data)
  {
    return std::make_shared<Law<dim>>(data);
  }

  /** Young's modulus E and Poisson's ratio nu, in this order. */
  extern const MaterialNumbers elastic_constants;

  /** All materials, in the order of the reference. */
  const std::vector<const MaterialKind *> &material_kinds();

  /** The material of a word in the table. */
  const MaterialKind &find_material(const std::string &word);

  /** Numbers of all materials, each name once. */
  MaterialNumbers material_numbers();

  /** Words of the materials that satisfy a condition. */
  std::string
  material_words(const std::string &separator,
                 const std::function<bool(const MaterialKind &)> &fits);
} // namespace abut::app

#endif

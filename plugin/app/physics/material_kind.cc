// SPDX-License-Identifier: LGPL-2.1-or-later
#include "material_kind.h"

#include "app/input/input_error.h"

#include <algorithm>
#include <set>

namespace abut::app
{
  extern const MaterialKind hooke_kind, neo_hooke_kind,
      st_venant_kirchhoff_kind;

  const std::vector<const MaterialKind *> &material_kinds()
  {
    static const std::vector<const MaterialKind *> kinds = {
        &hooke_kind,
        &neo_hooke_kind,
        &st_venant_kirchhoff_kind,
    };
    return kinds;
  }

  const MaterialNumbers elastic_constants = {
      {"Young modulus",
       "1",
       {nullptr, 1. / largest_value, largest_value, false, false},
       "Young modulus E; at finite strain, like nu, that of small "
       "deformation.",
       "force/length^2",
       "210e3"},
      {"Poisson ratio",
       "0.3",
       {nullptr, -1., 0.5, true, true},
       "Poisson ratio nu, below 0.5 (incompressible). From 0.45 on set "
       "`Element = mean dilatation`.",
       "1",
       "0.499"}};

  const MaterialKind &find_material(const std::string &word)
  {
    const auto &kinds = material_kinds();
    return **std::find_if(kinds.begin(), kinds.end(),
                          [&](const MaterialKind *kind)
                          { return kind->word == word; });
  }

  bool MaterialKind::has(const std::string &name) const
  {
    return std::any_of(numbers.begin(), numbers.end(),
                       [&](const MaterialNumber &each)
                       { return each.name == name; });
  }

  MaterialNumbers material_numbers()
  {
    MaterialNumbers result;
    std::set<std::string> names;
    for (const MaterialKind *kind : material_kinds())
      for (const MaterialNumber &number : kind->numbers)
        if (names.insert(number.name).second)
          result.push_back(number);
    return result;
  }

  std::string
  material_words(const std::string &separator,
                 const std::function<bool(const MaterialKind &)> &fits)
  {
    std::string result;
    for (const MaterialKind *kind : material_kinds())
      if (fits(*kind))
        result += (result.empty() ? "" : separator) + kind->word;
    return result;
  }
} // namespace abut::app

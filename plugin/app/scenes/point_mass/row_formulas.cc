// SPDX-License-Identifier: LGPL-2.1-or-later
#include "row_formulas.h"

#include "app/input/input_error.h"
#include "app/input/number_text.h"

#include <algorithm>

namespace abut::app
{
  std::unique_ptr<RowFormula> formula_in_x(const std::string &text,
                                           const std::string &parameter,
                                           const unsigned int n)
  {
    if (names_in(text).count("y") > 0)
      throw InputError(parameter, "'" + text
                                      + "' has y: the masses of this scene "
                                        "are in a row along x.");
    return std::make_unique<RowFormula>(text, parameter, n);
  }

  std::unique_ptr<RowFormula>
  formula_by_direction(const std::string &text, const std::string &parameter,
                       const unsigned int n_directions,
                       const std::string &where)
  {
    const std::vector<std::string> given = split_list(text, ';');
    const std::size_t n_given = given.size();
    for (const std::string &formula : given)
      check_one_formula(formula, text, parameter);
    if (n_given > n_directions)
      throw InputError(
          parameter, std::to_string(n_given) + " formulas for "
                         + std::to_string(n_directions)
                         + (n_directions == 1 ? " direction " : " directions ")
                         + where + ".");
    std::string all = n_given == 0 ? "0" : text;
    for (std::size_t k = std::max<std::size_t>(n_given, 1); k < n_directions;
         ++k)
      all += "; 0";
    return formula_in_x(all, parameter, n_directions);
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "generator_arguments.h"

#include "app/input/dealii_message.h"
#include "app/input/expression.h"
#include "app/input/number_text.h"

#include <map>

namespace abut::app
{
  namespace
  {
    /** Arguments by name, as deal.II 9.4 has them. */
    const std::map<std::string, std::string> &argument_names()
    {
      static const std::map<std::string, std::string> names = {
          {"hyper_cube", "left : right : colorize"},
          {"subdivided_hyper_cube", "repetitions : left : right : colorize"},
          {"hyper_rectangle", "p1 : p2 : colorize"},
          {"subdivided_hyper_rectangle", "repetitions : p1 : p2 : colorize"},
          {"cheese", "holes"},
          {"general_cell", "vertices : colorize"},
          {"hyper_cross", "sizes : colorize"},
          {"plate_with_a_hole",
           "inner_radius : outer_radius : pad_bottom : pad_top : pad_left : "
           "pad_right : center : polar_manifold_id : tfi_manifold_id : L : "
           "n_slices : colorize"},
          {"channel_with_cylinder",
           "shell_region_width : n_shells : skewness : colorize"},
          {"enclosed_hyper_cube", "left : right : thickness : colorize"},
          {"hyper_ball", "center : radius : attach_spherical_manifold"},
          {"hyper_ball_balanced", "center : radius"},
          {"quarter_hyper_ball", "center : radius"},
          {"half_hyper_ball", "center : radius"},
          {"cylinder", "radius : half_length"},
          {"subdivided_cylinder", "x_subdivisions : radius : half_length"},
          {"truncated_cone", "radius_0 : radius_1 : half_length"},
          {"pipe_junction", ""},
          {"hyper_L", "left : right : colorize"},
          {"hyper_cube_slit", "left : right : colorize"},
          {"hyper_shell",
           "center : inner_radius : outer_radius : n_cells : colorize"},
          {"half_hyper_shell",
           "center : inner_radius : outer_radius : n_cells : colorize"},
          {"quarter_hyper_shell",
           "center : inner_radius : outer_radius : n_cells : colorize"},
          {"eccentric_hyper_shell",
           "inner_center : outer_center : inner_radius : outer_radius : "
           "n_cells"},
          {"cylinder_shell",
           "length : inner_radius : outer_radius : n_radial_cells : "
           "n_axial_cells"},
          {"concentric_hyper_shells",
           "center : inner_radius : outer_radius : n_shells : skewness : "
           "n_cells_per_shell : colorize"},
          {"torus", "R : r : n_cells_toroidal : phi"},
          {"simplex", "vertices"},
          {"moebius", "n_cells : n_rotations : R : r"}};
      return names;
    }
  } // namespace

  const std::vector<std::string> &generators()
  {
    static const std::vector<std::string> names = []
    {
      std::vector<std::string> result;
      for (const auto &entry : argument_names())
        result.push_back(entry.first);
      return result;
    }();
    return names;
  }

  std::string wrong_arguments(const std::string &generator,
                              const std::string &arguments,
                              const std::string &complaint)
  {
    const std::size_t given = split_list(arguments, ':').size();
    const auto entry = argument_names().find(generator);
    const std::string names =
        entry == argument_names().end() ? "" : entry->second;
    const std::size_t named = split_list(names, ':').size();
    const std::size_t wanted = wanted_arguments(complaint);
    if (wanted == 0)
      return complaint;
    std::string text = "it needs " + std::to_string(wanted);
    // Another version of deal.II may have others.
    if (named == wanted)
      text += ", " + names;
    text += "; " + std::to_string(given)
            + (given == 1 ? " is given" : " are given");
    if (given == wanted)
      text += ", one of which is not of its kind (numbers; points and lists as "
              "numbers separated by commas; true or false)";
    return text + "." + misread_hint(arguments);
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/search_parameters.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <limits>
#include <string>

namespace abut
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;
    namespace Utilities = dealii::Utilities;

    constexpr double degree = dealii::numbers::PI / 180;
    constexpr double largest_number = 1e40;

    std::string algorithm_names()
    {
      std::string names;
      for (int i = 0; i < ABUT_SEARCH_N_ALGORITHMS; ++i)
        names += (i == 0 ? "" : "|")
                 + std::string(
                     abut_search_name(static_cast<abut_search_algorithm>(i)));
      return names;
    }

    /** An angle in whole degrees as the default of a parameter. */
    std::string degrees(const double angle)
    {
      return std::to_string(std::lround(angle / degree));
    }

    void declare_lists(ParameterHandler &prm, const abut_search_options &d)
    {
      prm.declare_entry("Algorithm", abut_search_name(d.algorithm),
                        Patterns::Selection(algorithm_names()),
                        "How facets near a node are found. All algorithms "
                        "find the same pairs. `all pairs` looks at each facet "
                        "for each node, `uniform buckets` sorts facets into "
                        "cells of one size, `adaptive buckets` into nested "
                        "buckets that follow the sizes of the facets.");
      prm.declare_entry("Bucket size",
                        Patterns::Tools::to_string(d.bucket_size),
                        NumberPattern::between(0, largest_number),
                        "Edge of a bucket as a multiple of the median facet "
                        "size; 0 chooses it from the data. `uniform buckets` "
                        "raises a value below the search radius and says so; "
                        "with `adaptive buckets` a bucket holds the facets of "
                        "a patch of this edge.");
      prm.declare_entry("Bucket capacity", std::to_string(d.capacity),
                        Patterns::Integer(0, 4096),
                        "`adaptive buckets`: most facets in a bucket; 0 "
                        "leaves it to `Bucket size`.");
      prm.declare_entry("Reach", Patterns::Tools::to_string(d.reach),
                        NumberPattern::between(0, largest_number),
                        "Length within which a facet is a candidate; the "
                        "larger of this and `Relative reach` counts.");
      prm.declare_entry("Relative reach",
                        Patterns::Tools::to_string(d.relative_reach),
                        NumberPattern::between(0, largest_number),
                        "The same as a multiple of the size of the facet.");
      prm.declare_entry("Skin", Patterns::Tools::to_string(d.skin),
                        NumberPattern::between(0, largest_number),
                        "Length by which lists of candidates are made too "
                        "long, so that they serve again after small motion. "
                        "0: the size of a facet where points move with the "
                        "bodies; else they are made anew after each motion.");
    }

    void declare_ranking(ParameterHandler &prm, const abut_detection_options &d)
    {
      prm.declare_entry("Facing angle", degrees(std::acos(-d.normal_cosine)),
                        NumberPattern::between(0, 180),
                        "Degrees within which two surfaces must face each "
                        "other, 0 being exactly opposed.");
      prm.declare_entry("Extension", Patterns::Tools::to_string(d.extension),
                        NumberPattern::between(0, largest_number),
                        "How far a node may lie beyond the border of the "
                        "primary surface and still be paired with a facet "
                        "there, as a multiple of the size of the facet.");
      prm.declare_entry("Self contact", d.self_contact ? "true" : "false",
                        Patterns::Bool(),
                        "Whether a surface may touch itself. A node is then "
                        "not paired with facets that share a node with its "
                        "own.");
      prm.declare_entry("Thickness", "", Patterns::Anything(),
                        "Thickness of bodies: one length, or lengths by "
                        "boundary id, `1: 0.2; *: 1` (* means all others; an "
                        "id is meant on each body that has it). A "
                        "node deeper than half of it is on the wrong side and "
                        "not paired. Empty: no limit.");
    }

    /** The number that is all of @p text; throws. */
    double number(const std::string &text, const std::string &entry)
    {
      try
      {
        // Hexadecimal digits do not match.
        if (Patterns::Double().match(Utilities::trim(text)))
          return Utilities::string_to_double(Utilities::trim(text));
      }
      catch (const dealii::ExceptionBase &)
      {
      }
      AssertThrow(false,
                  dealii::ExcMessage("Search/Thickness: '" + entry
                                     + "' is not of the form 'length' "
                                       "or 'id: length'."
                                     + (entry.find(',') == std::string::npos
                                            ? ""
                                            : " Is it a decimal comma?")));
      return 0;
    }

    void parse_thickness(const std::string &text, SearchParameters &result)
    {
      result.thickness.clear();
      result.other_thickness.reset();
      for (const std::string &entry : Utilities::split_string_list(text, ';'))
      {
        if (entry.empty())
          continue;
        const std::size_t colon = entry.find(':');
        const std::string id = colon == std::string::npos
                                   ? "*"
                                   : Utilities::trim(entry.substr(0, colon));
        const double value = number(
            entry.substr(colon == std::string::npos ? 0 : colon + 1), entry);
        AssertThrow(value > 0 && value <= largest_number,
                    dealii::ExcMessage("Search/Thickness: '" + entry
                                       + "': a thickness is positive."));
        if (id == "*")
          result.other_thickness = value;
        else
        {
          const double group = number(id, entry);
          AssertThrow(group >= 0 && group == std::floor(group)
                          && group <= std::numeric_limits<std::int32_t>::max(),
                      dealii::ExcMessage("Search/Thickness: '" + entry
                                         + "': an id is a whole number."));
          result.thickness[static_cast<std::int32_t>(group)] = value;
        }
      }
    }
  } // namespace

  void SearchParameters::declare_parameters(ParameterHandler &prm)
  {
    const abut_detection_options defaults = abut_detection_defaults();
    const abut_surface_data surface = abut_surface_data_defaults();
    prm.enter_subsection("Search");
    declare_lists(prm, defaults.search);
    declare_ranking(prm, defaults);
    prm.declare_entry("Feature angle", degrees(surface.feature_angle),
                      NumberPattern::between(0.1, 180),
                      "Degrees by which the normal turns across an edge of "
                      "the body; nodal normals there are weighted by angle "
                      "instead of area.");
    prm.declare_entry("Check orientation",
                      surface.check_orientation ? "true" : "false",
                      Patterns::Bool(),
                      "Whether a surface with facets that are inverted with "
                      "respect to their neighbours is refused.");
    prm.leave_subsection();
  }

  void SearchParameters::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Search");
    abut_search_options &lists = detection.search;
    abut_search_find(prm.get("Algorithm").c_str(), &lists.algorithm);
    lists.bucket_size = prm.get_double("Bucket size");
    lists.capacity =
        static_cast<std::int32_t>(prm.get_integer("Bucket capacity"));
    lists.reach = prm.get_double("Reach");
    lists.relative_reach = prm.get_double("Relative reach");
    lists.skin = prm.get_double("Skin");
    detection.normal_cosine =
        -std::cos(prm.get_double("Facing angle") * degree);
    detection.extension = prm.get_double("Extension");
    detection.self_contact = prm.get_bool("Self contact");
    feature_angle = prm.get_double("Feature angle") * degree;
    check_orientation = prm.get_bool("Check orientation");
    const std::string lengths = prm.get("Thickness");
    prm.leave_subsection();
    parse_thickness(lengths, *this);
  }

  GroupThicknesses SearchParameters::group_thicknesses(
      const std::set<std::int32_t> &groups) const
  {
    GroupThicknesses result;
    for (const std::int32_t group : groups)
    {
      const auto own = thickness.find(group);
      if (own == thickness.end() && !other_thickness)
        continue;
      result.groups.push_back(group);
      result.values.push_back(own != thickness.end() ? own->second
                                                     : *other_thickness);
    }
    return result;
  }
} // namespace abut

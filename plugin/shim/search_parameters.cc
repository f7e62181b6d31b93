// SPDX-License-Identifier: LGPL-2.1-or-later
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/search_parameters.h>
#include <abut/dealii/text_pattern.h>

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
      const NumberPattern size = NumberPattern::between(0, largest_number);
      parameter::declare(
          prm, "Algorithm", abut_search_name(d.algorithm),
          Patterns::Selection(algorithm_names()), parameter::advanced(),
          "Search for facets near a node. All algorithms find the same pairs. "
          "all pairs: each facet for each node. uniform buckets: cells of one "
          "size. adaptive buckets: nested cells that follow the sizes of the "
          "facets.");
      parameter::declare(
          prm, "Bucket size", "auto", OrWord(size, "auto"),
          parameter::expert("median facet size", "4"),
          "Edge of a bucket. auto: chosen from the data. uniform buckets: "
          "raised to the search radius if smaller, with a note in the report. "
          "adaptive buckets: a bucket has the facets of a patch of this edge.");
      parameter::declare(prm, "Bucket capacity", "auto",
                         OrWord(Patterns::Integer(1, 4096), "auto"),
                         parameter::expert("facets", "32"),
                         "adaptive buckets: largest number of facets in a "
                         "bucket. auto: by `Bucket size`.");
      parameter::declare(
          prm, "Reach", "none", OrWord(size, "none"),
          parameter::expert("length", "0.2"),
          "Distance within which a facet is a candidate. The larger of this "
          "and `Relative reach` counts.");
      parameter::declare(prm, "Relative reach",
                         Patterns::Tools::to_string(d.relative_reach), size,
                         parameter::expert("facet size", "1"),
                         "Distance within which a facet is a candidate, "
                         "relative to its size.");
      parameter::declare(
          prm, "Skin", "auto", OrWord(size, "auto"),
          parameter::expert("length", "0.1"),
          "Length added to the reach of candidate lists, so that they stay "
          "valid after small motion. auto: the size of a facet where contact "
          "points follow the deformation; else lists are built again after "
          "each motion.");
    }

    void declare_ranking(ParameterHandler &prm, const abut_detection_options &d)
    {
      parameter::declare(
          prm, "Facing angle", degrees(std::acos(-d.normal_cosine)),
          NumberPattern::between(0, 180), parameter::expert("degrees", "60"),
          "Largest angle between the normals of paired surfaces; 0 is exactly "
          "opposed.");
      parameter::declare(
          prm, "Extension", Patterns::Tools::to_string(d.extension),
          NumberPattern::between(0, largest_number),
          parameter::expert("facet size", "0.5"),
          "Distance of a node beyond the border of the primary surface up to "
          "which it is paired with a facet there.");
      parameter::declare(
          prm, "Self contact", d.self_contact ? "true" : "false",
          Patterns::Bool(), parameter::advanced(),
          "Whether a surface may touch itself. Nodes are then not paired with "
          "facets that share a node with their own.");
      parameter::declare(
          prm, "Thickness", "",
          TextPattern("a number, or numbers by boundary id"),
          parameter::advanced("length", "1: 0.2; *: 1"),
          "Thickness of bodies: one length, or lengths by boundary id; * "
          "stands for all other ids. Nodes deeper than half of it are on the "
          "wrong side and not paired. Empty: no limit.");
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
    parameter::declare(prm, "Feature angle", degrees(surface.feature_angle),
                       NumberPattern::between(0.1, 180),
                       parameter::expert("degrees", "30"),
                       "Rotation of the normal across an edge from which nodal "
                       "normals are weighted by angle instead of area.");
    parameter::declare(prm, "Check orientation",
                       surface.check_orientation ? "true" : "false",
                       Patterns::Bool(), parameter::expert(),
                       "Whether surfaces with facets inverted relative to "
                       "their neighbours are rejected.");
    prm.leave_subsection();
  }

  void SearchParameters::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Search");
    abut_search_options &lists = detection.search;
    abut_search_find(prm.get("Algorithm").c_str(), &lists.algorithm);
    lists.bucket_size = parameter::number_or_zero(prm, "Bucket size");
    lists.capacity = static_cast<std::int32_t>(
        parameter::number_or_zero(prm, "Bucket capacity"));
    lists.reach = parameter::number_or_zero(prm, "Reach");
    lists.relative_reach = prm.get_double("Relative reach");
    lists.skin = parameter::number_or_zero(prm, "Skin");
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

// SPDX-License-Identifier: LGPL-2.1-or-later

#include "boundary_expressions.h"

#include "input_error.h"

#include <algorithm>
#include <cctype>

namespace abut::app
{
  namespace
  {
    using Id = dealii::types::boundary_id;

    std::string join(const std::vector<Id> &ids)
    {
      std::string text;
      for (const Id id : ids)
        text += (text.empty() ? "" : ", ") + std::to_string(id);
      return text;
    }

    Id parse_id(const std::string &text, const std::string &parameter)
    {
      const bool digits =
          !text.empty() && text.size() <= 9
          && std::all_of(text.begin(), text.end(),
                         [](unsigned char c) { return std::isdigit(c); });
      if (!digits
          || std::stoul(text) >= dealii::numbers::internal_face_boundary_id)
        throw InputError(parameter,
                         "'" + text
                             + "' is not a boundary id; ids are whole numbers "
                               "from 0, or * for all.");
      return Id(std::stoul(text));
    }

    void check_id(const Id id, const std::vector<Id> &existing,
                  const std::string &parameter)
    {
      if (std::find(existing.begin(), existing.end(), id) == existing.end())
        throw InputError(parameter, "the mesh has no boundary id "
                                        + std::to_string(id) + "; it has "
                                        + join(existing) + ".");
    }
  } // namespace

  template <int dim>
  BoundaryExpressions<dim>::BoundaryExpressions(const std::string &text,
                                                const std::string &parameter,
                                                const unsigned int n_components)
      : parameter(parameter)
  {
    std::set<Id> seen;
    bool seen_others = false;
    // With several components the semicolon separates those, so that a new
    // entry begins only where a part has a colon.
    std::vector<std::string> parts;
    for (const std::string &part : split_list(text, ';'))
      if (n_components > 1 && !parts.empty()
          && split_list(part, ':').size() < 2)
        parts.back() += "; " + part;
      else
        parts.push_back(part);
    for (const std::string &part : parts)
    {
      if (part.empty())
        continue;
      const std::size_t colon = part.find(':');
      if (colon == std::string::npos)
        throw InputError(parameter,
                         "'" + part
                             + "' has no boundary id; write 'id: formula', "
                               "entries separated by ';', or '*: formula'.");
      Entry entry = {false, {}, nullptr};
      for (const std::string &word : split_list(part.substr(0, colon), ','))
        if (word == "*")
          entry.others = true;
        else
          entry.ids.insert(parse_id(word, parameter));
      for (const Id id : entry.ids)
        if (!seen.insert(id).second)
          throw InputError(parameter, "boundary id " + std::to_string(id)
                                          + " stands twice.");
      if (entry.others && seen_others)
        throw InputError(parameter, "* stands twice.");
      if (!entry.others && entry.ids.empty())
        throw InputError(parameter, "'" + part + "' has no boundary id.");
      seen_others = seen_others || entry.others;
      entry.expression = std::make_unique<Expression<dim>>(
          part.substr(colon + 1), parameter, n_components);
      entries.push_back(std::move(entry));
    }
  }

  template <int dim>
  std::map<Id, const dealii::Function<dim> *>
  BoundaryExpressions<dim>::functions(
      const dealii::Triangulation<dim> &triangulation,
      const std::set<Id> &without) const
  {
    const std::vector<Id> existing = triangulation.get_boundary_ids();
    std::map<Id, const dealii::Function<dim> *> result;
    for (const Entry &entry : entries)
      if (entry.others)
        for (const Id id : existing)
          if (without.count(id) == 0)
            result[id] = entry.expression.get();
    for (const Entry &entry : entries)
      for (const Id id : entry.ids)
      {
        check_id(id, existing, parameter);
        result[id] = entry.expression.get();
      }
    return result;
  }

  template <int dim> void BoundaryExpressions<dim>::set_time(const double time)
  {
    for (const Entry &entry : entries)
      entry.expression->set_time(time);
  }

  template <int dim> bool BoundaryExpressions<dim>::depends_on_time() const
  {
    return std::any_of(entries.begin(), entries.end(),
                       [](const Entry &entry)
                       { return entry.expression->depends_on_time(); });
  }

  template <int dim>
  std::set<Id>
  parse_boundary_ids(const std::string &text, const std::string &parameter,
                     const dealii::Triangulation<dim> &triangulation)
  {
    const std::vector<Id> existing = triangulation.get_boundary_ids();
    std::set<Id> ids;
    for (const std::string &word : split_list(text, ','))
      if (word == "*")
        ids.insert(existing.begin(), existing.end());
      else
      {
        const Id id = parse_id(word, parameter);
        check_id(id, existing, parameter);
        ids.insert(id);
      }
    return ids;
  }

  template class BoundaryExpressions<2>;
  template class BoundaryExpressions<3>;
  template std::set<Id> parse_boundary_ids<2>(const std::string &,
                                              const std::string &,
                                              const dealii::Triangulation<2> &);
  template std::set<Id> parse_boundary_ids<3>(const std::string &,
                                              const std::string &,
                                              const dealii::Triangulation<3> &);
} // namespace abut::app

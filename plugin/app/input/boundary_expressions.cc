// SPDX-License-Identifier: LGPL-2.1-or-later

#include "boundary_expressions.h"

#include "input_error.h"
#include "number_text.h"

#include <deal.II/base/utilities.h>

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
                                                const unsigned int n_components,
                                                const bool may_be_free)
      : parameter(parameter)
  {
    std::set<Id> seen;
    bool seen_others = false;
    for (const std::string &part : split_list(text, ';'))
    {
      if (part.empty())
        continue;
      const std::size_t colon = part.find(':');
      if (colon == std::string::npos)
        throw InputError(parameter,
                         "'" + part
                             + "' has no boundary id; write 'id: formula', "
                               "entries separated by ';', or '*: formula'.");
      Entry entry = {false, {}, nullptr, {}, nullptr};
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
      set_formulas(entry, dealii::Utilities::trim(part.substr(colon + 1)),
                   n_components, may_be_free);
      entry.checked =
          std::make_unique<CheckedExpression<dim>>(*entry.expression);
      entries.push_back(std::move(entry));
    }
  }

  template <int dim>
  void BoundaryExpressions<dim>::set_formulas(Entry &entry,
                                              const std::string &text,
                                              const unsigned int n_components,
                                              const bool may_be_free) const
  {
    if (n_components == 1)
    {
      entry.expression = std::make_unique<Expression<dim>>(text, parameter);
      entry.components = dealii::ComponentMask(1, true);
      return;
    }
    const std::vector<std::string> words = split_list(text, ',');
    if (words.size() != n_components)
      throw InputError(parameter,
                       "'" + text + "' is not " + std::to_string(n_components)
                           + " formulas separated by commas"
                           + (may_be_free ? ", or the word free." : ".")
                           + misread_hint(text));
    std::string formulas;
    std::vector<bool> counts(n_components, true);
    for (unsigned int c = 0; c < n_components; ++c)
    {
      counts[c] = !may_be_free || words[c] != "free";
      formulas += (c > 0 ? "; " : "") + (counts[c] ? words[c] : "0");
    }
    entry.expression =
        std::make_unique<Expression<dim>>(formulas, parameter, n_components);
    entry.components = dealii::ComponentMask(counts);
  }

  template <int dim>
  std::map<Id, BoundaryCondition<dim>>
  BoundaryExpressions<dim>::conditions(const std::vector<Id> &existing,
                                       const std::set<Id> &without) const
  {
    std::map<Id, BoundaryCondition<dim>> result;
    const auto set = [&result](const Id id, const Entry &entry)
    {
      result[id] = {entry.expression.get(), entry.components,
                    entry.checked.get()};
    };
    for (const Entry &entry : entries)
      if (entry.others)
        for (const Id id : existing)
          if (without.count(id) == 0)
            set(id, entry);
    for (const Entry &entry : entries)
      for (const Id id : entry.ids)
      {
        check_id(id, existing, parameter);
        set(id, entry);
      }
    return result;
  }

  template <int dim>
  std::map<Id, const dealii::Function<dim> *>
  BoundaryExpressions<dim>::functions(
      const dealii::Triangulation<dim> &triangulation,
      const std::set<Id> &without) const
  {
    std::map<Id, const dealii::Function<dim> *> result;
    for (const auto &[id, condition] :
         conditions(triangulation.get_boundary_ids(), without))
      result[id] = condition.checked;
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

  template <int dim> std::set<Id> BoundaryExpressions<dim>::named() const
  {
    std::set<Id> ids;
    for (const Entry &entry : entries)
      ids.insert(entry.ids.begin(), entry.ids.end());
    return ids;
  }

  std::set<Id> parse_boundary_ids(const std::string &text,
                                  const std::string &parameter,
                                  const std::vector<Id> &existing)
  {
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
} // namespace abut::app

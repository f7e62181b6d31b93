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
  } // namespace

  template <int dim>
  BoundaryExpressions<dim>::BoundaryExpressions(const std::string &text,
                                                const std::string &parameter,
                                                const unsigned int n_components,
                                                const bool may_be_free)
      : parameter(parameter)
  {
    std::set<std::string> seen;
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
        {
          BoundaryNames::check_word(word, parameter);
          if (!seen.insert(word).second)
            throw InputError(parameter,
                             "boundary id " + word + " stands twice.");
          entry.words.push_back(word);
        }
      if (entry.others && seen_others)
        throw InputError(parameter, "* stands twice.");
      if (!entry.others && entry.words.empty())
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
  BoundaryExpressions<dim>::conditions(const BoundaryNames &existing,
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
        for (const Id id : existing.ids())
          if (without.count(id) == 0)
            set(id, entry);
    std::map<Id, std::string> word_of;
    for (const Entry &entry : entries)
      for (const std::string &word : entry.words)
        for (const Id id : existing.find(word, parameter))
        {
          const auto [other, is_new] = word_of.emplace(id, word);
          if (!is_new)
            throw InputError(parameter, "'" + other->second + "' and '" + word
                                            + "' have the boundary id "
                                            + std::to_string(id)
                                            + " in common; each facet can have "
                                              "one formula only.");
          set(id, entry);
        }
    return result;
  }

  template <int dim>
  std::map<Id, const dealii::Function<dim> *>
  BoundaryExpressions<dim>::functions(const BoundaryNames &existing,
                                      const std::set<Id> &without) const
  {
    std::map<Id, const dealii::Function<dim> *> result;
    for (const auto &[id, condition] : conditions(existing, without))
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

  template <int dim> bool BoundaryExpressions<dim>::is_constant() const
  {
    return std::all_of(entries.begin(), entries.end(),
                       [](const Entry &entry)
                       { return entry.expression->is_wholly_constant(); });
  }

  template <int dim>
  std::set<Id>
  BoundaryExpressions<dim>::named(const BoundaryNames &existing) const
  {
    std::set<Id> ids;
    for (const Entry &entry : entries)
      for (const std::string &word : entry.words)
        for (const Id id : existing.find(word, parameter))
          ids.insert(id);
    return ids;
  }

  std::set<Id> parse_boundary_ids(const std::string &text,
                                  const std::string &parameter,
                                  const BoundaryNames &existing)
  {
    std::set<Id> ids;
    for (const std::string &word : split_list(text, ','))
      if (word == "*")
        ids.insert(existing.ids().begin(), existing.ids().end());
      else
        for (const Id id : existing.find(word, parameter))
          ids.insert(id);
    return ids;
  }

  template class BoundaryExpressions<2>;
  template class BoundaryExpressions<3>;
} // namespace abut::app

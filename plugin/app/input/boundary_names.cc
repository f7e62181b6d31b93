// SPDX-License-Identifier: LGPL-2.1-or-later
#include "boundary_names.h"

#include "input_error.h"
#include "number_text.h"
#include "parameters.h"

#include <algorithm>
#include <iterator>

namespace abut::app
{
  BoundaryNames::BoundaryNames(const std::vector<Id> &ids,
                               const std::vector<Set> &sets,
                               const std::map<std::string, std::string> &other)
      : all(ids), sets(sets), other(other)
  {
    for (Set &set : this->sets)
    {
      std::set<Id> left;
      for (const Id id : set.ids)
        if (std::find(all.begin(), all.end(), id) != all.end())
          left.insert(id);
      set.ids = left;
    }
  }

  std::vector<BoundaryNames::Set> BoundaryNames::named() const
  {
    std::vector<Set> result;
    std::copy_if(sets.begin(), sets.end(), std::back_inserter(result),
                 [](const Set &set) { return !set.name.empty(); });
    return result;
  }

  void BoundaryNames::check_word(const std::string &word,
                                 const std::string &parameter)
  {
    constexpr std::size_t most_digits = 9;
    if (word.empty() || word[0] == '-' || word[0] == '+'
        || (are_digits(word) && word.size() > most_digits))
      throw InputError(parameter,
                       "'" + word
                           + "' is not a boundary id; ids are whole numbers "
                             "from 0, or * for all.");
  }

  const BoundaryNames::Set *
  BoundaryNames::find_set(const std::string &word,
                          const std::string &parameter) const
  {
    const bool is_id = are_digits(word);
    const Set *found = nullptr;
    for (const Set &set : sets)
    {
      if (is_id ? set.id == std::stoul(word) : set.name == word)
        return &set;
      if (is_id || set.name.empty() || lower_case(set.name) != lower_case(word))
        continue;
      if (found != nullptr)
        throw InputError(parameter, "'" + word + "' may be '" + found->name
                                        + "' or '" + set.name + "'.");
      found = &set;
    }
    return found;
  }

  std::set<BoundaryNames::Id>
  BoundaryNames::find(const std::string &word,
                      const std::string &parameter) const
  {
    check_word(word, parameter);
    const Set *const set = find_set(word, parameter);
    if (set != nullptr)
    {
      if (set->ids.empty())
        throw InputError(
            parameter,
            "no facet is left of the set '" + word
                + "': Boundary ids assigns other ids to all of them.");
      return set->ids;
    }
    if (are_digits(word))
    {
      const Id id = static_cast<Id>(std::stoul(word));
      if (std::find(all.begin(), all.end(), id) != all.end())
        return {id};
      throw InputError(parameter, "the mesh has no boundary id " + word
                                      + list("; it has "));
    }
    const auto reason = other.find(word);
    if (reason != other.end())
      throw InputError(parameter, "'" + word + "' " + reason->second
                                      + list("; the mesh has "));
    if (named().empty())
      throw InputError(parameter,
                       "'" + word
                           + "' is not a boundary id; ids are whole numbers "
                             "from 0, or * for all.");
    std::vector<std::string> names;
    for (const Set &each : named())
      names.push_back(each.name);
    throw InputError(parameter, "the mesh has no boundary '" + word + "'"
                                    + list("; it has ")
                                    + did_you_mean(word, names));
  }

  std::string BoundaryNames::list(const std::string &begin) const
  {
    std::string text;
    for (const Id id : all)
      text += (text.empty() ? begin : ", ") + std::to_string(id);
    text += ".";
    std::string names;
    for (const Set &set : named())
      names += (names.empty() ? " Names: " : ", ") + set.name;
    return text + names + (names.empty() ? "" : ".");
  }

  std::string BoundaryNames::names_of(const Id id) const
  {
    std::string text;
    for (const Set &set : sets)
      if (!set.name.empty() && set.ids.count(id) > 0)
        text += (text.empty() ? "'" : ", '") + set.name + "'";
    return text;
  }

  std::string BoundaryNames::describe(const Id id) const
  {
    const std::string names = names_of(id);
    return "boundary " + std::to_string(id)
           + (names.empty() ? "" : " (" + names + ")");
  }
} // namespace abut::app

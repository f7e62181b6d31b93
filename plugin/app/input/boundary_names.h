// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BOUNDARY_NAMES_H
#define ABUT_APP_BOUNDARY_NAMES_H

#include <deal.II/base/types.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** Boundary ids of a mesh, and the words by which a scene file may name them:
   * the one place where words become ids. A word is the number or the name of a
   * set of facets, of one or several ids, or else the number of an id. */
  class BoundaryNames
  {
  public:
    using Id = dealii::types::boundary_id;

    /** Facets that a mesh file gives a number and perhaps a name. */
    struct Set
    {
      std::string name; /**< empty: a number only */
      Id id;
      std::set<Id> ids; /**< of its facets */
    };

    /** @param ids those of the mesh; what sets have beyond them counts not
     * @param other names that do not mean facets, with the reason ("is a
     * physical volume") */
    BoundaryNames(const std::vector<Id> &ids = {},
                  const std::vector<Set> &sets = {},
                  const std::map<std::string, std::string> &other = {});

    /** All ids, sorted. */
    const std::vector<Id> &ids() const
    {
      return all;
    }

    /** Sets with names, for reports. */
    std::vector<Set> named() const;

    /** Ids that a word means. A name need not have the right case if there is
     * no other. Throws InputError that names @p parameter and lists what there
     * is. */
    std::set<Id> find(const std::string &word,
                      const std::string &parameter) const;

    /** "'top'", or "'top', 'all'": the sets that an id belongs to; or empty. */
    std::string names_of(Id id) const;

    /** "boundary 3 ('top', 'all')": an id with these. */
    std::string describe(Id id) const;

    /** Throw InputError if a word can be no number of an id and no name. */
    static void check_word(const std::string &word,
                           const std::string &parameter);

  private:
    const Set *find_set(const std::string &word,
                        const std::string &parameter) const;
    std::string list(const std::string &begin) const;

    std::vector<Id> all;
    std::vector<Set> sets;
    std::map<std::string, std::string> other;
  };
} // namespace abut::app

#endif

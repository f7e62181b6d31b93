// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RECORD_FACETS_H
#define ABUT_APP_RECORD_FACETS_H

#include "mesh_record.h"

#include <unordered_map>

namespace abut::app
{
  using NodeNumbers = std::unordered_map<std::int64_t, std::size_t>;
  using ElementNumbers = std::unordered_map<std::int64_t, std::size_t>;

  constexpr unsigned int no_vertex = static_cast<unsigned int>(-1);

  /** A file whose cells are in a record already. */
  struct RecordSource
  {
    const FileMesh &file;
    const unsigned int dim;
    const NodeNumbers &node_of;                 /**< index by number */
    const ElementNumbers &element_of;           /**< index by number */
    const std::vector<unsigned int> &vertex_of; /**< by node, or no_vertex */
    const std::vector<std::size_t> &cells;      /**< elements */
    /** Elements that are cells a second time, with their first one. */
    const std::unordered_map<std::size_t, std::size_t> &repeated;
    const bool is_whole; /**< else other cells of the file are left out */
  };

  /** Find the boundary of the cells, the sets of its facets and of the cells,
   * and facets at the same place that are not connected. Throws MeshFileError
   * as make_mesh_record() does. */
  void add_facets(const RecordSource &source, MeshRecord &record);

  /** " in line 12". */
  std::string in_line(std::size_t line);

  /** "the element 5 in line 12". */
  std::string words_of(const FileElement &element);
} // namespace abut::app

#endif

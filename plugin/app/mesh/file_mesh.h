// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FILE_MESH_H
#define ABUT_APP_FILE_MESH_H

/** @file
 * The contents of a mesh file as they stand there: nodes, elements, sets, each
 * with its number. The readers of all formats make a FileMesh, which
 * mesh_record.h checks and makes a mesh of. Plain C++, nothing of deal.II.
 */

#include <array>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** The mistake in a mesh file: a sentence or its end, with the line. */
  struct MeshFileError : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  enum class CellShape
  {
    line,
    triangle,
    quadrilateral,
    tetrahedron,
    hexahedron
  };

  /** Corners, edges and faces of a shape; the corners are in the order of VTK,
   * gmsh and Abaqus. */
  struct ShapeInfo
  {
    const char *name, *plural;
    unsigned int dim, n_corners;
    std::vector<std::array<unsigned int, 2>> edges;
    /** Faces of dimension dim - 1 in the order of Abaqus' S1, S2, ...; their
     * corners go around the inward normal. */
    std::vector<std::vector<unsigned int>> faces;
  };

  const ShapeInfo &shape_info(CellShape shape);

  struct FileNode
  {
    std::int64_t number;
    std::size_t line; /**< in the file */
    std::array<double, 3> place;
  };

  struct FileElement
  {
    std::int64_t number;
    std::size_t line;
    CellShape shape;
    /** Numbers of the corners, then for degree 2 of the nodes at the middle of
     * the edges in their order in ShapeInfo, then of those inside faces and
     * cell. */
    std::vector<std::int64_t> nodes;
  };

  /** All faces of a cell on the boundary. */
  constexpr unsigned int every_side = 99;

  /** A physical group of gmsh, or a set or surface of Abaqus. */
  struct FileSet
  {
    std::string name;      /**< empty: it has a number only */
    unsigned int id = 0;   /**< 0: numbered in the order of the file */
    const char *kind = ""; /**< "node set", for messages */
    std::vector<std::int64_t> elements; /**< cells or facets */
    std::vector<std::pair<std::int64_t, unsigned int>>
        sides; /**< of elements: face from 0, or every_side */
    std::vector<std::int64_t> nodes; /**< facets with all corners in them */
    /** Whether it was made of ranges of numbers, not all of which need exist.
     */
    bool has_ranges = false;
  };

  struct FileMesh
  {
    std::vector<FileNode> nodes;
    std::vector<FileElement> elements;
    std::vector<FileSet> sets;
    std::string part; /**< name of all of it; or empty */
    /** Whether an element may stand once for each of its sets, with another
     * number, as in gmsh's format 2. */
    bool repeats_elements = false;
  };

  /** The first line of a file that is not empty; empty if it has none. */
  std::string first_line(const std::filesystem::path &file);

  /** The lines of a text file that are not empty, and their words. */
  class FileLines
  {
  public:
    /** Read the file. Throws MeshFileError. */
    explicit FileLines(const std::filesystem::path &file);

    /** Go to the next line that is not empty; false at the end. */
    bool next();

    /** Go to the beginning. */
    void rewind()
    {
      place = line = 0;
    }

    /** Number of the line, from 1. */
    std::size_t number() const
    {
      return line;
    }

    /** The line without blanks at its ends. */
    const std::string &text() const
    {
      return current;
    }

    /** Its words: parts between blanks, or between commas, without blanks
     * around them (a comma at the end begins no word). */
    std::vector<std::string> words(char separator = ' ') const;

    /** Throw MeshFileError "in line 12, WHAT". */
    [[noreturn]] void complain(const std::string &what) const;

    /** A finite number; Fortran's exponents (1.D+3) are numbers, too. */
    double real(const std::string &word) const;

    /** A whole number. */
    std::int64_t whole(const std::string &word) const;

    /** Several, of all words from the one at @p first. */
    std::vector<std::int64_t> wholes(const std::vector<std::string> &words,
                                     std::size_t first = 0) const;

  private:
    std::string bytes;
    std::string current;
    std::size_t place = 0, line = 0;
  };
} // namespace abut::app

#endif

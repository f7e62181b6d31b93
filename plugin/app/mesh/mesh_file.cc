// SPDX-License-Identifier: LGPL-2.1-or-later
/* What a file is of is seen by its first line where it is gmsh's or Abaqus',
 * and by its ending else: UCD files have the ending inp, too.
 *
 * deal.II's readers stop at the first word that is no number, and then report
 * what they miss behind it. So the reason is looked for in the words of the
 * file, whatever its format: numbers that are not finite, decimal commas,
 * coordinates that are so large that cells lose their digits. */
#include "mesh_file.h"

#include "abaqus_file.h"
#include "app/input/dealii_message.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "gmsh_file.h"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>

namespace abut::app
{
  namespace
  {
    /** Larger than coordinates are, whatever the unit of length. */
    constexpr double largest_coordinate = 1e9;

    using Visit = std::function<void(const std::string &, std::size_t)>;

    /** Call @p visit with each word of a text file and the number of its line.
     */
    void for_each_word(const std::filesystem::path &path, const Visit &visit)
    {
      std::ifstream in(path);
      std::string line, word;
      for (std::size_t number = 1; std::getline(in, line); ++number)
      {
        std::istringstream words(line);
        while (words >> word)
          visit(word, number);
      }
    }

    /** Whether all of @p word is a number of strtod, which knows nan and inf.
     */
    bool is_number(const std::string &word, double &value)
    {
      char *end = nullptr;
      value = std::strtod(word.c_str(), &end);
      return end != word.c_str() && *end == '\0';
    }

    bool has_decimal_comma(std::string word)
    {
      const std::size_t comma = word.find(',');
      double value;
      if (comma == std::string::npos || comma + 1 == word.size())
        return false;
      word[comma] = '.';
      return is_number(word, value);
    }

    /** The first word that is not a number or not finite, as an error; else
     * empty. */
    std::string wrong_number_in(const std::filesystem::path &path)
    {
      std::string found;
      bool is_abaqus = false;
      for_each_word(path,
                    [&](const std::string &word, const std::size_t line)
                    {
                      double value;
                      const bool is_finite =
                          !is_number(word, value) || std::isfinite(value);
                      is_abaqus = is_abaqus || word[0] == '*';
                      const bool has_comma =
                          !is_abaqus && has_decimal_comma(word);
                      if (!found.empty() || (is_finite && !has_comma))
                        return;
                      found =
                          "'" + word + "' in line " + std::to_string(line)
                          + (has_comma ? " is not a number: a decimal comma?"
                                       : " is not a finite number.");
                    });
      return found;
    }

    bool contains(const std::string &text, const std::string &words)
    {
      return text.find(words) != std::string::npos;
    }

    /** Why deal.II cannot read the file. */
    template <int dim>
    std::string reason(const std::filesystem::path &path,
                       const std::exception &error)
    {
      const std::string wrong_number = wrong_number_in(path);
      if (!wrong_number.empty())
        return wrong_number;
      const std::string message = dealii_message(error);
      if (contains(message, "No vertices given")
          || contains(message, "No cells given")
          || contains(message, "did not find any cells"))
        return std::string("it has no cells, which are ")
               + (dim == 2 ? "quadrilaterals or triangles."
                           : "hexahedra or tetrahedra.");
      if (contains(message, "negative"))
        return "some of its cells are folded, or have their corners in the "
               "opposite order of other cells."
               + large_number_hint(path);
      if (contains(message, "some condition which the author"))
        return "its cells do not make a mesh: some have no size, or overlap."
               + large_number_hint(path);
      // deal.II's words about it are a page of possible reasons.
      if (dynamic_cast<const dealii::StandardExceptions::ExcIO *>(&error)
          != nullptr)
        return "it ends too early, or has another format than its ending.";
      return message;
    }

    /** deal.II reads beyond the end of its vertices if a cell of a VTK file has
     * a vertex that does not exist. */
    void check_vtk_cells(const std::filesystem::path &path,
                         const std::string &parameter)
    {
      std::string keyword;
      double n_points = 0., n_words = 0., n_corners = 0.;
      std::size_t place = 0;
      const auto visit = [&](const std::string &word, const std::size_t line)
      {
        double value = 0.;
        if (word == "POINTS" || word == "CELLS" || word == "CELL_TYPES")
        {
          keyword = word;
          place = 0;
          return;
        }
        if (keyword.empty() || !is_number(word, value))
          return;
        ++place;
        if (keyword == "POINTS" && place == 1)
          n_points = value;
        if (keyword != "CELLS" || place == 1)
          return;
        if (place == 2)
          n_words = value;
        else if (n_corners == 0. && place - 3 < n_words)
          n_corners = value;
        else if (n_corners > 0.)
        {
          --n_corners;
          if (!(value >= 0. && value < n_points))
            throw InputError(parameter,
                             "the mesh file '" + path.string()
                                 + "' has a cell in line "
                                 + std::to_string(line) + " with the vertex "
                                 + word + "; it has the vertices 0 to "
                                 + short_number(n_points - 1.) + ".");
        }
      };
      for_each_word(path, visit);
    }

    template <int dim>
    typename dealii::GridIn<dim>::Format
    format_of(const std::filesystem::path &path, const std::string &parameter)
    {
      std::string extension = path.extension().string();
      extension = extension.empty() ? "" : extension.substr(1);
      try
      {
        return dealii::GridIn<dim>::parse_format(extension);
      }
      catch (const std::exception &)
      {
        throw InputError(parameter,
                         "the mesh file '" + path.string()
                             + "' has an unknown ending; use msh (gmsh), inp, "
                               "ucd, vtk, vtu, unv or xda.");
      }
    }

    /** Place of a corner of a quadrilateral or hexahedron in deal.II's order.
     * GeometryInfo has left-handed hexahedra in deal.II 9.4 and right-handed
     * ones in 9.6. */
    template <int dim> unsigned int place_of_corner(const unsigned int c)
    {
      constexpr unsigned int of_quadrilateral[] = {0, 1, 3, 2},
                             of_hexahedron[] = {2, 3, 7, 6, 0, 1, 5, 4};
      return dim == 2 ? of_quadrilateral[c] : of_hexahedron[c];
    }
  } // namespace

  template <int dim> MeshDescription<dim> describe(const MeshRecord &record)
  {
    const ShapeInfo &info = shape_info(record.shape);
    const bool is_cube = info.n_corners == (1u << dim);
    MeshDescription<dim> result;
    for (const std::array<double, 3> &x : record.vertices)
    {
      result.vertices.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        result.vertices.back()[d] = x[d];
    }
    for (const RecordCell &cell : record.cells)
    {
      dealii::CellData<dim> data(info.n_corners);
      for (unsigned int c = 0; c < info.n_corners; ++c)
        data.vertices[is_cube ? place_of_corner<dim>(c) : c] = cell.corners[c];
      data.material_id = cell.material;
      result.cells.push_back(std::move(data));
    }
    for (const RecordFacet &facet : record.facets)
    {
      dealii::CellData<dim - 1> data(
          static_cast<unsigned int>(facet.corners.size()));
      data.vertices.assign(facet.corners.begin(), facet.corners.end());
      data.boundary_id = facet.boundary_id;
      if constexpr (dim == 2)
        result.faces.boundary_lines.push_back(std::move(data));
      else
        result.faces.boundary_quads.push_back(std::move(data));
    }
    if (is_cube)
      dealii::GridTools::consistently_order_cells(result.cells);
    for (const auto &[edge, place] : record.middles)
    {
      dealii::Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = place[d];
      add_middle(edge.first, result.vertices[edge.first], edge.second,
                 result.vertices[edge.second], x, result.middles);
    }
    return result;
  }

  namespace
  {
    template <int dim>
    MeshFileExtras<dim> use_record(const MeshRecord &record,
                                   dealii::Triangulation<dim> &triangulation)
    {
      MeshDescription<dim> mesh = describe<dim>(record);
      triangulation.create_triangulation(mesh.vertices, mesh.cells, mesh.faces);
      MeshFileExtras<dim> extras;
      for (const RecordSet &set : record.boundary_sets)
        extras.sets.push_back(
            {set.name, set.id, {set.ids.begin(), set.ids.end()}});
      extras.degree = record.degree;
      extras.other_names = record.other_sets;
      extras.body_names = record.body_names;
      extras.middles = std::move(mesh.middles);
      for (const std::string &warning : record.warnings)
        extras.warnings.emplace_back("File", warning);
      return extras;
    }

    /** Whether a first line is that of gmsh's formats 2 and 4; format 1 is left
     * to deal.II. */
    bool is_gmsh(const std::string &line)
    {
      return !line.empty() && line[0] == '$' && line != "$NOD";
    }
  } // namespace

  template <int dim>
  MeshFileExtras<dim> read_mesh_file(const std::filesystem::path &path,
                                     const std::string &parameter,
                                     const std::string &part,
                                     dealii::Triangulation<dim> &triangulation)
  {
    const auto complain = [&](const std::string &why)
    {
      throw InputError(parameter, "the mesh file '" + path.string()
                                      + "' cannot be read as a mesh in "
                                      + std::to_string(dim)
                                      + " dimensions: " + why);
    };
    std::ifstream in(path);
    if (!in || std::filesystem::is_directory(path))
      throw InputError(parameter, "the mesh file '" + path.string()
                                      + "' cannot be opened.");
    const std::string line = first_line(path);
    try
    {
      if (is_gmsh(line))
        return use_record(make_mesh_record(read_gmsh(path), dim, part),
                          triangulation);
      if (!line.empty() && line[0] == '*')
        return use_record(make_mesh_record(read_abaqus(path, part), dim, part),
                          triangulation);
    }
    catch (const MeshFileError &error)
    {
      complain(error.what());
    }
    catch (const std::exception &error)
    {
      complain(reason<dim>(path, error));
    }
    if (!part.empty())
      complain("it has no parts with names, which files of gmsh (formats 2 and "
               "4) and Abaqus have: leave Part empty.");
    const auto format = format_of<dim>(path, parameter);
    if (format == dealii::GridIn<dim>::vtk)
      check_vtk_cells(path, parameter);
    dealii::GridIn<dim> reader(triangulation);
    try
    {
      reader.read(in, format);
    }
    catch (const std::exception &error)
    {
      complain(reason<dim>(path, error));
    }
    return {};
  }

  std::string large_number_hint(const std::filesystem::path &path)
  {
    std::string largest;
    double size = largest_coordinate;
    std::size_t where = 0;
    for_each_word(path,
                  [&](const std::string &word, const std::size_t line)
                  {
                    double value;
                    if (!is_number(word, value) || !(std::abs(value) > size))
                      return;
                    largest = word;
                    size = std::abs(value);
                    where = line;
                  });
    if (largest.empty())
      return "";
    return " Its largest number is " + largest + ", in line "
           + std::to_string(where)
           + ": too large relative to the size of cells, or a mistake.";
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template MeshDescription<dim> describe<dim>(const MeshRecord &);             \
  template MeshFileExtras<dim> read_mesh_file<dim>(                            \
      const std::filesystem::path &, const std::string &, const std::string &, \
      dealii::Triangulation<dim> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

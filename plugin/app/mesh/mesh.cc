// SPDX-License-Identifier: LGPL-2.1-or-later

#include "mesh.h"

#include "curved_sides.h"

#include "app/input/collective.h"
#include "app/input/dealii_message.h"
#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "app/input/parameters.h"
#include "app/input/short_number.h"
#include "generator_arguments.h"
#include "mesh_checks.h"
#include "mesh_file.h"
#include "shim/sampling.h"

#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace abut::app
{
  namespace
  {
    /** While it lives, failed assertions of deal.II's debug library throw
     * instead of ending the program: what a user wrote may well violate them.
     */
    class AssertionsThrow
    {
    public:
      AssertionsThrow()
      {
        dealii::deal_II_exceptions::disable_abort_on_exception();
      }
      ~AssertionsThrow()
      {
        dealii::deal_II_exceptions::enable_abort_on_exception();
      }
      AssertionsThrow(const AssertionsThrow &) = delete;
      AssertionsThrow &operator=(const AssertionsThrow &) = delete;
    };

    template <int dim>
    void generate(const MeshParameters &parameters,
                  dealii::Triangulation<dim> &triangulation)
    {
      const std::string in_dimension =
          " in " + std::to_string(dim) + " dimensions";
      check_numbers(parameters.arguments, parameters.section + "/Arguments");
      check_repetitions<dim>(parameters);
      try
      {
        dealii::GridGenerator::generate_from_name_and_arguments(
            triangulation, parameters.generator, parameters.arguments);
      }
      catch (const std::exception &error)
      {
        const bool known = std::find(generators().begin(), generators().end(),
                                     parameters.generator)
                           != generators().end();
        const std::string message = dealii_message(error);
        if (!known)
          throw InputError(
              parameters.section + "/Generator",
              "deal.II has no generator '" + parameters.generator + "'."
                  + did_you_mean(parameters.generator, generators()));
        if (says_not_implemented(message))
          throw InputError(parameters.section + "/Generator",
                           "the generator '" + parameters.generator
                               + "' does not exist" + in_dimension + ".");
        throw InputError(parameters.section + "/Arguments",
                         "'" + parameters.arguments
                             + "' are not arguments of "
                               "dealii::GridGenerator::"
                             + parameters.generator + "()" + in_dimension + ": "
                             + wrong_arguments(parameters.generator,
                                               parameters.arguments, message));
      }
    }

    /** What a coarse mesh must be, whoever made it. */
    template <int dim>
    void check_mesh(const MeshParameters &parameters,
                    const dealii::Triangulation<dim> &triangulation)
    {
      const std::string parameter =
          parameters.section
          + (parameters.file.empty() ? "/Arguments" : "/File");
      if (!triangulation.all_reference_cells_are_hyper_cube()
          && !triangulation.all_reference_cells_are_simplex())
        throw InputError(parameter,
                         dim == 2 ? "the mesh has triangles and "
                                    "quadrilaterals; it may have one kind only "
                                    "(in gmsh: Recombine)."
                                  : "the mesh has cells of several kinds, "
                                    "wedges or pyramids; it may have hexahedra "
                                    "only or tetrahedra only.");
      for (const dealii::Point<dim> &vertex : triangulation.get_vertices())
        for (unsigned int d = 0; d < dim; ++d)
          if (!std::isfinite(vertex[d]))
            throw InputError(parameter,
                             "a coordinate of the mesh is not finite.");
      check_cells(parameter, triangulation);
    }

    template <int dim>
    MeshFileExtras<dim> read_checked(const MeshParameters &parameters,
                                     const RunOptions &options,
                                     dealii::Triangulation<dim> &triangulation)
    {
      const std::filesystem::path path = options.input_file(parameters.file);
      const MeshFileExtras<dim> extras = read_mesh_file(
          path, parameters.section + "/File", parameters.part, triangulation);
      try
      {
        check_mesh(parameters, triangulation);
        return extras;
      }
      catch (const InputError &error)
      {
        throw InputError(error.parameter,
                         error.what() + large_number_hint(path));
      }
    }

    /** Generated or read, one level, in its own place. */
    template <int dim>
    std::shared_ptr<const dealii::Triangulation<dim>>
    make_reference(const MeshParameters &parameters, const RunOptions &options,
                   MeshFileExtras<dim> &extras)
    {
      const AssertionsThrow throwing;
      auto made = std::make_shared<dealii::Triangulation<dim>>();
      if (parameters.file.empty())
      {
        generate(parameters, *made);
        check_mesh(parameters, *made);
      }
      else
        extras = read_checked(parameters, options, *made);
      if (made->n_levels() == 1)
        return made;
      auto flat = std::make_shared<dealii::Triangulation<dim>>();
      dealii::GridGenerator::flatten_triangulation(*made, *flat);
      for (const dealii::types::manifold_id id : made->get_manifold_ids())
        if (id != dealii::numbers::flat_manifold_id)
          flat->set_manifold(id, made->get_manifold(id));
      return flat;
    }
  } // namespace

  void MeshParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    parameter::declare(
        prm, "Generator", "hyper_cube", TextPattern("a word"),
        parameter::basic("", "hyper_rectangle"),
        "Function of deal.II's namespace GridGenerator that makes the coarse "
        "mesh. Without effect where `File` is given.");
    parameter::declare(
        prm, "Arguments", "-1 : 1 : false", TextPattern("a list of arguments"),
        parameter::basic("length", "0, 0 : 2, 1 : true"),
        "All arguments of the function `Generator`, optional ones included, "
        "separated by colons; points and lists by commas. For hyper_cube: left "
        ": right : colorize. With colorize = true the sides have boundary ids "
        "0, 1, 2, ...");
    parameter::declare(
        prm, "File", "", TextPattern::file(), parameter::basic("", "block.msh"),
        "Mesh file, read instead of generating a mesh: msh (gmsh), inp "
        "(Abaqus, CalculiX or UCD), ucd, vtk, vtu, unv, xda. A relative name "
        "is relative to the scene file. Names of its surfaces and sets may "
        "stand for boundary ids.");
    parameter::declare(
        prm, "Part", "", TextPattern("a name"),
        parameter::advanced("", "BLOCK"),
        "Cells of the file that make the mesh: name of a physical volume (2D: "
        "physical surface), an element set or a part. Empty: all cells.");
    parameter::declare(prm, "Scale", "1", TextPattern::numbers(),
                       parameter::advanced("1", "0.001"),
                       "Factor of the coordinates, or one factor per "
                       "direction. Applied first.");
    parameter::declare(
        prm, "Rotate", "", TextPattern::numbers(),
        parameter::advanced("degrees", "90"),
        "Rotation about the origin: one angle in 2D, in 3D three angles about "
        "x, then y, then z. Applied after `Scale`.");
    parameter::declare(prm, "Move", "", TextPattern::number_vector(),
                       parameter::basic("length", "0, 1.5"),
                       "Translation at time 0, applied after `Rotate`.");
    parameter::declare(prm, "Boundary ids", "", TextPattern::formula_by_id(),
                       parameter::advanced("", "1: y > 0.99; 2: abs(x) < 1e-6"),
                       "Boundary ids set by conditions on the centre of a face "
                       "of the coarse mesh: `id: condition`, separated by "
                       "semicolons. The last condition that is true counts.");
    parameter::declare(
        prm, "Curved sides", "", TextPattern("a list of shapes by boundary id"),
        parameter::advanced("", "3: circle: 0, 0; 4: circle: 2, 1"),
        "Shapes that refinement follows; other sides of a mesh file keep "
        "straight facets. `ids: circle: centre` in 2D, `ids: sphere: centre` "
        "or `ids: cylinder: point of the axis: direction` in 3D, `ids: flat` "
        "for facets that are meant as they are. The radius follows from the "
        "nodes, which must be on the shape. Coordinates are those after "
        "`Scale`, `Rotate` and `Move`.");
  }

  void MeshParameters::parse(dealii::ParameterHandler &prm,
                             const std::string &section_name)
  {
    section = section_name;
    generator = prm.get("Generator");
    arguments = prm.get("Arguments");
    file = prm.get("File");
    part = prm.get("Part");
    if (file.empty() && !part.empty())
      throw InputError(section + "/Part",
                       "has no effect without a mesh file in File.");
    boundary_ids = prm.get("Boundary ids");
    curved_sides = prm.get("Curved sides");
    const auto numbers = [&](const std::string &name)
    { return parse_numbers(prm.get(name), section + "/" + name); };
    scale = numbers("Scale");
    rotate = numbers("Rotate");
    move = numbers("Move");
    for (const double factor : scale)
      if (!(factor > 0))
        throw InputError(section + "/Scale", "factors must be positive.");
  }

  template <int dim>
  Placement<dim> make_placement(const MeshParameters &parameters)
  {
    const auto wrong =
        [&parameters](const std::string &name, const std::string &message)
    { throw InputError(parameters.section + "/" + name, message); };
    const auto vector =
        [&wrong](const std::vector<double> &numbers, const std::string &name)
    {
      dealii::Tensor<1, dim> result;
      if (!numbers.empty() && numbers.size() != dim)
        wrong(name, "needs " + std::to_string(dim) + " numbers, not "
                        + std::to_string(numbers.size()) + "."
                        + count_hint(numbers.size(), dim));
      for (unsigned int d = 0; d < numbers.size(); ++d)
        result[d] = numbers[d];
      return result;
    };

    dealii::Tensor<2, dim> matrix;
    for (unsigned int d = 0; d < dim; ++d)
      matrix[d][d] = parameters.scale.empty() ? 1 : parameters.scale[0];
    if (parameters.scale.size() > 1)
    {
      const auto factors = vector(parameters.scale, "Scale");
      for (unsigned int d = 0; d < dim; ++d)
        matrix[d][d] = factors[d];
    }
    const std::size_t n_angles = dim == 2 ? 1 : 3;
    if (!parameters.rotate.empty() && parameters.rotate.size() != n_angles)
      wrong("Rotate", (dim == 2 ? "needs one angle in degrees."
                                : "needs three angles in degrees, about "
                                  "x, then y, then z.")
                          + count_hint(parameters.rotate.size(), n_angles));
    for (std::size_t axis = 0; axis < parameters.rotate.size(); ++axis)
    {
      const double angle =
          parameters.rotate[axis] * 3.14159265358979323846 / 180;
      const unsigned int i = dim == 2 ? 0 : unsigned(axis + 1) % 3;
      const unsigned int j = dim == 2 ? 1 : unsigned(axis + 2) % 3;
      dealii::Tensor<2, dim> rotation;
      for (unsigned int d = 0; d < dim; ++d)
        rotation[d][d] = 1;
      rotation[i][i] = rotation[j][j] = std::cos(angle);
      rotation[j][i] = std::sin(angle);
      rotation[i][j] = -std::sin(angle);
      matrix = rotation * matrix;
    }
    return {matrix, vector(parameters.move, "Move")};
  }

  template <int dim>
  MeshFileExtras<dim> create_mesh(const MeshParameters &parameters,
                                  const RunOptions &options,
                                  dealii::Triangulation<dim> &triangulation)
  {
    MeshFileExtras<dim> extras;
    std::shared_ptr<const dealii::Triangulation<dim>> reference;
    dealii::Triangulation<dim> placed;
    const auto prepare = [&]()
    {
      const Placement<dim> placement = make_placement<dim>(parameters);
      reference = make_reference<dim>(parameters, options, extras);
      placed.copy_triangulation(*reference);
      dealii::GridTools::transform([&placement](const dealii::Point<dim> &x)
                                   { return placement.place(x); },
                                   placed);
      // What was good where it was made was spoiled by its place.
      check_cells(parameters.section
                      + (parameters.move.empty() ? "/Scale" : "/Move"),
                  placed);
      for (const std::string &warning :
           set_boundary_ids(parameters.boundary_ids,
                            parameters.section + "/Boundary ids", placed))
        extras.warnings.emplace_back("Boundary ids", warning);
      for (const dealii::types::manifold_id id : reference->get_manifold_ids())
        if (id != dealii::numbers::flat_manifold_id)
          placed.set_manifold(id,
                              PlacedManifold<dim>(reference, id, placement));
      set_curved_sides(parameters.curved_sides,
                       parameters.section + "/Curved sides",
                       names_of(extras, placed), placed);
      for (auto &middle : extras.middles)
        middle.second = placement.place(middle.second);
    };
    collective(options.communicator, prepare);
    // Its copy of other cells would crash.
    if (dynamic_cast<dealii::parallel::distributed::Triangulation<dim> *>(
            &triangulation)
        != nullptr)
      require_cubes(placed, parameters, "this kind of scene");
    triangulation.copy_triangulation(placed);
    return extras;
  }

  template <int dim>
  BoundaryNames names_of(const MeshFileExtras<dim> &extras,
                         const dealii::Triangulation<dim> &triangulation)
  {
    return {triangulation.get_boundary_ids(), extras.sets, extras.other_names};
  }

  template <int dim>
  std::string cell_name(const dealii::Triangulation<dim> &triangulation)
  {
    if (triangulation.all_reference_cells_are_simplex())
      return dim == 2 ? "triangles" : "tetrahedra";
    return dim == 2 ? "quadrilaterals" : "hexahedra";
  }

  template <int dim>
  void require_cubes(const dealii::Triangulation<dim> &triangulation,
                     const MeshParameters &parameters, const std::string &where)
  {
    if (!triangulation.all_reference_cells_are_hyper_cube())
      throw InputError(parameters.source(),
                       "the cells are " + cell_name(triangulation) + "; in "
                           + where + " they may be "
                           + (dim == 2 ? "quadrilaterals only (in gmsh: "
                                         "Recombine)."
                                       : "hexahedra only."));
  }

  template <int dim>
  double half_extent(const dealii::Triangulation<dim> &triangulation)
  {
    dealii::Point<dim> least, largest;
    bool is_first = true;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (const unsigned int v : cell->vertex_indices())
      {
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double x = cell->vertex(v)[d];
          least[d] = is_first ? x : std::min(least[d], x);
          largest[d] = is_first ? x : std::max(largest[d], x);
        }
        is_first = false;
      }
    double extent = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      extent = std::max(extent, largest[d] - least[d]);
    return 0.5 * extent;
  }

  namespace
  {
    /** A boundary face and the part of it where a condition is true. */
    template <int dim> struct FacePart
    {
      dealii::Tensor<1, dim> normal; ///< of a plane face
      double size = 0., part = 0.;
      bool is_chosen = false; ///< by the centre
    };

    /** @p n points in each direction. */
    template <int dim, typename Face>
    FacePart<dim> part_of(const Face &face, const Expression<dim> &condition,
                          const unsigned int n)
    {
      const dealii::ReferenceCell shape = face->reference_cell();
      FacePart<dim> result;
      const auto grid =
          shim::regular_points<dim - 1>(n, dim == 3 && shape.is_simplex());
      for (const dealii::Point<dim - 1> &point : grid.get_points())
      {
        dealii::Point<dim> x;
        for (const unsigned int v : face->vertex_indices())
          x += shape.d_linear_shape_function(point, v) * face->vertex(v);
        result.part += condition.value(x) > 0 ? 1. / grid.size() : 0.;
      }
      result.size = face->measure();
      result.is_chosen = condition.value(face->center()) > 0;
      const dealii::Tensor<1, dim> edge = face->vertex(1) - face->vertex(0);
      if constexpr (dim == 2)
        result.normal = dealii::cross_product_2d(edge);
      else
        result.normal =
            dealii::cross_product_3d(edge, face->vertex(2) - face->vertex(0));
      result.normal /= result.normal.norm();
      return result;
    }

    /** Area that faces as a whole have too much or too little, as a part of
     * that of the chosen ones. A condition may be true on sides that it is not
     * about, as y > 0.9 is: so others count if they are parallel to a chosen
     * one. */
    template <int dim>
    double wrong_part(const std::vector<FacePart<dim>> &faces)
    {
      constexpr double cosine_of_parallel = 0.98;
      double chosen = 0., wrong = 0.;
      for (const FacePart<dim> &face : faces)
        if (face.is_chosen)
        {
          chosen += face.size;
          wrong += (1. - face.part) * face.size;
        }
        else if (face.part > 0.
                 && std::any_of(faces.begin(), faces.end(),
                                [&](const FacePart<dim> &other)
                                {
                                  return other.is_chosen
                                         && std::abs(other.normal * face.normal)
                                                > cosine_of_parallel;
                                }))
          wrong += face.part * face.size;
      return wrong / chosen;
    }
  } // namespace

  template <int dim>
  std::vector<std::string>
  set_boundary_ids(const std::string &text, const std::string &parameter,
                   dealii::Triangulation<dim> &triangulation)
  {
    std::vector<std::string> warnings;
    for (const std::string &entry : split_list(text, ';'))
    {
      if (entry.empty())
        continue;
      const std::size_t colon = entry.find(':');
      const std::vector<double> id =
          colon == std::string::npos
              ? std::vector<double>()
              : parse_numbers(entry.substr(0, colon), parameter);
      if (id.size() != 1 || id[0] < 0 || id[0] != std::floor(id[0])
          || id[0] >= dealii::numbers::internal_face_boundary_id)
        throw InputError(parameter,
                         "'" + entry
                             + "' is not of the form 'id: condition' with a "
                               "whole number from 0.");
      const std::string text = dealii::Utilities::trim(entry.substr(colon + 1));
      const Expression<dim> condition(text, parameter);
      std::vector<FacePart<dim>> faces;
      const unsigned int n_points = shim::samples_per_direction(
          triangulation.n_active_faces(), dim - 1, 2., 20.);
      bool found = false;
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary())
        {
          faces.push_back(part_of(face, condition, n_points));
          if (faces.back().is_chosen)
            face->set_all_boundary_ids(
                static_cast<dealii::types::boundary_id>(id[0]));
          found = found || faces.back().is_chosen;
        }
      if (!found)
        throw InputError(parameter, "no boundary face of the coarse mesh has "
                                    "its centre where '"
                                        + text + "'.");
      constexpr double visible = 0.01;
      if (const double wrong = wrong_part(faces); wrong > visible)
        warnings.push_back(
            "'" + text
            + "' changes within faces of the coarse mesh, each of which has "
              "one id, by its centre: "
            + short_number(100. * wrong, 2) + " % of the area of boundary "
            + short_number(id[0])
            + " is too much or missing. Let faces of the coarse mesh end where "
              "the condition does.");
    }
    return warnings;
  }

  template Placement<2> make_placement<2>(const MeshParameters &);
  template Placement<3> make_placement<3>(const MeshParameters &);
  template std::string cell_name(const dealii::Triangulation<2> &);
  template std::string cell_name(const dealii::Triangulation<3> &);
  template void require_cubes(const dealii::Triangulation<2> &,
                              const MeshParameters &, const std::string &);
  template void require_cubes(const dealii::Triangulation<3> &,
                              const MeshParameters &, const std::string &);
  template double half_extent<2>(const dealii::Triangulation<2> &);
  template double half_extent<3>(const dealii::Triangulation<3> &);
  template MeshFileExtras<2> create_mesh<2>(const MeshParameters &,
                                            const RunOptions &,
                                            dealii::Triangulation<2> &);
  template MeshFileExtras<3> create_mesh<3>(const MeshParameters &,
                                            const RunOptions &,
                                            dealii::Triangulation<3> &);
  template BoundaryNames names_of<2>(const MeshFileExtras<2> &,
                                     const dealii::Triangulation<2> &);
  template BoundaryNames names_of<3>(const MeshFileExtras<3> &,
                                     const dealii::Triangulation<3> &);
  template std::vector<std::string>
  set_boundary_ids<2>(const std::string &, const std::string &,
                      dealii::Triangulation<2> &);
  template std::vector<std::string>
  set_boundary_ids<3>(const std::string &, const std::string &,
                      dealii::Triangulation<3> &);
} // namespace abut::app

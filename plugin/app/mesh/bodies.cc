// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bodies.h"

#include "app/input/boundary_expressions.h"
#include "app/input/input_error.h"
#include "app/input/parameters.h"
#include "app/input/short_number.h"
#include "memory_check.h"
#include "mesh_checks.h"
#include "mesh_description.h"
#include "simplex_refinement.h"

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    template <int structdim, class Change>
    void append(const std::vector<dealii::CellData<structdim>> &from,
                const unsigned int first_vertex, const Change &change,
                std::vector<dealii::CellData<structdim>> &to)
    {
      for (dealii::CellData<structdim> cell : from)
      {
        for (unsigned int &vertex : cell.vertices)
          vertex += first_vertex;
        change(cell);
        to.push_back(cell);
      }
    }

    /** Whether a word is meant as a number, and gets the messages of one. */
    bool could_be_number(const std::string &word)
    {
      return word.find_first_of("0123456789") != std::string::npos;
    }
  } // namespace

  template <int dim> void BodyMeshes<dim>::straighten(const std::string &reason)
  {
    middles.reset();
    for (std::size_t body = 0; body < meshes.size(); ++body)
    {
      const auto &vertices = meshes[body].get_vertices();
      double largest = 0.;
      for (const auto &[edge, x] : extras[body].middles)
        largest = std::max(
            largest,
            x.distance(vertices[edge.first]
                       + 0.5 * (vertices[edge.second] - vertices[edge.first])));
      if (largest > 0.)
        extras[body].warnings.emplace_back(
            "File", "with " + reason
                        + " edges are straight: the middle nodes of curved "
                          "edges, up to "
                        + short_number(largest) + " away, are left out.");
      extras[body].middles.clear();
    }
  }

  template <int dim>
  bool BodyMeshes<dim>::may_have_simplices(
      const std::string &surface,
      const std::vector<BodyParameters> &bodies) const
  {
    for (const std::string &part : split_list(surface, ';'))
    {
      const std::string word =
          dealii::Utilities::trim(part.substr(0, part.find(':')));
      bool is_known = false;
      for (std::size_t body = 0; body < meshes.size(); ++body)
      {
        const std::vector<std::string> &names = extras[body].body_names;
        const bool is_meant =
            word == std::to_string(body + 1) || word == bodies[body].name
            || std::find(names.begin(), names.end(), word) != names.end();
        if (is_meant && are_simplices(body))
          return true;
        is_known = is_known || is_meant;
      }
      if (!is_known)
        return true;
    }
    return false;
  }

  template <int dim>
  BodyMeshes<dim>
  create_body_meshes(const std::vector<BodyParameters> &parameters,
                     const RunOptions &options)
  {
    BodyMeshes<dim> result(parameters.size());
    for (std::size_t body = 0; body < parameters.size(); ++body)
      result.extras[body] =
          create_mesh(parameters[body].mesh, options, result.meshes[body]);
    for (const MeshFileExtras<dim> &extras : result.extras)
      if (!extras.middles.empty())
        result.middles = std::make_shared<EdgeMiddles<dim>>();
    return result;
  }

  template <int dim>
  Bodies<dim>::Bodies(const std::vector<BodyParameters> &parameters,
                      const bool of_revolution)
      : parameters(parameters), of_revolution(of_revolution)
  {
  }

  template <int dim>
  void Bodies<dim>::merge(const BodyMeshes<dim> &coarse,
                          const unsigned int further_levels, Mesh &all)
  {
    MeshDescription<dim> whole;
    std::map<dealii::types::manifold_id, std::pair<unsigned int, unsigned int>>
        manifolds;
    dealii::types::manifold_id next_manifold = 0;
    for (unsigned int body = 0; body < size(); ++body)
    {
      const Mesh &mesh = coarse.meshes[body];
      for (const BoundaryId id : ids(body))
      {
        numbers[{body, id}] = static_cast<BoundaryId>(origin.size());
        origin.push_back({body, id});
      }
      std::map<dealii::types::manifold_id, dealii::types::manifold_id> renamed =
          {{dealii::numbers::flat_manifold_id,
            dealii::numbers::flat_manifold_id}};
      for (const auto id : mesh.get_manifold_ids())
        if (id != dealii::numbers::flat_manifold_id)
        {
          manifolds[next_manifold] = {body, id};
          renamed[id] = next_manifold++;
        }
      MeshDescription<dim> part = describe(mesh);
      if (coarse.middles)
        part.middles = coarse.extras[body].middles;
      if (coarse.are_simplices(body))
        for (unsigned int i = 0;
             i < parameters[body].refinements + further_levels; ++i)
          refine_red(mesh, part);
      const auto first = static_cast<unsigned int>(whole.vertices.size());
      whole.vertices.insert(whole.vertices.end(), part.vertices.begin(),
                            part.vertices.end());
      part.origins.resize(part.vertices.size());
      for (VertexOrigin vertex : part.origins)
      {
        for (unsigned int &end : vertex.ends)
          end += first;
        whole.origins.push_back(vertex);
      }
      append(
          part.cells, first,
          [&](dealii::CellData<dim> &cell)
          {
            cell.material_id = body;
            cell.manifold_id = renamed.at(cell.manifold_id);
          },
          whole.cells);
      const auto face = [&](auto &data)
      {
        if (data.boundary_id != dealii::numbers::internal_face_boundary_id)
          data.boundary_id = numbers.at({body, data.boundary_id});
        data.manifold_id = renamed.at(data.manifold_id);
      };
      append(part.faces.boundary_lines, first, face,
             whole.faces.boundary_lines);
      append(part.faces.boundary_quads, first, face,
             whole.faces.boundary_quads);
      for (const auto &[edge, x] : part.middles)
        coarse.middles->emplace(
            std::make_pair(first + edge.first, first + edge.second), x);
    }
    all.create_triangulation(whole.vertices, whole.cells, whole.faces);
    if (!coarse.has_cubes())
      description = std::move(whole);
    for (const auto &[id, from] : manifolds)
      all.set_manifold(id, coarse.meshes[from.first].get_manifold(from.second));
  }

  template <int dim>
  void
  Bodies<dim>::refine_cubes(const BodyMeshes<dim> &coarse,
                            const unsigned int further_levels,
                            dealii::Triangulation<dim> &triangulation) const
  {
    std::vector<unsigned int> n_levels;
    for (unsigned int body = 0; body < size(); ++body)
      n_levels.push_back(coarse.are_simplices(body)
                             ? 0
                             : parameters[body].refinements + further_levels);
    const unsigned int most =
        *std::max_element(n_levels.begin(), n_levels.end());
    // Where all ranks have all cells, all ranks flag all of them.
    const bool all_cells = coarse.has_simplices();
    for (unsigned int i = 0; i < most; ++i)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if ((all_cells || cell->is_locally_owned())
            && n_levels[cell->material_id()] > i)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
  }

  template <int dim>
  void Bodies<dim>::check_size(const BodyMeshes<dim> &coarse,
                               const RunOptions &options,
                               const CellDegrees &degrees,
                               const unsigned int further_levels) const
  {
    // What is most first: other cells take memory, too.
    double n_cubes = 0., n_simplices = 0.;
    for (unsigned int body = 0; body < size(); ++body)
      (coarse.are_simplices(body) ? n_simplices : n_cubes) +=
          coarse.meshes[body].n_active_cells()
          * std::pow(
              2., dim * double(parameters[body].refinements + further_levels));
    const auto check =
        [&](const double n, const unsigned int degree, const bool simplices)
    {
      if (n > 0.)
        check_memory(dim, n, degree, options.communicator, "Refinement/Level",
                     dim, simplices);
    };
    check(n_cubes, degrees.cubes, false);
    check(n_simplices, degrees.simplices, true);
  }

  template <int dim>
  void Bodies<dim>::create(const BodyMeshes<dim> &coarse,
                           const RunOptions &options,
                           const CellDegrees &degrees,
                           const unsigned int further_levels,
                           dealii::Triangulation<dim> &triangulation)
  {
    for (unsigned int body = 0; body < size(); ++body)
    {
      const MeshFileExtras<dim> &extras = coarse.extras[body];
      all_names.push_back(names_of(extras, coarse.meshes[body]));
      if (!parameters[body].name.empty())
        body_names.emplace_back(parameters[body].name, body);
      for (const std::string &name : extras.body_names)
        if (parameters[body].name.empty())
          body_names.emplace_back(name, body);
      if (!extras.middles.empty())
        curved.insert(body);
      if (coarse.are_simplices(body))
        of_simplices.insert(body);
      for (const auto &[name, warning] : extras.warnings)
        of_meshes.push_back(parameters[body].mesh.section + "/" + name + ": "
                            + warning);
      if constexpr (dim == 2)
        if (of_revolution)
          check_axis(parameters[body].mesh, coarse.meshes[body]);
    }
    check_size(coarse, options, degrees, further_levels);
    Mesh all;
    merge(coarse, further_levels, all);
    if (coarse.has_simplices())
      check_cells(parameters.front().mesh.section + "/Curved sides", all);
    triangulation.copy_triangulation(all);
    refine_cubes(coarse, coarse.has_simplices() ? further_levels : 0,
                 triangulation);
  }

  template <int dim>
  std::vector<unsigned int>
  Bodies<dim>::refine(const std::vector<bool> &marked,
                      dealii::Triangulation<dim> &triangulation)
  {
    std::vector<unsigned int> origin =
        bisect(triangulation, marked, description);
    Mesh all;
    all.create_triangulation(description.vertices, description.cells,
                             description.faces);
    for (const auto id : triangulation.get_manifold_ids())
      if (id != dealii::numbers::flat_manifold_id)
        all.set_manifold(id, triangulation.get_manifold(id));
    triangulation.clear();
    triangulation.copy_triangulation(all);
    return origin;
  }

  template <int dim>
  typename Bodies<dim>::BoundaryId
  Bodies<dim>::number(const unsigned int body, const BoundaryId id) const
  {
    return numbers.at({body, id});
  }

  template <int dim>
  std::string Bodies<dim>::name(const BoundaryId number) const
  {
    const auto [body, id] = origin[number];
    return "body " + std::to_string(body + 1) + ", "
           + all_names[body].describe(id);
  }

  template <int dim>
  std::string Bodies<dim>::given_name(const unsigned int body) const
  {
    for (const auto &[name, number] : body_names)
      if (number == body)
        return name;
    return "";
  }

  template <int dim>
  std::string Bodies<dim>::name_of_body(const unsigned int body) const
  {
    const std::string name = given_name(body);
    return name.empty() ? "body " + std::to_string(body + 1) : name;
  }

  template <int dim> std::string Bodies<dim>::names_in_words() const
  {
    std::string text;
    for (const auto &named : body_names)
      text += (text.empty() ? ", or its name, '" : "', '") + named.first;
    return text + (text.empty() ? "" : "'");
  }

  template <int dim>
  unsigned int Bodies<dim>::body_of(const BoundaryId number) const
  {
    return origin[number].first;
  }

  template <int dim>
  std::pair<unsigned int, std::string>
  Bodies<dim>::split_body(const std::string &text,
                          const std::string &parameter) const
  {
    const std::size_t colon = text.find(':');
    const std::string word =
        dealii::Utilities::trim(text.substr(0, std::min(colon, text.size())));
    std::set<unsigned int> named;
    for (const auto &[name, body] : body_names)
      if (colon != std::string::npos && name == word)
        named.insert(body);
    if (named.size() > 1)
      throw InputError(parameter, "several bodies have the name '" + word
                                      + "': write their numbers.");
    if (!named.empty())
      return {*named.begin(), text.substr(colon + 1)};
    std::vector<double> body;
    if (colon != std::string::npos && could_be_number(word))
      body = parse_numbers(word, parameter);
    if (body.size() != 1 || body[0] < 1 || body[0] > size()
        || body[0] != std::floor(body[0]))
      throw InputError(
          parameter,
          "'" + text + "' does not start with the number of a body, 1 to "
              + std::to_string(size()) + names_in_words() + ", and a colon.");
    return {static_cast<unsigned int>(body[0]) - 1, text.substr(colon + 1)};
  }

  template <int dim>
  typename Bodies<dim>::BoundaryIds
  Bodies<dim>::surface(const std::string &text,
                       const std::string &parameter) const
  {
    BoundaryIds result;
    for (const std::string &part : split_list(text, ';'))
    {
      const auto [body, list] = split_body(part, parameter);
      const BoundaryIds chosen =
          parse_boundary_ids(list, parameter, all_names[body]);
      if (chosen.empty())
        throw InputError(parameter, "'" + part + "' names no boundary id.");
      for (const BoundaryId id : chosen)
        result.insert(number(body, id));
    }
    return result;
  }

  template struct BodyMeshes<2>;
  template struct BodyMeshes<3>;
  template BodyMeshes<2> create_body_meshes(const std::vector<BodyParameters> &,
                                            const RunOptions &);
  template BodyMeshes<3> create_body_meshes(const std::vector<BodyParameters> &,
                                            const RunOptions &);
  template class Bodies<2>;
  template class Bodies<3>;
} // namespace abut::app

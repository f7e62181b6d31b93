// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BODIES_H
#define ABUT_APP_BODIES_H

/** @file
 * Several bodies on one distributed mesh.
 */

#include "app/physics/cell_degrees.h"
#include "body_parameters.h"
#include "mesh_description.h"

#include <deal.II/distributed/tria.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** The coarse meshes of bodies, each with cells of one kind. */
  template <int dim> struct BodyMeshes
  {
    explicit BodyMeshes(const std::size_t n_bodies = 0)
        : meshes(n_bodies), extras(n_bodies)
    {
    }

    /** Leave out the middles of edges, with warnings that it is because of
     * @p reason. */
    void straighten(const std::string &reason);

    /** Whether a body is of triangles or tetrahedra. */
    bool are_simplices(const std::size_t body) const
    {
      return meshes[body].all_reference_cells_are_simplex();
    }

    std::size_t n_of_simplices() const
    {
      std::size_t n = 0;
      for (std::size_t body = 0; body < meshes.size(); ++body)
        n += are_simplices(body) ? 1 : 0;
      return n;
    }

    bool has_simplices() const
    {
      return n_of_simplices() > 0;
    }

    bool has_cubes() const
    {
      return n_of_simplices() < meshes.size();
    }

    /** Whether bodies of a surface such as `1: 3, 4; pin: *` are of triangles
     * or tetrahedra, or their names are not known. */
    bool may_have_simplices(const std::string &surface,
                            const std::vector<BodyParameters> &bodies) const;

    std::vector<dealii::Triangulation<dim>> meshes;
    std::vector<MeshFileExtras<dim>> extras;
    /** Where Bodies::create() puts those of all bodies; null: all edges are
     * straight. */
    std::shared_ptr<EdgeMiddles<dim>> middles;
  };

  /** Throws InputError as create_mesh() does. Collective. */
  template <int dim>
  BodyMeshes<dim>
  create_body_meshes(const std::vector<BodyParameters> &parameters,
                     const RunOptions &options);

  /** The meshes of all bodies side by side in one triangulation: vertices,
   * cells and boundary faces one body after the other, nothing merged, so
   * that bodies that touch stay apart. Cells have the body's number, from 0,
   * as material id.
   *
   * Boundary ids are the user's own, body by body; in the triangulation they
   * have other numbers so that each belongs to one body. */
  template <int dim> class Bodies
  {
  public:
    using BoundaryId = dealii::types::boundary_id;
    using BoundaryIds = std::set<BoundaryId>;

    /** @param of_revolution whether x = 0 is an axis that no body may cross */
    explicit Bodies(const std::vector<BodyParameters> &parameters,
                    bool of_revolution = false);

    /** Make the mesh of all bodies in the empty @p triangulation and refine
     * each by its own `Refinements`. Triangles and tetrahedra, and cells beside
     * them, are refined by @p further_levels more; of other cells these are
     * counted when memory is checked. Throws InputError. Collective. */
    void create(const BodyMeshes<dim> &coarse, const RunOptions &options,
                const CellDegrees &degrees, unsigned int further_levels,
                dealii::Triangulation<dim> &triangulation);

    /** Bisect marked cells of the mesh that create() has made of triangles or
     * tetrahedra, see bisect(); returns the old cell of each new one. Unknowns
     * must be distributed again. Collective. */
    std::vector<unsigned int> refine(const std::vector<bool> &marked,
                                     dealii::Triangulation<dim> &triangulation);

    unsigned int size() const
    {
      return static_cast<unsigned int>(parameters.size());
    }

    const BodyParameters &operator[](const unsigned int body) const
    {
      return parameters[body];
    }

    /** Boundary ids that the user knows of a body, sorted. */
    const std::vector<BoundaryId> &ids(const unsigned int body) const
    {
      return all_names[body].ids();
    }

    /** These ids and their names in the file of the body's mesh. */
    const BoundaryNames &names(const unsigned int body) const
    {
      return all_names[body];
    }

    /** Warnings about the files of meshes, with the body. */
    const std::vector<std::string> &warnings() const
    {
      return of_meshes;
    }

    /** How the vertices came into a mesh of triangles or tetrahedra; empty for
     * other cells. */
    const std::vector<VertexOrigin> &vertex_origins() const
    {
      return description.origins;
    }

    /** Whether the file of a body's mesh has curved edges, which it keeps. */
    bool is_curved(const unsigned int body) const
    {
      return curved.count(body) > 0;
    }

    /** Whether the cells of a body are triangles or tetrahedra. */
    bool are_simplices(const unsigned int body) const
    {
      return of_simplices.count(body) > 0;
    }

    /** Number in the triangulation of a body's boundary id. */
    BoundaryId number(unsigned int body, BoundaryId id) const;

    /** "body 2, boundary 3", or "body 2, boundary 3 ('top')" where it has a
     * name, for a number of the triangulation. */
    std::string name(BoundaryId number) const;

    /** The name of a body, by the scene or its mesh file; empty: none. */
    std::string given_name(unsigned int body) const;

    /** "body 2", or its name. */
    std::string name_of_body(unsigned int body) const;

    /** What the user calls a boundary number of the triangulation in its body.
     */
    BoundaryId user_id(const BoundaryId number) const
    {
      return origin.at(number).second;
    }

    /** Body that a boundary number of the triangulation belongs to. */
    unsigned int body_of(BoundaryId number) const;

    /** The boundary numbers that a text such as `1: 3, 4; pin: *; 3: top` names
     * (body: its boundary ids or their names). Throws InputError that names @p
     * parameter. */
    BoundaryIds surface(const std::string &text,
                        const std::string &parameter) const;

    /** The body, from 0, whose number or name is the text before a colon, and
     * the rest of the text. Throws InputError that names @p parameter. */
    std::pair<unsigned int, std::string>
    split_body(const std::string &text, const std::string &parameter) const;

  private:
    using Mesh = dealii::Triangulation<dim>;

    std::string names_in_words() const;
    void merge(const BodyMeshes<dim> &coarse, unsigned int further_levels,
               Mesh &all);
    void check_size(const BodyMeshes<dim> &coarse, const RunOptions &options,
                    const CellDegrees &degrees,
                    unsigned int further_levels) const;
    void refine_cubes(const BodyMeshes<dim> &coarse,
                      unsigned int further_levels,
                      dealii::Triangulation<dim> &triangulation) const;

    const std::vector<BodyParameters> &parameters;
    const bool of_revolution;
    MeshDescription<dim> description;     ///< of triangles or tetrahedra
    std::vector<BoundaryNames> all_names; ///< by body
    std::vector<std::pair<std::string, unsigned int>> body_names;
    std::vector<std::string> of_meshes;
    std::set<unsigned int> curved, of_simplices;             ///< bodies
    std::vector<std::pair<unsigned int, BoundaryId>> origin; ///< by number
    std::map<std::pair<unsigned int, BoundaryId>, BoundaryId> numbers;
  };
} // namespace abut::app

#endif

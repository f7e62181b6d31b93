// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_H
#define ABUT_APP_MESH_H

/** @file
 * Coarse meshes from a scene file: a generator of deal.II by name, or a file.
 */

#include "app/input/run_options.h"
#include "mesh_file.h"
#include "placed_manifold.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/grid/tria.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** Section `Mesh` of a scene. */
  struct MeshParameters
  {
    std::string generator; /**< function of deal.II's GridGenerator */
    std::string arguments; /**< its arguments, `a : b : c` */
    std::string part;      /**< of the file; empty: all of it */
    std::string file;      /**< used instead of the generator if not empty */
    std::vector<double> scale;
    std::vector<double> rotate;
    std::vector<double> move;
    std::string boundary_ids;
    std::string curved_sides;
    std::string section; /**< full name of the section, for messages */

    /** Full name of the parameter that names the mesh. */
    std::string source() const
    {
      return section + (file.empty() ? "/Generator" : "/File");
    }

    /** Declare the parameters in the present section of @p prm. */
    static void declare(dealii::ParameterHandler &prm);

    /** Read them; @p section is the present section's full name. Throws
     * InputError for values that cannot be right in any dimension. */
    void parse(dealii::ParameterHandler &prm, const std::string &section);
  };

  /** The placement that Scale, Rotate and Move ask for; throws InputError for
   * a wrong number of numbers. */
  template <int dim>
  Placement<dim> make_placement(const MeshParameters &parameters);

  /** Create the coarse mesh in the empty @p triangulation: generate or read
   * it, then scale, rotate and move it, then set boundary ids and curved sides.
   * Manifolds of generators stay attached (as long as nothing but moving,
   * rotating and equal scaling is asked for; unequal scaling flattens them).
   *
   * Throws InputError, on all ranks alike, that names the parameter: an unknown
   * generator (with the nearest right names), arguments that do not fit (with
   * what deal.II expected), a file that is missing, of unknown format, or of
   * another dimension. Returns what the file says beside the mesh, at its
   * place. Collective. */
  template <int dim>
  MeshFileExtras<dim> create_mesh(const MeshParameters &parameters,
                                  const RunOptions &options,
                                  dealii::Triangulation<dim> &triangulation);

  /** Boundary ids of a mesh with the names that its file gives. */
  template <int dim>
  BoundaryNames names_of(const MeshFileExtras<dim> &extras,
                         const dealii::Triangulation<dim> &triangulation);

  /** "triangles", "quadrilaterals", "tetrahedra" or "hexahedra", for a mesh of
   * one kind of cells. */
  template <int dim>
  std::string cell_name(const dealii::Triangulation<dim> &triangulation);

  /** Throw InputError if the cells are triangles or tetrahedra, @p where they
   * cannot be, as in "scenes of kind 'obstacle'". */
  template <int dim>
  void require_cubes(const dealii::Triangulation<dim> &triangulation,
                     const MeshParameters &parameters,
                     const std::string &where);

  /** Half the largest extent of a mesh along a coordinate, of the coarse cells:
   * the same on all ranks. */
  template <int dim>
  double half_extent(const dealii::Triangulation<dim> &triangulation);

  /** Give the boundary faces whose centre satisfies a condition an id:
   * `1: y > 0.99; 2: abs(x) < 1e-6` (later entries win). An entry that no
   * face satisfies is an InputError. Returns warnings of conditions that
   * change within faces. */
  template <int dim>
  std::vector<std::string>
  set_boundary_ids(const std::string &text, const std::string &parameter,
                   dealii::Triangulation<dim> &triangulation);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_TWO_BLOCKS_H
#define ABUT_TESTS_TWO_BLOCKS_H

/** @file
 * The patch test as a deal.II program: two unit blocks of different material
 * and mesh, one on the other, in a frame that is turned by an odd angle. Top
 * and bottom are moved as the exact solution moves them, the sides are free.
 * The exact stress is -1 across the interface and 0 along it; its displacement
 * is linear in each block, so that any error is one of contact.
 */

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/mapping_by_cell.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/hp/fe_collection.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>

namespace abut::hosts
{
  using dealii::Point;
  using dealii::Tensor;
  namespace MPI = dealii::Utilities::MPI;

  /** Boundary ids. */
  enum Side : dealii::types::boundary_id
  {
    free_side = 0,
    bottom = 1,
    lower_interface = 2,
    upper_interface = 3,
    top = 4
  };

  /** Young's modulus and Poisson's ratio. */
  struct Material
  {
    double young, poisson;

    double mu() const
    {
      return young / (2. * (1. + poisson));
    }

    double lambda() const
    {
      return young * poisson / ((1. + poisson) * (1. - 2. * poisson));
    }

    /** Strain across and along the interface under unit pressure, in plane
     * strain (2D) or with all sides free (3D). */
    double normal_strain(const int dim) const
    {
      return -(dim == 2 ? 1. - poisson * poisson : 1.) / young;
    }

    double lateral_strain(const int dim) const
    {
      return (dim == 2 ? poisson * (1. + poisson) : poisson) / young;
    }
  };

  /** The rotation from the blocks' own frame, in which the last axis is the
   * normal of the interface. */
  template <int dim> Tensor<2, dim> rotation(const bool turned = true)
  {
    Tensor<2, dim> r;
    if (!turned)
    {
      for (int i = 0; i < dim; ++i)
        r[i][i] = 1.;
      return r;
    }
    const double c = std::cos(0.37), s = std::sin(0.37);
    if (dim == 2)
    {
      r[0][0] = r[1][1] = c;
      r[0][1] = -s;
      r[1][0] = s;
      return r;
    }
    // First about the first axis, then about the last.
    const double c2 = std::cos(1.1), s2 = std::sin(1.1);
    Tensor<2, 3> a, b;
    a[0][0] = 1.;
    a[1][1] = a[2][2] = c;
    a[1][2] = -s;
    a[2][1] = s;
    b[2][2] = 1.;
    b[0][0] = b[1][1] = c2;
    b[0][1] = -s2;
    b[1][0] = s2;
    const Tensor<2, 3> both = b * a;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        r[i][j] = both[i][j];
    return r;
  }

  /** Displacement of one block under unit pressure, which is moved by @p shift
   * in its own frame, too. */
  template <int dim> class ExactDisplacement : public dealii::Function<dim>
  {
  public:
    explicit ExactDisplacement(const Material &material,
                               const Tensor<1, dim> &shift = {})
        : dealii::Function<dim>(dim),
          material_(material),
          shift_(shift),
          r_(rotation<dim>())
    {
    }

    Tensor<1, dim> displacement(const Point<dim> &p) const
    {
      Tensor<1, dim> x = transpose(r_) * Tensor<1, dim>(p);
      for (int d = 0; d < dim; ++d)
        x[d] *= d == dim - 1 ? material_.normal_strain(dim)
                             : material_.lateral_strain(dim);
      return r_ * (x + shift_);
    }

    double value(const Point<dim> &p, const unsigned int c) const override
    {
      return displacement(p)[c];
    }

  private:
    const Material material_;
    const Tensor<1, dim> shift_;
    const Tensor<2, dim> r_;
  };

  /** Rule of a cell or face, exact for products of shape functions. */
  template <int dim>
  dealii::Quadrature<dim> rule(const bool simplices, const unsigned int degree)
  {
    if (simplices)
      return dealii::QGaussSimplex<dim>(degree + 1);
    return dealii::QGauss<dim>(degree + 1);
  }

  /** What is varied. */
  struct Case
  {
    std::string name;
    MethodParameters method;
    bool upper_is_secondary = true;
    unsigned int degree = 1;
    bool tied = false;
    /** Pressed by a pressure of 1 on the top of straight blocks of uniform
     * meshes, which slide freely on the bottom, instead of moved. */
    bool pressed = false;
    /** The upper block is a die: its interface is prescribed, too. */
    bool is_die = false;
    /** The upper block is lifted by separation + tilt times the first
     * coordinate of its own frame; 0 for the patch test. */
    double separation = 0., tilt = 0.;
    /** The top is moved by this along the first axis of the blocks' own frame,
     * too. */
    double aside = 0.;
    /** The upper block of pressed ones is not held sideways. */
    bool slides = false;
    /** Lower and upper block. */
    std::array<Material, 2> materials = {{{7., 0.3}, {3., 0.2}}};
    /** The law lets the blocks penetrate: pressures are compared with the mean
     * pressure then, and displacements not at all. */
    bool yields = false;
    /** Cells of the lower and upper block along each axis. */
    std::array<unsigned int, 2> cells = {{3, 4}};
    /** Triangles and tetrahedra, of which nodes are not equally far apart. */
    bool simplices = false;
    /** The upper block is of the other cells, of this degree; 0: both blocks
     * are of the same. */
    unsigned int other_degree = 0;
    /** No cell is refined, so that no node hangs. */
    bool uniform = false;

    /** Of block 0 or 1. */
    bool has_simplices(const int block) const
    {
      return simplices != (block == 1 && other_degree > 0);
    }

    bool has_hanging_nodes() const
    {
      return !pressed && !uniform;
    }
  };

  /** Largest errors. */
  struct Errors
  {
    double stress = 0.;        ///< of any component, relative to the pressure
    double normal_stress = 0.; ///< of the stress across the interface
    double displacement = 0.;  ///< relative to the largest one
    double pressure = 0.;      ///< of p n at secondary nodes
    double area = 0., force = 0., imbalance = 0., moment_imbalance = 0.;
    unsigned int steps = 0, hanging = 0;
    abut_reason reason = ABUT_REASON_NONE;
    dealii::types::global_dof_index n_rows = 0, n_active = 0;
  };

  /** The program. */
  template <int dim,
            class Mesh = dealii::parallel::distributed::Triangulation<dim>>
  class TwoBlocks
  {
  public:
    /** @p communicator of a distributed mesh. */
    explicit TwoBlocks(const Case &run,
                       const MPI_Comm communicator = MPI_COMM_WORLD);

    /** The pair of the two faces of the interface. */
    ContactPair<dim> pair() const;

    /** All up to the search for pairs. */
    void prepare(const std::vector<ContactPair<dim>> &pairs);

    /** Displacement 0, or @p lift of the upper block along the normal. */
    la::Vector displacement(const double lift = 0.) const;

    /** The patch test. */
    Errors solve();

    /** Solve from the displacement @p u on, and put the solution there. */
    Errors solve(la::Vector &u);

    /** Cut the mesh anew, with another weight of the cells of the upper block
     * (those of the lower one have 1000), and take displacement and pressures
     * along. If @p refine, cells on part of the interface are refined, too. */
    la::Vector repartition(const la::Vector &u, const unsigned int weight,
                           const bool refine = false);

    /** Prescribe displacements that are larger by @p lift along the normal
     * wherever the upper block is held. */
    void lift_supports(const double lift);

    /** Forget what contact has found. */
    void forget()
    {
      contact_.reinit(mapping_, dof_handler_, constraints_);
    }

    /** Start from 0, with the prescribed displacements. */
    la::Vector start() const;

    ContactAssembler<dim> &contact()
    {
      return contact_;
    }

    const dealii::DoFHandler<dim> &dof_handler() const
    {
      return dof_handler_;
    }

    /** The upper block moved along the first axis. */
    la::Vector sideways(const double way) const;

    const la::Vector &load() const
    {
      return load_;
    }

    const la::Matrix &stiffness() const
    {
      return stiffness_;
    }

    const dealii::AffineConstraints<double> &constraints() const
    {
      return constraints_;
    }

  private:
    const Material &material(const bool upper) const
    {
      return run_.materials[upper ? 1 : 0];
    }

    void make_mesh();

    /** The same cells on one part of the ranks each. */
    void create(const std::vector<Point<dim>> &vertices,
                const std::vector<dealii::CellData<dim>> &cells,
                const dealii::SubCellData &faces);

    /** Flag cells of both blocks up to @p towards along the interface and up to
     * @p depth from it. */
    void flag(const double towards, const double depth);

    /** Some cells at the interface and in the bulk of both blocks. */
    void refine();

    const dealii::hp::MappingCollection<dim> &make_collections();

    void add_element(bool simplices, unsigned int degree);

    void setup();

    /** Top and bottom follow the exact displacement. */
    void move_ends();

    /** The bottom slides; a corner of each block does not move sideways. */
    void let_slide();

    /** Pressure 1 on the top. */
    void press();

    void assemble();

    void measure(const la::Vector &u, Errors &errors) const;

    double mean_pressure(const Errors &errors) const
    {
      return run_.yields ? errors.force : 1.;
    }

    void measure_stress(const la::Vector &u, Errors &errors) const;

    /** p n must be the secondary's outward normal wherever there is a row. */
    void measure_pressure(Errors &errors) const;

    /** A mesh that is not distributed is that of each rank alone. */
    static std::unique_ptr<Mesh>
    make_triangulation([[maybe_unused]] const MPI_Comm communicator);

    const Case run_;
    const std::unique_ptr<Mesh> triangulation_;
    const MPI_Comm communicator_;
    /** By block, or one for both. */
    dealii::hp::FECollection<dim> fe_;
    dealii::hp::QCollection<dim> points_;
    dealii::hp::QCollection<dim - 1> face_points_;
    dealii::hp::MappingCollection<dim> mappings_;
    const MappingByCell<dim> mapping_;
    const Tensor<2, dim> rotation_;
    dealii::DoFHandler<dim> dof_handler_;
    dealii::IndexSet owned_, relevant_;
    dealii::AffineConstraints<double> constraints_;
    la::Matrix stiffness_;
    la::Vector load_;
    ContactAssembler<dim> contact_;
    unsigned int n_hanging_ = 0;
  };

  /** Print a failed check. */
  inline bool is_at_most(const double value, const double bound,
                         const std::string &what)
  {
    const bool good = value <= bound;
    if (!good && MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << " is " << value << ", allowed are "
                << bound << std::endl;
    return good;
  }

  // Compiled once, in two_blocks.cc.
  extern template class TwoBlocks<2>;
  extern template class TwoBlocks<3>;
} // namespace abut::hosts

#endif

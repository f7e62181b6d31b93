// SPDX-License-Identifier: LGPL-2.1-or-later
// Load steps that are given up leave no trace: the next steps give the same
// answer, bit for bit, as if they had never been tried. The same for a history
// that was written and read again, by another object or on other ranks; and
// what is no history is refused on all ranks.
#include "patch.h"

#include <abut/dealii/rigid_obstacle.h>

#include <sstream>

using namespace abut;

namespace
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::Tensor;

  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    const bool everywhere = MPI::min(holds ? 1 : 0, MPI_COMM_WORLD) == 1;
    if (!everywhere && MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << std::endl;
    good = good && everywhere;
  }

  /** Whether two vectors are the same on this rank: bit for bit on one and two
   * ranks; sums over more come in the order in which messages arrive. */
  bool are_same(const la::Vector &a, const la::Vector &b)
  {
    const bool exact = MPI::n_mpi_processes(MPI_COMM_WORLD) <= 2;
    const double noise = exact ? 0. : 1e-11 * a.linfty_norm();
    return la::n_owned(a) == la::n_owned(b)
           && std::equal(la::data(a), la::data(a) + la::n_owned(a), la::data(b),
                         [=](const double x, const double y)
                         { return std::abs(x - y) <= noise; });
  }

  double largest_difference(const la::Vector &a, const la::Vector &b)
  {
    la::Vector difference(a);
    difference -= b;
    return difference.linfty_norm();
  }

  /** Two blocks pressed together by an overlap that grows. */
  template <int dim> class Steps
  {
  public:
    explicit Steps(const hosts::Case &run,
                   const MPI_Comm communicator = MPI_COMM_WORLD,
                   std::shared_ptr<const Friction<dim>> friction = nullptr)
        : blocks_(run, communicator), pair_(blocks_.pair())
    {
      pair_.reach = 1.;
      pair_.friction = std::move(friction);
      blocks_.prepare({pair_});
      displacement = blocks_.start();
    }

    hosts::Errors step(const double overlap)
    {
      ContactPair<dim> pair = pair_;
      pair.gap = -overlap;
      contact().set_pairs({pair});
      return blocks_.solve(displacement);
    }

    /** The same up to the first change of the displacement. */
    void step_in_part(const double overlap)
    {
      ContactPair<dim> pair = pair_;
      pair.gap = -overlap;
      contact().set_pairs({pair});
      contact().detect(displacement);
      la::Vector residual(displacement), increment(displacement);
      blocks_.stiffness().vmult(residual, displacement);
      blocks_.constraints().set_zero(residual);
      contact().solve(blocks_.stiffness(), residual, increment);
      displacement += increment;
      contact().update(displacement);
    }

    void commit()
    {
      contact().commit(displacement);
    }

    ContactAssembler<dim> &contact()
    {
      return blocks_.contact();
    }

    void repartition(const unsigned int weight)
    {
      contact().detect(displacement);
      // Tpetra's vectors have no move assignment: they keep the partition.
      la::Vector moved = blocks_.repartition(displacement, weight);
      displacement.swap(moved);
    }

    la::Vector displacement;

  private:
    hosts::TwoBlocks<dim> blocks_;
    ContactPair<dim> pair_;
  };

  hosts::Case wedge(const std::string &law,
                    const abut_discretisation discretisation)
  {
    hosts::Case run;
    run.name = law + ", " + discretisation_name(discretisation);
    run.method = hosts::method(law, discretisation);
    // Closed on one side only.
    run.tilt = 0.5;
    run.yields = true;
    return run;
  }

  /** A step that is given up, as a whole or after its first system. */
  template <int dim> void check_rollback(const hosts::Case &run)
  {
    const std::string name = run.name + ", " + std::to_string(dim) + "D: ";
    Steps<dim> never(run), tried(run);
    unsigned int n_active = 0, n_rows = 0;
    for (Steps<dim> *steps : {&never, &tried})
    {
      const hosts::Errors first = steps->step(0.01);
      n_active = first.n_active;
      n_rows = first.n_rows;
      steps->commit();
    }
    expect(n_active > 0 && n_active < n_rows, name + "part in contact");

    const la::Vector committed = tried.displacement;
    tried.step(0.2);
    expect(largest_difference(tried.displacement, committed) > 0.05,
           name + "the large step does something");
    for (const bool in_part : {false, true})
    {
      if (in_part)
        tried.step_in_part(0.1);
      tried.contact().rollback();
      tried.displacement = committed;
    }
    for (const double overlap : {0.015, 0.02})
    {
      const hosts::Errors a = never.step(overlap), b = tried.step(overlap);
      expect(a.reason == ABUT_REASON_CONVERGED, name + "convergence");
      expect(a.steps == b.steps && a.n_active == b.n_active,
             name + "another way after a rollback");
      expect(are_same(never.displacement, tried.displacement),
             name + "another displacement after a rollback, by "
                 + std::to_string(largest_difference(never.displacement,
                                                     tried.displacement)));
      expect(are_same(never.contact().results().pressure(),
                      tried.contact().results().pressure()),
             name + "another pressure after a rollback");
      never.commit();
      tried.commit();
    }
  }

  /** Into another object, on the same ranks and on others. */
  template <int dim> void check_file(const hosts::Case &run)
  {
    const std::string name = run.name + ", " + std::to_string(dim) + "D: ";
    Steps<dim> first(run);
    first.step(0.01);
    first.commit();
    std::stringstream file;
    first.contact().state().save(file);
    const bool has_bytes = file.str().size() > 100;
    expect(has_bytes == (MPI::this_mpi_process(MPI_COMM_WORLD) == 0),
           name + "rank 0 writes");

    Steps<dim> second(run);
    second.displacement = first.displacement;
    second.contact().state().load(file);
    const la::Vector saved = first.contact().results().pressure();
    for (Steps<dim> *steps : {&first, &second})
      steps->step(0.015);
    expect(are_same(first.displacement, second.displacement),
           name + "another displacement after load()");
    expect(are_same(first.contact().results().pressure(),
                    second.contact().results().pressure()),
           name + "another pressure after load()");
    second.contact().rollback();
    second.contact().detect(first.displacement);
    expect(are_same(second.contact().results().pressure(), saved),
           name + "what was loaded counts as committed");

    // What rank 0 reads goes to whoever has the points now.
    Steps<dim> third(run);
    third.repartition(10000);
    const double force = first.contact().results().measures().force;
    std::stringstream other;
    first.commit();
    first.contact().state().save(other);
    third.contact().state().load(other);
    third.contact().detect(third.displacement);
    const auto expect_force = [&](Steps<dim> &steps, const std::string &where)
    {
      const double other_force = steps.contact().results().measures().force;
      expect(std::abs(other_force - force) <= 1e-12 * force && force > 0.,
             name + "force " + where);
    };
    expect_force(third, "on other ranks");

    // From all ranks to each alone, and from one to all.
    Steps<dim> alone(run, MPI_COMM_SELF), together(run);
    std::stringstream copy(MPI::broadcast(MPI_COMM_WORLD, other.str()));
    alone.contact().state().load(copy);
    alone.contact().detect(alone.displacement);
    expect_force(alone, "on each rank alone");
    alone.commit();
    std::stringstream back;
    alone.contact().state().save(back);
    together.contact().state().load(back);
    together.contact().detect(together.displacement);
    expect_force(together, "on all ranks again");
  }

  /** With friction the host tells the displacement of the commit(): slips must
   * not be measured from an undeformed body without a word. */
  template <int dim> void check_slips_after_load(const hosts::Case &run)
  {
    const std::string name = run.name + ", friction: ";
    auto friction = std::make_shared<Friction<dim>>();
    friction->coefficient = [](const dealii::Point<dim> &) { return 0.05; };
    Steps<dim> first(run, MPI_COMM_WORLD, friction);
    first.step(0.01);
    first.commit();
    std::stringstream file;
    first.contact().state().save(file);

    Steps<dim> second(run, MPI_COMM_WORLD, friction);
    second.displacement = first.displacement;
    second.contact().state().load(file);
    std::string message;
    try
    {
      second.contact().detect(second.displacement);
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    expect(message.find("set_committed()") != std::string::npos,
           name + "load() without set_committed() says '" + message + "'");
    second.contact().state().set_committed(first.displacement);
    for (Steps<dim> *steps : {&first, &second})
    {
      steps->step(0.015);
      expect(steps->contact().results().pairs()[0].friction_force > 0.,
             name + "no friction");
    }
    expect(are_same(first.displacement, second.displacement),
           name + "another displacement after load() and set_committed()");
  }

  template <int dim>
  std::string refusal_of(Steps<dim> &steps, const std::string &bytes)
  {
    std::istringstream stream(bytes);
    try
    {
      steps.contact().state().load(stream);
    }
    catch (const HistoryError &error)
    {
      return error.what();
    }
    return "";
  }

  template <int dim> void check_refusals(const hosts::Case &run)
  {
    Steps<dim> steps(run), same(run);
    for (Steps<dim> *each : {&steps, &same})
    {
      each->step(0.01);
      each->commit();
    }
    std::stringstream file;
    steps.contact().state().save(file);
    same.contact().state().save(file);
    const std::string bytes = MPI::broadcast(MPI_COMM_WORLD, file.str());
    const auto expect_refused =
        [&](const std::string &given, const std::string &word)
    {
      const std::string text = refusal_of(steps, given);
      expect(text.find(word) != std::string::npos,
             "refused with '" + text + "', without '" + word + "'");
    };
    expect_refused("", "empty or not open");
    expect_refused(std::string(1000, 'x'), "not a contact history");
    expect_refused(bytes.substr(0, 30), "cut off");
    const std::size_t half = bytes.size() / 2;
    expect_refused(bytes.substr(0, half - 1), "cut off");
    std::string damaged = bytes;
    damaged[half - 100] = static_cast<char>(damaged[half - 100] ^ 1);
    expect_refused(damaged, "damaged");
    damaged = bytes;
    damaged[12] = 9;
    expect_refused(damaged, "version");

    hosts::Case finer = run;
    finer.cells = {{4, 5}};
    Steps<dim> other(finer);
    other.step(0.01);
    other.commit();
    std::stringstream file_of_other;
    other.contact().state().save(file_of_other);
    expect_refused(MPI::broadcast(MPI_COMM_WORLD, file_of_other.str()),
                   "another mesh");

    // Nothing has changed.
    steps.step(0.015);
    same.step(0.015);
    expect(are_same(steps.displacement, same.displacement),
           "another displacement after histories that were refused");
  }

  template <int dim>
  ContactPair<dim> plane(const std::string &name, const double height)
  {
    Tensor<1, dim> up;
    up[dim - 1] = 1.;
    up = hosts::rotation<dim>() * up;
    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = dim;
    for (int d = 0; d < dim; ++d)
    {
      shape.axis[d] = up[d];
      shape.point[d] = height * up[d];
    }
    ContactPair<dim> pair;
    pair.name = name;
    pair.secondary = {hosts::upper_interface};
    pair.reach = 1.;
    pair.gap = -0.01;
    pair.obstacle = std::make_shared<RigidObstacle<dim>>(shape);
    return pair;
  }

  /** Two planes change places: nodes go from the first pair to the second. */
  template <int dim> void check_change_of_pairs()
  {
    const hosts::Case run =
        wedge("lagrange", ABUT_DISCRETISATION_NODE_TO_SEGMENT);
    hosts::TwoBlocks<dim> blocks(run);
    blocks.prepare({plane<dim>("first", 0.), plane<dim>("second", -10.)});
    ContactAssembler<dim> &contact = blocks.contact();
    la::Vector u = blocks.start();
    const hosts::Errors errors = blocks.solve(u);
    expect(errors.n_active > 0 && errors.n_active < errors.n_rows,
           "part in contact with the plane");
    const auto before = contact.results().pairs();
    const la::Vector pressure = contact.results().pressure();
    contact.set_pairs({plane<dim>("first", -10.), plane<dim>("second", 0.)});
    contact.detect(u);
    const auto after = contact.results().pairs();
    expect(before[0].n_rows > 0 && before[1].n_rows == 0 && after[0].n_rows == 0
               && after[1].n_rows == before[0].n_rows,
           "all rows change pairs");
    expect(are_same(contact.results().pressure(), pressure),
           "another pressure in another pair");
    expect(after[1].n_active == before[0].n_active, "another set in the pair");
  }

  template <int dim> void check_all()
  {
    for (const hosts::Case &run :
         {wedge("lagrange", ABUT_DISCRETISATION_DUAL_MORTAR),
          wedge("augmented lagrangian", ABUT_DISCRETISATION_MORTAR),
          wedge("augmented lagrangian", ABUT_DISCRETISATION_QUADRATURE_POINT)})
    {
      check_rollback<dim>(run);
      check_file<dim>(run);
    }
    check_refusals<dim>(wedge("lagrange", ABUT_DISCRETISATION_DUAL_MORTAR));
    check_change_of_pairs<dim>();
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_all<2>();
  check_all<3>();
  check_slips_after_load<2>(wedge("lagrange", ABUT_DISCRETISATION_DUAL_MORTAR));
  check_slips_after_load<3>(wedge("lagrange", ABUT_DISCRETISATION_DUAL_MORTAR));
  return good ? 0 : 1;
}

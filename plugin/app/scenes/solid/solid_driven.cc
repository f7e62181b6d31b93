// SPDX-License-Identifier: LGPL-2.1-or-later
// What a model has to do where forces move rigid obstacles: the order of their
// steps is that of the bodies.
#include "solid_model.h"

#include "shim/values_by_element.h"

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <limits>

namespace abut::app
{
  template <int dim> la::Vector SolidModel<dim>::start()
  {
    if (!motion)
      return MovingModel<dim>::start();
    driven.set_time(0.);
    driven.start();
    return MovingModel<dim>::start();
  }

  template <int dim> bool SolidModel<dim>::begin_start(la::Vector &u)
  {
    if (!MovingModel<dim>::begin_start(u))
      return false;
    driven.begin_start(motion->step_length());
    return true;
  }

  template <int dim> void SolidModel<dim>::end_start(la::Vector &u)
  {
    MovingModel<dim>::end_start(u);
    driven.end_start();
  }

  template <int dim>
  void SolidModel<dim>::resume(std::vector<la::Vector> fields)
  {
    MovingModel<dim>::resume(std::move(fields));
    if (motion)
      driven.resume();
  }

  template <int dim> bool SolidModel<dim>::begin_solve(la::Vector &u)
  {
    const bool is_new = MovingModel<dim>::begin_solve(u);
    if (motion)
      driven.begin_step(motion->step_length());
    return is_new;
  }

  template <int dim> bool SolidModel<dim>::next_solve(const la::Vector &u)
  {
    if (!MovingModel<dim>::next_solve(u))
      return false;
    driven.next_problem();
    return true;
  }

  template <int dim> void SolidModel<dim>::end_solve()
  {
    MovingModel<dim>::end_solve();
    if (!motion)
      return;
    driven.end_step();
    motion->add_rigid(driven.kinetic_energy(), driven.work());
  }

  template <int dim> Message SolidModel<dim>::commit()
  {
    driven.commit();
    return MovingModel<dim>::commit();
  }

  template <int dim> double SolidModel<dim>::energy(const la::Vector &u) const
  {
    const double of_bodies = MovingModel<dim>::energy(u);
    return motion ? of_bodies : of_bodies + driven.potential();
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SolidModel<dim>::driven_places(const double time) const
  {
    std::vector<dealii::Tensor<1, dim>> result;
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
      result.push_back(driven.displacement(o, time));
    return result;
  }

  template <int dim>
  double
  SolidModel<dim>::clearance(const std::size_t obstacle,
                             const dealii::Tensor<1, dim> &displacement) const
  {
    pairs->place_obstacle(obstacle, displacement);
    const la::Vector u = elasticity.ghosted(run.u);
    const auto nodes_of = shim::face_values(
        elasticity.mapping, elasticity.dof_handler, shim::face_nodes<dim>,
        dealii::update_values | dealii::update_quadrature_points);
    const dealii::FEValuesExtractors::Vector all(0);
    std::vector<dealii::Tensor<1, dim>> moved;
    std::vector<dealii::Point<dim>> places;
    std::vector<double> distances;
    double least = std::numeric_limits<double>::infinity();
    for (const auto &cell : elasticity.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary())
        continue;
      for (const unsigned int f : cell->face_indices())
        for (std::size_t p = 0; p < pairs->pairs().size(); ++p)
        {
          const ContactPair<dim> &pair = pairs->pairs()[p];
          if (pairs->obstacle_of(p) != obstacle || !cell->at_boundary(f)
              || pair.secondary.count(cell->face(f)->boundary_id()) == 0)
            continue;
          dealii::FEFaceValues<dim> &nodes = nodes_of.of(cell);
          moved.resize(nodes.n_quadrature_points);
          places.resize(nodes.n_quadrature_points);
          nodes.reinit(cell, f);
          nodes[all].get_function_values(u, moved);
          for (std::size_t q = 0; q < places.size(); ++q)
            places[q] = nodes.quadrature_point(q) + moved[q];
          pair.obstacle->distance(places, distances);
          for (const double distance : distances)
            least = std::min(least, distance + pair.gap);
        }
    }
    return dealii::Utilities::MPI::min(least, run.communicator);
  }

  template <int dim> void SolidModel<dim>::begin_places(const double tolerance)
  {
    driven.begin_problem(
        tolerance, [this](const std::size_t obstacle, const auto &displacement)
        { return clearance(obstacle, displacement); });
  }

  template <int dim>
  typename ContactModel<dim>::Placing
  SolidModel<dim>::place_obstacles(const bool solved, Message &why)
  {
    using Placing = typename ContactModel<dim>::Placing;
    using Answer = ForceBalance::Answer;
    Answer answer = Answer::stuck;
    if (solved)
    {
      std::vector<dealii::Tensor<1, dim>> force(parameters.obstacles.size());
      const std::vector<PairResult<dim>> results =
          run.contact.results().pairs();
      for (std::size_t p = 0; p < results.size(); ++p)
        if (const auto number = pairs->obstacle_of(p))
          force[*number] -= results[p].secondary_force;
      answer = driven.take(
          force, [this](const std::size_t obstacle, const auto &displacement)
          { return clearance(obstacle, displacement); });
    }
    else
      answer = driven.refuse();
    if (answer == Answer::move)
      return Placing::again;
    if (answer == Answer::balanced)
      return Placing::settled;
    if (solved)
      why = driven.explanation(answer);
    return Placing::lost;
  }

  template la::Vector SolidModel<2>::start();
  template la::Vector SolidModel<3>::start();
  template bool SolidModel<2>::begin_start(la::Vector &);
  template bool SolidModel<3>::begin_start(la::Vector &);
  template void SolidModel<2>::end_start(la::Vector &);
  template void SolidModel<3>::end_start(la::Vector &);
  template void SolidModel<2>::resume(std::vector<la::Vector>);
  template void SolidModel<3>::resume(std::vector<la::Vector>);
  template bool SolidModel<2>::begin_solve(la::Vector &);
  template bool SolidModel<3>::begin_solve(la::Vector &);
  template bool SolidModel<2>::next_solve(const la::Vector &);
  template bool SolidModel<3>::next_solve(const la::Vector &);
  template void SolidModel<2>::end_solve();
  template void SolidModel<3>::end_solve();
  template Message SolidModel<2>::commit();
  template Message SolidModel<3>::commit();
  template double SolidModel<2>::energy(const la::Vector &) const;
  template double SolidModel<3>::energy(const la::Vector &) const;
  template std::vector<dealii::Tensor<1, 2>>
  SolidModel<2>::driven_places(double) const;
  template std::vector<dealii::Tensor<1, 3>>
  SolidModel<3>::driven_places(double) const;
  template double SolidModel<2>::clearance(std::size_t,
                                           const dealii::Tensor<1, 2> &) const;
  template double SolidModel<3>::clearance(std::size_t,
                                           const dealii::Tensor<1, 3> &) const;
  template void SolidModel<2>::begin_places(double);
  template void SolidModel<3>::begin_places(double);
  template ContactModel<2>::Placing SolidModel<2>::place_obstacles(bool,
                                                                   Message &);
  template ContactModel<3>::Placing SolidModel<3>::place_obstacles(bool,
                                                                   Message &);
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "prescribed_forces.h"

#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Part of the magnitudes that a sum of forces has whose directions differ
     * by little. On a pin in its hole, with pressures like a cosine, it is
     * pi/4. */
    constexpr double one_direction = 0.9;

    template <int dim>
    dealii::Tensor<1, dim> part_in(const dealii::Tensor<1, dim> &force,
                                   const dealii::Tensor<1, dim> &directions)
    {
      dealii::Tensor<1, dim> part;
      for (unsigned int d = 0; d < dim; ++d)
        part[d] = directions[d] * force[d];
      return part;
    }
  } // namespace

  template <int dim>
  std::vector<const FreeBody<dim> *>
  bodies_in_balance(const std::vector<FreeBody<dim>> &bodies,
                    const std::vector<PairResult<dim>> &pairs,
                    const double force)
  {
    std::vector<dealii::Tensor<1, dim>> normal;
    std::vector<bool> known;
    double sum = 0.;
    std::size_t n_left = 0;
    for (const PairResult<dim> &pair : pairs)
    {
      normal.push_back(pair.secondary_force - pair.secondary_friction);
      known.push_back(normal.back().norm() == 0.);
      n_left += !known.back();
      sum += normal.back().norm();
    }
    if (n_left == 0 || sum < one_direction * force)
      return {};
    std::vector<const FreeBody<dim> *> in_balance;
    for (std::size_t before = 0; n_left > 0 && before != n_left;)
    {
      before = n_left;
      for (const FreeBody<dim> &body : bodies)
      {
        dealii::Tensor<1, dim> resultant;
        double magnitudes = 0.;
        for (std::size_t i = 0; i < pairs.size(); ++i)
          if (!known[i])
          {
            resultant += body.sides[i] * normal[i];
            magnitudes += std::abs(body.sides[i]) * normal[i].norm();
          }
        // Neither of 0, nor of NaN.
        if (!(magnitudes > 0.)
            || !(part_in(resultant, body.free).norm()
                 >= one_direction * magnitudes))
          continue;
        in_balance.push_back(&body);
        for (std::size_t i = 0; i < pairs.size(); ++i)
          if (!known[i] && body.sides[i] != 0.)
          {
            known[i] = true;
            --n_left;
          }
      }
    }
    return n_left == 0 ? in_balance : std::vector<const FreeBody<dim> *>();
  }

  template std::vector<const FreeBody<2> *>
  bodies_in_balance(const std::vector<FreeBody<2>> &,
                    const std::vector<PairResult<2>> &, double);
  template std::vector<const FreeBody<3> *>
  bodies_in_balance(const std::vector<FreeBody<3>> &,
                    const std::vector<PairResult<3>> &, double);
} // namespace abut::app

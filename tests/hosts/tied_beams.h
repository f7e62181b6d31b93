// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_TIED_BEAMS_H
#define ABUT_TESTS_TIED_BEAMS_H

/** @file
 * Two beams that are tied, of tetrahedra, and the displacements that the
 * example tetCM (contact_slag_tied_iter) of another program, FrontISTR,
 * has (https://github.com/FrontISTR/FrontISTR, commit 9f5e9f5f). (0,
 * 2) x (0, 1)^2 is clamped at x = 0 and tied at x = 2 to (2, 4) x (0, 1)^2; a
 * pressure of 1 follows the faces at y = 1. Young's modulus 1000, Poisson's
 * ratio 0.3, linear material. */

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace abut::hosts
{
  struct BeamNode
  {
    double x[3], u[3];
  };

  struct TiedBeams
  {
    std::vector<BeamNode> nodes;
    std::vector<std::array<unsigned int, 4>> cells;
  };

  // clang-format off
  inline const std::vector<BeamNode> tied_beam_nodes = {
    {{1, 0, 0}, {-0.01259090072826, -0.02121320778646, 0.00254859279039}},
    {{1, 0, 1}, {-0.01071902614155, -0.02008045040645, 0.003465169634022}},
    {{0, 0, 1}, {0, 0, 0}},
    {{0, 0, 0}, {0, 0, 0}},
    {{1, 1, 1}, {0.01259081929305, -0.02177935932591, 0.002742296897059}},
    {{0, 1, 1}, {0, 0, 0}},
    {{0, 1, 0}, {0, 0, 0}},
    {{1, 1, 0}, {0.01057570750104, -0.02040739610612, 0.003333147828883}},
    {{2, 1, 1}, {0.01933056954231, -0.05729088526856, 0.001982678015846}},
    {{2, 0, 1}, {-0.01553116359256, -0.05650705986998, 0.002219512459749}},
    {{2, 0, 0}, {-0.01922587081852, -0.05672822185788, 0.001718043157831}},
    {{2, 1, 0}, {0.01545571733615, -0.05688450306189, 0.002094606956462}},
    {{0.5, 0.5, 0.5}, {-3.876814809578e-05, -0.008079232552623, 0.001641078305396}},
    {{1.5, 0.49991703, 0.5}, {9.989537712431e-06, -0.03763576225064, 0.002445271340827}},
    {{3, 0, 0}, {-0.0218960713132, -0.09764397344629, -0.001696496404015}},
    {{3, 0, 1}, {-0.01720202760706, -0.09752608043663, -0.001329181929803}},
    {{2, 0, 1}, {-0.01553116359256, -0.05650705986998, 0.002219512459749}},
    {{2, 0, 0}, {-0.01922587081852, -0.05672822185788, 0.001718043157831}},
    {{3, 1, 1}, {0.02209136610518, -0.09831949216395, -0.001333638545536}},
    {{2, 1, 1}, {0.01933056954231, -0.05729088526856, 0.001982678015846}},
    {{2, 1, 0}, {0.01545571733615, -0.05688450306189, 0.002094606956462}},
    {{3, 1, 0}, {0.01734358744231, -0.09782623557894, -0.001310080023529}},
    {{4, 1, 1}, {0.02284893994186, -0.1393833781321, -0.006082445802387}},
    {{4, 0, 1}, {-0.01733474309161, -0.1386277460998, -0.006151009759195}},
    {{4, 0, 0}, {-0.02241500701068, -0.1387138532594, -0.006391986939799}},
    {{4, 1, 0}, {0.01774657886564, -0.1389493708742, -0.006132162627301}},
    {{2.5065283, 0.47230574, 0.47654158}, {-0.001086658795703, -0.07713770647929, 0.0002916596712227}},
    {{3.4757498, 0.53102702, 0.51110506}, {0.001433370757984, -0.1173455383366, -0.003727361389897}},
  };
  // clang-format on

  /** The corners of a tetrahedron in an order with positive volume. */
  inline std::array<unsigned int, 4>
  right_handed(std::array<unsigned int, 4> cell)
  {
    double e[3][3];
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        e[k][d] =
            tied_beam_nodes[cell[k + 1]].x[d] - tied_beam_nodes[cell[0]].x[d];
    const double volume = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1])
                          - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0])
                          + e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    if (volume < 0.)
      std::swap(cell[2], cell[3]);
    return cell;
  }

  /** Four unit cubes in a row, each of twelve tetrahedra between its faces,
   * which a diagonal cuts in two, and a node inside. The beams share no nodes:
   * the first two cubes come before the others. */
  inline TiedBeams make_tied_beams()
  {
    // Corners x + 2 y + 4 z at the ends of the diagonals of the faces at the
    // lower and upper x, y and z; those at the lower x alternate.
    constexpr unsigned int diagonals[6][2] = {{2, 4}, {1, 7}, {1, 4},
                                              {2, 7}, {0, 3}, {5, 6}},
                           alternate[2] = {0, 6}, center[4] = {12, 13, 26, 27};
    const auto &nodes = tied_beam_nodes;
    TiedBeams beams{nodes, {}};
    for (unsigned int cube = 0; cube < 4; ++cube)
    {
      const auto node = [&](const unsigned int corner)
      {
        const double at[3] = {1. * (cube + (corner & 1U)),
                              1. * ((corner >> 1U) & 1U), 1. * (corner >> 2U)};
        const unsigned int first = cube < 2 ? 0 : 14;
        return static_cast<unsigned int>(
            std::find_if(nodes.begin() + first, nodes.end(),
                         [&](const BeamNode &one)
                         { return std::equal(one.x, one.x + 3, at); })
            - nodes.begin());
      };
      for (unsigned int face = 0; face < 6; ++face)
      {
        const unsigned int *ends =
            face == 0 && cube % 2 == 1 ? alternate : diagonals[face];
        const unsigned int bit = 1U << (face / 2), side = face % 2 * bit;
        for (unsigned int third = 0; third < 8; ++third)
          if ((third & bit) == side && third != ends[0] && third != ends[1])
            beams.cells.push_back(right_handed(
                {{center[cube], node(ends[0]), node(ends[1]), node(third)}}));
      }
    }
    return beams;
  }
} // namespace abut::hosts

#endif

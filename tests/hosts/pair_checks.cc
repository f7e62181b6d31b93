// SPDX-License-Identifier: LGPL-2.1-or-later
// Pairs that cannot be solved are answered in words; nodes that no row holds
// are found on the deformed bodies.
#include "patch.h"

using namespace abut;

namespace
{
  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (holds)
      return;
    good = false;
    std::cout << "FAILED: " << what << std::endl;
  }

  /** detect() throws a ContactError with all of @p words. */
  void refuses(const hosts::Case &run, const ContactPair<2> *other,
               const std::vector<std::string> &words)
  {
    hosts::TwoBlocks<2> blocks(run);
    blocks.prepare({other != nullptr ? *other : blocks.pair()});
    try
    {
      blocks.contact().detect(blocks.displacement());
    }
    catch (const ContactError &error)
    {
      for (const std::string &word : words)
        expect(std::string(error.what()).find(word) != std::string::npos,
               "'" + word + "' in '" + error.what() + "'");
      return;
    }
    expect(false, "an error with the words '" + words.front() + "'");
  }

  void check_refusals()
  {
    hosts::Case run;
    run.separation = 0.6;
    refuses(run, nullptr, {"interface", "too far apart", "0.6", "reach"});
    run.separation = -0.3;
    refuses(run, nullptr, {"interface", "overlap", "0.3", "reach"});
    run.separation = 0.;

    ContactPair<2> pair;
    pair.name = "wheel on rail";
    pair.secondary = {hosts::upper_interface};
    refuses(run, &pair, {"wheel on rail", "neither"});
    pair.primary = {77};
    refuses(run, &pair, {"wheel on rail", "no facet", "primary"});
    pair.primary = {hosts::upper_interface, hosts::lower_interface};
    refuses(run, &pair, {"wheel on rail", "both sides"});
    // The top of the upper block looks the same way as that of the lower.
    pair.primary = {hosts::lower_interface};
    pair.secondary = {hosts::top};
    pair.reach = 2.;
    refuses(run, &pair, {"wheel on rail", "normals", "same direction"});

    run.method =
        hosts::method("lagrange", ABUT_DISCRETISATION_QUADRATURE_POINT);
    refuses(run, nullptr, {"interface", "quadrature point", "lagrange"});
    run.method = hosts::method("barrier", std::nullopt);
    run.tied = true;
    refuses(run, nullptr, {"interface", "barrier", "cannot tie"});
  }

  /** A wedge that opens from 0 to 0.4: half a facet reaches to a third of it.
   */
  void check_search_after_motion()
  {
    hosts::Case run;
    run.tilt = 0.4;
    hosts::TwoBlocks<2> blocks(run);
    blocks.prepare({blocks.pair()});
    ContactAssembler<2> &contact = blocks.contact();
    contact.detect(blocks.displacement());
    const double before = contact.checks().pairs().at(0).covered_area;
    expect(before > 0.2 && before < 0.5, "a third of the surface covered");
    expect(contact.checks().penetrations(blocks.displacement(), 1e-6).empty(),
           "no penetration at rest");

    const la::Vector moved = blocks.displacement(-0.3);
    const auto found = contact.checks().penetrations(moved, 1e-6);
    expect(!found.empty(), "nodes found after the motion");
    for (const auto &node : found)
    {
      const auto x =
          transpose(hosts::rotation<2>()) * dealii::Tensor<1, 2>(node.point);
      // The wedge is closed up to 0.75 and has rows up to 0.3 at least.
      expect(x[0] > 0.25 && x[0] < 0.751, "a place between rows and edge");
      expect(node.depth > 0. && node.depth <= 0.3, "a depth within the motion");
    }

    contact.detect(moved);
    expect(contact.checks().pairs().at(0).covered_area > before,
           "a reach that follows the motion");
    expect(contact.checks().penetrations(moved, 1e-6).empty(),
           "rows at all penetrating nodes");
  }

  /** Rows at the nodes of a coarse secondary say nothing of the primary's nodes
   * between them: those are measured, but they are no misses. */
  void check_between_rows()
  {
    for (const auto discretisation :
         {ABUT_DISCRETISATION_NODE_TO_SEGMENT, ABUT_DISCRETISATION_MORTAR})
    {
      hosts::Case run;
      run.cells = {{3, 9}};
      run.upper_is_secondary = false;
      run.method = hosts::method("penalty", discretisation);
      hosts::TwoBlocks<2> blocks(run);
      blocks.prepare({blocks.pair()});
      ContactAssembler<2> &contact = blocks.contact();
      contact.detect(blocks.displacement());
      const std::string name = discretisation_name(discretisation);
      expect(contact.checks()
                 .penetrations(blocks.displacement(-0.05), 1e-6)
                 .empty(),
             name + ": no misses where all nodes have rows");
      const double depth = contact.results().pairs().at(0).between_rows;
      expect(std::abs(depth - 0.05) < 1e-12,
             name + ": depth of the primary's nodes, " + std::to_string(depth));
    }
  }

  /** A die that its boundary values move after reinit(). */
  void check_moved_die()
  {
    hosts::Case run;
    run.is_die = true;
    run.upper_is_secondary = false;
    run.method = hosts::method("penalty", ABUT_DISCRETISATION_DUAL_MORTAR);
    hosts::TwoBlocks<2> blocks(run);
    blocks.prepare({blocks.pair()});
    ContactAssembler<2> &contact = blocks.contact();
    const la::Vector rest = blocks.displacement();
    for (const double height : {0., 0.01, 0.03})
    {
      if (height > 0.)
        blocks.lift_supports(height == 0.01 ? 0.01 : 0.02);
      contact.detect(rest);
      const la::Vector gap = contact.results().gap();
      const double largest = gap.linfty_norm();
      expect(std::abs(largest - height) < 1e-12,
             "a gap of " + std::to_string(height) + " and not "
                 + std::to_string(largest));
    }
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_refusals();
  check_search_after_motion();
  check_between_rows();
  check_moved_die();
  return good ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RUN_SUMMARY_H
#define ABUT_APP_RUN_SUMMARY_H

#include <boost/property_tree/ptree.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace abut::app
{
  /** The summary.json of a run. */
  class RunSummary
  {
  public:
    RunSummary() = default;

    /** Read @p file; without it, or if it is not whole, there are no values. */
    explicit RunSummary(const std::filesystem::path &file);

    /** A number by name, none when it is not there or not finite:
     *
     *     contact_force           true and false are 1 and 0
     *     pair_1_force[1]         a component, counted from 0
     *     sections/solve/seconds  of an object inside
     */
    std::optional<double> number(const std::string &key) const;

    /** @p key without the sections `results` and `output`, which measure and
     * write: for processor_seconds and wall_seconds. */
    std::optional<double> cost(const std::string &key) const;

    std::vector<std::string> keys() const;

    /** What is wrong with a key that number() has nothing for, and what to
     * write instead, with a blank in front; empty if nothing is like it. */
    std::string explain(const std::string &key) const;

  private:
    boost::property_tree::ptree tree;
  };
} // namespace abut::app

#endif

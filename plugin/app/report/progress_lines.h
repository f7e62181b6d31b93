// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PROGRESS_LINES_H
#define ABUT_APP_PROGRESS_LINES_H

#include <optional>
#include <string>

namespace abut::app
{
  /** Lines of progress on standard output: all of them; or, on a terminal, one
   * line that is written over; or else a few: the first and the last, one for
   * each fifth of the run where its end is known, and numbers 2, 4, 16, 64, ...
   * where it is not. */
  class ProgressLines
  {
  public:
    explicit ProgressLines(bool all);

    /** A step has ended after so many seconds.
     * @param done part of the run behind it; from it follows the time left */
    void step(const std::string &line, double seconds,
              std::optional<double> done);

    /** A step between those, which a few lines leave out. */
    void detail(const std::string &line, double seconds);

    /** Any other line. */
    void print(const std::string &line);

    /** A line of standard error follows. */
    void interrupt();

    /** No step follows: print the last one, if it was left out. */
    void finish();

    /** Lines so far, with those of standard error. */
    unsigned int n_printed() const
    {
      return n;
    }

  private:
    bool is_wanted(std::optional<double> done);
    void write(const std::string &text);
    void overwrite(const std::string &text);
    void end_line();

    const bool all, terminal;
    bool is_open = false; ///< the terminal's line has no end yet
    unsigned int n = 0, n_steps = 0, n_fifths = 0;
    std::string left_out; ///< the last step
  };
} // namespace abut::app

#endif

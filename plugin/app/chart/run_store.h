// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHART_RUN_STORE_H
#define ABUT_APP_CHART_RUN_STORE_H

/** @file
 * Finished runs on disk.
 *
 * Each stands in a folder `runs/<key>-<repeat>` with the files that `abut run`
 * wrote and `run.json`. A run works in `<that>.part`, which is renamed when all
 * is written: an interrupted one leaves nothing that could be taken for a
 * result.
 */

#include "app/report/run_figures.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace abut::app
{
  /** What is kept of a run. */
  struct RunRecord
  {
    std::string setting;  /**< all that it depends on */
    std::string ended;    /**< ok, unusable, refused, failed, out of time */
    std::string reason;   /**< what the run said, unless ok */
    double limit = 0;     /**< processor seconds that it had */
    double seconds = 0;   /**< on the wall, from start to end */
    int code = 0;         /**< exit code, or minus the signal */
    RunFigures figures{}; /**< of what it wrote */
  };

  /** The folder `runs` of a chart, locked while this exists. */
  class RunStore
  {
  public:
    /** Make the folder, remove what interrupted runs left. Throws InputError
     * while another chart works there. */
    explicit RunStore(const std::filesystem::path &folder);
    ~RunStore();
    RunStore(const RunStore &) = delete;
    RunStore &operator=(const RunStore &) = delete;

    /** The finished run of @p setting; none if there is none, if a signal ended
     * it, or if it ended for want of time and there is more now. */
    std::optional<RunRecord> find(const std::string &setting,
                                  unsigned int repeat, double limit) const;

    /** An empty folder for a run to work in. */
    std::filesystem::path begin(const std::string &setting,
                                unsigned int repeat) const;

    /** Keep what stands in the folder given by begin(), and @p record. */
    void finish(const RunRecord &record, unsigned int repeat) const;

    /** Name of a run, made from all that it depends on. */
    static std::string key(const std::string &setting);

  private:
    std::filesystem::path place(const std::string &setting,
                                unsigned int repeat) const;

    std::filesystem::path folder;
    int lock;
  };

  /** 64 bits of FNV-1a. */
  std::uint64_t hash(const std::string &bytes);

  /** The bytes of a file; throws std::runtime_error. */
  std::string file_bytes(const std::filesystem::path &file);

  /** Write @p text to a file at once: a reader sees the old file or the new
   * one. Throws std::runtime_error. */
  void write_at_once(const std::filesystem::path &file,
                     const std::string &text);
} // namespace abut::app

#endif

#pragma once

#include "io/case/case.hpp"
#include "io/results/files.hpp"
#include "io/run_folder/log.hpp"
#include "io/run_folder/run_folder.hpp"
#include "solver/stages/command_line.hpp"
#include "solver/stages/pace.hpp"

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>

namespace mpm
{
/// What all parts of a run share: options, case, log, output folder and the time on the wall.
class Session
{
public:
  /// Reads the case; its warnings go to the log. `Error` as load_case.
  explicit Session(Options options);

  /// Takes the output folder for a run of this identity; opens the log. `Error` as RunFolder.
  void open_folder(const RunFolder::Identity& identity);

  /// Whether a signal or `--max-wall` asks for an end.
  bool must_stop() const;
  /// Whether the interval between checkpoints has gone by since the last one: the case's, or where that
  /// adapts as much more as makes writing take no more than 2 %. Nothing of the results depends on it.
  bool checkpoint_due() const;
  /// Writes a checkpoint with what belongs to it, and notes how long that took; says so where it makes the
  /// next ones rarer, or where the case's interval does not allow for it.
  void write_checkpoint(const std::function<void()>& write);

  Provenance provenance() const;
  double wall_seconds() const; ///< since the program began

  Options options;
  Log log;
  Case case_file; ///< a seismic run sets the duration where it goes with the record
  std::unique_ptr<RunFolder> folder;
  nlohmann::json facts = nlohmann::json::object(); ///< what was found out before the run, for summary.json

private:
  using Wall = std::chrono::steady_clock;

  Wall::time_point start_ = Wall::now();
  Pace checkpoints_{0};
  bool told_of_cost_ = false;
};
} // namespace mpm

#pragma once

#include "io/case/case.hpp"
#include "io/results/files.hpp"
#include "io/run_folder/log.hpp"
#include "io/run_folder/run_folder.hpp"
#include "solver/stages/command_line.hpp"

#include <chrono>
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
  /// Whether the case's interval has gone by since the last checkpoint.
  bool checkpoint_due() const;
  void note_checkpoint() { last_checkpoint_ = Wall::now(); }

  Provenance provenance() const;
  double wall_seconds() const; ///< since the program began

  Options options;
  Log log;
  Case case_file; ///< a seismic run sets the duration where it goes with the record
  std::unique_ptr<RunFolder> folder;
  nlohmann::json facts = nlohmann::json::object(); ///< what was found out before the run, for summary.json

private:
  using Wall = std::chrono::steady_clock;
  Wall::time_point start_ = Wall::now(), last_checkpoint_ = start_;
};
} // namespace mpm

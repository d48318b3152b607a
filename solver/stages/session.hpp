#pragma once

#include "io/case/case.hpp"
#include "io/results/files.hpp"
#include "io/run_folder/log.hpp"
#include "io/run_folder/run_folder.hpp"
#include "solver/stages/command_line.hpp"
#include "solver/stages/model.hpp"

#include <chrono>
#include <nlohmann/json.hpp>

namespace mpm
{
/// Of all states that a run goes on from.
inline constexpr std::string_view checkpoint_schema = "seismpm-checkpoint/3";

/// Step counter and time: t = t0 + (k - k0) dt, so that no rounding piles up.
struct Clock
{
  double dt = 0;
  std::int64_t step = 0;
  double start_time = 0;
  std::int64_t start_step = 0;

  double time() const { return start_time + static_cast<double>(step - start_step) * dt; }
  void change_step(double new_dt)
  {
    start_time = time();
    start_step = step;
    dt = new_dt;
  }
  /// Whether a multiple of `every` (s) was reached in the last step.
  bool passed(double every) const;
};

/// What both stages share: options, case, log, output folder, the clock on the wall and the summary.
class Session
{
public:
  explicit Session(Options options);

  /// Takes the output folder for a run of this identity; opens the log.
  void open_folder(const RunFolder::Identity& identity);
  /// Whether a signal or the wall-time limit asks for an end.
  bool must_stop() const;
  /// Whether the next checkpoint is due; asking resets nothing.
  bool checkpoint_due() const;
  /// Writes the state of a stage: `fill` adds what is the stage's own.
  void write_checkpoint(const std::string& name, std::string_view stage, Model& model, const Clock& clock,
                        const std::function<void(h5::File&)>& fill);
  /// Whether the folder holds the finished run, with all its files whole; says so. What is not whole is told,
  /// and the run is no longer finished.
  bool finished_already();
  /// Begins or goes on with the folder's run, from the best state in it: `load` takes it from the file, or
  /// throws. One that is damaged or cannot be is told and passed over for an older one. False: there is none,
  /// the run starts from the beginning. `Error` folder_taken when all that a state lacks is a result file
  /// that goes with it.
  bool resume(const std::function<void(const h5::File&)>& load);
  /// Whether the state that was resumed is the run's last.
  bool at_end() const { return at_end_; }
  /// Writes summary.json and ends the run's log. With `exit` done, marks the folder as finished by the files
  /// named in `results` beside those that every run has.
  void finish(std::string_view stage, int exit, const Model& model, const Clock& clock, nlohmann::json more,
              std::vector<std::string> results = {});
  /// The case with every default written out, and the records of the command line in it, as YAML.
  std::string resolved_case() const;
  Provenance provenance() const;
  double wall_seconds() const;
  void loop_begins(std::int64_t step, const Model& model);

  Options options;
  Log log;
  Case case_file;
  std::unique_ptr<RunFolder> folder;
  nlohmann::json facts = nlohmann::json::object(); ///< what was found out before the run, for the summary

private:
  using Wall = std::chrono::steady_clock;
  Wall::time_point start_ = Wall::now(), last_checkpoint_ = start_, loop_start_ = start_;
  /// Opens a state of this very run, or throws.
  h5::File open_state(const std::filesystem::path& path);

  std::int64_t first_step_ = 0;
  bool at_end_ = false;
  std::array<double, phase_names.size()> earlier_{}; ///< times of the phases when the loop began, s
};

/// Halves the step when the ground has become so loose that waves outrun it.
void check_step(Session& session, const Model& model, double courant_number, Clock& clock);

/// Parses the command line, runs `stage` and maps every way to end to its exit code (INTERFACE: exit codes).
int run_program(int argc, char** argv, const std::string& name, int (*stage)(Session&));

/// Loads clock and domains of a checkpoint of the same stage, which cannot be later than `at_most` (s). The
/// clock holds the step with which the case begins. `Error` bad_input when no run of the case can have left
/// such a state.
void load_model(const h5::File& file, Model& model, Clock& clock, double at_most);

/// What of a case makes a run of a stage that run and no other, defaults written out.
RunFolder::Identity static_settings(const Case& case_file);
RunFolder::Identity seismic_settings(const Case& case_file);

/// The settings that shape the ground itself, as sorted lines `key = value`: what static and seismic stage
/// must share.
std::vector<std::string> ground_settings(const Case& case_file);
} // namespace mpm

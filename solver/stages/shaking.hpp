#pragma once

#include "solver/stages/departures.hpp"
#include "solver/stages/energy_watch.hpp"
#include "solver/stages/motion.hpp"
#include "solver/stages/observer.hpp"
#include "solver/stages/pace.hpp"
#include "solver/stages/resume.hpp"
#include "solver/stages/self_driven.hpp"
#include "solver/stages/summary.hpp"

namespace mpm
{
/// The seismic stage: shaking and run-out, from the switch or from a checkpoint to the end of the case.
class Shaking
{
public:
  /// `from`: digest of the static state, empty for none.
  Shaking(Session& session, Model& model, const Motion& motion, std::string from);

  /// The switch from the static state; what is written down begins here.
  void start(const Clock& clock);
  /// Takes up a state of this run, with its boundaries; `clock` holds the step with which the case begins.
  /// `Error` bad_input, folder_taken.
  void load(const h5::File& state, Clock& clock);
  /// Steps to the end of the case, writes results and returns the exit code; an error of the run is thrown.
  int run(Clock& clock, Start start);

private:
  enum class Ended
  {
    by_itself,   ///< at the case's end, or when ground had left and seismic.leaving is stop
    interrupted, ///< with a checkpoint
  };
  void report_start(const Clock& clock);
  Ended loop(Clock& clock, Progress& progress);
  bool is_good() const;
  void step(Clock& clock);
  void look_after(Clock& clock);
  bool take_out_departed(const Clock& clock);
  void let_rest(double time);
  void end_motion(const Clock& clock);
  void fade_when_self_driven();
  bool ends_self_driven() const;
  void save(const std::string& name, const Clock& clock);
  void report_end(const Clock& clock) const;
  double applied_until(const Clock& clock) const;
  Moment moment(const Clock& clock) const;
  nlohmann::json facts(const Clock& clock) const;

  Session& session_;
  const Case& case_file_;
  Model& model_;
  const Motion& motion_;
  std::string from_;
  Observer observer_;
  Pace series_{30, 0.01}; ///< of the series of a run that is under way, for whoever looks at it
  EnergyWatch energy_;
  Departures departures_;
  SelfDriven self_driven_;
};
} // namespace mpm

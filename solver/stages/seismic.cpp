// mpm-seismic: shakes a slope from its static state, and follows the slide.
//
//   mpm-seismic cases/slope/case.yaml --from run/static/final.h5 --out run/a
//   mpm-seismic cases/slope/case.yaml --from run/static/final.h5 --motion record.AT2 --out run/b
//   (the same again)                                          goes on after an interruption

#include "solver/stages/checkpoint.hpp"
#include "solver/stages/fidelity.hpp"
#include "solver/stages/filling_report.hpp"
#include "solver/stages/identity.hpp"
#include "solver/stages/predict.hpp"
#include "solver/stages/program.hpp"
#include "solver/stages/shaking.hpp"
#include "solver/stages/time_step.hpp"

#include <utility>

namespace mpm
{
namespace
{
constexpr double most_steps = 1e12; // years of computing for a single particle

/// A motion asked for on the command line is not to be left out; load_motion() warns of one of the case.
void refuse_motion_of_fixed_base(const Session& session)
{
  if (session.case_file.seismic.base != BaseKind::fixed) return;
  const Options& options = session.options;
  if (!options.motion.empty() || !options.vertical.empty() || options.scale != 1)
    throw Error(exit_code::usage,
                "mpm-seismic: --motion, --vertical and --scale: seismic.base.kind is fixed, "
                "and such a base takes no motion; leave them out, or make it compliant");
}

/// What can be known to be wrong before anything is read but the case.
void check_request(const Session& session)
{
  const Case& case_file = session.case_file;
  const Options& options = session.options;
  if (case_file.seismic.duration <= 0)
    throw Error(exit_code::bad_input, case_file.path.string() + ": has no seismic section; nothing to shake");
  refuse_motion_of_fixed_base(session);
  if (options.from.empty() && case_file.static_stage.gravity != 0 && !options.check)
    throw Error(exit_code::usage, "mpm-seismic: --from is missing: give the final.h5 of mpm-static");
  if (options.fresh && !options.from.empty() &&
      std::filesystem::weakly_canonical(options.from).parent_path() ==
          std::filesystem::weakly_canonical(options.out))
    throw Error(exit_code::usage,
                options.out.string() + ": --fresh would remove the static state; give another --out");
}

/// A wrong time step of a record shows as a run that would take for ever.
void check_steps(double duration, double dt)
{
  if (duration / dt <= most_steps) return;
  throw Error(exit_code::bad_input,
              fmt::format("seismic.duration: {:g} s are more than {:g} steps of {:.3g} s, which no run gets "
                          "through; shorten it, or mend the time step of the record",
                          duration, most_steps, dt));
}

/// The base's spring acts explicitly: on a base without mass it is stable while a = dt / T has
/// (1 - exp(-2 a)) (a + 2) < 4, a < 2.05. Asked for is a quarter of that.
void check_spring(const Case& case_file, double dt)
{
  const double time = case_file.seismic.base == BaseKind::compliant ? spring_time(case_file) : 0;
  if (time == 0 || time >= 2 * dt) return;
  throw Error(
      exit_code::bad_input,
      fmt::format(
          "{}: seismic.base.spring: {:.3g} s is shorter than two time steps of {:.3g} s, too stiff for "
          "them (map spring of cases/verification/ATLAS.md); give auto or a longer time",
          case_file.path.string(), time, dt));
}

int run_seismic(Session& session)
{
  const Case& case_file = session.case_file;
  const Options& options = session.options;
  check_request(session);

  // 1. The motion, and the ground as the static stage has left it.
  const Motion motion = load_motion(session);
  Model model;
  Clock clock;
  std::string from;
  const auto take_static_state = [&]
  {
    clock = {.dt = step_dividing(case_file.output.gauges.every, case_file.courant_number, *model.main)};
    if (!options.from.empty()) from = load_static_state(session, model);
  };
  const auto begin = [&]
  {
    model = make_model(case_file);
    take_static_state();
  };
  model = make_model(case_file);
  report_filling(session.log, case_file, model.filling);
  take_static_state();
  check_steps(case_file.seismic.duration, clock.dt);
  check_spring(case_file, clock.dt);
  const double first_step = clock.dt; // that of a state may have been halved since
  if (options.check)
  {
    report_wave_fidelity(session, first_step, motion.wave.get());
    model = make_model(case_file); // the probe needs no static state, and takes none that is loaded by half
    return predict_shaking(session, model, clock, motion.wave);
  }
  if (options.from.empty()) session.log.info("no gravity: starts from a stress-free state");

  // 2. The folder: ours, finished, or to be gone on with.
  RunFolder::Identity identity = seismic_settings(case_file);
  identity.insert(identity.end(), motion.identity.begin(), motion.identity.end());
  if (!from.empty()) identity.push_back({"from", from});
  session.open_folder(identity);
  if (finished_already(session)) return exit_code::done;

  // 3. The state: where an interrupted run stopped, or the switch from the static state.
  std::optional<Shaking> shaking;
  const Start start = resume(session, begin,
                             [&](const h5::File& state)
                             {
                               shaking.emplace(session, model, motion, from);
                               shaking->load(state, clock);
                             });
  if (start == Start::afresh)
  {
    shaking.emplace(session, model, motion, from);
    shaking->start(clock);
  }

  report_wave_fidelity(session, first_step, motion.wave.get());

  // 4. Shaking and run-out.
  return shaking->run(clock, start);
}
} // namespace
} // namespace mpm

int main(int argc, char** argv)
{
  return mpm::run_program(argc, argv, "mpm-seismic", mpm::run_seismic);
}

// mpm-static: the stress state of a slope under gravity.
//
//   mpm-static cases/slope/case.yaml --out run/static
//   mpm-static cases/slope/case.yaml --out run/static      goes on after an interruption
//   mpm-static cases/slope/case.yaml --check               says what it would cost

#include "solver/stages/checkpoint.hpp"
#include "solver/stages/fidelity.hpp"
#include "solver/stages/filling_report.hpp"
#include "solver/stages/identity.hpp"
#include "solver/stages/predict.hpp"
#include "solver/stages/program.hpp"
#include "solver/stages/relaxation.hpp"
#include "solver/stages/time_step.hpp"

namespace mpm
{
namespace
{
int run_static(Session& session)
{
  const Case& case_file = session.case_file;
  const StaticSettings& settings = case_file.static_stage;
  if (settings.gravity == 0)
    throw Error(exit_code::bad_input, case_file.path.string() +
                                          ": static.gravity: is 0, so there is no static state to "
                                          "find; run mpm-seismic without --from");
  // 1. The undeformed ground between walls.
  Clock clock;
  Model model = make_static_model(case_file, clock);
  report_filling(session.log, case_file, model.filling);
  const double shaking_step = unscaled_step(case_file.courant_number, *model.main); // of the seismic stage
  if (session.options.check)
  {
    report_wave_fidelity(session, shaking_step, nullptr);
    return predict_relaxation(session, model, clock);
  }

  // 2. The folder: ours, finished, or to be gone on with.
  session.open_folder(static_settings(case_file));
  if (finished_already(session)) return exit_code::done;
  std::optional<Relaxation> relaxation;
  const Start start = resume(
      session, [&] { model = make_static_model(case_file, clock); },
      [&](const h5::File& state)
      {
        relaxation.emplace(session, model);
        load_model(state, model, clock, settings.until.at_most);
        relaxation->load(state, clock);
      });
  if (start == Start::afresh)
  {
    relaxation.emplace(session, model);
    relaxation->start();
  }
  report_wave_fidelity(session, shaking_step, nullptr);

  // 3. Gravity grows, the ground settles: elastic first, then plastic.
  return relaxation->run(clock, start);
}
} // namespace
} // namespace mpm

int main(int argc, char** argv)
{
  return mpm::run_program(argc, argv, "mpm-static", mpm::run_static);
}

// mpm-static: the stress state of a slope under gravity.
//
//   mpm-static cases/slope/case.yaml --out run/static
//   mpm-static cases/slope/case.yaml --out run/static      goes on after an interruption
//   mpm-static cases/slope/case.yaml --check               says what it would cost

#include "solver/stages/fidelity.hpp"
#include "solver/stages/filling_report.hpp"
#include "solver/stages/predict.hpp"
#include "solver/stages/relaxation.hpp"

#include <utility>

namespace mpm
{
namespace
{
int run_static(Session& session)
{
  const Case& case_file = session.case_file;
  if (case_file.static_stage.gravity == 0)
    throw Error(exit_code::bad_input, case_file.path.string() +
                                          ": static.gravity: is 0, so there is no static state to "
                                          "find; run mpm-seismic without --from");
  // 1. The undeformed ground between kinematic walls.
  Model model;
  Clock clock;
  double shaking_step = 0;
  bool as_new = false;
  const auto begin = [&] // unless nothing has been done to it yet
  {
    if (std::exchange(as_new, true)) return;
    model = make_model(case_file);
    clock = {};
    add_static_boundaries(model, case_file);
    shaking_step = case_file.courant_number * case_file.grid.spacing / greatest_wave_speed(*model.main);
    if (case_file.static_stage.mass_scaling) scale_masses(model);
    clock.dt =
        case_file.static_stage.courant_number * case_file.grid.spacing / greatest_wave_speed(*model.main);
  };
  begin();
  report_filling(session.log, case_file, model.filling);
  if (session.options.check)
  {
    report_wave_fidelity(session, shaking_step, nullptr);
    return predict_relaxation(session, model, clock);
  }

  // 2. The folder: ours, finished, or to be gone on with.
  session.open_folder(static_settings(case_file));
  if (session.finished_already()) return exit_code::done;
  std::optional<Relaxation> relaxation;
  const auto load = [&](const h5::File& file)
  {
    begin();
    as_new = false;
    relaxation.emplace(session, model);
    load_model(file, model, clock, case_file.static_stage.until.at_most);
    relaxation->load(file);
  };
  if (!session.resume(load))
  {
    begin();
    relaxation.emplace(session, model);
    relaxation->start();
  }

  report_wave_fidelity(session, shaking_step, nullptr);

  // 3. Gravity grows, the ground settles: elastic first, then plastic.
  return relaxation->run(clock);
}
} // namespace
} // namespace mpm

int main(int argc, char** argv)
{
  return mpm::run_program(argc, argv, "mpm-static", mpm::run_static);
}

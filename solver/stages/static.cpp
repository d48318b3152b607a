// mpm-static: the stress state of a slope under gravity.
//
//   mpm-static cases/slope/case.yaml --out run/static
//   mpm-static cases/slope/case.yaml --out run/static      goes on after an interruption
//   mpm-static cases/slope/case.yaml --check               says what it would cost

#include "solver/stages/fidelity.hpp"
#include "solver/stages/filling_report.hpp"
#include "solver/stages/predict.hpp"
#include "solver/stages/relaxation.hpp"

namespace mpm
{
namespace
{
int run_static(Session& session)
{
  const Case& scene = session.scene;
  if (scene.statics.gravity == 0)
    throw Error(exit_code::bad_input, scene.path.string() +
                                          ": static.gravity: is 0, so there is no static state to "
                                          "find; run mpm-seismic without --from");
  // 1. The undeformed scene between kinematic walls.
  Model model = make_model(scene);
  report_filling(session.log, scene, model.filling);
  add_static_boundaries(model, scene);
  const double shaking_step = scene.safety * scene.grid.spacing / greatest_wave_speed(*model.main);
  Clock clock;
  if (scene.statics.mass_scaling) scale_masses(model);
  clock.dt = scene.statics.safety * scene.grid.spacing / greatest_wave_speed(*model.main);
  if (session.options.check)
  {
    report_wave_fidelity(session, shaking_step, nullptr);
    return predict(session, model, clock, scene.statics.ramp);
  }

  // 2. The folder: ours, finished, or to be gone on with.
  RunFolder::Identity identity{{"stage", "static"}};
  for (const auto& [key, value] : settings_with_digests(scene))
  {
    const bool of_the_shaking = key.starts_with("seismic.motion") || key == "seismic.duration";
    if (!of_the_shaking && !key.starts_with("output")) identity.push_back({key, value});
  }
  session.open_folder(identity);
  if (std::filesystem::exists(*session.folder / "final.h5"))
  {
    session.log.info("{}: is finished already; --fresh starts anew", (*session.folder / "final.h5").string());
    return exit_code::done;
  }
  Relaxation relaxation(session, model);
  if (const auto file = session.newest_checkpoint())
  {
    load_model(*file, model, clock);
    relaxation.load(*file);
  }
  else
    relaxation.start();

  report_wave_fidelity(session, shaking_step, nullptr);

  // 3. Gravity grows, the ground settles: elastic first, then plastic.
  return relaxation.run(clock);
}
} // namespace
} // namespace mpm

int main(int argc, char** argv)
{
  return mpm::run_program(argc, argv, "mpm-static", mpm::run_static);
}

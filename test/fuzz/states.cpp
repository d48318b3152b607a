#include "test/fuzz/states.hpp"

#include "io/common/digest.hpp"
#include "solver/mpm/domain.hpp"
#include "solver/stages/checkpoint.hpp"
#include "solver/stages/identity.hpp"
#include "solver/stages/relaxation.hpp"
#include "solver/stages/shaking.hpp"
#include "solver/stages/time_step.hpp"
#include "test/sealed.hpp"

#include <array>

namespace mpm::fuzz
{
namespace
{
constexpr int steps_after = 3;

// Two materials, of which one softens; gauges, columns, a base with its spring.
constexpr const char* small_case = R"(schema: seismpm-case/1
name: small
grid: {spacing: 2 m, particles_per_cell: 2}
domain: {x: [0 m, 12 m], bottom: 0 m}
surfaces:
  rockhead: {points: [[0 m, 2 m]]}
  ground: {points: [[0 m, 6 m], [5 m, 6 m], [7 m, 5 m]]}
regions:
  - {material: clay, above: rockhead, below: ground}
  - {material: rock, below: rockhead}
materials:
  rock: {model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}
  clay:
    model: von_mises
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.35
    strength: {peak: 80 kPa, residual: 40 kPa}
    softening: {displacement: 0.2 m}
static: {ramp: 0.2 s, until: {unbalanced: 1e-2, kinetic: 1e-3, at_most: 5 s}}
seismic: {duration: 1 s}
output: {frames: {every: 10 s}, gauges: {points: {crest: [4 m, 6 m]}}}
)";

/// Sessions of both stages in a folder of their own, and the states that they leave.
class Runs
{
public:
  static Runs& the()
  {
    static Runs runs;
    return runs;
  }

  std::array<std::string, state_kinds> bytes;

  void from(const std::string& path)
  {
    seismic_.options.from = path;
    Clock clock;
    Model model = seismic_model(clock);
    load_static_state(seismic_, model);
    add_seismic_boundaries(model, seismic_.case_file, motion_.wave, false);
    go_on(model, clock);
  }
  void static_checkpoint(const std::string& path)
  {
    Clock clock;
    Model model = make_static_model(static_.case_file, clock);
    const h5::File state = open_state(static_, path);
    Relaxation relaxation(static_, model);
    load_model(state, model, clock, static_.case_file.static_stage.until.at_most);
    relaxation.load(state, clock);
    state.read_strings(checkpoint::warnings);
    relaxation.settle(clock, steps_after);
  }
  void seismic_checkpoint(const std::string& path)
  {
    Clock clock;
    Model model = seismic_model(clock);
    const h5::File state = open_state(seismic_, path);
    Shaking shaking(seismic_, model, motion_, "");
    shaking.load(state, clock);
    state.read_strings(checkpoint::warnings);
    go_on(model, clock);
  }
  std::string file(const std::string& name) const { return folder_ / name; }

private:
  Runs()
      : static_(options("mpm-static", "static")), seismic_(options("mpm-seismic", "seismic")),
        motion_(load_motion(seismic_))
  {
    Clock clock;
    Model model = make_static_model(static_.case_file, clock);
    static_.open_folder(static_settings(static_.case_file));
    write_text_atomically(folder_ / "static" / resolved_name, ""); // resume() does it for the programs
    Relaxation relaxation(static_, model);
    relaxation.start();
    if (relaxation.run(clock, Start::afresh) != exit_code::done)
      throw std::runtime_error("the small case does not settle");
    bytes[0] = bytes[1] = test::unsealed(test::contents(folder_ / "static/final.h5"));

    seismic_.options.from = folder_ / "static/final.h5";
    model = seismic_model(clock);
    const std::string digest = load_static_state(seismic_, model);
    RunFolder::Identity identity = seismic_settings(seismic_.case_file);
    identity.insert(identity.end(), motion_.identity.begin(), motion_.identity.end());
    identity.push_back({"from", digest});
    seismic_.open_folder(identity);
    Shaking shaking(seismic_, model, motion_, digest);
    shaking.start(clock);
    seismic_.options.max_wall = 1e-9; // a checkpoint after the first step
    if (shaking.run(clock, Start::afresh) != exit_code::interrupted)
      throw std::runtime_error("the small case does not stop");
    bytes[2] = test::unsealed(test::contents(folder_ / "seismic" / checkpoint_name(clock.step)));
  }

  Options options(const char* program, const std::string& out)
  {
    test::put(folder_ / "case.yaml", small_case);
    Options o;
    o.program = program;
    o.case_file = folder_ / "case.yaml";
    o.out = folder_ / out;
    o.verbosity = Verbosity::silent;
    return o;
  }
  Model seismic_model(Clock& clock) const
  {
    const Case& case_file = seismic_.case_file;
    Model model = make_model(case_file);
    clock = {.dt = step_dividing(case_file.output.gauges.every, case_file.courant_number, *model.main)};
    return model;
  }
  static void go_on(Model& model, const Clock& clock)
  {
    for (int k = 0; k < steps_after; ++k) advance(model, clock.time() + k * clock.dt, clock.dt);
    check_health(model);
  }

  test::TemporaryFolder folder_;
  Session static_, seismic_;
  Motion motion_;
};
} // namespace

const std::string& state_bytes(StateKind kind)
{
  return Runs::the().bytes[static_cast<std::size_t>(kind)];
}

void take_up(StateKind kind, const std::string& bytes)
{
  Runs& runs = Runs::the();
  const std::string path = runs.file("state.h5");
  test::put(path, bytes);
  if (kind == StateKind::from)
    runs.from(path);
  else if (kind == StateKind::static_checkpoint)
    runs.static_checkpoint(path);
  else
    runs.seismic_checkpoint(path);
}
} // namespace mpm::fuzz

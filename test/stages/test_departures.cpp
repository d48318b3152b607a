// Ground that leaves the model: by hand, and in the programs.

#include "solver/stages/departures.hpp"
#include "test/read_json.hpp"
#include "test/stages/ground.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;
using Catch::Contains;

namespace
{
/// Level ground 20 m wide and 6 m high in cells of 1 m, two particles a cell, after the switch.
struct Shaken
{
  TemporaryFolder folder;
  std::unique_ptr<Session> session;
  Model model;
  std::unique_ptr<Departures> departures;

  explicit Shaken(const std::string& base = "compliant", const std::string& sides = "free_field")
  {
    put(folder.path() / "case.yaml", level_ground(1, 2, 20, 4, 6, 9.81));
    Options options;
    options.case_file = folder.path() / "case.yaml";
    options.overrides = {"seismic.base.kind=" + base, "seismic.sides.kind=" + sides};
    options.verbosity = Verbosity::quiet;
    session = std::make_unique<Session>(options);
    model = make_model(session->case_file);
    settle_at_once(model, session->case_file);
    add_seismic_boundaries(model, session->case_file, std::make_shared<IncomingWave>(), false);
    for (const auto& [part, domain] : model.domains()) open_energy_balance(*domain);
    departures = std::make_unique<Departures>(*session, model);
  }

  /// Moves all particles by what `how` says of their positions (m).
  template <class How>
  void move(const How& how)
  {
    Particles& p = model.main->particles;
    for (int k = 0; k < p.size(); ++k)
    {
      const auto [ux, uy] = how(p.reference_x[k], p.reference_y[k]);
      p.x[k] = p.reference_x[k] + ux;
      p.y[k] = p.reference_y[k] + uy;
    }
    sort_particles(*model.main);
  }
  double area(Edge edge) const { return departure(model, edge).area; }
  double area_here() const
  {
    double sum = 0;
    for (const std::int64_t id : model.main->particles.id) sum += model.reference_volume[id];
    return sum;
  }
};
using Shift = std::array<double, 2>;
} // namespace

TEST_CASE("ground that moves with its sides and its base does not leave", "[stages]")
{
  const std::string sides = GENERATE("free_field", "quiet");
  Shaken ground("compliant", sides);
  ground.move([](double, double) { return Shift{7, -5}; }); // where a record's residual displacement takes it
  CHECK_FALSE(ground.departures->take_out(1));
  ground.move([](double, double y) { return Shift{0.6 * y, 0}; }); // the soil sways 3.6 cells over its height
  CHECK_FALSE(ground.departures->take_out(1));
  ground.move([](double x, double y) { return Shift{x > 17 && y > 4 ? 0.4 : 0, 30}; }); // thrown up
  CHECK_FALSE(ground.departures->take_out(1));
  CHECK(ground.model.main->departed.empty());
}

TEST_CASE("a side's own ground leaves when it is a cell beyond it, not before", "[stages]")
{
  const bool right = GENERATE(true, false);
  const double beyond = GENERATE(0.9, 1.1); // of the top row's outermost particle
  Shaken ground;
  const double total = ground.area_here();
  // The upper metre slides over the lower five.
  const auto slide = [&](double, double y) {
    return Shift{(y > 5 ? 1.0 : 0.0) * (right ? 1 : -1) * (beyond + 0.25), 0};
  };
  ground.move(slide);
  const Edge edge = right ? Edge::right : Edge::left;
  CHECK(ground.departures->take_out(2) == (beyond > 1));
  CHECK(ground.area(edge) == Approx(beyond > 1 ? 2 * 0.25 : 0)); // two rows, one particle each
  CHECK(ground.area(Edge::bottom) == 0);
  CHECK(ground.area_here() + ground.area(edge) == Approx(total));
  for (const int index : ground.model.main->particles.index_of)
    CHECK(index < ground.model.main->particles.size());
}

TEST_CASE("debris from elsewhere leaves as soon as it has passed a side", "[stages]")
{
  const double beyond = GENERATE(-0.1, 0.1);
  Shaken ground;
  ground.move([&](double x, double y) { return Shift{x > 14 && x < 15 && y > 5 ? 5.25 + beyond : 0, 2}; });
  CHECK(ground.departures->take_out(2) == (beyond > 0));
  CHECK(ground.area(Edge::right) == Approx(beyond > 0 ? 2 * 0.25 : 0));
}

TEST_CASE("ground that falls below the base leaves by it", "[stages]")
{
  Shaken ground;
  ground.move([](double x, double y) { return Shift{0, x > 8 && x < 10 && y > 5 ? -5.4 : 0}; });
  CHECK(ground.departures->take_out(2));
  CHECK(ground.area(Edge::bottom) == Approx(2 * 0.5)); // of the two rows, the lower one
  CHECK(ground.session->log.warnings().size() == 1);
  CHECK_THAT(ground.session->log.warnings()[0], Contains("ground passes the base"));
}

TEST_CASE("nothing passes mirrored walls", "[stages]")
{
  Shaken ground("fixed", "roller");
  ground.move([](double x, double) { return Shift{x > 19 ? 3.0 : 0, x > 19 ? -9.0 : 0}; });
  CHECK_FALSE(ground.departures->take_out(2));
}

TEST_CASE("the energy balance closes over a departure, and what left is in it", "[stages]")
{
  Shaken ground;
  Domain& main = *ground.model.main;
  for (int k = 0; k < main.particles.size(); ++k)
    if (main.particles.y[k] > 5) main.particles.velocity_x[k] = 3;
  main.energy.work = kinetic_energy(main); // somebody pushed it
  ground.move([](double, double y) { return Shift{y > 5 ? 4.1 : 0, y > 5 ? -0.5 : 0}; });
  const Energies before = energies_of(main);
  const double kinetic = kinetic_energy(main);
  REQUIRE(ground.departures->take_out(2));
  const Energies after = energies_of(main);
  const double left = departure(ground.model).mass;
  CHECK(left > 0);
  CHECK(kinetic - kinetic_energy(main) == Approx(0.5 * left * 9));
  CHECK(after[Energy::departed] >= 0.5 * left * 9);
  CHECK(after[Energy::transfer] == Approx(before[Energy::transfer]).margin(1e-9 * kinetic));
  CHECK(residual(after) == Approx(residual(before)).margin(1e-9 * largest_term(before)));
}

TEST_CASE("a gauge leaves with its ground", "[stages]")
{
  Shaken ground;
  ground.session->case_file.output.gauges.points = {{"inside", 10, 6}, {"outside", 20, 6}};
  ground.model.main->gauges = {{10, 6, 10, 6}, {21.2, 4, 20, 6}};
  ground.departures->take_out(3);
  CHECK(ground.model.main->gauges[0].x == 10);
  CHECK(std::isnan(ground.model.main->gauges[1].x));
  CHECK_THAT(ground.session->log.warnings().at(0), Contains("gauge outside"));
  ground.departures->take_out(3.1); // told once
  CHECK(ground.session->log.warnings().size() == 1);
}

namespace
{
/// A bank whose debris runs over the right end of the model.
const std::string overrun = R"(schema: seismpm-case/1
name: overrun
grid: {spacing: 1 m, particles_per_cell: 2}
domain: {x: [0 m, 34 m], bottom: 0 m}
surfaces:
  rock: {points: [[0 m, 12 m], [10 m, 12 m], [22 m, 3 m], [34 m, 3 m]]}
  ground: {points: [[0 m, 12 m], [8 m, 12 m], [11 m, 17 m], [16 m, 17 m], [24 m, 3 m], [34 m, 3 m]]}
regions:
  - {material: soil, above: rock, below: ground}
  - {material: rock, below: rock}
materials:
  rock: {model: elastic, density: 2200 kg/m3, young_modulus: 400 MPa, poisson_ratio: 0.25}
  soil: {model: von_mises, density: 1800 kg/m3, young_modulus: 10 MPa, poisson_ratio: 0.4, strength: {peak: 110 kPa, residual: 1 kPa}, softening: {displacement: 0.1 m}}
static: {ramp: 3 s, until: {unbalanced: 1e-3, at_most: 60 s}}
seismic:
  duration: 5 s
  motion: {recorded_as: outcrop, horizontal: {file: shake.txt, format: column, dt: 0.01 s, unit: m/s2}}
output:
  frames: {every: 1 s}
  checkpoint: {every: 0.05 s, keep: 2}
  gauges: {points: {top: [15 m, 17 m]}}
)";
} // namespace

TEST_CASE(
    "debris that runs over a side is told of and left out of the measures, bit for bit the same after a "
    "restart and on two threads",
    "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml", overrun);
  put(bench / "shake.txt", sine(40, 2));
  bench.make_static();
  const Ending whole = bench.run_seismic("whole");
  INFO(whole.said);
  REQUIRE(whole.code == 0);
  CHECK_THAT(whole.said, Contains("ground passes the right side and leaves the model") &&
                             Contains("have passed the right side") && !Contains("does not close"));
  const auto summary = read_json(bench / "whole" / "summary.json");
  CHECK(summary["slide"]["toe"].get<double>() < 34 + 1.5); // the side, a cell, and its own motion
  CHECK(summary["slide"]["left_area"].get<double>() > 1);
  CHECK(summary["energy"]["departed"].get<double>() > 0);
  // Neither flung about by the side's images, nor braked: what the transfers take is no more than gravity
  // gave, less what images gave to nodes with next to no mass, of which particles feel nothing.
  const auto energy = [&](const char* term) { return summary["energy"][term].get<double>(); };
  CHECK(energy("transfer") - energy("static_reaction") < -energy("gravitational"));
  CHECK_THAT(summary["warnings"].dump(), Contains("have passed the right side"));

  REQUIRE(bench.run_seismic("two", {"--threads", "2"}).code == 0);
  check_same_results(bench / "whole", bench / "two");

  Running running("mpm-seismic", bench.seismic_arguments("cut"), bench / "said.txt");
  REQUIRE(running.wait_until(
      [&] { return contents(bench / "said.txt").find("ground passes") != std::string::npos; }));
  const auto newest = [&]
  { return checkpoints(bench / "cut").empty() ? fs::path() : checkpoints(bench / "cut").back(); };
  const fs::path before = newest();
  REQUIRE(running.wait_until([&] { return newest() != before; }));
  running.signal(SIGKILL);
  REQUIRE(running.wait().code == -SIGKILL);
  const Ending again = bench.run_seismic("cut");
  INFO(again.said);
  REQUIRE(again.code == 0);
  CHECK_THAT(again.said, Contains("goes on from"));
  check_same_results(bench / "whole", bench / "cut");

  const Ending stopped = bench.run_seismic("stopped", {"--set", "seismic.leaving=stop"});
  CHECK(stopped.code == 0);
  CHECK_THAT(stopped.said, Contains("the run ends at t = "));
  const auto end = read_json(bench / "stopped" / "summary.json");
  CHECK(end["time"].get<double>() < 4.9);
}

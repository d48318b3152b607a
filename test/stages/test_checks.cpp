// What a stage looks after while it goes.

#include "solver/stages/session.hpp"
#include "solver/stages/time_step.hpp"
#include "test/domains.hpp"
#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

using namespace mpm;
using namespace mpm::test;

namespace
{
struct Stage
{
  TemporaryFolder folder;
  Options options(const std::string& text) const
  {
    put(folder.path() / "case.yaml", text);
    Options made;
    made.case_file = folder.path() / "case.yaml";
    made.verbosity = Verbosity::quiet;
    return made;
  }
};
} // namespace

TEST_CASE("a step is halved when the ground has loosened so far that waves outrun it", "[stages]")
{
  const Stage stage;
  Session session(stage.options(level_ground(1, 2, 8, 4, 8, 9.81)));
  Model model = make_model(session.case_file);
  Clock clock;
  clock.step = 10;
  clock.dt = stable_step(session.case_file, model);
  const double dt = clock.dt, time = clock.time();
  halve_step_if_outrun(session, model, session.case_file.courant_number, clock);
  CHECK(clock.dt == dt);
  // c_p goes with the root of the volume: 0.5 grows to 0.69, then to 0.71.
  for (double& volume : model.main->particles.volume) volume *= 1.38 * 1.38;
  halve_step_if_outrun(session, model, session.case_file.courant_number, clock);
  CHECK(clock.dt == dt);
  for (double& volume : model.main->particles.volume) volume *= (1.42 * 1.42) / (1.38 * 1.38);
  halve_step_if_outrun(session, model, session.case_file.courant_number, clock);
  CHECK(clock.dt == dt / 2);
  CHECK(clock.time() == time);
}

TEST_CASE("ground that is torn apart does not shorten the step", "[stages]")
{
  // A cloud of particles without friction or cohesion's hold, blown up to e times its volume: it carries
  // nothing, and its waves are those of the ground that it will be when it has closed.
  const MohrCoulomb law = domains::mohr_coulomb(30, 0);
  Domain cloud = domains::make_domain({{law, {0, 0, 4, 4}, 0.5}}, 1);
  const double speed = law.pressure_speed(), dt = 0.2 / speed;
  CHECK(greatest_wave_speed(cloud) == Approx(speed).epsilon(1e-12));
  for (int k = 0; k < cloud.particles.size(); ++k)
  {
    cloud.particles.affine_xx[k] = cloud.particles.affine_yy[k] = 1 / (100 * dt);
    cloud.particles.velocity_x[k] = (cloud.particles.x[k] - 2) / (100 * dt);
    cloud.particles.velocity_y[k] = (cloud.particles.y[k] - 2) / (100 * dt);
  }
  for (int k = 0; k < 65; ++k) step(cloud, dt);
  const Particles& p = cloud.particles;
  CHECK(p.volume[0] * law.density / p.mass[0] > 2);                 // (1 + 0.65)^2 = 2.7
  CHECK(greatest_wave_speed(cloud) == Approx(speed).epsilon(0.01)); // strains of third order in dt L
}

TEST_CASE("the stress of a side is compared with that of its column", "[stages]")
{
  const Case case_file = case_from(level_ground(1, 2, 8, 4, 8, 9.81));
  Model model = make_model(case_file);
  for (const auto& [part, domain] : model.domains())
  {
    Particles& p = domain->particles;
    for (int k = 0; k < p.size(); ++k)
      p.stress_xx[k] =
          -1e3 * (8 - p.reference_y[k]) * (part == Part::ground && p.reference_x[k] > 4 ? 1.2 : 1);
  }
  CHECK(side_stress_mismatch(model, case_file, Edge::left) == 0);
  CHECK(side_stress_mismatch(model, case_file, Edge::right) == Approx(0.2));
}

TEST_CASE(
    "what takes long to write becomes rarer where a share of the time is set, as that of checkpoints is",
    "[stages]")
{
  using namespace std::chrono_literals;
  const auto write = [] { std::this_thread::sleep_for(10ms); };
  Pace shared(0.001, 0.02), fixed(0.001);
  shared.write(write);
  CHECK(shared.cost() >= 0.01);
  CHECK(shared.interval() == shared.cost() / 0.02); // 0.5 s for 10 ms
  CHECK_FALSE(shared.due());
  std::this_thread::sleep_for(100ms);
  CHECK_FALSE(shared.due());
  const auto begin = std::chrono::steady_clock::now();
  while (!shared.due() && std::chrono::steady_clock::now() < begin + 60s) std::this_thread::sleep_for(10ms);
  CHECK(shared.due());
  fixed.write(write);
  CHECK(fixed.interval() == 0.001);
  std::this_thread::sleep_for(5ms);
  CHECK(fixed.due());

  const Stage stage;
  Session session(stage.options(level_ground(1, 2, 8, 4, 8, 9.81) + "output: {checkpoint: {every: 1 ms}}\n"));
  std::this_thread::sleep_for(5ms);
  CHECK(session.checkpoint_due());
  session.write_checkpoint(write);
  std::this_thread::sleep_for(5ms);
  CHECK(session.checkpoint_due());
  CHECK_FALSE(Session(stage.options(level_ground(1, 2, 8, 4, 8, 9.81))).checkpoint_due());
}

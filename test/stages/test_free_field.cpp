#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

TEST_CASE("level ground under gravity stays still without input", "[stages]")
{
  // What rounding leaves: displacements below 1e-4 h and speeds below 1e-6 m/s over 5 s.
  const Case case_file = case_from(level_ground(1, 2, 20, 10, 20, 9.81));
  Model model = make_model(case_file);
  settle_at_once(model, case_file);
  relax(model, case_file, 6, false);
  add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(), false);
  const double dt = stable_step(case_file, model);
  double speed = 0;
  for (int k = 0; k * dt < 5; ++k)
  {
    advance(model, k * dt, dt);
    speed = std::max(speed, greatest_speed(model.main->particles));
  }
  const Particles& p = model.main->particles;
  double moved = 0;
  for (int k = 0; k < p.size(); ++k)
    moved = std::max(moved, std::hypot(p.x[k] - p.reference_x[k], p.y[k] - p.reference_y[k]));
  INFO("speed " << speed << " m/s, moved " << moved << " m");
  CHECK(speed < 1e-6);
  CHECK(moved < 1e-4 * case_file.grid.spacing);
}

TEST_CASE("the switch leaves no acceleration behind in the boundary strip and corners", "[stages]")
{
  // An elastic slope with corners of different height: images and corners must hand over all that the walls
  // bore.
  std::string text = level_ground(1, 2, 60, 10, 20, 9.81);
  text.replace(text.find("ground: {points: [[0 m, 20 m], [60 m, 20 m]]}"), 45,
               "ground: {points: [[0 m, 24 m], [20 m, 24 m], [40 m, 20 m], [60 m, 20 m]]}");
  const Case case_file = case_from(text);
  Model model = make_model(case_file);
  relax(model, case_file, 24, true);
  add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(), false);
  const double dt = stable_step(case_file, model);
  advance(model, 0, dt);
  const Particles& p = model.main->particles;
  double strip = 0, inside = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    const double a = std::hypot(p.velocity_x[k], p.velocity_y[k]) / dt / 9.81;
    const bool near = p.y[k] < 4 || p.x[k] < 4 || p.x[k] > 56;
    (near ? strip : inside) = std::max(near ? strip : inside, a);
  }
  INFO("boundary strip " << strip << " g, elsewhere " << inside << " g");
  CHECK(strip < 1e-4);
  CHECK(inside <
        1e-3); // nodes with little mass at the sloping surface, which answer to what the static stage left
}

TEST_CASE("gravity adds nothing to the motion of a base that moves over the grid", "[stages]")
{
  // A vertical pulse lifts the base by 3.2 cells, with and without gravity: the frozen images must go along.
  // To 1e-3 of the peak velocity.
  const double length = 1.0, peak = 3.2 / (2 * length * 3.0 / 8.0); // integral of sin^4 is 3/8 of the length
  const auto motion = [&](double gravity)
  {
    const Case case_file = case_from(level_ground(1, 3, 12, 10, 10, gravity));
    Model model = make_model(case_file);
    if (gravity > 0)
    {
      settle_at_once(model, case_file);
      relax(model, case_file, 4, false);
    }
    IncomingWave wave;
    wave.vertical = pulse(peak, length, 2);
    add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(wave), false);
    const double dt = stable_step(case_file, model);
    std::vector<double> velocity; // of every particle by id, every 20 steps
    for (int k = 0; k * dt < 1.5; ++k)
    {
      advance(model, k * dt, dt);
      if (k % 20 == 0)
        for (const int index : model.main->particles.index_of)
          velocity.push_back(model.main->particles.velocity_y[index]);
    }
    return velocity;
  };
  const std::vector<double> with = motion(9.81), without = motion(0);
  double error = 0;
  for (std::size_t k = 0; k < std::min(with.size(), without.size()); ++k)
    error = std::max(error, std::fabs(with[k] - without[k]));
  INFO("difference / PGV " << error / (2 * peak));
  CHECK(error < 1e-3 * 2 * peak);
}

TEST_CASE("level ground stays still after the switch whatever its base and sides are", "[stages]")
{
  const std::string base = GENERATE("compliant", "fixed"), sides = GENERATE("free_field", "quiet", "roller");
  std::string text = level_ground(1, 2, 16, 5, 10, 9.81);
  text.replace(text.find("kind: compliant"), 15, "kind: " + base);
  text.replace(text.find("kind: free_field"), 16, "kind: " + sides);
  const Case case_file = case_from(text);
  Model model = make_model(case_file);
  settle_at_once(model, case_file);
  relax(model, case_file, 4, false);
  add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(), false);
  const double dt = stable_step(case_file, model);
  double speed = 0;
  for (int k = 0; k * dt < 1; ++k)
  {
    advance(model, k * dt, dt);
    speed = std::max(speed, greatest_speed(model.main->particles));
  }
  INFO(base << " base, " << sides << " sides: " << speed << " m/s");
  CHECK(speed < 1e-6);
}

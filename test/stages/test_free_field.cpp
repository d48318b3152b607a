#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// K0 stress of level ground under gravity, exact to the particles' own spacing.
void settle_at_once(Model& model, const Case& scene)
{
  model.for_each_domain(
      [&](Domain& domain, const std::string&)
      {
        Particles& p = domain.particles;
        for (std::size_t m = 0; m < domain.materials.size(); ++m)
          for (int k = domain.material_begin[m]; k < domain.material_begin[m + 1]; ++k)
          {
            const double rock = scene.surfaces[0].height(0), top = scene.ground_height(0),
                         g = scene.statics.gravity;
            const double soil = 1800 * g * (top - std::max(p.y[k], rock)),
                         rest = 2200 * g * std::max(0.0, rock - p.y[k]);
            const double nu = domain.materials[m].elastic().poisson;
            p.stress_yy[k] = -(soil + rest);
            p.stress_xx[k] = p.stress_zz[k] = nu / (1 - nu) * p.stress_yy[k];
          }
      });
}

/// Lets the ground find its discrete equilibrium between walls.
void relax(Model& model, const Case& scene, double duration, bool grow)
{
  add_static_boundaries(model, scene);
  const double dt = stable_step(scene, model);
  for (int k = 0; k * dt < duration; ++k)
  {
    const double s = grow ? std::min(1.0, 2 * k * dt / duration) : 1;
    model.for_each_domain(
        [&](Domain& domain, const std::string&)
        { domain.gravity_y = -scene.statics.gravity * s * s * s * (10 + s * (6 * s - 15)); });
    advance(model, k * dt, dt);
  }
}

struct Difference
{
  double velocity = 0; ///< greatest |v - v_column|, m/s
  double greatest = 0; ///< greatest |v_column|, m/s
};

/// Greatest difference between any particle of the model and its row of the left column, over a run.
Difference compare_with_column(const Case& scene, double peak, double duration)
{
  Model model = make_model(scene);
  if (scene.statics.gravity > 0)
  {
    settle_at_once(model, scene);
    relax(model, scene, 2, false);
  }
  IncomingWave wave;
  wave.horizontal = pulse(peak, 0.25, duration);
  wave.vertical = pulse(0.5 * peak, 0.2, duration);
  add_seismic_boundaries(model, scene, std::make_shared<IncomingWave>(wave), false);
  const double dt = stable_step(scene, model);
  Difference worst;
  const Particles &p = model.main->particles, &q = model.left->domain->particles;
  std::vector<int> row(p.size());
  for (int id = 0; id < p.size(); ++id) row[id] = model.left->row_near(p.reference_y[model.main->place[id]]);
  for (int k = 0; k * dt < duration; ++k)
  {
    advance(model, k * dt, dt);
    if (k % 20 != 0) continue;
    for (int i = 0; i < p.size(); ++i)
    {
      const int c = model.left->particle_of_row(row[p.id[i]]);
      worst.velocity = std::max(
          worst.velocity, std::hypot(p.velocity_x[i] - q.velocity_x[c], p.velocity_y[i] - q.velocity_y[c]));
      worst.greatest = std::max(worst.greatest, std::hypot(q.velocity_x[c], q.velocity_y[c]));
    }
  }
  return worst;
}
} // namespace

TEST_CASE("a level layered model moves as its own free-field column, S and P together (33)", "[stages]")
{
  // METHODS test 33: 1e-3 or better with ghost rows. Without gravity only the rows' sliding past each other
  // is left.
  const Case scene = scene_from(level_ground(1, 2, 40, 10, 20, 0));
  const Difference d = compare_with_column(scene, 0.25, 1.5);
  INFO("difference / peak " << d.velocity / d.greatest);
  CHECK(d.greatest > 0.3);
  CHECK(d.velocity < 1e-3 * d.greatest);
}

TEST_CASE("a level layered model under gravity moves as its own free-field column (33)", "[stages]")
{
  const Case scene = scene_from(level_ground(1, 2, 40, 10, 20, 9.81));
  const Difference d = compare_with_column(scene, 0.25, 1.5);
  INFO("difference / peak " << d.velocity / d.greatest);
  CHECK(d.velocity < 1e-3 * d.greatest);
}

TEST_CASE("level ground under gravity stays still without input (16, shortened)", "[stages]")
{
  // METHODS test 16: displacement below 1e-4 h and speed below 1e-6 m/s; 5 s instead of 100.
  const Case scene = scene_from(level_ground(1, 2, 20, 10, 20, 9.81));
  Model model = make_model(scene);
  settle_at_once(model, scene);
  relax(model, scene, 6, false);
  add_seismic_boundaries(model, scene, std::make_shared<IncomingWave>(), false);
  const double dt = stable_step(scene, model);
  double speed = 0;
  for (int k = 0; k * dt < 5; ++k)
  {
    advance(model, k * dt, dt);
    speed = std::max(speed, greatest_speed(*model.main));
  }
  const Particles& p = model.main->particles;
  double moved = 0;
  for (int k = 0; k < p.size(); ++k)
    moved = std::max(moved, std::hypot(p.x[k] - p.reference_x[k], p.y[k] - p.reference_y[k]));
  INFO("speed " << speed << " m/s, moved " << moved << " m");
  CHECK(speed < 1e-6);
  CHECK(moved < 1e-4 * scene.grid.spacing);
}

TEST_CASE("the switch leaves no acceleration behind in the boundary strip and corners (29)", "[stages]")
{
  // A slope with corners of different height, elastic. METHODS test 29: below 1e-4 g.
  std::string text = level_ground(1, 2, 60, 10, 20, 9.81);
  text.replace(text.find("ground: {points: [[0 m, 20 m], [60 m, 20 m]]}"), 45,
               "ground: {points: [[0 m, 24 m], [20 m, 24 m], [40 m, 20 m], [60 m, 20 m]]}");
  const Case scene = scene_from(text);
  Model model = make_model(scene);
  relax(model, scene, 24, true);
  add_seismic_boundaries(model, scene, std::make_shared<IncomingWave>(), false);
  const double dt = stable_step(scene, model);
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
  CHECK(inside < 1e-3); // nodes with little mass at the sloping surface, METHODS section 13
}

TEST_CASE("gravity adds nothing to the motion of a base that moves over the grid (29)", "[stages]")
{
  // A vertical pulse that lifts the base by several cells, with and without gravity; METHODS test 29: 1e-3 of
  // PGV.
  const double length = 1.0, peak = 3.2 / (2 * length * 3.0 / 8.0); // integral of sin^4 is 3/8 of the length
  const auto motion = [&](double gravity)
  {
    const Case scene = scene_from(level_ground(1, 3, 12, 10, 10, gravity));
    Model model = make_model(scene);
    if (gravity > 0)
    {
      settle_at_once(model, scene);
      relax(model, scene, 4, false);
    }
    IncomingWave wave;
    wave.vertical = pulse(peak, length, 2);
    add_seismic_boundaries(model, scene, std::make_shared<IncomingWave>(wave), false);
    const double dt = stable_step(scene, model);
    std::vector<double> velocity; // of every particle by id, every 20 steps
    for (int k = 0; k * dt < 1.5; ++k)
    {
      advance(model, k * dt, dt);
      if (k % 20 == 0)
        for (const int place : model.main->place) velocity.push_back(model.main->particles.velocity_y[place]);
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
  const Case scene = scene_from(text);
  Model model = make_model(scene);
  settle_at_once(model, scene);
  relax(model, scene, 4, false);
  add_seismic_boundaries(model, scene, std::make_shared<IncomingWave>(), false);
  const double dt = stable_step(scene, model);
  double speed = 0;
  for (int k = 0; k * dt < 1; ++k)
  {
    advance(model, k * dt, dt);
    speed = std::max(speed, greatest_speed(*model.main));
  }
  INFO(base << " base, " << sides << " sides: " << speed << " m/s");
  CHECK(speed < 1e-6); // METHODS test 16
}

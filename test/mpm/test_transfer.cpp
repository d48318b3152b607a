#include "test/scenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace scenes;

namespace
{
/// Angular momentum about the origin with the spin that the affine velocity carries (METHODS section 1).
double angular_momentum(const Domain& domain)
{
  const Particles& p = domain.particles;
  const double inertia = domain.grid.spacing * domain.grid.spacing / 3;
  double sum = 0;
  for (int k = 0; k < p.size(); ++k)
    sum += p.mass[k] * (p.x[k] * p.velocity_y[k] - p.y[k] * p.velocity_x[k] +
                        inertia * (p.affine_yx[k] - p.affine_xy[k]));
  return sum;
}

double momentum(const Domain& domain, const std::vector<double>& velocity)
{
  double sum = 0;
  for (int k = 0; k < domain.particles.size(); ++k) sum += domain.particles.mass[k] * velocity[k];
  return sum;
}

/// So soft that no stress acts on it: as its spin is integrated, a step stretches it by (w dt)^2 / 2.
Domain single_particle(double x, double y)
{
  Domain domain = make_domain({{elastic(1e-6), {x - 0.25, y - 0.25, 0.5, 0.5}}});
  REQUIRE(domain.particles.size() == 1);
  return domain;
}
} // namespace

TEST_CASE("A free elastic block keeps its linear and angular momentum for 10000 steps", "[mpm]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(), {-3, 1, 6, 5}}}, 1, 0.3, 22);
  random_velocities(domain, 0.05, 23);
  random_affine(domain, 0.05, 24);
  for (double& v : domain.particles.velocity_x) v += 0.03;
  const double px = momentum(domain, domain.particles.velocity_x);
  const double py = momentum(domain, domain.particles.velocity_y);
  const double spin = angular_momentum(domain);
  // Scales of the sums: all particles with the greatest speed, and with it at the far corner.
  double mass = 0;
  for (const double m : domain.particles.mass) mass += m;
  const double scale = mass * 0.08;
  const double dt = 0.5 / elastic().pressure_speed();
  double linear = 0, angular = 0;
  for (int k = 0; k < 100; ++k)
  {
    run(domain, 100, dt);
    linear = std::max({linear, std::fabs(momentum(domain, domain.particles.velocity_x) - px) / scale,
                       std::fabs(momentum(domain, domain.particles.velocity_y) - py) / scale});
    // x^{n+1} = x^n + dt v^{n+1}, and v x v = 0: the sum may be taken with the positions after the move.
    angular = std::max(angular, std::fabs(angular_momentum(domain) - spin) / (6 * scale));
  }
  CHECK(greatest(domain.particles.stress_xx) > 0); // it did not just fly
  CHECK(linear < 1e-13);  // per 1e4 steps: round-off is a random walk of 100 times 1e-16
  CHECK(angular < 1e-12); // arms of up to 8 m that the flight makes longer
}

TEST_CASE("A single particle flies on the discrete parabola for 10 s, and its spin stays", "[mpm]")
{
  const Threads one(1);
  Domain domain = single_particle(0.3, 0.6);
  Particles& p = domain.particles;
  p.velocity_x[0] = 3;
  p.velocity_y[0] = 50;
  p.affine_xy[0] = -0.1;
  p.affine_yx[0] = 0.1; // a spin does not strain
  domain.gravity_x = 0.5;
  domain.gravity_y = -9.81;
  const double dt = 1e-3, x = p.x[0], y = p.y[0];
  run(domain, 10000, dt);
  const double t = 10;
  // Relative to the way, 500 m: the sum of 1e4 moves rounds off by 1e-16 * 500 each, at random.
  CHECK(std::fabs(p.x[0] - (x + 3 * t + 0.5 * t * (t + dt) / 2)) / 500 < 1e-12);
  CHECK(std::fabs(p.y[0] - (y + 50 * t - 9.81 * t * (t + dt) / 2)) / 500 < 1e-12);
  CHECK(std::fabs(p.velocity_y[0] - (50 - 98.1)) / 50 < 1e-12);
  // A step finds C to 3 v / h times 1e-16, which is 1e-14; its weights change slowly, so that the round-off
  // of 1e4 steps need not be at random and may make 1e-10.
  CHECK(std::fabs(p.affine_yx[0] - 0.1) < 1e-9);
  CHECK(std::fabs(p.affine_xy[0] + 0.1) < 1e-9);
  CHECK(std::fabs(p.affine_xx[0]) < 1e-9);
  CHECK(std::fabs(p.affine_yy[0]) < 1e-9);
}

TEST_CASE("Two particles that approach feel nothing beyond four cells, and each other within two", "[mpm]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(), {-2.93, 0.1, 0.5, 0.5}}, {elastic(), {3.07, 0.1, 0.5, 0.5}}});
  Particles& p = domain.particles;
  REQUIRE(p.size() == 2);
  const double dt = 0.3 / elastic().pressure_speed(), speed = 0.01 / dt;
  const int left = domain.place[0], right = domain.place[1];
  p.velocity_x[left] = speed;
  p.velocity_x[right] = -speed;
  double change = 0, stress = 0;
  int steps = 0;
  for (; p.x[domain.place[1]] - p.x[domain.place[0]] > 4; ++steps)
  {
    step(domain, dt);
    // The last step took its forces and velocities from places more than four cells apart.
    change = std::max({change, std::fabs(p.velocity_x[domain.place[0]] / speed - 1),
                       std::fabs(p.velocity_x[domain.place[1]] / speed + 1)});
    stress = std::max({stress, greatest(p.stress_xx), greatest(p.stress_yy), greatest(p.stress_xy)});
  }
  CHECK(steps > 98);
  CHECK(change < 1e-13);                   // round-off of 100 steps
  CHECK(stress / elastic().young < 1e-13); // strain increments of 0.01 times round-off
  while (p.x[domain.place[1]] - p.x[domain.place[0]] > 2 && ++steps < 1000) step(domain, dt);
  CHECK(p.velocity_x[domain.place[0]] < 0.99 * speed);
  // What one loses the other does too.
  CHECK(std::fabs(p.velocity_x[domain.place[0]] + p.velocity_x[domain.place[1]]) / speed < 1e-13);
}

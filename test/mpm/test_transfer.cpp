#include "solver/mpm/spline.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

namespace
{
/// Angular momentum about the origin with the spin that the affine velocity carries, sum m (x v_y - y v_x + D
/// (C_yx
/// - C_xy)), D = h^2 / 3.
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
  domain.settings.gravity_x = 0.5;
  domain.settings.gravity_y = -9.81;
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
  const int left = domain.particles.index_of[0], right = domain.particles.index_of[1];
  p.velocity_x[left] = speed;
  p.velocity_x[right] = -speed;
  double change = 0, stress = 0;
  int steps = 0;
  for (; p.x[domain.particles.index_of[1]] - p.x[domain.particles.index_of[0]] > 4; ++steps)
  {
    step(domain, dt);
    // The last step took its forces and velocities from places more than four cells apart.
    change = std::max({change, std::fabs(p.velocity_x[domain.particles.index_of[0]] / speed - 1),
                       std::fabs(p.velocity_x[domain.particles.index_of[1]] / speed + 1)});
    stress = std::max({stress, greatest(p.stress_xx), greatest(p.stress_yy), greatest(p.stress_xy)});
  }
  CHECK(steps > 98);
  CHECK(change < 1e-13);                   // round-off of 100 steps
  CHECK(stress / elastic().young < 1e-13); // strain increments of 0.01 times round-off
  while (p.x[domain.particles.index_of[1]] - p.x[domain.particles.index_of[0]] > 2 && ++steps < 1000)
    step(domain, dt);
  CHECK(p.velocity_x[domain.particles.index_of[0]] < 0.99 * speed);
  // What one loses the other does too.
  CHECK(std::fabs(p.velocity_x[domain.particles.index_of[0]] + p.velocity_x[domain.particles.index_of[1]]) /
            speed <
        1e-13);
}

TEST_CASE("Particles that have left their cells since the sort read what the definition says, each by itself",
          "[mpm]")
{
  const Threads one(1);
  const bool flip = GENERATE(false, true);
  const double h = 0.8, dt = 1e-3;
  // 21 x 11 particles: stretches of a block end within a vector of particles.
  Domain domain = make_domain({{elastic(1e-6), {-3 * h, h, 7 * h, 3.6667 * h}, h / 3}}, h, 0.4, 51);
  domain.settings.flip = flip;
  random_velocities(domain, 1, 52);
  particles_to_grid(domain, dt);
  solve_grid(domain, dt);
  Random random(53);
  Grid& g = domain.grid;
  Particles& p = domain.particles;
  for (int node = 0; node < g.nodes(); ++node)
  {
    g.velocity_x[node] = random(-1, 1);
    g.velocity_y[node] = random(-1, 1);
    if (!flip) continue;
    g.gained_x[node] = random(-1, 1);
    g.gained_y[node] = random(-1, 1);
  }
  for (int k = 0; k < p.size(); ++k) // so that neighbours in the order stand in several cells
  {
    p.x[k] += random(-0.7, 0.7) * h;
    p.y[k] += random(-0.7, 0.7) * h;
  }
  const Particles before = p;
  grid_to_particles(domain, dt);

  // Sums of 16 products of splines, with moments of at most 2 h: some 20 roundings of numbers up to 1.
  const double rounding = 20 * std::numeric_limits<double>::epsilon();
  double velocity = 0, position = 0, affine = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    const Stencil x = cubic_stencil(before.x[k], h), y = cubic_stencil(before.y[k], h);
    double v[2]{}, change[2]{}, C[2][2]{};
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
      {
        const int node = g.node(x.first + i, y.first + j);
        REQUIRE(node >= 0);
        const double w = x.weight[i] * y.weight[j], now[2] = {g.velocity_x[node], g.velocity_y[node]};
        for (int c = 0; c < 2; ++c)
        {
          v[c] += w * now[c];
          if (flip) change[c] += w * (c == 0 ? g.gained_x : g.gained_y)[node];
          C[c][0] += 3 / (h * h) * w * x.offset[i] * now[c];
          C[c][1] += 3 / (h * h) * w * y.offset[j] * now[c];
        }
      }
    const double vx = flip ? before.velocity_x[k] + change[0] : v[0];
    const double vy = flip ? before.velocity_y[k] + change[1] : v[1];
    velocity = std::max({velocity, std::fabs(p.velocity_x[k] - vx), std::fabs(p.velocity_y[k] - vy)});
    position = std::max(
        {position, std::fabs(p.x[k] - before.x[k] - dt * v[0]), std::fabs(p.y[k] - before.y[k] - dt * v[1])});
    affine = std::max({affine, std::fabs(p.affine_xx[k] - C[0][0]), std::fabs(p.affine_xy[k] - C[0][1]),
                       std::fabs(p.affine_yx[k] - C[1][0]), std::fabs(p.affine_yy[k] - C[1][1])});
  }
  CHECK(velocity < 3 * rounding); // two sums and the particle's own velocity
  CHECK(position < 6 * rounding); // at up to 6 m
  CHECK(affine < 6 / h * rounding);
}

TEST_CASE("What FLIP's particles take is the nodes' velocity less what they brought", "[mpm]")
{
  const bool consistent = GENERATE(false, true);
  const double h = 0.8, dt = 1e-3;
  Domain domain = make_domain({{elastic(1e6), {-3 * h, h, 7 * h, 3.6667 * h}, h / 3}}, h, 0.4, 51);
  domain.settings.flip = true;
  domain.settings.consistent_inertia = consistent;
  domain.settings.gravity_y = -9.81;
  random_velocities(domain, 1, 52);
  particles_to_grid(domain, dt);
  solve_grid(domain, dt);
  const Grid& g = domain.grid;
  double error = 0, greatest = 0;
  for (int k = 0; k < g.nodes(); ++k)
  {
    if (g.mass[k] <= g.smallest_mass)
    {
      CHECK(std::hypot(g.gained_x[k], g.gained_y[k]) == 0);
      continue;
    }
    error = std::max({error, std::fabs(g.gained_x[k] - (g.velocity_x[k] - g.momentum_x[k] / g.mass[k])),
                      std::fabs(g.gained_y[k] - (g.velocity_y[k] - g.momentum_y[k] / g.mass[k]))});
    greatest = std::max({greatest, std::fabs(g.gained_y[k]), std::fabs(g.velocity_y[k])});
  }
  CHECK(greatest > 1e-3);
  CHECK(error < 4 * std::numeric_limits<double>::epsilon() * greatest); // a quotient, a sum, a difference
}

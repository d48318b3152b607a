#include "boundaries/mirrored_wall.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

TEST_CASE("Nothing moves through a wall, nor along one that sticks", "[boundaries]")
{
  const Threads one(1);
  for (const bool slip : {true, false})
  {
    Domain domain = random_corner(0.7, 1, 1);
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 5, 1, slip}));
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, -3, 1, true}));
    sort_particles(domain);
    particles_to_grid(domain, 1e-4);
    solve_grid(domain, 1e-4);
    const Grid& g = domain.grid;
    for (int i = -3; i < 6; ++i)
    {
      REQUIRE(g.mass[g.node(i, 5)] > 0);
      CHECK(g.velocity_y[g.node(i, 5)] == 0);
      CHECK((g.velocity_x[g.node(i, 5)] == 0) == (!slip || i == -3));
    }
    for (int j = 5; j < 12; ++j) CHECK(g.velocity_x[g.node(-3, j)] == 0);
    // The ghosts move as the images, so that particles see a whole field.
    for (int i = -2; i < 6; ++i)
      for (const int depth : {1, 2})
      {
        const int inside = g.node(i, 5 + depth), ghost = g.node(i, 5 - depth);
        CHECK(g.velocity_y[ghost] == -g.velocity_y[inside]);
        CHECK(g.velocity_x[ghost] == (slip ? 1 : -1) * g.velocity_x[inside]);
      }
  }
}

TEST_CASE("A body that slides over many cells stays on its side of the wall", "[boundaries]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(), {-4, 5, 8, 4}}});
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 5, 1, true}));
  sort_particles(domain);
  set_velocity(domain, 10, 0);
  domain.settings.gravity_y = -9.81;
  domain.settings.local_damping = 0;
  const double dt = 0.5 / elastic().pressure_speed();
  const int steps = 150;
  run(domain, steps, dt);
  const Particles& p = domain.particles;
  double x = 0, lowest = 1e9;
  for (int k = 0; k < p.size(); ++k)
  {
    x += p.x[k] / p.size();
    lowest = std::min(lowest, p.y[k]);
  }
  CHECK(x == Approx(10 * steps * dt).epsilon(1e-10)); // slip: the momentum along the wall stays
  CHECK(lowest > 5);
  // It bounces on its own springs, by no more than twice its settlement rho g H^2 / 2 M = 0.12 m, and back.
  CHECK(lowest < 5.5);
}

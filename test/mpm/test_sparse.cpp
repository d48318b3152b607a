#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

namespace
{
std::size_t blocks_of_two(double distance)
{
  return make_domain({{elastic(), {2, 2, 4, 4}}, {elastic(), {2 + distance, 2, 4, 4}}}).grid.blocks.size();
}
} // namespace

TEST_CASE("Grid blocks exist only around material, however far apart the bodies are", "[mpm]")
{
  const std::size_t alone = make_domain({{elastic(), {2, 2, 4, 4}}}).grid.blocks.size();
  CHECK(alone == 9); // its own and those around it
  CHECK(blocks_of_two(24) == 2 * alone);
  CHECK(blocks_of_two(1000) == 2 * alone);
  CHECK(blocks_of_two(1e6) == 2 * alone);
  CHECK(blocks_of_two(8) < 2 * alone); // neighbours share theirs
}

TEST_CASE("The grid follows a body over a kilometre and leaves nothing behind", "[mpm]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(), {2, 2, 4, 4}}});
  const double dt = 0.2 / 100;
  set_velocity(domain, 100, -35);
  run(domain, 5000, dt); // 1000 m in x, 350 m down
  const Particles& p = domain.particles;
  CHECK(p.x[domain.particles.index_of[0]] == Approx(1002.25).epsilon(1e-12));
  CHECK(p.y[domain.particles.index_of[0]] == Approx(-347.75).epsilon(1e-12));
  CHECK(domain.grid.blocks.size() <= 16); // 9, and more when it straddles block edges
  for (int k = 0; k < p.size(); ++k)
    for (const int reach : {-1, 2})
      REQUIRE(domain.grid.node(static_cast<int>(std::floor(p.x[k])) + reach,
                               static_cast<int>(std::floor(p.y[k])) + reach) >= 0);
  for (const BlockIndex& block : domain.grid.blocks) REQUIRE(std::abs(block.x - 125) <= 3);
  // It flies free of stress: round-off of v / h 1e-16 in 5000 strain increments at random.
  CHECK(greatest(p.stress_xx) / elastic().young < 1e-13);
}

TEST_CASE("Mass and momentum on the grid are those of the particles", "[mpm]")
{
  const Threads two(2);
  Domain domain = make_domain({{elastic(), {-9.3, -3.2, 19, 11}}}, 1, 0.4, 51);
  random_velocities(domain, 1, 52);
  domain.settings.gravity_y = -9.81;
  for (int repeated = 0; repeated < 2; ++repeated) // the second time the grid must have been cleared
  {
    particles_to_grid(domain, 1e-3);
    double mass = 0, grid_mass = 0, momentum = 0, grid_momentum = 0, force = 0;
    const Particles& p = domain.particles;
    for (int k = 0; k < p.size(); ++k)
    {
      mass += p.mass[k];
      momentum += p.mass[k] * p.velocity_x[k];
    }
    for (int k = 0; k < domain.grid.nodes(); ++k)
    {
      grid_mass += domain.grid.mass[k];
      grid_momentum += domain.grid.momentum_x[k];
      force += domain.grid.force_y[k];
    }
    // Sums of a thousand terms.
    CHECK(std::fabs(grid_mass / mass - 1) < 1e-13);
    CHECK(std::fabs(grid_momentum - momentum) / mass < 1e-13);
    CHECK(std::fabs(force / (-9.81 * mass) - 1) < 1e-13);
  }
}

// Extremes at walls that no other test holds; cases/verification/ATLAS.md lists them all.

#include "boundaries/mirrored_wall.hpp"
#include "solver/mpm/energy_balance.hpp"
#include "solver/mpm/health.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

// Sound ground of these stiffnesses crosses a quarter of a cell a step at 1/2 of its wave speed.
TEST_CASE("Debris of 66 and 100 m/s does not go through a wall, and loses energy at it", "[boundaries]")
{
  const Threads one(1);
  const bool flip = GENERATE(true, false);
  for (const double speed : {66.0, 100.0})
  {
    MohrCoulomb debris = mohr_coulomb(30, 0);
    debris.young = 500e6;
    Domain domain = make_domain({{debris, {-8, 0, 6, 4}}});
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, 0, -1, true}));
    domain.settings.flip = flip;
    sort_particles(domain);
    set_velocity(domain, speed, 0);
    open_energy_balance(domain);
    const double start = kinetic_energy(domain), dt = 0.5 / debris.pressure_speed();
    double furthest = -1e9;
    for (int k = 0; k < 1200; ++k)
    {
      step(domain, dt);
      if (k % 100 == 0)
      {
        limit_openings(domain);
        check_particles(domain);
      }
      for (const double x : domain.particles.x) furthest = std::max(furthest, x);
    }
    INFO("flip " << flip << ", " << speed << " m/s; furthest " << furthest << " m, energy left "
                 << kinetic_energy(domain) / start);
    CHECK(furthest < 0.25); // half of the particles' distance
    CHECK(kinetic_energy(domain) + elastic_energy(domain) < start);
  }
}

TEST_CASE("Ground without any strength flows, and never faster than its weight allows", "[boundaries]")
{
  const Threads one(1);
  const VonMises slurry = von_mises(1e-3, 1e-3, 1, 50e6);
  const MohrCoulomb sand = mohr_coulomb(1, 0);
  for (const Law& law : {Law(slurry), Law(sand)})
  {
    Domain domain = make_domain({{law, {0, 0, 6, 6}}});
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, true}));
    sort_particles(domain);
    domain.settings.gravity_y = -9.81;
    domain.settings.flip = true;
    domain.settings.filter = {3, 0.001};
    open_energy_balance(domain);
    const double dt = 0.5 / domain.materials[0].elastic().pressure_speed();
    for (int k = 0; k < 800; ++k)
    {
      step(domain, dt);
      if (k % 100 == 0) limit_openings(domain);
    }
    check_particles(domain);
    const Energies e = energies_of(domain);
    CHECK(e[Energy::gravitational] < 0);
    CHECK(e[Energy::kinetic] < -1.001 * e[Energy::gravitational]);
  }
}

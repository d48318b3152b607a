#include "solver/mpm/health.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

namespace
{
constexpr double speed = 1e-3; // m/s: strains of 1e-4, so that the change of volume does not touch the energy

Domain shaken_block()
{
  Domain domain = make_domain({{elastic(), {0.2, 0.4, 6, 5}}});
  random_velocities(domain, speed, 31);
  random_affine(domain, speed, 32);
  return domain;
}
} // namespace

// Symplectic Euler keeps v^n . v^{n+1} / 2 + U(sigma^n), not v^n . v^n / 2 + U(sigma^n), which swings about
// it by omega dt / 2. From random velocities the first transfers take out what the grid cannot carry, far
// more than that swing, so that the plain sum may be held against its start.
TEST_CASE("Up to the Courant number 0.78 a free elastic block never gains energy", "[mpm]")
{
  const Threads one(1);
  for (const double courant : {0.5, 0.6, 0.7, 0.78})
  {
    INFO("Courant number " << courant);
    Domain domain = shaken_block();
    const double dt = courant / elastic().pressure_speed();
    const double start = kinetic_energy(domain) + strain_energy(domain);
    double highest = 0, late = 0;
    for (int k = 0; k < 3000; ++k)
    {
      step(domain, dt);
      const double now = (kinetic_energy(domain) + strain_energy(domain)) / start;
      highest = std::max(highest, now);
      if (k == 100) late = now;
    }
    CHECK(highest < 1 + 1e-6);
    // Nor does an instability grow below the first loss: the energy has not risen since step 100.
    CHECK((kinetic_energy(domain) + strain_energy(domain)) / start < late);
  }
}

// A lone particle is the first to go, beyond 0.93: its C and stress swing ever further
// while its velocity stays, so that it is its volume that tells. A block with full cells follows between 1.3
// and 1.5.
TEST_CASE("At the Courant number 1.3 a lone particle blows up and is caught within 1000 steps", "[mpm]")
{
  const Threads one(1);
  for (const double offset : {0.0, 0.25, 0.5})
  {
    Domain domain = make_domain({{elastic(), {offset, offset, 0.5, 0.5}}});
    random_affine(domain, speed, 33);
    const double dt = 1.3 / elastic().pressure_speed();
    int steps = 0;
    const auto shake = [&]
    {
      for (; steps < 1000; ++steps)
      {
        step(domain, dt);
        check_particles(domain);
      }
    };
    CHECK_THROWS_AS(shake(), Diverged);
    CHECK(steps < 1000);
  }
}

TEST_CASE("At the Courant number 0.9 a lone particle comes to rest", "[mpm]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(), {0, 0, 0.5, 0.5}}});
  random_affine(domain, speed, 33);
  run(domain, 1000, 0.9 / elastic().pressure_speed());
  // Its spin w stays, and with it C_xx = w^2 dt or 4e-8 1/s, as the spin is integrated; the straining dies
  // away.
  CHECK(std::fabs(domain.particles.affine_xx[0]) < 1e-4 * speed);
  CHECK(greatest(domain.particles.stress_xx) / elastic().young < 1e-8);
}

TEST_CASE("At the Courant number 1.5 a free elastic block blows up and is caught within 1000 steps", "[mpm]")
{
  const Threads one(1);
  Domain domain = shaken_block();
  const double dt = 1.5 / elastic().pressure_speed();
  int steps = 0;
  const auto shake = [&]
  {
    for (; steps < 1000; ++steps) step(domain, dt);
  };
  CHECK_THROWS_AS(shake(), Diverged);
  CHECK(steps < 1000);
}

TEST_CASE("A particle that is not a number is caught in the step that sees it", "[mpm]")
{
  const Threads one(1);
  Domain domain = shaken_block();
  domain.particles.velocity_y[7] = NAN;
  CHECK_THROWS_AS(step(domain, 1e-3), Diverged);
}

TEST_CASE("A squeezed particle is named", "[mpm]")
{
  Domain domain = shaken_block();
  CHECK_NOTHROW(check_particles(domain));
  domain.particles.volume[domain.particles.index_of[17]] = 0.02;
  CHECK_THROWS_WITH(check_particles(domain), Catch::Contains("particle 17 of m0 at"));
  domain.particles.volume[domain.particles.index_of[17]] = 0.25;
  domain.particles.stress_zz[domain.particles.index_of[18]] = INFINITY;
  CHECK_THROWS_WITH(check_particles(domain), Catch::Contains("particle 18 of m0 at"));
}

#include "solver/mpm/step.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

namespace
{
constexpr double below = 1e-4;      // m/s, a thousandth of the pulse
constexpr double speed_of_P = 9.4;  // m/s
constexpr double time_step = 0.053; // s, half a cell of 1 m at that speed

/// A bar of 128 m by 8 m, with a pulse of 0.1 m/s at 16 m that runs to both sides.
Domain bar()
{
  Domain domain = make_domain({{elastic(1.32e5), {0, 0, 128, 8}}});
  Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k) p.velocity_x[k] = 0.1 * std::exp(-std::pow((p.x[k] - 16) / 4, 2));
  return domain;
}

int sleeping(const Domain& domain)
{
  int count = 0;
  for (const OccupiedBlock& occupied : domain.blocks.occupied) count += occupied.asleep;
  return count;
}

double difference(const Domain& a, const Domain& b, std::vector<double> Particles::*field)
{
  double worst = 0;
  for (int id = 0; id < a.particles.size(); ++id)
    worst = std::max(worst, std::fabs((a.particles.*field)[a.particles.index_of[id]] -
                                      (b.particles.*field)[b.particles.index_of[id]]));
  return worst;
}
} // namespace

TEST_CASE("Ground at rest is skipped, wakes before a wave, and misses no more than what it may", "[mpm]")
{
  const Threads one(1);
  REQUIRE(elastic(1.32e5).pressure_speed() == Approx(speed_of_P).epsilon(0.01));
  Domain whole = bar(), rested = bar();
  allow_rest(rested, below);
  const int steps = 220; // 11.7 s: the pulse passes 110 m
  int most_asleep = 0, ahead = 0;
  for (int k = 0; k < steps; ++k)
  {
    run(whole, 1, time_step);
    run(rested, 1, time_step);
    most_asleep = std::max(most_asleep, sleeping(rested));
    for (const OccupiedBlock& occupied : rested.blocks.occupied)
      for (const ParticleRange& range : occupied.ranges)
        if (occupied.asleep)
          for (int q = range.begin; q < range.end; ++q)
            ahead += std::fabs(whole.particles.velocity_x[whole.particles.index_of[rested.particles.id[q]]]) >
                     2 * below;
  }
  CHECK(most_asleep >= 5);
  CHECK(rested.rest.skipped > 0.15 * steps * rested.particles.size());
  CHECK(ahead == 0); // what sleeps would not have moved otherwise, but for what walls reflected
  // Each of the 16 blocks is a wall once, for speeds of up to `below`, and a wall doubles the stress.
  const double bound = 2 * 16 * below;
  CHECK(greatest(whole.particles.velocity_x) > 10 * bound);
  CHECK(difference(whole, rested, &Particles::velocity_x) < bound);
  CHECK(difference(whole, rested, &Particles::x) < below * steps * time_step);
}

TEST_CASE("Nothing rests before it is allowed to, and all wakes when it no longer is", "[mpm]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(1.32e5), {0, 0, 40, 8}}});
  const int window = static_cast<int>(std::ceil(Rest::window / time_step)) + 1;
  run(domain, 3 * window, time_step);
  CHECK(sleeping(domain) == 0);
  domain.settings.gravity_y = -1e-6; // a gauge in ground that is there does not fall
  domain.gauges.push_back({20, 4, 20, 4});
  allow_rest(domain, below);
  run(domain, window, time_step);
  CHECK(sleeping(domain) == 0); // a second has to be watched from its beginning
  run(domain, window, time_step);
  CHECK(sleeping(domain) == static_cast<int>(domain.blocks.occupied.size()));
  domain.particles.velocity_y.assign(domain.particles.size(), 1);
  run(domain, 1, time_step);
  CHECK(greatest(domain.particles.y) < 8); // asleep, whatever it is told
  CHECK(domain.gauges[0].velocity_y == 0);
  allow_rest(domain, 0);
  CHECK(sleeping(domain) == 0);
  const double before = domain.particles.y[0];
  run(domain, 1, time_step);
  CHECK(domain.particles.y[0] == Approx(before + time_step));
}

TEST_CASE("What rests does not depend on the number of threads, nor on sorting in between", "[mpm]")
{
  std::vector<Domain> results;
  for (const int threads : {1, 2})
  {
    const Threads now(threads);
    Domain domain = bar();
    allow_rest(domain, below);
    run(domain, 120, time_step);
    REQUIRE(sleeping(domain) > 0);
    const int before = sleeping(domain);
    sort_particles(domain);
    REQUIRE(sleeping(domain) == before);
    run(domain, 100, time_step);
    results.push_back(std::move(domain));
  }
  CHECK(identical(results[0], results[1]));
}

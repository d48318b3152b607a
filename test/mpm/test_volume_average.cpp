#include "test/domains.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace mpm;
using namespace domains;

namespace
{
/// A block of yielding clay that meets one of an elastic material, everything random, over several grid
/// blocks.
Domain collision(bool averaged)
{
  const Body left{elastic(2e7, 0.25), {-9.3, -3.2, 9, 11}},
      right{von_mises(2e4, 5e3, 0.1, 1e7), {1.2, -2.7, 8, 9}};
  Domain domain = make_domain({left, right}, 1, 0.4, 51);
  random_velocities(domain, 0.5, 52);
  random_stress(domain, 1e3, 53);
  for (int k = 0; k < domain.particles.size(); ++k)
    domain.particles.velocity_x[k] += k < domain.material_begin[1] ? 3.0 : -2.0;
  domain.settings.gravity_y = -9.81;
  domain.settings.average_volume = averaged;
  return domain;
}

double step_size()
{
  return 0.5 / elastic(2e7, 0.25).pressure_speed();
}

double mean_stress(const Particles& p, int k)
{
  return (p.stress_xx[k] + p.stress_yy[k] + p.stress_zz[k]) / 3;
}

/// One step of a block of clay that starts free of stress with random velocities.
struct Step
{
  Domain domain;
  std::map<std::pair<int, int>, std::vector<int>> cells; ///< particles by the cell where they began

  explicit Step(bool averaged) : domain(make_domain({{von_mises(1e9, 1e9, 1), {-6, -6, 12, 12}}}, 1, 0.4, 61))
  {
    random_velocities(domain, 1, 62);
    domain.settings.average_volume = averaged;
    const Particles& p = domain.particles;
    for (int k = 0; k < p.size(); ++k)
      cells[{static_cast<int>(std::floor(p.x[k])), static_cast<int>(std::floor(p.y[k]))}].push_back(k);
    run(domain, 1, 1e-4);
  }
};
} // namespace

TEST_CASE("Averaged volume changes give the particles of a cell one pressure, which is their mean one",
          "[mpm]")
{
  const Threads one(1);
  const Step own(false), shared(true);
  const Particles &p = shared.domain.particles, &q = own.domain.particles;
  const double bulk = shared.domain.materials[0].elastic().bulk_modulus();
  double spread = 0, shift = 0, before = 0, volume = 0;
  for (const auto& [cell, members] : shared.cells)
  {
    double mean = 0;
    for (const int k : members)
      mean += mean_stress(q, k) / static_cast<double>(members.size()); // equal masses
    for (const int k : members)
    {
      spread = std::max(spread, std::fabs(mean_stress(p, k) - mean_stress(p, members[0])));
      shift = std::max(shift, std::fabs(mean_stress(p, k) - mean));
      before = std::max(before, std::fabs(mean_stress(q, k) - mean));
      volume = std::max(volume, std::fabs(p.volume[k] / 0.25 - 1 - mean / bulk));
    }
  }
  // Strains of the step are up to 1e-4: their squares are what the averaging leaves out (det and
  // Hughes-Winget's middle).
  CHECK(before > 1e-5 * bulk);
  CHECK(spread < 2e-8 * bulk);
  CHECK(shift < 2e-8 * bulk);
  CHECK(volume < 2e-8);
  // Shape changes and velocities are each particle's own.
  for (int k = 0; k < p.size(); ++k)
  {
    CHECK(p.stress_xy[k] == q.stress_xy[k]);
    CHECK(p.stress_xx[k] - p.stress_zz[k] == Approx(q.stress_xx[k] - q.stress_zz[k]).margin(1e-12 * bulk));
    CHECK(p.velocity_x[k] == q.velocity_x[k]);
  }
}

TEST_CASE("Averaging leaves materials that cannot yield as they are, to the last bit", "[mpm]")
{
  const Threads one(1);
  std::vector<Domain> results;
  for (const bool averaged : {false, true})
  {
    results.push_back(make_domain({{elastic(), {-6, -6, 12, 12}}}, 1, 0.4, 71));
    random_velocities(results.back(), 0.5, 72);
    results.back().settings.average_volume = averaged;
    run(results.back(), 50, 0.5 / elastic().pressure_speed());
  }
  CHECK(identical(results[0], results[1]));
}

TEST_CASE("Averaged volume changes are the same to the last bit on any threads and after a restart", "[mpm]")
{
  std::vector<Domain> results;
  for (const int threads : {1, 2, 3})
  {
    const Threads now(threads);
    results.push_back(collision(true));
    run(results.back(), 120, step_size());
  }
  CHECK(greatest(results[0].materials[1].state[0]) > 0.001);
  CHECK(identical(results[0], results[1]));
  CHECK(identical(results[0], results[2]));

  const Threads one(1);
  Domain& whole = results[0];
  REQUIRE(whole.blocks.drift > 0); // particles stand in other cells than when they were sorted
  Domain resumed = same_particles(whole);
  resumed.settings.average_volume = true;
  for (const OccupiedBlock& occupied : whole.blocks.occupied)
    resumed.blocks.occupied.push_back({occupied.block, {}, occupied.ranges});
  resumed.blocks.drift = whole.blocks.drift;
  rebuild(resumed);
  run(whole, 100, step_size());
  run(resumed, 100, step_size());
  CHECK(identical(whole, resumed));
}

// An average over cells is a projection, so that the averaged pressure does the averaged work: what the
// stress holds is what the forces did, but for particles that change cells.
TEST_CASE("The energy balance closes with averaged volume changes as it does without", "[mpm]")
{
  const Threads one(1);
  std::vector<double> open;
  for (const bool averaged : {false, true})
  {
    Domain domain = make_domain({{von_mises(1e9, 1e9, 1), {-6, -6, 12, 12}}}, 1);
    for (int k = 0; k < domain.particles.size(); ++k)
      domain.particles.velocity_x[k] = 0.1 * std::sin(0.26 * domain.particles.x[k]);
    domain.settings.average_volume = averaged;
    open_energy_balance(domain);
    run(domain, 1000, 0.1 / domain.materials[0].elastic().pressure_speed());
    const Energies balance = energies_of(domain);
    open.push_back(std::fabs(residual(balance)) / largest_term(balance));
  }
  CHECK(open[0] < 0.02); // the bound that a run warns beyond
  CHECK(open[1] < 0.02);
}

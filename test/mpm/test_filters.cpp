#include "solver/mpm/filters.hpp"
#include "solver/mpm/flow.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

namespace
{
/// A free block with a ragged edge, of ground that can flow.
Domain block()
{
  Domain domain = make_domain({{von_mises(1e9, 1e9, 1), {0.3, 0.2, 12, 9}}}, 1, 0.3, 71);
  sort_particles(domain);
  return domain;
}

/// As if all ground had flowed by a plastic strain e.
void let_flow(Domain& domain, double e)
{
  for (double& strain : *domain.materials[0].field("plastic_strain")) strain += e;
}

struct Momentum
{
  double x = 0, y = 0, turning = 0; ///< with the spin D (C_yx - C_xy) of the particles

  explicit Momentum(const Domain& domain)
  {
    const Particles& p = domain.particles;
    const double d = domain.grid.spacing * domain.grid.spacing / 3;
    for (int k = 0; k < p.size(); ++k)
    {
      x += p.mass[k] * p.velocity_x[k];
      y += p.mass[k] * p.velocity_y[k];
      turning += p.mass[k] * (p.x[k] * p.velocity_y[k] - p.y[k] * p.velocity_x[k] +
                              d * (p.affine_yx[k] - p.affine_xy[k]));
    }
  }
};

double root_mean_square(const std::vector<double>& values)
{
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}
} // namespace

TEST_CASE("The velocity filter keeps momentum, and leaves an affine field as it is", "[mpm]")
{
  Domain domain = block();
  domain.settings.filter.time = 2;
  random_velocities(domain, 1, 72);
  random_affine(domain, 1, 73);
  const Momentum before(domain);
  filter_velocities(domain, 1e-3);
  const Momentum after(domain);
  const double size = 2000.0 * 12 * 9; // kg; times 1 m/s, and times 10 m
  CHECK(std::fabs(after.x - before.x) < 1e-13 * size);
  CHECK(std::fabs(after.y - before.y) < 1e-13 * size);
  CHECK(std::fabs(after.turning - before.turning) < 1e-12 * size);

  Particles& p = domain.particles;
  const auto affine = [](double x, double y) { return 0.3 - 0.02 * x + 0.05 * y; };
  for (int k = 0; k < p.size(); ++k)
  {
    p.velocity_x[k] = affine(p.x[k], p.y[k]);
    p.affine_xx[k] = -0.02;
    p.affine_xy[k] = 0.05;
  }
  const Particles wanted = p;
  filter_velocities(domain, 1e-3);
  double apart = 0;
  for (int k = 0; k < p.size(); ++k)
    apart = std::max(apart, std::fabs(p.velocity_x[k] - wanted.velocity_x[k]));
  CHECK(apart < 1e-14);
}

TEST_CASE("Velocities that no node feels fade to 1/e in the filter's time, whatever the step", "[mpm]")
{
  // +v and -v from particle to particle: 1 - A leaves nearly all of it.
  const double dt = GENERATE(1e-3, 0.02);
  Domain domain = make_domain({{elastic(), {0, 0, 20, 20}}});
  Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
    p.velocity_x[k] = (std::lround(p.x[k] / 0.5 - 0.5) + std::lround(p.y[k] / 0.5 - 0.5)) % 2 ? 1 : -1;
  domain.settings.filter.time = 2;
  for (long k = 1; k * dt <= 2 + 1e-9; ++k) // from the first interval's end to the last's
  {
    domain.time = k * dt;
    filter_velocities(domain, dt);
  }
  CHECK(root_mean_square(p.velocity_x) == Approx(std::exp(-1)).epsilon(0.02));
}

TEST_CASE("The stress filter leaves affine stresses and ground that did not flow as they are", "[mpm]")
{
  Domain domain = block();
  domain.settings.filter.strain = 0.01;
  Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    p.stress_xx[k] = -40 - 3 * p.x[k] + 2 * p.y[k];
    p.stress_xy[k] = 5 + p.x[k];
  }
  const Particles before = p;
  follow_flow(domain, 1e-3);
  CHECK(p.stress_xx == before.stress_xx); // nothing has flowed
  let_flow(domain, 0.05);
  follow_flow(domain, 1e-3);
  double apart = 0;
  for (int k = 0; k < p.size(); ++k)
    apart = std::max({apart, std::fabs(p.stress_xx[k] - before.stress_xx[k]),
                      std::fabs(p.stress_xy[k] - before.stress_xy[k])});
  // What keeps a lone row's fit defined takes a sixth of a slope of 3 Pa a cell at a ragged corner; squared.
  CHECK(apart < 0.1);
  const std::vector<double> once = p.stress_xx;
  follow_flow(domain, 1e-3); // nothing has flowed since
  CHECK(p.stress_xx == once);
}

TEST_CASE("Stresses that no node feels fade with the flow, and their energy is booked", "[mpm]")
{
  Domain domain = block();
  domain.settings.filter.strain = 0.01;
  random_stress(domain, 1e3, 74);
  open_energy_balance(domain);
  const std::vector<double> before = domain.particles.stress_xy;
  const double energy = elastic_energy(domain);
  let_flow(domain, 0.1);
  follow_flow(domain, 1e-3);
  CHECK(root_mean_square(domain.particles.stress_xy) < 0.75 * root_mean_square(before));
  CHECK(domain.energy.work == Approx(energy - elastic_energy(domain)));
  CHECK(domain.energy.work > 0);
}

TEST_CASE("Volumes go with the mean stress that is taken, as in elastic ground", "[mpm]")
{
  Domain domain = block();
  domain.settings.filter.strain = 0.001;
  random_stress(domain, 1e5, 78);
  Particles& p = domain.particles;
  const auto trace = [&](int k) { return p.stress_xx[k] + p.stress_yy[k] + p.stress_zz[k]; };
  const Particles before = p;
  std::vector<double> mean;
  for (int k = 0; k < p.size(); ++k) mean.push_back(trace(k) / 3);
  let_flow(domain, 0.05);
  follow_flow(domain, 1e-3);
  const double bulk = domain.materials[0].elastic().bulk_modulus();
  double moved = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    const double change = std::log(p.volume[k] / before.volume[k]);
    moved = std::max(moved, std::fabs(change));
    REQUIRE(change == Approx((trace(k) / 3 - mean[k]) / bulk).margin(1e-14));
  }
  CHECK(moved > 1e-3 * 1e5 / bulk); // and they do go
}

TEST_CASE("The stress filter puts no ground under tension, and leaves out what is torn apart", "[mpm]")
{
  Domain domain = make_domain({{slip_weakening(0.4, 0.1, 0.5, 1), {0, 0, 8, 8}}});
  domain.settings.filter.strain = 0.01;
  Particles& p = domain.particles;
  Random random(75);
  std::vector<double>& opening = *domain.materials[0].field("opening");
  for (int k = 0; k < p.size(); ++k)
  {
    const double pressure = random(0, 1e3);
    opening[k] = k % 5 == 0 ? 0.1 : 0;
    p.stress_xx[k] = p.stress_yy[k] = p.stress_zz[k] = k % 5 == 0 ? 0 : -pressure * pressure / 1e3;
  }
  let_flow(domain, 0.1);
  follow_flow(domain, 1e-3);
  for (int k = 0; k < p.size(); ++k)
  {
    const double trace = p.stress_xx[k] + p.stress_yy[k] + p.stress_zz[k];
    if (opening[k] > 0)
      REQUIRE(trace == 0);
    else
      REQUIRE(trace <= 0);
  }
}

TEST_CASE("Flow is averaged over the width of a band, once, and knows no blocks", "[mpm]")
{
  // A row that flows, in ground that creeps, three times; the lattice begins in a block or across two.
  const double width = 3, length = 24, slip = 0.02, creep = 1e-3;
  std::vector<double> first;
  for (const double shift : {0.0, 3.0})
  {
    Domain domain = make_domain({{slip_weakening(0.4, 0.1, 0.5, width), {shift, shift, length, 18}}});
    domain.settings.average_flow = true;
    Particles& p = domain.particles;
    std::vector<double>& strain = *domain.materials[0].field("plastic_strain");
    for (int k = 0; k < 3; ++k)
    {
      for (int q = 0; q < p.size(); ++q)
        strain[q] += creep + (std::fabs(p.y[q] - shift - 8.5) < 0.5 ? slip : 0);
      follow_flow(domain, 1e-3);
    }
    std::vector<double> found(p.size());
    for (int q = 0; q < p.size(); ++q) found[p.id[q]] = strain[q];
    if (first.empty()) first = found;
    double apart = 0, most = 0, sum = 0;
    for (int q = 0; q < p.size(); ++q)
    {
      apart = std::max(apart, std::fabs(found[q] - first[q]));
      most = std::max(most, found[q]);
      sum += found[q];
    }
    CHECK(apart < 1e-15);
    // The disc's chord through the row is the row's thickness over the width on average, 4 / pi of it in the
    // middle.
    CHECK((most - 3 * creep) * width == Approx(3 * slip * 4 / std::numbers::pi).epsilon(0.15));
    // The sum stays but at the edges, where the disc is cut.
    CHECK(sum / p.size() == Approx(3 * (creep + slip / 18)).epsilon(0.05));
  }
}

TEST_CASE("Ground that flows with filters has the same bits on any number of threads", "[mpm]")
{
  const auto run_on = [](int threads)
  {
    const Threads some(threads);
    Domain domain = make_domain({{von_mises(2e3, 1e3, 0.1), {0, 0, 20, 20}}}, 1, 0.2, 76);
    random_velocities(domain, 3, 77);
    domain.settings.flip = true;
    domain.settings.filter = {0.1, 0.001};
    run(domain, 60, 0.5 / elastic().pressure_speed());
    return domain;
  };
  CHECK(identical(run_on(1), run_on(3)));
}

#include "boundaries/mirrored_wall.hpp"
#include "test/scenes.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;
using namespace scenes;

namespace
{
constexpr double pi = std::numbers::pi;

/// A column one cell wide that wraps in x, on a wall that sticks: exactly one-dimensional.
Domain make_column(const Law& law, double height, double size = 0.5)
{
  Domain domain;
  domain.name = "column";
  domain.grid.wrapped = true;
  const int across = static_cast<int>(std::lround(1 / size)),
            up = static_cast<int>(std::lround(height / size));
  set_materials(domain, {{"m", law, {}}}, {across * up});
  Particles& p = domain.particles;
  for (int k = 0; k < across * up; ++k)
  {
    p.x[k] = p.reference_x[k] = (k % across + 0.5) * size;
    p.y[k] = p.reference_y[k] = (k / across + 0.5) * size;
    p.volume[k] = size * size;
    p.mass[k] = p.volume[k] * domain.materials[0].elastic().density;
  }
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, false}));
  sort_particles(domain);
  return domain;
}

double total(const std::vector<double>& values)
{
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}
} // namespace

TEST_CASE("A falling block turns weight times height into kinetic energy", "[mpm]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(), {0.2, 0.4, 6, 5}}});
  domain.gravity_x = 1;
  domain.gravity_y = -9.81;
  open_ledger(domain);
  const double dt = 1e-3, mass = total(domain.particles.mass);
  run(domain, 400, dt);
  const Energies e = energy_balance(domain);
  const double t = 400 * dt, exact = 0.5 * mass * (1 + 9.81 * 9.81) * t * t;
  // A body without stress falls exactly; only rounding is left, of 400 steps at most 1e-15 each.
  CHECK(e[Energy::kinetic] == Approx(exact).epsilon(1e-12));
  CHECK(e[Energy::gravitational] == Approx(-exact).epsilon(1e-12));
  CHECK(std::fabs(e[Energy::elastic]) < 1e-12 * exact);
  CHECK(std::fabs(e[Energy::transfer]) < 1e-12 * exact);
  CHECK(std::fabs(residual(e)) < 1e-12 * exact);
}

// A standing wave in a column fixed below and free above: a quarter wave, lambda = 4 H. The velocity filter
// of the transfers damps it by xi = a (kh)^3 / (2 C), a = .0471 and C = dt c / h (METHODS section 7), which
// is all that the ledger may book, and it books it as transfer.
TEST_CASE("An oscillating column changes kinetic into elastic energy and loses what the transfers take",
          "[mpm]")
{
  const Threads one(1);
  const Elastic law = elastic(1e7, 0.0);
  const double height = 5, k = pi / (2 * height), omega = k * law.pressure_speed();
  for (const double courant : {0.25, 0.5})
  {
    INFO("Courant number " << courant);
    Domain domain = make_column(law, height);
    Particles& p = domain.particles;
    for (int q = 0; q < p.size(); ++q)
    {
      p.velocity_y[q] = 1e-3 * std::sin(k * p.y[q]);
      p.affine_yy[q] = 1e-3 * k * std::cos(k * p.y[q]);
    }
    open_ledger(domain);
    const double start = kinetic_energy(domain), dt = courant / law.pressure_speed();
    const int quarter = static_cast<int>(std::lround(0.5 * pi / (omega * dt)));
    double greatest_residual = 0, greatest_elastic = 0, last_transfer = 0;
    for (int n = 0; n < 20 * quarter; ++n)
    {
      run(domain, 1, dt);
      const Energies e = energy_balance(domain);
      greatest_residual = std::max(greatest_residual, std::fabs(residual(e)));
      greatest_elastic = std::max(greatest_elastic, e[Energy::elastic]);
      CHECK(e[Energy::transfer] >= last_transfer * (1 - 1e-12));
      last_transfer = e[Energy::transfer];
    }
    const double xi = 0.0471 * std::pow(k, 3) / (2 * courant), cycles = 20 * quarter * dt * omega;
    INFO("transfer " << last_transfer / start << ", closed form " << 1 - std::exp(-2 * xi * cycles)
                     << ", residual " << greatest_residual / start << ", elastic "
                     << greatest_elastic / start);
    CHECK(last_transfer == Approx(start * (1 - std::exp(-2 * xi * cycles))).epsilon(0.2));
    CHECK(greatest_elastic == Approx(start).epsilon(0.05));
    // At the ends (omega dt)^2 of the wave; and the stress does work in half a step on what the transfers
    // take, at most omega dt / 2 of it, omega being that of the fastest motion on the grid, about c/h.
    CHECK(greatest_residual < std::pow(omega * dt, 2) * start + 0.5 * courant * last_transfer);
  }
}

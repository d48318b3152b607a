#include "boundaries/mirrored_wall.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;
using namespace domains;

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
  domain.settings.gravity_x = 1;
  domain.settings.gravity_y = -9.81;
  open_energy_balance(domain);
  const double dt = 1e-3, mass = total(domain.particles.mass);
  run(domain, 400, dt);
  const Energies e = energies_of(domain);
  const double t = 400 * dt, exact = 0.5 * mass * (1 + 9.81 * 9.81) * t * t;
  // A body without stress falls exactly; only rounding is left, of 400 steps at most 1e-15 each.
  CHECK(e[Energy::kinetic] == Approx(exact).epsilon(1e-12));
  CHECK(e[Energy::gravitational] == Approx(-exact).epsilon(1e-12));
  CHECK(std::fabs(e[Energy::elastic]) < 1e-12 * exact);
  CHECK(std::fabs(e[Energy::transfer]) < 1e-12 * exact);
  CHECK(std::fabs(residual(e)) < 1e-12 * exact);
}

// A standing wave in a column fixed below and free above: a quarter wave, lambda = 4 H. The velocity filter
// of the transfers damps it by xi = a (kh)^3 / (2 C), a = .0471 and C = dt c / h (dispersion.hpp), which
// is all that the energy balance may book, and it books it as transfer.
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
    open_energy_balance(domain);
    const double start = kinetic_energy(domain), dt = courant / law.pressure_speed();
    const int quarter = static_cast<int>(std::lround(0.5 * pi / (omega * dt)));
    double greatest_residual = 0, greatest_elastic = 0, last_transfer = 0;
    for (int n = 0; n < 20 * quarter; ++n)
    {
      run(domain, 1, dt);
      const Energies e = energies_of(domain);
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

// rho g (H - y) squeezes the column with M: the energy stored is rho^2 g^2 H^3 / (6 M) for each metre of
// width, and the weight comes down by twice that. What gravity releases and elasticity does not store, the
// damping takes, and a little the transfers. Tolerance: half a per cent of the closed form, as the settlement
// itself has at H/h = 10.
TEST_CASE("A column that settles under its sudden weight gives half of its work to the damping", "[mpm]")
{
  const Threads one(1);
  const Elastic law = elastic(1e9, 0.0);
  const double height = 10, g = 9.81;
  Domain domain = make_column(law, height);
  domain.settings.gravity_y = -g;
  domain.settings.local_damping = 0.75;
  open_energy_balance(domain);
  const double stored = std::pow(law.density * g, 2) * std::pow(height, 3) / (6 * law.p_modulus());
  run(domain, 2000, 0.5 / law.pressure_speed());
  const Energies e = energies_of(domain);
  INFO("elastic " << e[Energy::elastic] / stored << ", gravitational " << e[Energy::gravitational] / stored
                  << ", damping " << e[Energy::damping] / stored << ", transfer "
                  << e[Energy::transfer] / stored << ", residual " << residual(e) / stored);
  CHECK(e[Energy::kinetic] < 1e-10 * stored);
  CHECK(e[Energy::elastic] == Approx(stored).epsilon(0.005));
  CHECK(e[Energy::gravitational] == Approx(-2 * stored).epsilon(0.005));
  CHECK(e[Energy::damping] + e[Energy::transfer] == Approx(stored).epsilon(0.01));
  CHECK(e[Energy::damping] > 0.8 * stored);
}

TEST_CASE("Gravity that grows slowly does the work that the column stores, noted now and then", "[mpm]")
{
  const Threads one(1);
  const Elastic law = elastic(1e9, 0.0);
  const double height = 10, g = 9.81, dt = 0.5 / law.pressure_speed();
  Domain domain = make_column(law, height);
  domain.settings.local_damping = 0.75;
  open_energy_balance(domain);
  const double stored = std::pow(law.density * g, 2) * std::pow(height, 3) / (6 * law.p_modulus());
  constexpr int steps = 8000; // 100 periods 4 H / c
  for (int k = 0; k < steps; ++k)
  {
    domain.settings.gravity_y = -g * std::min(1.0, 2.0 * k / steps);
    run(domain, 1, dt);
    if (k % 100 == 0) note_gravity(domain);
  }
  const Energies e = energies_of(domain);
  // The jumps of the load's rate at both ends of the ramp, of 50 periods T, leave waves of T/50 of the load.
  CHECK(e[Energy::elastic] == Approx(stored).epsilon(0.005));
  CHECK(e[Energy::gravitational] == Approx(-stored).epsilon(0.01));
  CHECK(e[Energy::damping] + e[Energy::transfer] < 0.01 * stored);
  CHECK(std::fabs(residual(e)) < 0.002 * stored);
}

// Matter so heavy that its stress does not change its motion: a block is sheared by its own inertia with
// gamma = 2 exy, evenly. It stores tau_y^2 / 2G and dissipates tau_y (gamma - tau_y / G) a volume, tau_y = q
// / sqrt 3. The edges feel their stress by tau t / (rho h) = 1e-4 of the velocity; the area shrinks by
// gamma^2 / 4 = 6e-4.
TEST_CASE("A sheared block dissipates yield stress times plastic shear", "[mpm]")
{
  const Threads one(1);
  const double peak = 1e4, young = 1e6;
  VonMises law = von_mises(peak, peak, 1, young, 0.3);
  law.density = 1e7;
  Domain domain = make_domain({{law, {0.2, 0.4, 6, 5}}});
  Particles& p = domain.particles;
  const double rate = 0.5, time = 0.1, gamma = rate * time, centre_x = 3.2, centre_y = 2.9;
  for (int k = 0; k < p.size(); ++k)
  {
    p.velocity_x[k] = 0.5 * rate * (p.y[k] - centre_y);
    p.velocity_y[k] = 0.5 * rate * (p.x[k] - centre_x);
    p.affine_xy[k] = p.affine_yx[k] = 0.5 * rate;
  }
  open_energy_balance(domain);
  run(domain, 1000, time / 1000);
  const Energies e = energies_of(domain);
  const double volume = 30, tau = peak / std::sqrt(3.0), yield = tau / law.shear_modulus();
  INFO("residual " << residual(e) << ", transfer " << e[Energy::transfer]);
  CHECK(e[Energy::plastic] == Approx(volume * tau * (gamma - yield)).epsilon(2e-3));
  CHECK(e[Energy::elastic] == Approx(volume * tau * yield / 2).epsilon(5e-3));
  CHECK(-e[Energy::kinetic] ==
        Approx(e[Energy::elastic] + e[Energy::plastic] + e[Energy::transfer]).epsilon(2e-3));
}

TEST_CASE("One and three threads keep the same energy balance to the last bit", "[mpm]")
{
  const auto energies_on = [](int threads)
  {
    const Threads use(threads);
    Domain domain = make_domain({{von_mises(2e3, 1e3, 0.1), {0.2, 0.4, 30, 20}}}, 1, 0.3, 7);
    random_velocities(domain, 1, 8);
    domain.settings.gravity_y = -9.81;
    domain.settings.local_damping = 0.3;
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, false}));
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, 0, 1, true}));
    rebuild(domain);
    open_energy_balance(domain);
    run(domain, 50, 0.2 / elastic().pressure_speed());
    return energies_of(domain);
  };
  const Energies once = energies_on(1);
  CHECK(once[Energy::plastic] > 0);
  CHECK(once.value == energies_on(3).value);
}

// The two halves of a symmetric case, and one half with a mirrored wall in place of the other.
TEST_CASE("A body before mirrored walls has a quarter of the energy balance of the whole", "[mpm]")
{
  const Threads one(1);
  const auto energies_in = [](bool quarter)
  {
    const Elastic law = elastic();
    Domain domain = make_domain({{law, quarter ? Rectangle{0, 0, 4, 3} : Rectangle{-4, -3, 8, 6}}});
    Particles& p = domain.particles;
    for (int k = 0; k < p.size(); ++k)
    {
      p.velocity_x[k] = 1e-3 * std::sin(p.x[k] / 3) * std::cos(p.y[k]);
      p.velocity_y[k] = 2e-3 * std::sin(p.y[k] / 2) * std::cos(p.x[k] / 4);
    }
    if (quarter)
    {
      domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, 0, 1, true}));
      domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, true}));
      rebuild(domain);
    }
    domain.settings.local_damping = 0.1;
    open_energy_balance(domain);
    run(domain, 100, 0.4 / law.pressure_speed());
    return energies_of(domain);
  };
  const Energies whole = energies_in(false), quarter = energies_in(true);
  for (const Energy term : {Energy::kinetic, Energy::elastic, Energy::damping, Energy::transfer})
    CHECK(quarter[term] == Approx(whole[term] / 4).epsilon(1e-11)); // sums in another order
  CHECK(whole[Energy::damping] > 0);
}

namespace
{
/// The energies of a free block, 10 cells wide, that waves run through, every 100 steps.
std::vector<Energies> shake_free_block(int steps, bool random)
{
  const Elastic law = elastic(1e6, 0.0);
  Domain domain = make_domain({{law, {0, 0, 10, 4}}});
  Particles& p = domain.particles;
  const double k = pi / 10; // the longest wave between free ends; without lateral strain, as nu = 0
  for (int q = 0; q < p.size() && !random; ++q)
  {
    p.velocity_x[q] = 1e-3 * std::cos(k * p.x[q]);
    p.affine_xx[q] = -1e-3 * k * std::sin(k * p.x[q]);
  }
  if (random) random_velocities(domain, 1e-3, 51);
  open_energy_balance(domain);
  std::vector<Energies> seen;
  for (int n = 0; n < steps; n += 100)
  {
    run(domain, 100, 0.5 / law.pressure_speed());
    seen.push_back(energies_of(domain));
  }
  seen.push_back({});
  seen.back()[Energy::kinetic] = domain.energy.kinetic; // what it began with
  return seen;
}

/// In rising by rounding, 1e-15 of the start a step at most, the energy may not pass what it was.
void check_that_it_never_rises(int steps)
{
  const Threads one(1);
  const std::vector<Energies> seen = shake_free_block(steps, true);
  const double start = seen.back()[Energy::kinetic];
  double lowest = 0, risen = 0;
  for (std::size_t n = 0; n + 1 < seen.size(); ++n)
  {
    const double energy = seen[n][Energy::kinetic] + seen[n][Energy::elastic];
    risen = std::max(risen, (energy - lowest) / start);
    lowest = std::min(lowest, energy);
    CHECK(residual(seen[n]) / start <
          0.125); // of what the transfers took at most C/4, as in the column above
  }
  INFO("risen by " << risen << " of the start");
  CHECK(risen < 1e-15 * steps);
}
} // namespace

TEST_CASE("A wave in a free block fades as the closed form of the transfers' damping says", "[mpm]")
{
  const Threads one(1);
  const std::vector<Energies> seen = shake_free_block(1000, false);
  const double start = seen.back()[Energy::kinetic], k = pi / 10, omega_dt = 0.5 * k;
  const double xi = 0.0471 * std::pow(k, 3) / (2 * 0.5), exact = 1 - std::exp(-2 * xi * omega_dt * 1000);
  INFO("lost " << seen[9][Energy::transfer] / start << ", closed form " << exact);
  CHECK(seen[9][Energy::transfer] / start == Approx(exact).epsilon(0.3));
}

TEST_CASE("The energy of a free elastic block never rises", "[mpm]")
{
  check_that_it_never_rises(20000);
}

TEST_CASE("The energy of a free elastic block never rises in a million steps", "[.fine]")
{
  check_that_it_never_rises(1000000);
}

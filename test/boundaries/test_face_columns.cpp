#include "boundaries/compliant_base.hpp"
#include "test/domains.hpp"
#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

#include <numbers>
#include <numeric>

using namespace mpm;
using namespace domains;

namespace
{
const Elastic rock = elastic(250e6, 0.25, 2200);

std::shared_ptr<const IncomingWave> no_wave()
{
  return std::make_shared<IncomingWave>();
}

/// Puts a body with consistent inertia on a compliant base at the height `bottom` whose dashpots are
/// `strength` times as strong as the ground's impedance.
void put_on_base(Domain& domain, double strength, double bottom, std::shared_ptr<const IncomingWave> wave)
{
  std::vector<Face> faces = find_faces(domain, Edge::bottom, bottom, 0.5);
  for (Face& face : faces)
  {
    face.dashpot_x *= strength;
    face.dashpot_y *= strength;
  }
  domain.settings.consistent_inertia = true;
  domain.boundaries.push_back(
      std::make_unique<CompliantBase>(std::move(faces), std::move(wave), BaseSpring(0)));
  sort_particles(domain);
}

/// Soft ground on stiff ground, ragged by scatter, whose base lies between two lines of nodes; all moves at
/// random.
Domain ragged_ground(double contrast, double strength, double offset)
{
  const Law stiff = elastic(1e6 * contrast, 0.3, 2300), soft = elastic(1e6, 0.3, 1700);
  Domain domain = make_domain({{stiff, {0.2, offset, 6, 3}}, {soft, {0.2, offset + 3, 6, 3}}}, 1, 0.3, 51);
  random_velocities(domain, 1e-3, 52);
  random_affine(domain, 1e-3, 53);
  put_on_base(domain, strength, offset, no_wave());
  return domain;
}

/// Greatest velocity that a base sends back of a pulse of S or P waves `cells` long, over the pulse's peak;
/// the base is `offset` above a line of nodes, and the pulse too weak to move it.
double sent_back(double cells, bool consistent, double offset, bool pressure)
{
  const double height = 3 * cells, c = pressure ? rock.pressure_speed() : rock.shear_speed(),
               dt = 0.5 / rock.pressure_speed(), peak = 1e-3;
  Domain domain = make_domain({{rock, {0, offset, 1, height}}});
  domain.grid.wrapped = true;
  put_on_base(domain, 1, offset, no_wave());
  domain.settings.consistent_inertia = consistent;
  Particles& p = domain.particles;
  auto &velocity = pressure ? p.velocity_y : p.velocity_x, &slope = pressure ? p.affine_yy : p.affine_xy,
       &stress = pressure ? p.stress_yy : p.stress_xy;
  const auto pulse = [&](double y)
  {
    const double at = (y - offset - 0.2 * cells) / cells;
    return at > 0 && at < 1 ? peak * std::pow(std::sin(std::numbers::pi * at), 4) : 0;
  };
  for (int k = 0; k < p.size(); ++k)
  {
    velocity[k] = pulse(p.y[k]);
    slope[k] = (pulse(p.y[k] + 1e-4) - pulse(p.y[k] - 1e-4)) / 2e-4;
    stress[k] = rock.density * c * pulse(p.y[k] + 0.5 * dt * c); // half a step later
    if (pressure) p.stress_xx[k] = p.stress_zz[k] = rock.poisson / (1 - rock.poisson) * stress[k];
  }
  run(domain, static_cast<int>(2.2 * cells / (c * dt)), dt); // what comes back is half-way up
  return greatest(velocity) / peak;
}
} // namespace

TEST_CASE("With consistent inertia a base sends back less than half of what it does with the lumped mass",
          "[boundaries]")
{
  const Threads one(1);
  // The lumped mass errs by (kh)^2 / 6 at the face, consistent inertia at the next order; measured 0.3 of it.
  const double cells = GENERATE(20.0, 30.0), with = sent_back(cells, true, 0, false),
               without = sent_back(cells, false, 0, false);
  CAPTURE(cells, with, without);
  CHECK(with < 0.5 * without);
  CHECK(with < 0.003);
}

TEST_CASE("A base sends back less than with the lumped mass wherever its face stands in a cell",
          "[boundaries]")
{
  const Threads one(1);
  // Half a particle above the face, the lowest node's mass goes to zero at an offset of 0.75.
  const bool pressure = GENERATE(false, true);
  const double offset = GENERATE(0.0, 0.25, 0.5, 0.6, 0.65, 0.7, 0.73, 0.745, 0.75, 0.77, 0.9),
               with = sent_back(20, true, offset, pressure), without = sent_back(20, false, offset, pressure);
  CAPTURE(pressure, offset, with, without);
  CHECK(with < without);
}

TEST_CASE("A face's dashpots never give energy, however strong, wherever the face is in a cell",
          "[boundaries][long]")
{
  const Threads one(1);
  const double contrast = GENERATE(1.0, 1e4), strength = GENERATE(1.0, 10.0, 1000.0),
               offset = GENERATE(0.0, 0.37);
  const bool flip = GENERATE(false, true);
  CAPTURE(contrast, strength, offset, flip);
  Domain domain = ragged_ground(contrast, strength, offset);
  domain.settings.flip = flip;
  domain.settings.filter.time = 1;
  const double dt = 0.78 / elastic(1e6 * contrast, 0.3, 2300).pressure_speed();
  const EnergyShares energy = energy_shares(domain, 1000, dt);
  CHECK(energy.greatest < 1 + 1e-6);
  CHECK(energy.last <= energy.early);
}

TEST_CASE("The work that the energy balance books at a base is that of the force that acted", "[boundaries]")
{
  const Threads one(1);
  // Free of stress, the base is all that acts in the first step.
  const double strength = GENERATE(1.0, 30.0), offset = GENERATE(0.0, 0.3, 0.65, 0.74);
  IncomingWave wave;
  wave.horizontal = test::pulse(0.7, 0.01, 2);
  wave.vertical = test::pulse(-0.4, 0.01, 2);
  Domain domain = make_domain({{rock, {0.2, offset, 6, 4}}});
  random_velocities(domain, 1, 61);
  random_affine(domain, 1, 62);
  put_on_base(domain, strength, offset, std::make_shared<IncomingWave>(wave));
  domain.time = 0.005;
  step(domain, 0.5 / rock.pressure_speed());
  const Energies& flow = domain.energy.flow;
  CHECK(flow[Energy::incoming] > 0);
  CHECK(domain.energy.work == Approx(flow[Energy::incoming] - flow[Energy::radiated_base]).epsilon(1e-11));
}

TEST_CASE("A face's dashpots take the momentum rho c v an area and time from a body that moves with v",
          "[boundaries]")
{
  const Threads one(1);
  const double weak = 1e-6, v = 0.3, width = 6, dt = 0.5 / rock.pressure_speed();
  Domain domain = make_domain({{rock, {0.2, 0, width, 4}}}, 1, 0);
  set_velocity(domain, v, -2 * v);
  put_on_base(domain, weak, 0, no_wave());
  const auto momentum = [&](const std::vector<double>& velocity)
  { return std::inner_product(velocity.begin(), velocity.end(), domain.particles.mass.begin(), 0.0); };
  const Particles& p = domain.particles;
  const double x = momentum(p.velocity_x), y = momentum(p.velocity_y),
               area = weak * dt * rock.density * width;
  step(domain, dt);
  // Of sums of 5e4 N s, known to 1e-10 at worst, the dashpots take about 1e-3.
  CHECK((x - momentum(p.velocity_x)) / (area * rock.shear_speed() * v) == Approx(1).epsilon(1e-5));
  CHECK((y - momentum(p.velocity_y)) / (area * rock.pressure_speed() * -2 * v) == Approx(1).epsilon(1e-5));
}

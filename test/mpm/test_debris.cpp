// Ground in pieces: particles that fly alone, and gauges among them.

#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;

namespace
{
/// One particle of cohesionless ground in cells of 1 m, a quarter of a cell large, 20 m up.
Domain lone_particle()
{
  Domain domain = domains::make_domain({{domains::mohr_coulomb(30, 0), {2, 20, 0.5, 0.5}, 0.5}}, 1);
  domain.settings.gravity_y = -9.81;
  return domain;
}
} // namespace

TEST_CASE("A particle that flies alone spreads no further than its spline reaches", "[mpm]")
{
  Domain domain = lone_particle();
  Particles& p = domain.particles;
  p.velocity_x[0] = 5;
  p.affine_xx[0] = p.affine_yy[0] = 3;
  const std::vector<double>& opening = domain.materials[0].state[1];
  for (int part = 0; part < 20; ++part)
  {
    domains::run(domain, 100, 1e-3);
    const double closed = p.volume[0] * std::exp(-opening[0]);
    limit_openings(domain);
    CHECK(p.volume[0] <= 16 * (1 + 1e-12));
    CHECK(p.volume[0] * std::exp(-opening[0]) == Approx(closed).epsilon(1e-12));
  }
  // It would be exp(2 x 3 x 2) times as large as it was; and it flies as before.
  CHECK(p.volume[0] == Approx(16).epsilon(1e-12));
  CHECK(p.velocity_x[0] == Approx(5));
  CHECK(p.velocity_y[0] == Approx(-9.81 * 2));
  CHECK(greatest_speed(domain.particles) < 25);
}

TEST_CASE("Ground that is whole, or torn less than that, keeps its volume", "[mpm]")
{
  Domain domain = lone_particle();
  domain.particles.volume[0] = 15.9;
  domain.materials[0].state[1][0] = std::log(15.9 / 0.25);
  const Domain before = domains::same_particles(domain);
  limit_openings(domain);
  CHECK(domain.particles.volume == before.particles.volume);
  CHECK(domain.materials[0].state == before.materials[0].state);
  Domain whole = domains::make_domain({{domains::elastic(), {0, 0, 4, 4}, 0.5}}, 1);
  whole.particles.volume[3] = 100;
  limit_openings(whole);
  CHECK(whole.particles.volume[3] == 100);
}

TEST_CASE("A crack turns with the particle, and spreads no further than it", "[mpm]")
{
  MohrCoulomb law = domains::mohr_coulomb(30, 10e3);
  law.tension_cutoff = 0;
  Domain domain = domains::make_domain({{law, {2, 20, 0.5, 0.5}, 0.5}}, 1);
  Particles& p = domain.particles;
  Material& ground = domain.materials[0];
  const auto set = [&](const char* field, double value) { (*ground.field(field))[0] = value; };
  const auto get = [&](const char* field) { return (*ground.field(field))[0]; };
  set("opening", 0.5);
  set("opening_xx", 0.5); // a crack along y
  const double spin = 2, dt = 1e-3;
  p.affine_xy[0] = -spin, p.affine_yx[0] = spin;
  domains::run(domain, 500, dt);
  const double angle = 500 * 2 * std::atan(0.5 * dt * spin), c = std::cos(angle), s = std::sin(angle);
  // A step along the tangent swells what turns by half the square of its angle, in either direction.
  const double swollen = 500 * 0.5 * (dt * spin) * (dt * spin);
  CHECK(get("opening") == Approx(0.5 + 2 * swollen).epsilon(1e-5));
  CHECK(get("opening_xx") == Approx(0.5 * c * c + swollen).epsilon(1e-5));
  CHECK(get("opening_yy") == Approx(0.5 * s * s + swollen).epsilon(1e-5));
  CHECK(get("opening_xy") == Approx(0.5 * s * c).epsilon(1e-5));
  const double before = get("opening"), share = get("opening_xy") / before;
  p.volume[0] = 16 * std::exp(0.2);
  limit_openings(domain);
  CHECK(get("opening") == Approx(before - 0.2).epsilon(1e-12));
  CHECK(get("opening_xy") == Approx(share * get("opening")).epsilon(1e-12));
}

TEST_CASE("A gauge beside a particle that flies alone flies too", "[mpm]")
{
  Domain domain = lone_particle();
  Particles& p = domain.particles;
  p.velocity_x[0] = 5;
  p.affine_xy[0] = -50; // turns, so that nodes 1.5 m away do 75 m/s
  p.affine_yx[0] = 50;
  domain.gauges.push_back({p.x[0] - 0.3, p.y[0] + 1.5, p.x[0] - 0.3, p.y[0] + 1.5, 5, 0});
  domains::run(domain, 100, 1e-3);
  const Gauge& gauge = domain.gauges[0];
  CHECK(gauge.velocity_x == 5);
  CHECK(gauge.velocity_y == Approx(-0.981).epsilon(1e-12));
  CHECK(gauge.x - gauge.reference_x == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("A gauge on the edge of a vertical cut moves with the ground", "[mpm]")
{
  Domain domain = domains::make_domain({{domains::elastic(), {0, 0, 6, 6}, 0.5}}, 1);
  domains::set_velocity(domain, 1, -2);
  for (const double offset : {0.0, 0.25, 0.5, 0.75})
    domain.gauges.push_back({6 - offset, 6, 6 - offset, 6, 0, 0});
  domains::run(domain, 1, 1e-3);
  for (const Gauge& gauge : domain.gauges)
  {
    CHECK(gauge.velocity_x == Approx(1).epsilon(1e-9));
    CHECK(gauge.velocity_y == Approx(-2).epsilon(1e-9));
  }
}

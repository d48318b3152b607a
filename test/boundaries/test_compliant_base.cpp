#include "boundaries/compliant_base.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;

namespace
{
const Elastic rock = domains::elastic(250e6, 0.25, 2200);

/// A column of rock, periodic and one cell wide, on a compliant base.
struct Column
{
  Domain domain;
  CompliantBase* base;

  Column(double height, double spring_time)
      : domain(domains::make_domain({{rock, {0, 0, 1, height}}})), base(add_base(spring_time))
  {
  }
  double step() const { return 0.5 / rock.pressure_speed(); }
  int lowest() const
  {
    const std::vector<double>& y = domain.particles.reference_y;
    return static_cast<int>(std::min_element(y.begin(), y.end()) - y.begin());
  }

private:
  CompliantBase* add_base(double spring_time)
  {
    domain.grid.wrapped = true;
    auto owned = std::make_unique<CompliantBase>(find_faces(domain, Edge::bottom, 0, 0.5),
                                                 std::make_shared<IncomingWave>(), BaseSpring(spring_time));
    CompliantBase* const result = owned.get();
    domain.boundaries.push_back(std::move(owned));
    sort_particles(domain);
    return result;
  }
};

constexpr double height = 10, load = 1; // m, Pa

/// A column under a lasting load in x or y.
Column loaded(char direction, double spring_time, double duration)
{
  Column column(height, spring_time);
  (direction == 'x' ? column.domain.settings.gravity_x : column.domain.settings.gravity_y) =
      load / (rock.density * height);
  domains::run(column.domain, static_cast<int>(duration / column.step()), column.step());
  return column;
}
} // namespace

TEST_CASE("known weakness: a base on dashpots alone gives way to a lasting load F at the speed F / (rho c)",
          "[boundaries]")
{
  // The column rings at 4 H / c = 0.2 s and loses most of it to the dashpots each time; 3 s leave nothing of
  // it.
  const char direction = GENERATE('x', 'y');
  const Column column = loaded(direction, 0, 3);
  const Particles& p = column.domain.particles;
  const int k = column.lowest();
  const double impedance = rock.density * (direction == 'x' ? rock.shear_speed() : rock.pressure_speed());
  CHECK((direction == 'x' ? p.velocity_x : p.velocity_y)[k] == Approx(load / impedance).epsilon(1e-6));
}

TEST_CASE("under a lasting load F the spring lets the base go by about F T / (rho c), and brings it back",
          "[boundaries]")
{
  // The slowest mode is that of the reaction, about exp(-t / 10 T): 150 T leave 3e-7. A coordinate of 10 m is
  // known to 2e-15 m, of a way of 4e-7 m.
  const char direction = GENERATE('x', 'y');
  const double time = 0.2;
  Column column(height, time);
  (direction == 'x' ? column.domain.settings.gravity_x : column.domain.settings.gravity_y) =
      load / (rock.density * height);
  const double way =
      load * time / (rock.density * (direction == 'x' ? rock.shear_speed() : rock.pressure_speed()));
  double furthest = 0, moved = 0;
  for (int n = 0; n * column.step() < 150 * time; ++n)
  {
    domains::run(column.domain, 1, column.step());
    const Particles& p = column.domain.particles;
    const int k = column.lowest();
    moved = direction == 'x' ? p.x[k] - p.reference_x[k] : p.y[k] - p.reference_y[k];
    furthest = std::max(furthest, moved);
  }
  CHECK(furthest < 1.3 * way); // a sudden load makes the column swing
  CHECK(furthest > 0.5 * way);
  CHECK(std::fabs(moved) < 1e-5 * way);
}

TEST_CASE("a wave meets the spring as dashpot, lag and reaction in series", "[boundaries]")
{
  // A pulse of S waves on its way down. Of v = down + up and the traction z (up - down) = -z v - (z / T) (s +
  // r) at the base: v = down - (s + r) / 2T.
  const double time = 0.1, length = 0.4, start = 5, c = rock.shear_speed();
  Column column(170, time); // the surface's echo takes 1.5 s
  const auto down = [&](double t)
  { return t > 0 && t < length ? std::pow(std::sin(std::numbers::pi * t / length), 4) : 0; };
  Particles& p = column.domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    p.velocity_x[k] = down((p.y[k] - start) / c);
    p.stress_xy[k] = rock.density * c * p.velocity_x[k];
  }
  const double dt = column.step();
  double u = 0, s = 0, r = 0; // of the differential equation
  double error = 0, reflected = 0;
  for (int n = 1; n * dt < 1.2; ++n)
  {
    domains::run(column.domain, 1, dt);
    const double echo = -(s + r) / (2 * time), v = down(n * dt - start / c) + echo;
    error = std::max(error, std::fabs(p.velocity_x[column.lowest()] - v));
    reflected = std::max(reflected, std::fabs(echo));
    u += dt * v;
    s += dt * (u - s) / (0.5 * time);
    r += dt * s / (10 * time);
  }
  INFO("error " << error << " of the pulse's peak; reflected " << reflected);
  // Half a step and a quarter of a metre between particle and face: 2 ms of a pulse that rises by 9 a second
  // at most.
  CHECK(error < 0.02);
  CHECK(reflected > 0.2);
}

TEST_CASE("the base's drift is its displacement beyond the free field's, between the columns", "[boundaries]")
{
  Domain domain = domains::make_domain({{rock, {0, 0, 20, 2}}});
  const CompliantBase base(find_faces(domain, Edge::bottom, 0, 0.5), std::make_shared<IncomingWave>(),
                           BaseSpring(0));
  const double angle = 1e-3, sunk = -0.02;
  Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    p.x[k] += 0.01 + 0.001 * p.reference_x[k]; // as the free field, whose sides differ
    p.y[k] += sunk + angle * (p.reference_x[k] - 10);
  }
  const BaseDrift drift = base.drift(domain.particles, {{0, {0.01, 0}}, {20, {0.03, 0}}});
  CHECK(drift.half_length == Approx(9.75));
  CHECK(drift.rotation == Approx(angle));
  CHECK(std::fabs(drift.corner[0][0]) < 1e-12);
  CHECK(drift.corner[0][1] == Approx(sunk - 9.75 * angle));
  CHECK(drift.corner[1][1] == Approx(sunk + 9.75 * angle));
  CHECK(drift.greatest == Approx(0.02 + 9.75 * angle));
}

#include "boundaries/mirrored_wall.hpp"
#include "solver/mpm/dispersion.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

namespace
{
struct Wave
{
  double frequency; ///< Hz
  double damping;   ///< ratio
};

/// Frequency and damping ratio of a signal that is one damped oscillation: with samples s steps apart
/// q_{n+s} = 2 r cos(b) q_n - r^2 q_{n-s}, solved for r and b by least squares.
Wave fit(const std::vector<double>& q, int s, double dt)
{
  double aa = 0, ab = 0, bb = 0, ya = 0, yb = 0;
  for (std::size_t n = s; n + s < q.size(); ++n)
  {
    const double a = q[n], b = q[n - s], y = q[n + s];
    aa += a * a, ab += a * b, bb += b * b, ya += y * a, yb += y * b;
  }
  const double det = aa * bb - ab * ab;
  const double twice_cosine = (ya * bb - yb * ab) / det, square = -(yb * aa - ya * ab) / det;
  const double r = std::sqrt(square), angle = std::acos(twice_cosine / (2 * r));
  return {angle / (2 * std::numbers::pi * s * dt), -std::log(r) / angle};
}

/// A wave that stands between two walls half a wavelength of `cells` apart, in a column of 1 m cells; the S
/// wave moves along them, the P wave across. Eigenmode of grid and walls, so that nothing else moves.
Wave standing_wave(bool shear, int cells, double courant, bool consistent = false)
{
  const Elastic law = elastic(1e6, 0.3);
  const double speed = shear ? law.shear_speed() : law.pressure_speed(), dt = courant / speed;
  Domain domain = make_domain({{law, {0, 0, 1, cells / 2.0}}});
  domain.grid.wrapped = true;
  domain.settings.consistent_inertia = consistent;
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, false}));
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, cells / 2, -1, false}));
  sort_particles(domain);
  Particles& p = domain.particles;
  auto& velocity = shear ? p.velocity_x : p.velocity_y;
  const auto shape = [&](int k) { return std::sin(2 * std::numbers::pi * p.reference_y[k] / cells); };
  for (int k = 0; k < p.size(); ++k) velocity[k] = 1e-7 * speed * shape(k);
  const int steps_a_period = static_cast<int>(cells / courant);
  std::vector<double> amplitude;
  for (int n = 0; n < 4 * steps_a_period; ++n)
  {
    step(domain, dt);
    double sum = 0;
    for (int k = 0; k < p.size(); ++k) sum += velocity[k] * shape(k);
    amplitude.push_back(sum);
  }
  return fit(amplitude, steps_a_period / 6, dt);
}
} // namespace

TEST_CASE("a standing wave is as slow and as damped as the formulas say", "[boundaries]")
{
  const Threads one(1);
  const bool shear = GENERATE(true, false);
  const int cells = GENERATE(14, 26);
  // The Courant number of P waves is at most 0.78; that of S waves in this ground 0.53 times it.
  const double courant = shear ? GENERATE(0.05, 0.35) : GENERATE(0.2, 0.7);
  const Elastic law = elastic(1e6, 0.3);
  const double speed = shear ? law.shear_speed() : law.pressure_speed(), exact = speed / cells;
  const Resolution resolution{1, courant / speed};
  const Wave found = standing_wave(shear, cells, courant);
  const double slow = phase_error(resolution, speed, exact),
               damped = numerical_damping(resolution, speed, exact);
  CAPTURE(shear, cells, courant, slow, 1 - found.frequency / exact, damped, found.damping);
  // The next terms are (k h)^2 / 8 of the first: 3 % at 14 cells a wave.
  CHECK(1 - found.frequency / exact == Approx(slow).epsilon(0.05));
  CHECK(found.damping == Approx(damped).epsilon(0.05));
  // And so are the frequencies up to which both are within a bound.
  CHECK(phase_error(resolution, speed, phase_limit(resolution, speed, 0.01)) == Approx(0.01));
  CHECK(numerical_damping(resolution, speed, damping_limit(resolution, speed, 0.01)) == Approx(0.01));
}

TEST_CASE("with consistent inertia a wave of ten cells is nearly as fast as it should be", "[boundaries]")
{
  const Threads one(1);
  const int cells = GENERATE(10, 14);
  const double courant = GENERATE(0.05, 0.35);
  const Elastic law = elastic(1e6, 0.3);
  const double speed = law.shear_speed(), exact = speed / cells;
  const Resolution resolution{.spacing = 1, .dt = courant / speed, .consistent_inertia = true};
  const Wave found = standing_wave(true, cells, courant, true);
  const double slow = phase_error(resolution, speed, exact), kh = 2 * std::numbers::pi / cells;
  CAPTURE(cells, courant, slow, 1 - found.frequency / exact);
  // Next terms: (kh)^6 of the series, and half the square of the damping ratio, which slows the wave too.
  const double next = 0.02 * std::pow(kh, 6) + 0.5 * found.damping * found.damping;
  CHECK(std::fabs(1 - found.frequency / exact - slow) < 2e-4 + next);
  CHECK(slow < 0.1 * kh * kh / 6); // a tenth of the lumped mass's lag
  for (const double share : {0.01, 0.03})
    CHECK(phase_error(resolution, speed, phase_limit(resolution, speed, share)) == Approx(share));
}

TEST_CASE("half the time step doubles a wave's numerical damping", "[boundaries]")
{
  const Threads one(1);
  // G does not know the time step; the growth factor is sqrt(G) a step, whatever the frequency.
  CHECK(standing_wave(true, 20, 0.1).damping / standing_wave(true, 20, 0.2).damping ==
        Approx(2).epsilon(0.03));
}

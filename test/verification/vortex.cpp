#include "test/verification/cases.hpp"

#include "boundaries/mirrored_wall.hpp"
#include "test/domains.hpp"
#include "test/verification/body_force.hpp"

#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double pi = std::numbers::pi;
constexpr double amplitude = 0.15; // rad
constexpr double period = 1;       // s
constexpr double half_width = 1.3; // m, of the block that the ring is part of

Elastic material()
{
  return domains::elastic(1e4, 0.3, 1000);
}

/// Circles turn rigidly by alpha(R, t) = A (1 - cos(2 pi t / T)) / 2 (1 - 32 (R - 1)^2 + 256 (R - 1)^4) for
/// 0.75 < R < 1.25, and not at all elsewhere.
struct Vortex
{
  struct Shape
  {
    double value = 0, slope = 0, curvature = 0; ///< over R
  };
  static Shape shape(double R)
  {
    const double s = R - 1;
    if (std::fabs(s) > 0.25) return {};
    return {1 - 32 * s * s + 256 * std::pow(s, 4), -64 * s + 1024 * std::pow(s, 3), -64 + 3072 * s * s};
  }
  static double turn(double t) { return 0.5 * amplitude * (1 - std::cos(2 * pi * t / period)); }
  static double turn_rate(double t) { return amplitude * pi / period * std::sin(2 * pi * t / period); }
  static double turn_acceleration(double t)
  {
    return 2 * amplitude * std::pow(pi / period, 2) * std::cos(2 * pi * t / period);
  }
  static double angle(double R, double t) { return shape(R).value * turn(t); }
  /// Shear gamma = R d alpha / dR of the circles over each other.
  static double shear(double R, double t) { return R * shape(R).slope * turn(t); }

  struct Stress
  {
    double rr, rt; ///< and sigma_tt = -sigma_rr
  };
  /// What the Jaumann rate makes of simple shear.
  static Stress stress(double R, double t)
  {
    const double G = material().shear_modulus(), gamma = shear(R, t);
    return {-G * (1 - std::cos(gamma)), G * std::sin(gamma)};
  }
  /// Radial and tangential body acceleration.
  static std::array<double, 2> body_acceleration(double R, double t)
  {
    const Shape f = shape(R);
    const double G = material().shear_modulus(), rho = material().density, gamma = shear(R, t);
    const double gamma_slope = (f.slope + R * f.curvature) * turn(t);
    const Stress s = stress(R, t);
    const double rate = f.value * turn_rate(t);
    return {-R * rate * rate - (-G * std::sin(gamma) * gamma_slope + 2 * s.rr / R) / rho,
            R * f.value * turn_acceleration(t) - (G * std::cos(gamma) * gamma_slope + 2 * s.rt / R) / rho};
  }
};

/// A material point: its radius, and the angle at which it stands at time t.
struct Polar
{
  double R, angle;
  Polar(const Particles& p, int k, double t)
      : R(std::hypot(p.reference_x[k], p.reference_y[k])),
        angle(std::atan2(p.reference_y[k], p.reference_x[k]) + Vortex::angle(R, t))
  {
  }
  double x() const { return R * std::cos(angle); }
  double y() const { return R * std::sin(angle); }
};

/// sigma in x and y: xx, yy, xy.
std::array<double, 3> cartesian(const Vortex::Stress& s, double angle)
{
  const double c = std::cos(2 * angle), q = std::sin(2 * angle);
  return {s.rr * c - s.rt * q, -s.rr * c + s.rt * q, s.rr * q + s.rt * c};
}

/// At rest at t = 0; positions and stresses half a step ahead. The block sticks to its frame, or it would
/// turn as a whole by what the particles' sum of the body force's moment errs.
Domain start(double h, double dt)
{
  const domains::Rectangle body{-half_width, -half_width, 2 * half_width, 2 * half_width};
  Domain domain = domains::make_domain({{material(), body, h / 3}}, h);
  Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    const Polar at(p, k, 0.5 * dt);
    p.x[k] = at.x();
    p.y[k] = at.y();
    const auto [xx, yy, xy] = cartesian(Vortex::stress(at.R, 0.5 * dt), at.angle);
    p.stress_xx[k] = xx;
    p.stress_yy[k] = yy;
    p.stress_xy[k] = xy;
  }
  domain.boundaries.push_back(std::make_unique<BodyForce>(
      [](const Particles& q, int k, double t) -> std::array<double, 2>
      {
        const Polar at(q, k, t);
        const auto [r, a] = Vortex::body_acceleration(at.R, t);
        const double c = std::cos(at.angle), s = std::sin(at.angle);
        return {r * c - a * s, r * s + a * c};
      }));
  const int last = static_cast<int>(std::lround(half_width / h));
  for (const Direction normal : {Direction::x, Direction::y})
    for (const int line : {-last, last})
      domain.boundaries.push_back(
          std::make_unique<MirroredWall>(Wall{normal, line, line < 0 ? 1 : -1, false}));
  sort_particles(domain);
  return domain;
}

bool in_ring(double R)
{
  return std::fabs(R - 1) < 0.25;
}

/// Root mean square of the ring's distances from where it should be, over that of the greatest turn's way.
double position_error(const Domain& domain, double t)
{
  const Particles& p = domain.particles;
  double error = 0, square = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    const Polar at(p, k, t);
    if (!in_ring(at.R)) continue;
    error += std::pow(p.x[k] - at.x(), 2) + std::pow(p.y[k] - at.y(), 2);
    square += std::pow(at.R * Vortex::angle(at.R, 0.5 * period), 2);
  }
  return std::sqrt(error / square);
}

double stress_error(const Domain& domain, double t)
{
  const Particles& p = domain.particles;
  double error = 0, square = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    const Polar at(p, k, t);
    if (!in_ring(at.R)) continue;
    const auto [xx, yy, xy] = cartesian(Vortex::stress(at.R, t), at.angle);
    error += std::pow(p.stress_xx[k] - xx, 2) + std::pow(p.stress_yy[k] - yy, 2) +
             2 * std::pow(p.stress_xy[k] - xy, 2);
    square += xx * xx + yy * yy + 2 * xy * xy;
  }
  return std::sqrt(error / square);
}

/// Along the particles that began nearest to the x axis: angle turned, and shear stress, over the radius.
std::vector<Curve> profiles(const Domain& domain, double h, double t)
{
  const Particles& p = domain.particles;
  std::vector<Curve> curves{{"angle turned at half time", "R (m)", "angle (rad)", {}, {}, {}},
                            {"shear stress at half time", "R (m)", "sigma_rt (Pa)", {}, {}, {}}};
  for (const int k : domain.particles.index_of)
  {
    const Polar at(p, k, t);
    if (p.reference_x[k] < 0 || p.reference_y[k] < 0 || p.reference_y[k] > 0.5 * h || at.R < 0.6 ||
        at.R > 1.4)
      continue;
    const double began = std::atan2(p.reference_y[k], p.reference_x[k]);
    const double now = std::atan2(p.y[k], p.x[k]), c = std::cos(2 * now), s = std::sin(2 * now);
    for (Curve& curve : curves) curve.x.push_back(at.R);
    curves[0].model.push_back(now - began);
    curves[0].reference.push_back(at.angle - began);
    curves[1].model.push_back(p.stress_xy[k] * c + 0.5 * (p.stress_yy[k] - p.stress_xx[k]) * s);
    curves[1].reference.push_back(Vortex::stress(at.R, t).rt);
  }
  return curves;
}

/// The tabulated solution and the one above must be the same.
void compare(const std::filesystem::path& folder)
{
  const auto table = read_table(folder / "reference.csv");
  const double t = table.at("time").at(0);
  for (std::size_t k = 0; k < table.at("R").size(); ++k)
  {
    const double R = table.at("R")[k];
    const auto [radial, tangential] = Vortex::body_acceleration(R, t);
    const double wrong = std::max({std::fabs(Vortex::angle(R, t) - table.at("angle")[k]),
                                   std::fabs(Vortex::stress(R, t).rr - table.at("stress_rr")[k]) / 1e4,
                                   std::fabs(Vortex::stress(R, t).rt - table.at("stress_rt")[k]) / 1e4,
                                   std::fabs(radial - table.at("acceleration_r")[k]),
                                   std::fabs(tangential - table.at("acceleration_t")[k])});
    // The table's body force is a numerical derivative of the stress.
    if (wrong > 1e-5) throw std::runtime_error("vortex: reference.csv is not the solution that is run");
  }
}

/// Turns the ring and back; the measures' names end with `suffix`.
Findings turn(double h, bool consistent, const std::string& suffix)
{
  const int half = static_cast<int>(std::ceil(0.5 * period * material().pressure_speed() / (0.5 * h)));
  const double dt = 0.5 * period / half;
  Domain domain = start(h, dt);
  domain.settings.consistent_inertia = consistent;
  domains::run(domain, half, dt);
  const double late = 0.5 * period + 0.5 * dt;
  Findings found;
  found.curves = profiles(domain, h, late);
  found.errors["position" + suffix] = position_error(domain, late);
  found.errors["stress" + suffix] = stress_error(domain, late);
  domains::run(domain, half, dt);
  found.errors["position after turning back" + suffix] = position_error(domain, period + 0.5 * dt);
  return found;
}
} // namespace

Findings run_vortex(const std::filesystem::path& folder, double h)
{
  compare(folder);
  Findings found = turn(h, false, "");
  found.errors.merge(turn(h, true, ", consistent").errors);
  return found;
}
} // namespace mpm::verification

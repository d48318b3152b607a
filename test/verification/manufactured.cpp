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
constexpr double amplitude = 0.05; // m
constexpr double end = 0.0125;     // s

Elastic material()
{
  return domains::elastic(1e7, 0.3, 1000);
}

/// u_x = A sin(pi X) sin(c pi t), u_y = A sin(pi Y) sin(c pi t + pi), c = sqrt(E / rho), on the unit square.
struct Solution
{
  double frequency = pi * std::sqrt(material().young / material().density); // 1/s

  double phase(int axis, double t) const { return frequency * t + axis * pi; }
  double displacement(int axis, double X, double t) const
  {
    return amplitude * std::sin(pi * X) * std::sin(phase(axis, t));
  }
  double velocity(int axis, double X, double t) const
  {
    return amplitude * frequency * std::sin(pi * X) * std::cos(phase(axis, t));
  }
  double stretch(int axis, double X, double t) const
  {
    return 1 + amplitude * pi * std::cos(pi * X) * std::sin(phase(axis, t));
  }
  /// d v / d X, which is the velocity gradient times the stretch.
  double velocity_slope(int axis, double X, double t) const
  {
    return amplitude * frequency * pi * std::cos(pi * X) * std::cos(phase(axis, t));
  }
  /// sigma = lambda ln J + 2 mu ln F along an axis, no shear.
  double stress(int axis, double X, double Y, double t) const
  {
    const double along = std::log(stretch(axis, axis == 0 ? X : Y, t));
    return material().lame() * log_volume(X, Y, t) + 2 * material().shear_modulus() * along;
  }
  double log_volume(double X, double Y, double t) const
  {
    return std::log(stretch(0, X, t) * stretch(1, Y, t));
  }
  /// rho_0 b_x = rho_0 a_x - d(F_yy sigma_xx) / dX
  std::array<double, 2> body_acceleration(double X, double Y, double t) const
  {
    const double position[] = {X, Y};
    std::array<double, 2> b;
    for (int axis = 0; axis < 2; ++axis)
    {
      const double across = stretch(1 - axis, position[1 - axis], t);
      const double curvature = -pi * pi * displacement(axis, position[axis], t);
      const double divergence =
          across * material().p_modulus() * curvature / stretch(axis, position[axis], t);
      b[axis] =
          -frequency * frequency * displacement(axis, position[axis], t) - divergence / material().density;
    }
    return b;
  }
};

/// The square between slipping walls at t = 0, positions and stresses half a step ahead of the velocities.
Domain start(const Solution& exact, double h, double dt)
{
  Domain domain = domains::make_domain({{material(), {0, 0, 1, 1}, h / 3}}, h);
  Particles& p = domain.particles;
  const double t = 0.5 * dt;
  for (int k = 0; k < p.size(); ++k)
  {
    const double X = p.reference_x[k], Y = p.reference_y[k];
    p.x[k] = X + exact.displacement(0, X, t);
    p.y[k] = Y + exact.displacement(1, Y, t);
    p.velocity_x[k] = exact.velocity(0, X, 0);
    p.velocity_y[k] = exact.velocity(1, Y, 0);
    p.affine_xx[k] = exact.velocity_slope(0, X, 0);
    p.affine_yy[k] = exact.velocity_slope(1, Y, 0);
    p.stress_xx[k] = exact.stress(0, X, Y, t);
    p.stress_yy[k] = exact.stress(1, X, Y, t);
    p.stress_zz[k] = material().lame() * exact.log_volume(X, Y, t);
    p.volume[k] *= std::exp(exact.log_volume(X, Y, t));
  }
  const int last = static_cast<int>(std::lround(1 / h));
  for (const Direction normal : {Direction::x, Direction::y})
    for (const int line : {0, last})
      domain.boundaries.push_back(
          std::make_unique<MirroredWall>(Wall{normal, line, line == 0 ? 1 : -1, true}));
  domain.boundaries.push_back(std::make_unique<BodyForce>(
      [exact](const Particles& q, int k, double time)
      { return exact.body_acceleration(q.reference_x[k], q.reference_y[k], time); }));
  sort_particles(domain);
  return domain;
}

/// The tabulated solution and the one above must be the same.
void compare(const Solution& exact, const std::filesystem::path& folder)
{
  const auto table = read_table(folder / "reference.csv");
  for (std::size_t k = 0; k < table.at("X").size(); ++k)
  {
    const double X = table.at("X")[k], v = exact.velocity(0, X, end), s = exact.stress(0, X, 0.25, end);
    if (std::fabs(v - table.at("velocity_x")[k]) > 1e-9 * amplitude * exact.frequency ||
        std::fabs(s - table.at("stress_xx")[k]) > 1e-9 * material().young)
      throw std::runtime_error("manufactured: reference.csv is not the solution that is run");
  }
}

/// Runs the square; the measures' names end with `suffix`.
Findings move(const Solution& exact, double h, bool consistent, const std::string& suffix)
{
  const int steps = static_cast<int>(std::ceil(end * material().pressure_speed() / (0.5 * h)));
  const double dt = end / steps;
  Domain domain = start(exact, h, dt);
  domain.settings.consistent_inertia = consistent;
  domains::run(domain, steps, dt);
  const Particles& p = domain.particles;
  Curve speed{"velocity along the row nearest to Y = 0.25", "X (m)", "v_x (m/s)", {}, {}, {}};
  Curve stress{"stress along the row nearest to Y = 0.25", "X (m)", "sigma_xx (Pa)", {}, {}, {}};
  double v_error = 0, v_square = 0, s_error = 0, s_square = 0;
  const double row = (std::floor(0.25 / (h / 3)) + 0.5) * h / 3;
  for (const int k : domain.particles.index_of) // by id: row by row, from the left
  {
    const double X = p.reference_x[k], Y = p.reference_y[k], late = end + 0.5 * dt;
    const double vx = exact.velocity(0, X, end), vy = exact.velocity(1, Y, end);
    const double sx = exact.stress(0, X, Y, late), sy = exact.stress(1, X, Y, late);
    v_error += std::pow(p.velocity_x[k] - vx, 2) + std::pow(p.velocity_y[k] - vy, 2);
    v_square += vx * vx + vy * vy;
    s_error +=
        std::pow(p.stress_xx[k] - sx, 2) + std::pow(p.stress_yy[k] - sy, 2) + 2 * std::pow(p.stress_xy[k], 2);
    s_square += sx * sx + sy * sy;
    if (std::fabs(Y - row) > 1e-6 * h) continue;
    for (Curve* curve : {&speed, &stress}) curve->x.push_back(X);
    speed.model.push_back(p.velocity_x[k]);
    speed.reference.push_back(vx);
    stress.model.push_back(p.stress_xx[k]);
    stress.reference.push_back(sx);
  }
  return {{{"velocity" + suffix, std::sqrt(v_error / v_square)},
           {"stress" + suffix, std::sqrt(s_error / s_square)}},
          {speed, stress}};
}
} // namespace

Findings run_manufactured(const std::filesystem::path& folder, double h)
{
  const Solution exact;
  compare(exact, folder);
  Findings found = move(exact, h, false, "");
  found.errors.merge(move(exact, h, true, ", consistent").errors);
  return found;
}
} // namespace mpm::verification

#include "test/verification/infinite_slope.hpp"

#include "boundaries/mirrored_wall.hpp"
#include "test/domains.hpp"

#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double g = 9.81, angle = 14 * std::numbers::pi / 180;
constexpr double period = 1, triggered = 0.1;

/// Acceleration of the rock along the slope, positive downwards: one period of a sine, uphill first, so that
/// the block is left behind downhill.
double shaking(const InfiniteSlope& slope, double t)
{
  return t < period ? -slope.pulse * std::sin(2 * std::numbers::pi * t / period) : 0;
}

constexpr double length = 60, low = 10;   // m, of a block of finite length and its thickness
constexpr double behind = 10, ahead = 20; // m, of the zone beyond it

/// Gravity presses and pulls, every stress in equilibrium and equal in all directions but for the shear.
void stress_by_weight(Domain& domain, double top)
{
  Particles& p = domain.particles;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
    for (int k = domain.material_begin[m]; k < domain.material_begin[m + 1]; ++k)
    {
      const double weight = domain.materials[m].elastic().density * g * (top - p.y[k]);
      p.stress_xx[k] = p.stress_yy[k] = p.stress_zz[k] = -weight * std::cos(angle);
      p.stress_xy[k] = weight * std::sin(angle);
    }
}
} // namespace

Slide slide(const InfiniteSlope& slope)
{
  const double h = slope.spacing, rock = h * slope.rock_cells, zone = rock + h * slope.zone_cells,
               top = zone + slope.block;
  Elastic stiff = slope.law;
  Domain domain = domains::make_domain({{stiff, {0, 0, h, rock}, h / 2},
                                        {slope.law, {0, rock, h, h * slope.zone_cells}, h / 2},
                                        {stiff, {0, zone, h, slope.block}, h / 2}},
                                       h);
  domain.grid.wrapped = true;
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, false}));
  sort_particles(domain);
  stress_by_weight(domain, top);
  domain.settings.gravity_y = -g * std::cos(angle);
  domain.settings.flip = slope.flip;
  domain.settings.filter = slope.filter;
  domain.settings.average_flow = slope.flip;

  const double dt = slope.courant * h / stiff.pressure_speed();
  const auto steps = static_cast<int>(std::ceil(slope.duration / dt));
  const int highest = static_cast<int>(
      std::max_element(domain.particles.y.begin(), domain.particles.y.end()) - domain.particles.y.begin());
  const auto id = domain.particles.id[highest];
  Slide result;
  for (int k = 0; k < steps; ++k)
  {
    domain.time = k * dt;
    // In the frame of the rock, which stands still here.
    domain.settings.gravity_x = g * std::sin(angle) - shaking(slope, domain.time + 0.5 * dt);
    step(domain, dt);
    const int top_particle = domain.particles.index_of[id];
    result.slip = domain.particles.x[top_particle] - domain.particles.reference_x[top_particle];
    if (result.trigger == 0 && result.slip > triggered) result.trigger = domain.time + dt;
  }
  return result;
}

Slide slide_finite(const InfiniteSlope& slope)
{
  const double h = slope.spacing, sole = h * slope.rock_cells, zone = sole + h * slope.zone_cells;
  const double across = behind + length + ahead;
  Elastic stiff = slope.law;
  Domain domain = domains::make_domain({{stiff, {0, 0, across, sole}, h / 2},
                                        {slope.law, {0, sole, across, zone - sole}, h / 2},
                                        {stiff, {behind, zone, length, low}, h / 2}},
                                       h);
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, false}));
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, 0, 1, true}));
  const int last = static_cast<int>(std::lround(across / h));
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, last, -1, true}));
  sort_particles(domain);
  // Gravity grows while the ground is elastic and damped.
  const double dt = slope.courant * h / stiff.pressure_speed(), ramp = 0.5, settled = 1;
  domain.settings.plastic = false;
  domain.settings.local_damping = 0.7;
  for (int k = 0; k * dt < settled; ++k)
  {
    const double part = std::min(1.0, k * dt / ramp);
    domain.settings.gravity_x = part * g * std::sin(angle);
    domain.settings.gravity_y = -part * g * std::cos(angle);
    step(domain, dt);
  }
  domain.settings.plastic = true;
  domain.settings.local_damping = 0;
  domain.settings.flip = slope.flip;
  domain.settings.filter = slope.filter;
  domain.settings.average_flow = slope.flip;
  domain.particles.reference_x = domain.particles.x;
  Slide result;
  for (int k = 0; k * dt < slope.duration; ++k)
  {
    domain.time = k * dt;
    domain.settings.gravity_x = g * std::sin(angle) - shaking(slope, domain.time + 0.5 * dt);
    step(domain, dt);
    const Particles& p = domain.particles;
    double sum = 0;
    for (int q = domain.material_begin[2]; q < domain.material_begin[3]; ++q)
      sum += p.x[q] - p.reference_x[q];
    result.slip = sum / (domain.material_begin[3] - domain.material_begin[2]);
    if (result.trigger == 0 && result.slip > triggered) result.trigger = domain.time + dt;
  }
  return result;
}

Slide rigid_block(const InfiniteSlope& slope)
{
  const double dt = 1e-4;
  const auto acceleration = [&](double t, double slip)
  {
    const double strain = slip / (std::sqrt(3.0) * slope.law.thickness);
    return g * std::sin(angle) - slope.law.mobilised(slope.law.friction(strain)) * g * std::cos(angle) -
           shaking(slope, t);
  };
  Slide result;
  double d = 0, v = 0;
  for (int k = 0; k * dt < slope.duration; ++k)
  {
    const double t = k * dt;
    if (v <= 0 && acceleration(t, d) <= 0)
    {
      v = 0;
      continue;
    }
    const double v1 = v, a1 = acceleration(t, d);
    const double v2 = v + 0.5 * dt * a1, a2 = acceleration(t + 0.5 * dt, d + 0.5 * dt * v1);
    const double v3 = v + 0.5 * dt * a2, a3 = acceleration(t + 0.5 * dt, d + 0.5 * dt * v2);
    const double v4 = v + dt * a3, a4 = acceleration(t + dt, d + dt * v3);
    d += dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (result.trigger == 0 && d > triggered) result.trigger = t + dt;
  }
  result.slip = d;
  return result;
}
Slide elastic_block(const InfiniteSlope& slope)
{
  // Displacements at the ends of pieces, the last of which is the surface, shear stresses between them.
  constexpr int pieces_a_zone = 8;
  const double thickness = slope.law.thickness, rock = slope.spacing * slope.rock_cells,
               piece = thickness / pieces_a_zone;
  const int below = static_cast<int>(std::lround(rock / piece)),
            count = below + pieces_a_zone + static_cast<int>(std::lround(slope.block / piece));
  const double density = slope.law.density, modulus = slope.law.shear_modulus(),
               dt = 0.5 * piece / slope.law.shear_speed();
  const auto depth = [&](int k) { return (count - k - 0.5) * piece; };
  std::vector<double> stress(count + 1, 0.0), velocity(count + 1, 0.0);
  for (int k = 0; k < count; ++k) stress[k] = density * g * std::sin(angle) * depth(k);
  double flow = 0; // the zone's plastic shear strain, its mean
  double way = 0;
  Slide result;
  for (int n = 0; n * dt < slope.duration; ++n)
  {
    const double drive = g * std::sin(angle) - shaking(slope, (n + 0.5) * dt);
    for (int k = 1; k <= count; ++k)
      velocity[k] += dt * (drive + (stress[k] - stress[k - 1]) / (density * piece * (k == count ? 0.5 : 1)));
    const double friction = slope.law.mobilised(slope.law.friction(flow / std::sqrt(3.0)));
    for (int k = 0; k < count; ++k)
    {
      stress[k] += dt * modulus * (velocity[k + 1] - velocity[k]) / piece;
      const double most = friction * density * g * std::cos(angle) * depth(k),
                   beyond = std::fabs(stress[k]) - most;
      if (k < below || k >= below + pieces_a_zone || beyond <= 0) continue;
      stress[k] -= std::copysign(beyond, stress[k]);
      flow += beyond / modulus / pieces_a_zone;
    }
    way += dt * velocity[count];
    if (result.trigger == 0 && way > triggered) result.trigger = (n + 1) * dt;
  }
  result.slip = way;
  return result;
}
} // namespace mpm::verification

#include "test/verification/cases.hpp"

#include "test/domains.hpp"

namespace mpm::verification
{
namespace
{
constexpr double vx = 0.3, vy = -0.7;                          // m/s at the origin
constexpr double xx = 0.11, xy = -0.23, yx = 0.31, yy = -0.17; // velocity gradient, 1/s
constexpr double dt = 1e-9; // s: strain increments and dt C are the same to 1e-9

void set_affine_field(Particles& p)
{
  for (int k = 0; k < p.size(); ++k)
  {
    p.velocity_x[k] = vx + xx * p.x[k] + xy * p.y[k];
    p.velocity_y[k] = vy + yx * p.x[k] + yy * p.y[k];
    p.affine_xx[k] = xx;
    p.affine_xy[k] = xy;
    p.affine_yx[k] = yx;
    p.affine_yy[k] = yy;
  }
}

double greatest(std::initializer_list<double> values)
{
  double result = 0;
  for (const double v : values) result = std::max(result, std::fabs(v));
  return result;
}
} // namespace

Findings run_transfer(const std::filesystem::path&, double h)
{
  const domains::Threads one(1);
  const Elastic law = domains::elastic();
  Domain domain = domains::make_domain({{law, {-6 * h, -5 * h, 12 * h, 11 * h}, 0.5 * h}}, h, 0.5, 21);
  Particles& p = domain.particles;
  set_affine_field(p);
  const Particles before = p;
  particles_to_grid(domain, dt);
  solve_grid(domain, dt);
  grid_to_particles(domain, dt);
  const double growth = (1 + dt * xx) * (1 + dt * yy) - dt * dt * xy * yx;
  const double G = law.shear_modulus(), lame = law.lame() * dt * (xx + yy);
  double velocity = 0, affine = 0, move = 0, volume = 0, stress = 0, speed = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    speed = std::max(speed, greatest({before.velocity_x[k], before.velocity_y[k]}));
    velocity = std::max(
        velocity, greatest({p.velocity_x[k] - before.velocity_x[k], p.velocity_y[k] - before.velocity_y[k]}));
    affine = std::max(affine, greatest({p.affine_xx[k] - xx, p.affine_xy[k] - xy, p.affine_yx[k] - yx,
                                        p.affine_yy[k] - yy}));
    move = std::max(move, greatest({p.x[k] - before.x[k] - dt * before.velocity_x[k],
                                    p.y[k] - before.y[k] - dt * before.velocity_y[k]}));
    volume = std::max(volume, std::fabs(p.volume[k] / before.volume[k] / growth - 1));
    stress = std::max(
        stress, greatest({p.stress_xx[k] - lame - 2 * G * dt * xx, p.stress_yy[k] - lame - 2 * G * dt * yy,
                          p.stress_zz[k] - lame, p.stress_xy[k] - G * dt * (xy + yx)}) /
                    (G * dt));
  }
  return {{{"velocity", velocity / speed},
           {"affine velocity", affine * h / speed},
           {"position", move / h},
           {"volume", volume},
           {"stress", stress}},
          {}};
}
} // namespace mpm::verification

#include "solver/mpm/step.hpp"

namespace mpm
{
namespace
{
struct StrainIncrements
{
  alignas(64) std::array<double, chunk_size> xx, yy, xy;
};

/// Hughes-Winget rotation of the stress with the step's spin, in closed form (METHODS section 1).
void rotate_stress(Particles& p, int begin, int count, const VelocityGradients& L, double dt)
{
  double* __restrict xx = &p.stress_xx[begin];
  double* __restrict yy = &p.stress_yy[begin];
  double* __restrict xy = &p.stress_xy[begin];
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    const double a = 0.25 * dt * (L.yx[k] - L.xy[k]);
    const double scale = 1 / (1 + a * a), c = (1 - a * a) * scale, s = 2 * a * scale;
    const double sxx = xx[k], syy = yy[k], sxy = xy[k];
    xx[k] = c * c * sxx - 2 * c * s * sxy + s * s * syy;
    yy[k] = s * s * sxx + 2 * c * s * sxy + c * c * syy;
    xy[k] = c * s * (sxx - syy) + (c * c - s * s) * sxy;
  }
}

void deform(Particles& p, int begin, int count, const VelocityGradients& L, double dt, StrainIncrements& e)
{
  double* __restrict volume = &p.volume[begin];
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    volume[k] *= (1 + dt * L.xx[k]) * (1 + dt * L.yy[k]) - dt * dt * L.xy[k] * L.yx[k];
    e.xx[k] = dt * L.xx[k];
    e.yy[k] = dt * L.yy[k];
    e.xy[k] = 0.5 * dt * (L.xy[k] + L.yx[k]);
  }
}
} // namespace

void update_particles(Domain& domain, int material, int begin, int count, const VelocityGradients& gradients,
                      double dt)
{
  Particles& p = domain.particles;
  StrainIncrements e;
  deform(p, begin, count, gradients, dt, e);
  rotate_stress(p, begin, count, gradients, dt);
  const StressBatch stress{
      count,       &p.stress_xx[begin], &p.stress_yy[begin], &p.stress_zz[begin], &p.stress_xy[begin],
      e.xx.data(), e.yy.data(),         e.xy.data()};
  Material& m = domain.materials[material];
  std::array<double*, 8> state{};
  for (std::size_t k = 0; k < m.state.size(); ++k)
    state[k] = &m.state[k][begin - domain.material_begin[material]];
  std::visit([&](const auto& law) { law.update(stress, state.data(), domain.plastic); }, m.law);
}
} // namespace mpm

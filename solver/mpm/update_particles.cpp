#include "solver/mpm/step.hpp"

namespace mpm
{
namespace
{
/// Strain increments and rotation (cosine and sine) of a step, of a chunk of particles.
struct Increments
{
  alignas(64) std::array<double, chunk_size> xx, yy, xy, cosine, sine;
};

/// Changes the volume, and finds strain and rotation from the gradient at the middle of the step,
/// A (1 + A / 2)^-1 with A = dt L: a rigid rotation of any size strains nothing (Hughes & Winget 1980). The
/// rotation is exactly orthogonal: cos = (1 - a^2) / (1 + a^2), sin = 2 a / (1 + a^2), a half of its spin.
void deform(Particles& p, int begin, int count, const VelocityGradients& L, double dt, Increments& e)
{
  double* __restrict volume = &p.volume[begin];
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    const double xx = dt * L.xx[k], xy = dt * L.xy[k], yx = dt * L.yx[k], yy = dt * L.yy[k];
    const double det = xx * yy - xy * yx;
    // det(1 + A / 2), and a times it; one division serves strain and rotation.
    const double middle = 1 + 0.5 * (xx + yy) + 0.25 * det, spin = 0.25 * (yx - xy);
    const double square = middle * middle + spin * spin, inverse = 1 / (middle * square);
    const double strain = inverse * square, turn = inverse * middle;
    volume[k] *= 1 + xx + yy + det;
    e.xx[k] = strain * (xx + 0.5 * det);
    e.yy[k] = strain * (yy + 0.5 * det);
    e.xy[k] = strain * 0.5 * (xy + yx);
    e.cosine[k] = turn * (middle * middle - spin * spin);
    e.sine[k] = turn * 2 * middle * spin;
  }
}

/// Rotates the stress with the spin of the step (METHODS section 1).
void rotate_stress(Particles& p, int begin, int count, const Increments& e)
{
  double* __restrict xx = &p.stress_xx[begin];
  double* __restrict yy = &p.stress_yy[begin];
  double* __restrict xy = &p.stress_xy[begin];
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    const double c = e.cosine[k], s = e.sine[k];
    const double sxx = xx[k], syy = yy[k], sxy = xy[k];
    xx[k] = c * c * sxx - 2 * c * s * sxy + s * s * syy;
    yy[k] = s * s * sxx + 2 * c * s * sxy + c * c * syy;
    xy[k] = c * s * (sxx - syy) + (c * c - s * s) * sxy;
  }
}
} // namespace

void update_particles(Domain& domain, int material, int begin, int count, const VelocityGradients& gradients,
                      double dt)
{
  Particles& p = domain.particles;
  Increments e;
  deform(p, begin, count, gradients, dt, e);
  rotate_stress(p, begin, count, e);
  const StressBatch stress{
      count,           &p.stress_xx[begin], &p.stress_yy[begin], &p.stress_zz[begin], &p.stress_xy[begin],
      e.xx.data(),     e.yy.data(),         e.xy.data(),         &p.mass[begin],      &p.volume[begin],
      e.cosine.data(), e.sine.data()};
  Material& m = domain.materials[material];
  std::array<double*, most_state_fields> state{};
  for (std::size_t k = 0; k < m.state.size(); ++k)
    state[k] = &m.state[k][begin - domain.material_begin[material]];
  std::visit([&](const auto& law) { law.update(stress, state.data(), domain.settings.plastic); }, m.law);
}
} // namespace mpm

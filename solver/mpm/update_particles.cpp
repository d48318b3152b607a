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

/// With A = dt L and m = det(1 + A / 2): changes the volume, V *= det(1 + A), and finds strain and rotation
/// from the gradient at the middle of the step, A (1 + A / 2)^-1 (Hughes & Winget, Int. J. Numer. Methods
/// Eng. 15 (1980) 1862). Its symmetric part is the strain increment,
///
///   e_xx = (A_xx + det A / 2) / m,   e_yy = (A_yy + det A / 2) / m,   e_xy = (A_xy + A_yx) / (2 m),
///
/// and half its skew part, a = (A_yx - A_xy) / (4 m), gives the rotation cos = (1 - a^2) / (1 + a^2),
/// sin = 2 a / (1 + a^2). A rigid rotation of any size strains nothing, and the rotation is exactly
/// orthogonal.
void deform(Particles& p, int begin, int count, const VelocityGradients& L, double dt, Increments& e)
{
  double* __restrict volume = &p.volume[begin];
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    const double xx = dt * L.xx[k], xy = dt * L.xy[k], yx = dt * L.yx[k], yy = dt * L.yy[k];
    const double det = xx * yy - xy * yx;
    // m, and a m; one division serves strain and rotation.
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

/// sigma = R sigma R^T with the rotation of the step; zz stays. The Jaumann rate taken over the step
/// explicitly would lengthen the stress by the square of the spin each time.
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

#include "test/verification/dashpot_reflection.hpp"

#include <Eigen/Dense>

#include <complex>

namespace mpm::verification
{
namespace
{
using Complex = std::complex<double>;
using Vector = Eigen::Vector2cd;

/// A plane wave by its slowness (s/m) and the direction of its particle velocity, exp(i omega (slowness . x -
/// t)).
struct PlaneWave
{
  Vector slowness, velocity;
};

/// `up` is 1 for waves that leave the base, -1 for those that come to it.
PlaneWave plane_wave(WaveKind kind, double horizontal_slowness, double up, const Elastic& law)
{
  const double c = speed_of(kind, law), sine = horizontal_slowness * c;
  const Complex cosine =
      up * std::sqrt(Complex(1 - sine * sine)); // beyond the critical angle: decays upwards
  const Vector n(sine, cosine);
  return {n / c, kind == WaveKind::P ? n : Vector(cosine, -sine)};
}

/// What the dashpots miss: (sigma_xy - rho c_s v_x, sigma_yy - rho c_p v_y), zero for the whole field.
Vector mismatch(const PlaneWave& wave, const Elastic& law)
{
  const auto &s = wave.slowness, &v = wave.velocity;
  // grad u = -(v slowness^T), since v = -i omega u.
  const Complex divergence = -(s.x() * v.x() + s.y() * v.y()), shear = -(s.x() * v.y() + s.y() * v.x());
  const Complex yy = law.lame() * divergence - 2 * law.shear_modulus() * s.y() * v.y();
  return {law.shear_modulus() * shear - law.density * law.shear_speed() * v.x(),
          yy - law.density * law.pressure_speed() * v.y()};
}

/// Energy flux through the base over rho |velocity|^2 / 2; nothing for a wave that decays.
double flux(WaveKind kind, const PlaneWave& wave, const Elastic& law)
{
  const double c = speed_of(kind, law);
  return c * c * std::fabs(wave.slowness.y().real());
}
} // namespace

double reflected_energy(WaveKind kind, double sine, const Elastic& law)
{
  const double along = std::fabs(sine) / speed_of(kind, law);
  const PlaneWave in = plane_wave(kind, along, -1, law);
  const PlaneWave p = plane_wave(WaveKind::P, along, 1, law), s = plane_wave(WaveKind::S, along, 1, law);
  Eigen::Matrix2cd system;
  system << mismatch(p, law), mismatch(s, law);
  const Vector amplitude = system.partialPivLu().solve(-mismatch(in, law));
  return (std::norm(amplitude[0]) * flux(WaveKind::P, p, law) +
          std::norm(amplitude[1]) * flux(WaveKind::S, s, law)) /
         flux(kind, in, law);
}
} // namespace mpm::verification

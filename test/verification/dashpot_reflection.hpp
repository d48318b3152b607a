#pragma once
// Plane waves that meet a base of viscous dashpots at an angle: closed form.

#include "materials/elastic.hpp"

namespace mpm::verification
{
enum class WaveKind
{
  P,
  S,
};

inline double speed_of(WaveKind kind, const Elastic& law)
{
  return kind == WaveKind::P ? law.pressure_speed() : law.shear_speed();
}

/// Share of the energy of a plane wave that a base of dashpots rho c_p (normal) and rho c_s (tangential)
/// sends back, as P and S wave together; `sine` of the angle of incidence from the normal (Lysmer &
/// Kuhlemeyer 1969).
double reflected_energy(WaveKind kind, double sine, const Elastic& law);
} // namespace mpm::verification

#include "test/domains.hpp"
#include "test/materials/point.hpp"
#include "test/verification/cases.hpp"

#include <numbers>

namespace mpm::verification
{
namespace
{
using domains::mohr_coulomb;
using point::hold_yy;
using point::Point;
using point::update;

constexpr double pressure = 100e3;             // Pa, of the confinement
constexpr double angle = std::numbers::pi / 6; // 30 degrees
constexpr double cohesion = 20e3;              // Pa

template <class L>
L ground(L law)
{
  law.density = 2000;
  law.young = 50e6;
  law.poisson = 0.3;
  if (!law.resolve(1).empty()) throw std::runtime_error("verification: a law of the case 'laws' is refused");
  return law;
}

double error_of(double found, double wanted)
{
  return std::fabs(found / wanted - 1);
}

/// Lateral extension while z, the axis, is held: sigma_z = N sigma_r - 2 c sqrt(N).
double triaxial(double step)
{
  const MohrCoulomb law = mohr_coulomb(30, cohesion);
  Point p;
  p.stress = {-200e3, -200e3, -600e3, 0};
  for (int k = 0; k * step < 5e-3; ++k) p = update(law, p, {0.1 * step, 0.1 * step, 0});
  const auto s = p.principal();
  return error_of(s[2], 3 * s[0] - 2 * cohesion * std::sqrt(3.0));
}

/// Compression across a held lateral stress: tau_max = sigma_m sin phi + c cos phi.
double biaxial(double step)
{
  const MohrCoulomb law = mohr_coulomb(30, cohesion);
  Point p;
  p.stress = {-pressure, -pressure, -pressure, 0};
  for (int k = 0; k * step < 0.02; ++k) p = hold_yy(law, p, -step, 0, -pressure);
  const auto s = p.principal();
  return error_of(0.5 * (s[0] - s[2]), -0.5 * (s[0] + s[2]) * std::sin(angle) + cohesion * std::cos(angle));
}

/// Shear stress in simple shear under a held pressure across the band.
template <class L>
double simple_shear(const L& law, double step)
{
  Point p;
  p.stress = {-0.5 * pressure, -pressure, -0.5 * pressure, 0};
  for (int k = 0; k * step < 0.1; ++k) p = hold_yy(law, p, 0, step, -pressure);
  return p.stress[3];
}

double weakened(SlipWeakening::Match match, double step)
{
  SlipWeakening law;
  law.friction_peak = 0.56;
  law.friction_residual = 0.07;
  law.critical_slip = 0.02;
  law.thickness = 1;
  law.match = match;
  law = ground(law);
  // The slip at the end is 0.2 m less the elastic part, ten times the critical one: nothing is left to
  // weaken.
  return error_of(simple_shear(law, step), pressure * law.mobilised(0.07));
}
} // namespace

Findings run_laws(const std::filesystem::path&, double step)
{
  Findings found;
  auto& e = found.errors;
  e["triaxial"] = triaxial(step);
  e["biaxial"] = biaxial(step);
  e["simple shear"] = error_of(simple_shear(mohr_coulomb(30, 0), step), pressure * std::sin(angle));
  // Davis (1968): sin phi cos psi / (1 - sin phi sin psi)
  const double psi = 0.5 * angle;
  e["simple shear, dilating"] =
      error_of(simple_shear(mohr_coulomb(30, 0, 15), step),
               pressure * std::sin(angle) * std::cos(psi) / (1 - std::sin(angle) * std::sin(psi)));
  VonMises clay;
  clay.peak = 70e3;
  e["clay"] = error_of(simple_shear(ground(clay), step), 70e3 / std::sqrt(3.0));
  e["slip weakening"] = weakened(SlipWeakening::mc, step);
  e["slip weakening, plane"] = weakened(SlipWeakening::plane, step);
  return found;
}
} // namespace mpm::verification

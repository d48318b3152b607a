#include "materials/slip_weakening.hpp"

#include <cstdio>

namespace mpm
{
namespace
{
// Cells of a zone's thickness. The particles beside the zone reach two cells into it from either side; with
// less than four some node always belongs to both sides where the zone is not parallel to the grid, and the
// sides, which do not weaken, hold each other there: of a slip of 506 m a zone of three cells let 351 to 486
// m happen, of four 486 to 502 m (test/verification/infinite_slope).
constexpr double cells_wanted = 4;
} // namespace

std::string SlipWeakening::resolve(double /*spacing*/)
{
  if (std::isnan(friction_residual) && !std::isnan(critical_slip))
    return "critical_slip: has no residual friction to fall to; give friction.residual, or leave "
           "critical_slip "
           "away";
  if (std::isnan(friction_residual)) friction_residual = friction_peak;
  if (friction_residual > friction_peak)
    return "friction.residual: is above friction.peak; give at most the peak";
  if (weakens() && std::isnan(critical_slip))
    return "critical_slip: is missing; give the slip over which the friction falls to its residual";
  idle_ = !weakens() && !std::isnan(critical_slip);
  if (match == plane && friction_peak >= 1)
    return "match: 'plane' takes the friction as sin(phi), which must be below 1; use mc or less friction";
  return {};
}

std::string SlipWeakening::note() const
{
  std::array<char, 160> text;
  std::snprintf(
      text.data(), text.size(),
      "match %s: in simple shear the friction of %.3g mobilises tau / sigma_n = %.3f, the residual %.3g %.4f",
      std::string(match_names[match]).c_str(), friction_peak, mobilised(friction_peak), friction_residual,
      mobilised(friction_residual));
  return text.data();
}

std::vector<std::string> SlipWeakening::warnings(double spacing) const
{
  std::vector<std::string> texts;
  if (idle_)
    texts.emplace_back("critical_slip: has no effect, since the residual friction is that of the peak");
  if (thickness >= cells_wanted * spacing) return texts;
  std::array<char, 200> text;
  std::snprintf(
      text.data(), text.size(),
      "thickness: %.3g m is %.2g cells; across a zone of less than 4 cells its sides reach and hold each "
      "other: use a finer grid or a thicker zone",
      thickness, thickness / spacing);
  texts.emplace_back(text.data());
  return texts;
}

/// The friction falls fastest at first; with the match mc what it mobilises may do so later, when it is
/// small, by d(mu / sqrt(1 + mu^2)) / d mu <= 1.
double SlipWeakening::snap_back_pressure() const
{
  if (!weakens()) return std::numeric_limits<double>::infinity();
  double steepest = 0;
  constexpr int samples = 100;
  for (int k = 0; k <= samples; ++k)
  {
    const double drop = (friction_peak - friction_residual) * k / samples, mu = friction_residual + drop;
    steepest = std::max(steepest, decay() * drop * (match == plane ? 1 : std::pow(1 + mu * mu, -1.5)));
  }
  return std::sqrt(3.0) * shear_modulus() / steepest;
}

/// Solves f(x) = tau - sqrt(3) G x - p sin(phi)(strain + x) = 0 by Newton's method, from the residual
/// strength's solution downwards. f is concave there (for friction below 0.7), so that the steps come from
/// one side, also where the strength falls faster than the stress and a start from 0 would go astray.
double SlipWeakening::plastic_step(double tau, double pressure, double strain) const
{
  const double stiffness = std::sqrt(3.0) * shear_modulus();
  const double greatest = (tau - pressure * mobilised(friction_residual)) / stiffness;
  if (!weakens() || pressure <= 0) return greatest;
  double low = 0, high = greatest, x = greatest;
  for (int k = 0; k < 60; ++k)
  {
    const double mu = friction(strain + x);
    const double value = tau - stiffness * x - pressure * mobilised(mu);
    (value > 0 ? low : high) = x;
    const double root = match == plane ? 1 : std::sqrt(1 + mu * mu);
    const double mobilised_slope = 1 / (root * root * root);
    const double slope = -stiffness + pressure * mobilised_slope * decay() * (mu - friction_residual);
    double next = x - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::fabs(next - x);
    x = next;
    if (change <= 1e-15 * greatest) break;
  }
  return x;
}

/// At constant pressure the deviator shrinks from the trial's tau = sqrt(J2) to p sin(phi), by sqrt(3) G per
/// plastic strain; the work of the step is sqrt(3) p sin(phi) per plastic strain.
void SlipWeakening::return_to_surface(const StressBatch& s, double* __restrict strain,
                                      double* __restrict opening, double* __restrict dissipation) const
{
  const double G = shear_modulus(), K = bulk_modulus();
  const double peak = mobilised(friction_peak), residual = mobilised(friction_residual);
  // Points that have slipped are looked at closely from the residual strength on: their own costs an
  // exponential.
  const auto excess = [&](int k)
  {
    const Deviator trial(s, k);
    const double over = std::sqrt(trial.j2()) + (strain[k] > 0 ? residual : peak) * trial.mean;
    return opening[k] > 0 ? 1.0 : over;
  };
  const auto settle = [&](int k)
  {
    const Deviator trial(s, k);
    const double closed = close_opening(trial.mean, K, opening[k]);
    const double mean = std::min(closed, 0.0); // no tension
    opening[k] += (closed - mean) / K;
    const double tau = std::sqrt(trial.j2());
    double step = 0, scale = 1;
    if (tau > -mean * mobilised(friction(strain[k])))
    {
      step = plastic_step(tau, -mean, strain[k]);
      scale = mean < 0 ? 1 - std::sqrt(3.0) * G * step / tau : 0;
      strain[k] += step;
      dissipation[k] += std::sqrt(3.0) * scale * tau * step * volume_ratio(s, k, density);
    }
    if (step == 0 && mean == trial.mean) return;
    s.xx[k] = mean + trial.xx * scale;
    s.yy[k] = mean + trial.yy * scale;
    s.zz[k] = mean + trial.zz * scale;
    s.xy[k] *= scale;
  };
  for_each_beyond(s.count, excess, settle);
}
} // namespace mpm

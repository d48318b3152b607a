#include "materials/mohr_coulomb.hpp"

#include "materials/root.hpp"

#include <cstdio>

namespace mpm
{
std::string MohrCoulomb::resolve(double spacing)
{
  const bool residual = !std::isnan(friction_residual) || !std::isnan(cohesion_residual);
  if (const std::string unused = refuse_unused(residual, "friction_angle.residual or cohesion.residual");
      !unused.empty())
    return unused;
  if (std::isnan(friction_residual)) friction_residual = friction_peak;
  if (std::isnan(cohesion_residual)) cohesion_residual = cohesion_peak;
  if (friction_residual > friction_peak)
    return "friction_angle.residual: is above friction_angle.peak; give at most the peak";
  if (cohesion_residual > cohesion_peak)
    return "cohesion.residual: is above cohesion.peak; give at most the peak";
  if (dilation > friction_peak)
    return "dilation_angle: is above friction_angle.peak, which would create energy; give at most the peak";
  if (!softens())
  {
    resolve_no_softening();
    return {};
  }
  // What snaps back under the weight of a single cell does so everywhere.
  const double weight = density * usual_gravity * spacing;
  const double lost = std::max(cohesion_peak - cohesion_residual, fall().at(weight));
  return resolve_softening(spacing, lost / (std::sqrt(3.0) * shear_modulus()));
}

/// Angle and cohesion fall linearly, so that the strength falls fastest at the end.
MohrCoulomb::Fall MohrCoulomb::fall() const
{
  const double angle = friction_peak - friction_residual, cosine = std::cos(friction_residual);
  return {(cohesion_peak - cohesion_residual) * cosine -
              cohesion_residual * std::sin(friction_residual) * angle,
          angle * cosine};
}

/// On the main plane and at constant volume the stress unloads by sqrt(3) G per plastic strain, with dilation
/// faster.
double MohrCoulomb::snap_back_pressure() const
{
  const Fall lost = fall();
  if (!softens() || lost.frictional <= 0) return unlimited;
  return (std::sqrt(3.0) * shear_modulus() * softening_strain - lost.cohesive) / lost.frictional;
}

std::vector<std::string> MohrCoulomb::warnings(double /*spacing*/) const
{
  std::vector<std::string> texts;
  const auto warn = [&](const char* format, double a, double b)
  {
    std::array<char, 160> text;
    std::snprintf(text.data(), text.size(), format, a, b);
    texts.emplace_back(text.data());
  };
  if (!idle_warning().empty()) texts.push_back(idle_warning());
  const double apex = surface(0).apex;
  if (tension_cutoff < unlimited && tension_cutoff > apex)
    warn("tension_cutoff: %.4g kPa is above c cot(phi) = %.4g kPa, which is all that the ground holds",
         1e-3 * tension_cutoff, 1e-3 * apex);
  if (dilation > friction_residual)
    warn("dilation_angle: %.3g deg is above friction_angle.residual = %.3g deg; softened ground dilates at "
         "its "
         "friction angle",
         dilation * 180 / std::numbers::pi, friction_residual * 180 / std::numbers::pi);
  return texts;
}

std::string MohrCoulomb::note() const
{
  const auto line = [](double friction, double cohesion)
  {
    std::array<char, 80> text;
    std::snprintf(text.data(), text.size(), "%.3f sigma_n + %.4g kPa", std::sin(friction),
                  1e-3 * cohesion * std::cos(friction));
    return std::string(text.data());
  };
  std::string text =
      "at constant volume it slides in simple shear at tau = " + line(friction_peak, cohesion_peak);
  if (softens())
    text += ", from a plastic strain of " + std::to_string(softening_strain) + " on at " +
            line(friction_residual, cohesion_residual);
  return text;
}

MohrCoulombSurface MohrCoulomb::surface(double softened) const
{
  const double t = softens() ? std::min(softened, 1.0) : 0;
  const double friction = friction_peak + t * (friction_residual - friction_peak);
  const double cohesion = cohesion_peak + t * (cohesion_residual - cohesion_peak);
  const double sine = std::sin(friction), cosine = std::cos(friction);
  const double flow = dilation > 0 ? std::min(std::sin(dilation), sine) : 0;
  const double apex = sine > 0 ? cohesion * cosine / sine : unlimited;
  // A friction angle that falls would raise the apex; what holds in tension is cohesion, which does not grow.
  const bool raised = friction < friction_peak;
  const double tension = raised ? std::min(apex, cohesion / std::tan(friction_peak)) : apex;
  return {shear_modulus(),
          bulk_modulus(),
          sine,
          2 * cohesion * cosine,
          flow,
          apex,
          std::min(tension, tension_cutoff)};
}

namespace
{
/// Where a point that opens at its apex only returns to, and by how much its mean stress falls there.
/// `before`: mean of the trial stress.
double return_whole(std::array<double, 3>& s, double before, double dilation, const MohrCoulombSurface& at)
{
  const auto mean = [&] { return (s[0] + s[1] + s[2]) / 3; };
  double torn = 0;
  if (at.excess(s[0], s[2]) > 0)
  {
    bool beyond = dilation == 0 && before >= at.apex;
    if (!beyond)
    {
      s = at.return_to_planes(s);
      beyond = s[0] < s[1] || s[1] < s[2] || mean() >= at.apex;
    }
    if (beyond)
    {
      const double apex = at.apex < MohrCoulombSurface::unlimited
                              ? at.apex
                              : before; // without friction or cohesion: round-off
      s = {apex, apex, apex};
      torn = std::max(0.0, before - apex);
    }
  }
  if (s[0] <= at.apex) return torn;
  const double uncut = mean(); // round-off
  for (double& value : s) value = std::min(value, at.apex);
  return mean() >= 0 ? torn + (uncut - mean()) : torn;
}

/// Equivalent plastic strain sqrt(2/3 e : e) of the deviator e of principal strains.
double equivalent(const std::array<double, 3>& strain)
{
  const double mean = (strain[0] + strain[1] + strain[2]) / 3;
  double square = 0;
  for (const double e : strain) square += (e - mean) * (e - mean);
  return std::sqrt(2.0 / 3 * square);
}

void store(const StressBatch& s, int k, const Principal& p)
{
  const auto [xx, yy, zz, xy] = turn_back(p);
  s.xx[k] = xx;
  s.yy[k] = yy;
  s.zz[k] = zz;
  s.xy[k] = xy;
}
} // namespace

/// A point that opens at its apex only.
void MohrCoulomb::settle_whole(const StressBatch& s, int k, const PointState& at,
                               const Surface& surface) const
{
  const double G = shear_modulus(), K = bulk_modulus();
  Principal p = principal_stresses(s.xx[k], s.yy[k], s.zz[k], s.xy[k]);
  const double elastic = p.mean(), closed = close_opening(elastic, K, at.opening);
  if (closed != elastic)
    for (double& value : p.value) value += closed - elastic;
  else if (surface.excess(p.value[0], p.value[2]) <= 0 && p.value[0] <= surface.apex)
    return;

  const Triple trial = p.value;
  const double torn = return_whole(p.value, closed, dilation, surface);
  const double fall = closed - p.mean();
  double square = 0, work = 0;
  for (int i = 0; i < 3; ++i)
  {
    const double deviator = (trial[i] - p.value[i] - fall) / (2 * G);
    square += deviator * deviator;
    work += p.value[i] * (deviator + fall / (3 * K));
  }
  at.strain += std::sqrt(2.0 / 3 * square);
  at.opening += torn / K;
  at.dissipation += work * volume_ratio(s, k, density);
  store(s, k, p);
}

/// The return whose strength is that after the plastic strain of the step, which becomes `strain`. `cracks`:
/// their strains before the step in the principal directions. Plastic strain is what shears, and what opens
/// cracks; not what closes them.
MohrCoulombSurface::Returned MohrCoulomb::soften(const Triple& trial, const Triple& cracks,
                                                 const PointState& at, double& strain) const
{
  const auto flow = [&](const Surface::Returned& to, const Surface& surface)
  {
    const Triple& less = to.opening() > at.opening ? cracks : to.crack;
    Triple lost =
        surface.elastic_strain({trial[0] - to.stress[0], trial[1] - to.stress[1], trial[2] - to.stress[2]});
    for (int i = 0; i < 3; ++i) lost[i] -= less[i];
    return equivalent(lost);
  };
  Surface::Returned end;
  double tried = 0;
  const auto flow_after = [&](double step)
  {
    tried = step;
    const Surface surface = surface_after(at.strain + step);
    end = surface.return_with_cracks(trial, at.opening);
    return flow(end, surface);
  };
  const double first = strain = flow_after(0), rest = softening_strain - at.strain;
  if (!softens() || rest <= 0 || first == 0) return end;
  // The weaker the ground, the more it flows: the residual strength bounds the strain, and the line between
  // both is a guess. The strength is that of the strain found, so that an error of 1e-8 of it is in no
  // stress.
  const double most = flow_after(rest);
  strain = most;
  if (most >= rest) return end;
  if (most <= first) // a cut-off that does not soften
  {
    flow_after(strain = first);
    return end;
  }
  const double guess = first + (most - first) * most / rest - most;
  const double rounding = 4e-16 * (std::fabs(trial[0]) + std::fabs(trial[2])) / shear_modulus();
  strain = find_root({0, first}, {most, guess}, std::max(rounding, 1e-8 * first),
                     [&](double step) { return flow_after(step) - step; });
  if (tried != strain) flow_after(strain);
  return end;
}

/// A point whose cracks have directions. The trial is the stress as if they were closed, so that what closes
/// them is found with what opens them.
void MohrCoulomb::settle_cracked(const StressBatch& s, int k, const PointState& at) const
{
  const double G = shear_modulus(), opening = at.opening;
  Triple crack{};
  if (opening > 0)
  {
    const double c = s.cosine[k], r = s.sine[k], xx = at.opening_xx, yy = at.opening_yy, xy = at.opening_xy;
    crack = {c * c * xx - 2 * c * r * xy + r * r * yy, r * r * xx + 2 * c * r * xy + c * c * yy,
             c * r * (xx - yy) + (c * c - r * r) * xy};
  }
  const auto [cxx, cyy, cxy] = crack;
  const double volumetric = lame() * opening, czz = opening - cxx - cyy;
  Principal p = principal_stresses(s.xx[k] + volumetric + 2 * G * cxx, s.yy[k] + volumetric + 2 * G * cyy,
                                   s.zz[k] + volumetric + 2 * G * czz, s.xy[k] + 2 * G * cxy);
  if (opening <= 0)
  {
    const Surface now = surface_after(at.strain);
    if (now.excess(p.value[0], p.value[2]) <= 0 && p.value[0] <= now.cutoff) return;
  }
  const Triple before = components_along(p, cxx, cyy, czz, cxy);
  double step = 0;
  const Surface::Returned to = soften(p.value, before, at, step);

  const Triple lost = surface(0).elastic_strain(
      {p.value[0] - to.stress[0], p.value[1] - to.stress[1], p.value[2] - to.stress[2]});
  double work = 0;
  for (int i = 0; i < 3; ++i) work += to.stress[i] * (lost[i] - before[i]);
  at.strain += step;
  at.opening = to.opening();
  at.dissipation += work * volume_ratio(s, k, density);
  p.value = to.crack;
  const auto turned = turn_back(p);
  at.opening_xx = turned[0];
  at.opening_yy = turned[1];
  at.opening_xy = turned[3];
  p.value = to.stress;
  store(s, k, p);
}

void MohrCoulomb::return_to_surface(const StressBatch& s, double* const* state) const
{
  const Surface peak = surface(0), residual = surface(1);
  const double end = softens() ? softening_strain : unlimited;
  const bool cracks = softens() || peak.cutoff < peak.apex;
  const double* __restrict strain = state[0];
  const double* __restrict opening = state[1];
  // Points between peak and residual are always looked at closely: their strength costs a sine.
  const auto excess = [&](int k)
  {
    const double centre = 0.5 * (s.xx[k] + s.yy[k]), half = 0.5 * (s.xx[k] - s.yy[k]);
    const double radius = std::sqrt(half * half + s.xy[k] * s.xy[k]);
    const double high = std::max(centre + radius, s.zz[k]), low = std::min(centre - radius, s.zz[k]);
    const bool soft = strain[k] >= end;
    const double sine = soft ? residual.sine : peak.sine, cohesive = soft ? residual.cohesive : peak.cohesive;
    const double cutoff = soft ? residual.cutoff : peak.cutoff;
    const double over = std::max(high - low + (high + low) * sine - cohesive, high - cutoff);
    const bool between = (strain[k] > 0) & (strain[k] < end) & (end < unlimited);
    return between | (opening[k] > 0) ? 1.0 : over;
  };
  const auto settle = [&](int k)
  {
    const PointState at{state[0][k], state[1][k], state[2][k], state[3][k], state[4][k], state[5][k]};
    if (cracks)
      settle_cracked(s, k, at);
    else
      settle_whole(s, k, at, peak);
  };
  for_each_beyond(s.count, excess, settle);
}
} // namespace mpm

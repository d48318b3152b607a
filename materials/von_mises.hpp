#pragma once

#include "materials/elastic.hpp"
#include "materials/plastic.hpp"
#include "materials/softening.hpp"

namespace mpm
{
/// Elasticity with a von Mises yield surface q = sqrt(3 J2) that softens linearly with the plastic strain
/// eps,
///
///   q_y = max(q_p - (q_p - q_r) eps / eps_r, q_r),   eps_r = delta_r / (sqrt(3) l)   (paper Table 1, eq. 8),
///
/// delta_r being the shear displacement at which the residual strength is reached and l the width of the
/// band. Strengths are Mises stresses in Pa, work conjugate to eps: the undrained shear strength is q /
/// sqrt(3).
struct VonMises : Elastic, LinearSoftening
{
  static constexpr std::string_view model = "von_mises";
  double peak = NAN;
  double residual = NAN; ///< left out: perfectly plastic

  static constexpr auto parameters()
  {
    using L = VonMises;
    const std::array strength{
        Parameter<L>{"strength.peak",
                     "Mises stress q = sqrt(3 J2) at first yield, sqrt(3) times the undrained shear strength",
                     Dimension::stress, Interval::positive(), &L::peak},
        Parameter<L>{"strength.residual", "Mises stress after softening", Dimension::stress,
                     Interval::not_negative(), &L::residual, "strength.peak: perfectly plastic"},
    };
    return joined(elastic_parameters<L>(), strength, softening_parameters<L>());
  }
  static constexpr std::array<StateField, 1> state_fields()
  {
    return {{{"plastic_strain", "1", "accumulated equivalent plastic strain"}}};
  }

  double averaging_length() const { return band(); } ///< m
  std::string resolve(double spacing)
  {
    if (const std::string unused = refuse_unused(!std::isnan(residual), "strength.residual"); !unused.empty())
      return unused;
    if (std::isnan(residual)) residual = peak;
    if (residual > peak) return "strength.residual: is above strength.peak; give at most the peak";
    if (residual == peak)
    {
      resolve_no_softening();
      return {};
    }
    return resolve_softening(spacing, (peak - residual) / (3 * shear_modulus()));
  }

  std::vector<std::string> warnings(double /*spacing*/) const
  {
    return idle_warning().empty() ? std::vector<std::string>{} : std::vector{idle_warning()};
  }

  /// Elastic trial, and a radial return of the deviator that is exact for linear softening; state[0] is the
  /// plastic strain.
  void update(const StressBatch& s, double* const* state, bool plastic) const
  {
    add_elastic_stress(s, lame(), shear_modulus());
    if (plastic) return_to_yield_surface(s, state[0]);
  }

  /// Energy in J/m3 that plastic flow has dissipated at point k: the strength integrated over the plastic
  /// strain. The flow keeps the volume, so that deformed and undeformed volume differ by elastic strains
  /// only.
  double dissipated(const double* const* state, int k) const
  {
    const double strain = state[0][k], softened = std::min(strain, softening_strain);
    return (peak + 0.5 * (residual - peak) * softened / softening_strain) * softened +
           residual * (strain - softened);
  }

private:
  /// With the trial's q and the slope H = -(q_p - q_r) / eps_r < 0 of the strength, the plastic strain of the
  /// step solves q - 3 G x = q_y(eps + x): x = (q - q_y) / (3 G + H) while it softens, (q - q_r) / (3 G)
  /// beyond. The deviator shrinks by 1 - 3 G x / q; the mean stress stays.
  void return_to_yield_surface(const StressBatch& s, double* __restrict strain) const
  {
    // All that the loops need is a copy: a member that a store might change keeps them from being vectors.
    const double stiffness = 3 * shear_modulus(), top = peak, bottom = residual;
    const double slope = (bottom - top) / softening_strain;
    const double softening_rate = 1 / (stiffness + slope), residual_rate = 1 / stiffness;
    const auto excess = [=, &s](int k)
    {
      const double allowed = std::max(bottom, top + slope * strain[k]);
      return 3 * Deviator(s, k).j2() - allowed * allowed;
    };
    const auto settle = [=, &s](int begin, int n, const double* __restrict over)
    {
#pragma GCC ivdep
      for (int i = 0; i < n; ++i)
      {
        const int k = begin + i;
        const Deviator trial(s, k);
        const bool yields = over[i] > 0; // an elastic point stays as it is, to the last bit
        const double q = std::max(trial.mises(), std::numeric_limits<double>::min());
        // The two roots x, softening and residual; the smaller one is the strength's.
        const double soft = (q - (top + slope * strain[k])) * softening_rate;
        const double flat = (q - bottom) * residual_rate;
        const double step = yields ? std::max(0.0, std::min(soft, flat)) : 0;
        const double scale = 1 - stiffness * step / q;
        strain[k] += step;
        s.xx[k] = yields ? trial.mean + trial.xx * scale : s.xx[k];
        s.yy[k] = yields ? trial.mean + trial.yy * scale : s.yy[k];
        s.zz[k] = yields ? trial.mean + trial.zz * scale : s.zz[k];
        s.xy[k] = yields ? trial.xy * scale : s.xy[k];
      }
    };
    for_each_piece_beyond(s.count, excess, settle);
  }
};
} // namespace mpm

#pragma once
// What the laws that yield, slide and open share. Their update is an elastic trial of a whole chunk, a test
// of the yield surface that the compiler makes vectors of, and a return of those points that are beyond it.

#include "materials/parameter.hpp"
#include "materials/plane_strain.hpp"

#include <algorithm>
#include <array>

namespace mpm
{
/// What such a law remembers of a point.
inline constexpr std::array<StateField, 3> flow_and_opening{
    {{"plastic_strain", "1", "accumulated equivalent plastic strain"},
     {"opening", "1", "volumetric strain by which the point is torn apart"},
     {"dissipation", "J/m3", "energy dissipated by plastic flow per undeformed volume"}}};

/// Calls f(begin, n, over) for pieces of a batch in which some point has excess(k) > 0; over[k] is what
/// excess(begin + k) was. Finding them vectorises, so that a batch in which nobody yields costs little.
/// Inline, or the loops of f would not be vectors.
template <class Excess, class Function>
[[gnu::always_inline]] inline void for_each_piece_beyond(int count, const Excess& excess, const Function& f)
{
  constexpr int width = 64;
  for (int begin = 0; begin < count; begin += width)
  {
    const int n = std::min(width, count - begin);
    std::array<double, width> over;
    int found = 0;
#pragma GCC ivdep
    for (int k = 0; k < n; ++k)
    {
      over[k] = excess(begin + k);
      found += over[k] > 0 ? 1 : 0;
    }
    if (found > 0) f(begin, n, over.data());
  }
}

/// Calls f(k) for the points of a batch with excess(k) > 0, k from 0.
template <class Excess, class Function>
void for_each_beyond(int count, const Excess& excess, const Function& f)
{
  for_each_piece_beyond(count, excess,
                        [&](int begin, int n, const double* over)
                        {
                          for (int k = 0; k < n; ++k)
                            if (over[k] > 0) f(begin + k);
                        });
}

/// Ground that was torn apart carries no pressure until it has closed again. `opening` is the volumetric
/// strain by which a point has opened at its tensile strength; a compression closes it first, and only what
/// is left becomes pressure. Returns the mean stress (Pa, tension positive) out of the elastic one; `bulk` is
/// the bulk modulus in Pa.
inline double close_opening(double mean, double bulk, double& opening)
{
  if (opening <= 0 || mean >= 0) return mean;
  const double wanted = -mean / bulk;
  if (wanted <= opening)
  {
    opening -= wanted;
    return 0;
  }
  mean += bulk * opening;
  opening = 0;
  return mean;
}

/// Volume of point k over its undeformed one, for a law of this density (kg/m3).
inline double volume_ratio(const StressBatch& s, int k, double density)
{
  return density * s.volume[k] / s.mass[k];
}
} // namespace mpm

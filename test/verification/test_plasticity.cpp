#include "test/scenes.hpp"
#include "test/verification/infinite_slope.hpp"
#include "test/verification/shear_band.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::verification;

namespace
{
SlipWeakening zone(double thickness)
{
  SlipWeakening law;
  law.density = 2450;
  law.young = 1e9;
  law.poisson = 0.3;
  law.friction_peak = 0.4;
  law.friction_residual = 0.1;
  law.critical_slip = 0.5;
  law.thickness = thickness;
  return law;
}
} // namespace

TEST_CASE("A block on a weakening zone slides as Newmark's rigid block", "[.fine][verification]")
{
  for (const double h : {2.0, 1.0, 0.5})
    for (const double share : {1.0, 1.45 / 3})
    {
      InfiniteSlope slope{zone(3 * h * share), h};
      const Slide found = slide(slope), wanted = rigid_block(slope);
      WARN("h " << h << " thickness/zone " << share << ": trigger " << found.trigger << " s ("
                << wanted.trigger << "), slip " << found.slip << " m (" << wanted.slip << ")");
    }
}

TEST_CASE("A softening band dissipates half its strength drop times the residual displacement",
          "[.fine][verification]")
{
  VonMises law = scenes::von_mises(70e3, 39e3, NAN, 40e6, 0.35);
  law.softening_displacement = 0.2;
  for (const double degrees : {0.0, 22.5, 45.0})
    for (const double h : {1.0, 0.5, 0.25})
    {
      const BandEnergy band = shear_band(law, degrees, h, 0.5);
      WARN(degrees << " degrees, h " << h << ": " << band.softening << " of " << band.expected
                   << " J/m2, ratio " << band.softening / band.expected << ", dissipated "
                   << band.dissipated);
    }
}

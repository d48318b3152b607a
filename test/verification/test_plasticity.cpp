#include "test/domains.hpp"
#include "test/verification/infinite_slope.hpp"
#include "test/verification/shear_band.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::verification;

namespace
{
/// Cells of 1 m; the thickness of eq. 8 is the zone's.
InfiniteSlope on_zone_of(int cells)
{
  InfiniteSlope slope{domains::slip_weakening(0.4, 0.1, 0.5, cells)};
  slope.zone_cells = cells;
  slope.flip = true;
  slope.filter = usual_filter;
  return slope;
}

InfiniteSlope with_apic(InfiniteSlope slope)
{
  slope.flip = false;
  slope.filter = {};
  return slope;
}

struct Ratio
{
  double trigger, slip; ///< over an elastic column's
};

Ratio over_elastic_block(const InfiniteSlope& slope)
{
  const Slide found = slide(slope), wanted = elastic_block(slope);
  return {found.trigger / wanted.trigger, found.slip / wanted.slip};
}
} // namespace

TEST_CASE("A block on a weakening zone slides as an elastic column does", "[verification]")
{
  // In a wide zone the flow gathers at the lower edge, where half of what it is averaged over lies outside:
  // 12 cells slide 1.15 times as far.
  for (const auto& [cells, within] : {std::pair{4, 0.05}, {6, 0.1}, {12, 0.2}})
  {
    const Ratio ratio = over_elastic_block(on_zone_of(cells));
    CAPTURE(cells);
    CHECK(ratio.trigger == Approx(1).epsilon(0.03));
    CHECK(ratio.slip == Approx(1).epsilon(within));
  }
}

TEST_CASE("A zone of three cells lets a block slide wherever it lies between the nodes", "[verification]")
{
  for (const double offset : {0.0, 0.25, 0.5, 0.75})
  {
    InfiniteSlope slope = on_zone_of(3);
    slope.rock_cells += offset;
    CAPTURE(offset);
    CHECK(over_elastic_block(slope).slip == Approx(1).margin(0.05));
    CHECK(over_elastic_block(with_apic(slope)).slip < 0.4); // a viscosity of rho h^2 / dt
  }
}

TEST_CASE("How far a block slides does not depend on the time step", "[verification]")
{
  InfiniteSlope slope = on_zone_of(3);
  slope.rock_cells += 0.25;
  const double usual = slide(slope).slip;
  for (const double courant : {0.1, 0.25, 0.7})
  {
    slope.courant = courant;
    CAPTURE(courant);
    CHECK(slide(slope).slip == Approx(usual).epsilon(0.01));
  }
}

TEST_CASE("A thick block on three and four cells keeps a rigid block's pace for half a kilometre",
          "[verification]")
{
  // Half a minute of the Tsaoling slide: 100 m on cells of 8 m, friction 0.4 to 0.07 over 1.7 m.
  for (const int cells : {3, 4})
  {
    InfiniteSlope slope = on_zone_of(cells);
    slope.law.friction_residual = 0.07;
    slope.law.critical_slip = 1.7;
    slope.law.thickness = 8 * cells;
    slope.spacing = 8;
    slope.block = 100;
    slope.pulse = 12;
    slope.duration = 25;
    slope.filter.time = 30;
    CHECK(rigid_block(slope).slip > 500);
    CAPTURE(cells);
    CHECK(over_elastic_block(slope).slip == Approx(1).margin(cells == 3 ? 0.06 : 0.05)); // 0.942 with three
    CHECK(over_elastic_block(with_apic(slope)).slip < 0.3);
  }
}

TEST_CASE("A band of clay that slips for four cells keeps the volume of its particles", "[verification]")
{
  // Plastic flow of clay keeps volumes, and elastic changes are mean stress over K: ten times the strength is
  // 0.016 of K. Where nothing holds what no node feels, volumes drift by 0.027 and 0.036 in inclined bands.
  const double degrees = GENERATE(0.0, 22.5, 45.0);
  VonMises law = domains::von_mises(70e3, 39e3, NAN, 40e6, 0.35);
  law.softening_displacement = 0.2;
  const BandEnergy found = shear_band(law, degrees, BandPosition::on_nodes, 0.5, 2, Softening::averaged);
  CAPTURE(degrees, found.slip, found.dilation);
  CHECK(found.slip > 1);
  CHECK(found.dilation < 0.016);
}

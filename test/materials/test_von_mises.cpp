#include "test/domains.hpp"
#include "test/materials/rate_equations.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace point;
using domains::Random;
using domains::von_mises;

namespace
{
/// The soil of the paper's Table 1: peak 70 kPa, residual 39 kPa, over the plastic strain 0.05.
VonMises soil()
{
  return von_mises(70e3, 39e3, 0.05, 25e6, 0.3);
}
} // namespace

TEST_CASE("Below the peak von Mises is elastic to the last bit", "[materials]")
{
  Random random(61);
  const VonMises law = soil();
  for (int k = 0; k < 1000; ++k)
  {
    const Increment e{random(-8e-4, 8e-4), random(-8e-4, 8e-4), random(-8e-4, 8e-4)};
    const Point trial = update(static_cast<const Elastic&>(law), {}, e);
    const Point s = update(law, {}, e);
    if (mises(trial) > 70e3) continue;
    REQUIRE(s.strain() == 0);
    REQUIRE(distance(s, trial) < 1e-10); // p + (sigma - p): the round-off of 1e5 Pa
    const std::array<double, 4> hooke = elastic_rate(law, e);
    for (int c = 0; c < 4; ++c) REQUIRE(s.stress[c] == Approx(hooke[c]).margin(1e-10));
  }
}

TEST_CASE("With yielding switched off von Mises is elastic", "[materials]")
{
  const Point s = update(soil(), {}, {0.01, -0.02, 0.03}, false);
  CHECK(mises(s) > 1e5);
  CHECK(s.strain() == 0);
  CHECK(distance(s, update(static_cast<const Elastic&>(soil()), {}, {0.01, -0.02, 0.03})) == 0);
}

// From a stress-free state the stress keeps its direction, so that the rate equations and one radial return
// have the same answer whatever the step; left is the round-off of 1000 small steps and of the kinks found by
// bisection.
TEST_CASE("A step from rest to anywhere on the softening line is the integral of the rate equations",
          "[materials]")
{
  Random random(62);
  const VonMises law = soil();
  const RateEquations integrate{law};
  int elastic = 0, softening = 0, residual = 0;
  double worst = 0, strain = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    const double size = std::exp(random(std::log(1e-3), std::log(0.2)));
    const Increment e{random(-size, size), random(-size, size), random(-size, size)};
    const Point s = update(law, {}, e), exact = integrate({}, e, 1000);
    (s.strain() == 0 ? elastic : s.strain() < law.softening_strain ? softening : residual) += 1;
    worst = std::max(worst, distance(s, exact) / 70e3);
    strain = std::max(strain, std::fabs(s.strain() - exact.strain()));
  }
  CHECK(elastic > 5);
  CHECK(softening > 5);
  CHECK(residual > 5);
  CHECK(worst < 1e-9);
  CHECK(strain < 1e-10);
}

TEST_CASE("On a winding strain path the return converges to the rate equations with the step", "[materials]")
{
  const VonMises law = soil();
  const RateEquations integrate{law};
  const auto path = [](double t) {
    return std::array{0.02 * std::sin(3 * t), -0.015 * t * t, 0.02 * (1 - std::cos(4 * t))};
  };
  const auto error = [&](int steps)
  {
    Point s, exact;
    double worst = 0;
    for (int k = 0; k < steps; ++k)
    {
      const auto a = path(k / static_cast<double>(steps)), b = path((k + 1) / static_cast<double>(steps));
      const Increment e{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
      s = update(law, s, e);
      exact = integrate(exact, e, 1000);
      worst = std::max(worst, distance(s, exact) / 70e3);
    }
    CHECK(exact.strain() > law.softening_strain); // the path goes through peak, softening and residual
    return worst;
  };
  const double coarse = error(100), fine = error(400);
  CHECK(coarse < 0.02);
  // First order in the step; both follow the same polygon, so that nothing else is left.
  CHECK(fine < 0.35 * coarse);
}

TEST_CASE("The Mises stress never exceeds the strength, and the pressure is the elastic one", "[materials]")
{
  Random random(63);
  for (const double residual : {39e3, 0.0, 70e3})
  {
    const VonMises law = von_mises(70e3, residual, 0.05, 25e6, 0.3);
    Point s;
    double excess = 0, change = 0;
    for (int k = 0; k < 2000; ++k)
    {
      const Increment e{random(-4e-3, 4e-3), random(-4e-3, 4e-3), random(-4e-3, 4e-3)};
      const Point elastic = update(static_cast<const Elastic&>(law), s, e);
      const double before = s.strain();
      s = update(law, s, e);
      REQUIRE(s.strain() >= before);
      excess = std::max(excess, (mises(s) - strength(law, s.strain())) / 70e3);
      change = std::max(change, std::fabs(s.mean() - elastic.mean()) / 70e3);
    }
    CHECK(s.strain() > law.softening_strain);
    // Round-off of trial stresses up to 1e6 Pa.
    CHECK(excess < 1e-13);
    CHECK(change < 1e-13);
  }
}

TEST_CASE("A step from the peak into the residual stops at the residual strength", "[materials]")
{
  const VonMises law = soil();
  const Point s = update(law, {}, {0, 0, 0.2});
  // q = sqrt(3) tau; trial 2 G 0.2 sqrt(3), and 3 G of it is plastic.
  const double G = law.shear_modulus();
  CHECK(std::fabs(mises(s) / 39e3 - 1) < 1e-12);
  CHECK(std::fabs(s.strain() / ((0.4 * G * std::sqrt(3.0) - 39e3) / (3 * G)) - 1) < 1e-12);
  CHECK(s.strain() > law.softening_strain);
}

TEST_CASE("Work softening releases half the strength drop times the softening strain", "[materials]")
{
  const VonMises law = soil();
  Point s;
  double work = 0, plastic = 0; // plastic work above the residual's
  for (int k = 0; k < 20000; ++k)
  {
    const Point before = s;
    s = update(law, s, {0, 0, 5e-6});
    work += 0.5 * (mises(before) + mises(s) - 2 * 39e3) * (s.strain() - before.strain());
    plastic += s.strain() - before.strain();
  }
  REQUIRE(plastic > law.softening_strain);
  // The trapezoidal rule is exact on the line and misses at the two kinks only, by one step in 9000 each.
  CHECK(work == Approx(0.5 * (70e3 - 39e3) * 0.05).epsilon(1e-3));
}

// Trapezoids under a line are exact but where the line bends: at the residual strain, one step in 9000.
TEST_CASE("The dissipated energy of von Mises is the plastic work done along the way", "[materials]")
{
  const VonMises law = soil();
  Point s;
  double work = 0, worst = 0;
  for (int k = 0; k < 20000; ++k)
  {
    const Point before = s;
    s = update(law, s, {0, 0, 5e-6});
    work += 0.5 * (mises(before) + mises(s)) * (s.strain() - before.strain());
    const double* state[] = {&s.state[0]};
    worst = std::max(worst, std::fabs(law.dissipated(state, 0) - work));
  }
  REQUIRE(s.strain() > law.softening_strain);
  // The first plastic step begins below the yield stress, the last softening one ends below its line.
  CHECK(worst < 2 * 70e3 * 5e-6);
  Material material{"soil", law, {{0.0, s.strain()}}};
  CHECK(material.dissipated(0) == 0);
  CHECK(material.dissipated(1) == Approx(work).epsilon(1e-3));
}

TEST_CASE("Equal peak and residual strength are perfect plasticity to the last bit", "[materials]")
{
  Random random(64);
  VonMises softening = von_mises(70e3, 70e3, 0.05, 25e6, 0.3), perfect = von_mises(70e3, NAN, NAN, 25e6, 0.3);
  VonMises by_length = von_mises(70e3, 70e3, NAN, 25e6, 0.3);
  by_length.softening_displacement = 0.1;
  VonMises as_given = softening;
  for (VonMises* law : {&softening, &perfect, &by_length}) REQUIRE(law->resolve(0.5).empty());
  Point a, b, c, d;
  for (int k = 0; k < 5000; ++k)
  {
    const Increment e{random(-2e-3, 2e-3), random(-2e-3, 2e-3), random(-2e-3, 2e-3)};
    a = update(softening, a, e);
    b = update(perfect, b, e);
    c = update(by_length, c, e);
    d = update(as_given, d, e);
  }
  CHECK(a.strain() > 1);
  for (const Point* other : {&b, &c, &d})
  {
    CHECK(a.stress == other->stress);
    CHECK(a.strain() == other->strain());
  }
}

TEST_CASE("A batch gives each of its points what it gives one alone", "[materials]")
{
  Random random(65);
  const VonMises law = soil();
  constexpr int count = 64;
  std::array<double, count> xx, yy, zz, xy, exx, eyy, exy, strain;
  std::vector<Point> alone;
  for (int k = 0; k < count; ++k)
  {
    Point s{{random(-5e4, 5e4), random(-5e4, 5e4), random(-5e4, 5e4), random(-5e4, 5e4)}, {random(0, 0.06)}};
    const Increment e{random(-2e-3, 2e-3), random(-2e-3, 2e-3), random(-2e-3, 2e-3)};
    xx[k] = s.stress[0];
    yy[k] = s.stress[1];
    zz[k] = s.stress[2];
    xy[k] = s.stress[3];
    strain[k] = s.strain();
    exx[k] = e.xx;
    eyy[k] = e.yy;
    exy[k] = e.xy;
    alone.push_back(update(law, s, e));
  }
  double* state[] = {strain.data()};
  law.update({count, xx.data(), yy.data(), zz.data(), xy.data(), exx.data(), eyy.data(), exy.data()}, state,
             true);
  for (int k = 0; k < count; ++k)
  {
    // A vectorised loop may contract its sums in another way: the last bits of 1e5 Pa.
    CHECK(distance({{xx[k], yy[k], zz[k], xy[k]}}, alone[k]) < 1e-9);
    CHECK(std::fabs(strain[k] - alone[k].strain()) < 1e-15);
  }
}

TEST_CASE("Softening too steep to be followed is refused, and less is not", "[materials]")
{
  const double limit = 31e3 / (3 * soil().shear_modulus());
  VonMises steep = von_mises(70e3, 39e3, 0.999 * limit, 25e6, 0.3);
  CHECK_THAT(steep.resolve(0.5), Catch::StartsWith("softening: is so steep"));
  VonMises gentle = von_mises(70e3, 39e3, 1.001 * limit, 25e6, 0.3);
  CHECK(gentle.resolve(0.5).empty());
  VonMises wide = von_mises(70e3, 39e3, NAN, 25e6, 0.3);
  wide.softening_displacement = 0.1;
  wide.band_width = 0.1 / (std::sqrt(3.0) * limit) * 1.001;
  CHECK_THAT(wide.resolve(0.5), Catch::StartsWith("softening: is so steep"));
}

TEST_CASE("The softening strain follows from the displacement and the band width", "[materials]")
{
  VonMises law = von_mises(70e3, 39e3, NAN, 25e6, 0.3);
  law.softening_displacement = 0.1;
  REQUIRE(law.resolve(0.5).empty());
  CHECK(law.softening_strain == Approx(0.1 / (std::sqrt(3.0) * 3 * 0.5)).epsilon(1e-14)); // eq. (8)
  const double first = law.softening_strain;
  REQUIRE(law.resolve(0.5).empty()); // resolving again changes nothing
  CHECK(law.softening_strain == first);
  VonMises narrow = von_mises(70e3, 39e3, NAN, 25e6, 0.3);
  narrow.softening_displacement = 0.1;
  narrow.band_cells = 1.45;
  REQUIRE(narrow.resolve(0.5).empty());
  CHECK(narrow.softening_strain == Approx(first * 3 / 1.45).epsilon(1e-14));
  narrow.band_width = 1;
  CHECK_THAT(narrow.resolve(0.5), Catch::StartsWith("softening: give either 'band_width'"));
}

TEST_CASE("Strengths that make no sense are refused", "[materials]")
{
  VonMises reversed = von_mises(39e3, 70e3, 0.05);
  CHECK_THAT(reversed.resolve(1), Catch::StartsWith("strength.residual: is above"));
  VonMises neither = von_mises(70e3, 39e3, NAN);
  CHECK_THAT(neither.resolve(1), Catch::StartsWith("softening: give either"));
  VonMises both = von_mises(70e3, 39e3, 0.05);
  both.softening_displacement = 0.1;
  CHECK_THAT(both.resolve(1), Catch::StartsWith("softening: give either"));
}

TEST_CASE("Softening that would not be used is refused, and told of where it has no effect", "[materials]")
{
  const auto clay = []
  {
    VonMises law;
    law.density = 2000, law.young = 25e6, law.poisson = 0.3, law.peak = 70e3;
    return law;
  };
  VonMises alone = clay();
  alone.softening_strain = 0.05;
  CHECK_THAT(alone.resolve(1), Catch::StartsWith("softening: has no residual strength"));
  VonMises band = clay();
  band.band_cells = 2;
  CHECK_THAT(band.resolve(1), Catch::StartsWith("softening: has no residual strength"));
  VonMises beside = clay();
  beside.residual = 39e3, beside.softening_strain = 0.05, beside.band_width = 1;
  CHECK_THAT(beside.resolve(1), Catch::StartsWith("softening.band_width: turns a displacement"));
  VonMises equal = clay();
  equal.residual = 70e3, equal.softening_strain = 0.05;
  REQUIRE(equal.resolve(1).empty());
  REQUIRE(equal.warnings(1).size() == 1);
  CHECK_THAT(equal.warnings(1)[0], Catch::StartsWith("softening: has no effect"));
  VonMises perfect = clay();
  REQUIRE(perfect.resolve(1).empty());
  REQUIRE(perfect.resolve(1).empty());
  CHECK(perfect.warnings(1).empty());
}

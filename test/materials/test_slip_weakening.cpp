#include "test/domains.hpp"
#include "test/materials/point.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace point;
using domains::Random;

namespace
{
/// The shear zone of the paper's Table 2, `thickness` in m.
SlipWeakening zone(SlipWeakening::Match match = SlipWeakening::mc, double thickness = 4)
{
  SlipWeakening law = domains::slip_weakening(0.56, 0.07, 1.7, thickness);
  law.match = match;
  REQUIRE(law.resolve(1).empty());
  return law;
}

Point under_pressure(double pressure = 2e6)
{
  Point p;
  p.stress = {-pressure, -pressure, -pressure, 0};
  return p;
}
} // namespace

TEST_CASE("The friction falls with slip as eqs. 7 and 8 mean it, to 5 % of the drop at the critical slip",
          "[materials]")
{
  const SlipWeakening law = zone();
  CHECK(law.friction(0) == 0.56);
  const double strain = 1.7 / (std::sqrt(3.0) * 4);
  CHECK(law.friction(strain) == Approx(0.07 + 0.05 * 0.49).epsilon(1e-12));
  CHECK(law.friction(100 * strain) == Approx(0.07));
}

TEST_CASE("A band in simple shear mobilises sin(atan mu), or mu with the plane match", "[materials]")
{
  for (const auto match : {SlipWeakening::mc, SlipWeakening::plane})
    for (const double mu : {0.56, 0.07})
    {
      SlipWeakening law = zone(match);
      law.friction_peak = law.friction_residual = mu;
      Point p;
      p.stress = {-1e6, -2e6, -1e6, 0};
      for (int k = 0; k < 5000; ++k) p = hold_yy(law, p, 0, 2e-5, -2e6);
      const double wanted = match == SlipWeakening::mc ? mu / std::sqrt(1 + mu * mu) : mu;
      CHECK(std::fabs(p.stress[3] / 2e6 / wanted - 1) < 1e-6);
      CHECK(law.mobilised(mu) == Approx(wanted).epsilon(1e-14));
    }
}

// The return solves for the strength at the step's end, so that the stress lies on the analytic curve at any
// step.
TEST_CASE("Ramped slip follows the analytic weakening curve", "[materials]")
{
  for (const auto match : {SlipWeakening::mc, SlipWeakening::plane})
  {
    const SlipWeakening law = zone(match);
    Point p = under_pressure();
    double worst = 0, work = 0;
    const double step = 1e-4, G = law.shear_modulus();
    for (int k = 1; k <= 10000; ++k)
    {
      const double before = p.stress[3], strain = p.strain();
      p = update(law, p, {0, 0, 0.5 * step});
      work += 0.5 * (before + p.stress[3]) * step;
      if (p.strain() == strain) continue;
      // Plastic shear is what is left of the shear applied; the slip is that times the thickness.
      const double slip = (k * step - p.stress[3] / G) * 4;
      const double mu = 0.07 + 0.49 * std::exp(std::log(0.05) * slip / 1.7);
      const double tau = 2e6 * (match == SlipWeakening::plane ? mu : std::sin(std::atan(mu)));
      worst = std::max(worst, std::fabs(p.stress[3] - tau));
      REQUIRE(p.strain() * std::sqrt(3.0) * 4 == Approx(slip).epsilon(1e-9));
    }
    CHECK(worst < 1e-9 * 2e6);
    CHECK(p.strain() * std::sqrt(3.0) * 4 > 2 * 1.7);
    // Left over: the stress at the end of each step against its mean, half the drop of 1 MPa times a step,
    // and the elastic energy.
    const double stored = p.stress[3] * p.stress[3] / (2 * G);
    CHECK(std::fabs(p.dissipation() - (work - stored)) < 0.6e6 * step);
  }
}

TEST_CASE("Weakening over a millionth of a metre is stable", "[materials]")
{
  Random random(81);
  for (const double residual : {0.07, 0.0})
  {
    SlipWeakening law = zone();
    law.critical_slip = 1e-6;
    law.friction_residual = residual;
    Point p = under_pressure();
    for (int k = 0; k < 5000; ++k)
    {
      const double before = p.strain();
      p = update(law, p, {random(-1e-4, 1e-4), random(-1e-4, 1e-4), random(-1e-4, 3e-4)});
      REQUIRE(std::isfinite(p.stress[0] + p.stress[3] + p.strain()));
      REQUIRE(p.strain() >= before);
      REQUIRE(p.shear() <= -p.mean() * law.mobilised(law.friction(p.strain())) + 1e-13 * 2e6);
    }
    CHECK(law.friction(p.strain()) == Approx(residual).margin(1e-12));
  }
}

TEST_CASE("Slip weakening never exceeds its strength, and flows at constant pressure", "[materials]")
{
  Random random(82);
  for (const double thickness : {1.0, 4.0, 400.0})
  {
    const SlipWeakening law = zone(SlipWeakening::mc, thickness);
    double over = 0, change = 0;
    for (int k = 0; k < 20000; ++k)
    {
      Point from = under_pressure(random(1e3, 5e6));
      from.state[0] = random(-0.2, 0.4) / thickness;
      from.state[0] = std::max(0.0, from.state[0]);
      const Increment e{random(-2e-3, 2e-3), random(-2e-3, 2e-3), random(-2e-3, 2e-3)};
      const Point p = update(law, from, e), elastic = update(law, from, e, false);
      if (elastic.mean() >= 0)
      {
        REQUIRE(p.shear() == 0);
        REQUIRE(p.opening() == Approx(elastic.mean() / law.bulk_modulus()).margin(1e-18));
        continue;
      }
      const double scale = elastic.shear() - elastic.mean();
      over = std::max(over, (p.shear() + p.mean() * law.mobilised(law.friction(p.strain()))) / scale);
      change = std::max(change, std::fabs(p.mean() - elastic.mean()) / scale);
    }
    // The strain is found to 1e-15 of the step; its strength moves by sqrt(3) G times that, some 1e-15 of the
    // trial.
    CHECK(over < 1e-13);
    CHECK(change < 1e-15);
  }
}

TEST_CASE("Equal peak and residual friction are perfect plasticity to the last bit", "[materials]")
{
  Random random(83);
  SlipWeakening equal = zone(), perfect = zone();
  equal.friction_residual = 0.56;
  perfect.friction_residual = NAN;
  perfect.critical_slip = NAN;
  REQUIRE(perfect.resolve(1).empty());
  Point a = under_pressure(), b = a;
  for (int k = 0; k < 5000; ++k)
  {
    const Increment e{random(-1e-3, 1e-3), random(-1e-3, 1e-3), random(-1e-3, 1e-3)};
    a = update(equal, a, e);
    b = update(perfect, b, e);
  }
  CHECK(a.strain() > 1);
  CHECK(a.stress == b.stress);
  CHECK(a.state == b.state);
}

TEST_CASE("Slip-weakening parameters that do not go together are refused, thin zones warned of",
          "[materials]")
{
  SlipWeakening law = zone();
  law.friction_residual = 0.6;
  CHECK_THAT(law.resolve(1), Catch::StartsWith("friction.residual: is above"));
  law = zone();
  law.critical_slip = NAN;
  CHECK_THAT(law.resolve(1), Catch::StartsWith("critical_slip: is missing"));
  SlipWeakening steady = zone();
  steady.friction_residual = NAN;
  CHECK_THAT(steady.resolve(1), Catch::StartsWith("critical_slip: has no residual friction"));
  steady.friction_residual = steady.friction_peak;
  CHECK(steady.resolve(1).empty());
  REQUIRE(steady.warnings(1).size() == 1);
  CHECK_THAT(steady.warnings(1)[0], Catch::StartsWith("critical_slip: has no effect"));
  law = zone(SlipWeakening::plane);
  law.friction_peak = 1.2;
  CHECK_THAT(law.resolve(1), Catch::StartsWith("match: 'plane'"));
  CHECK(zone().warnings(1).empty());
  REQUIRE(zone().warnings(2).size() == 1);
  CHECK_THAT(zone().warnings(2)[0], Catch::StartsWith("thickness: 4 m is 2 cells"));
  CHECK_THAT(zone().note(), Catch::Contains("tau / sigma_n = 0.489") && Catch::Contains("0.0698"));
  CHECK_THAT(zone(SlipWeakening::plane).note(), Catch::Contains("tau / sigma_n = 0.560"));
}

TEST_CASE("Slip weakening tells the pressure above which its friction snaps back", "[materials]")
{
  for (const auto match : {SlipWeakening::mc, SlipWeakening::plane})
  {
    const SlipWeakening law = zone(match, 400);
    const auto widest = [&](double pressure)
    {
      Point p = under_pressure(pressure);
      double step = 0;
      for (int k = 0; k < 4000; ++k)
      {
        const double before = p.strain();
        p = update(law, p, {0, 0, 1e-6});
        step = std::max(step, p.strain() - before);
      }
      REQUIRE(p.strain() > 0);
      return step;
    };
    const double limit = law.snap_back_pressure(), whole = 1.7 / (std::sqrt(3.0) * 400);
    CHECK(widest(0.8 * limit) < 0.02 * whole);
    CHECK(widest(1.5 * limit) > 0.2 * whole);
  }
}

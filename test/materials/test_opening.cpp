// Ground that is torn apart and meets again.

#include "test/domains.hpp"
#include "test/materials/point.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;
using namespace point;
using domains::mohr_coulomb;
using domains::Random;

namespace
{
/// The point after steps e of compression, once it carries pressure.
template <class L>
Point closed(const L& law, Point p, const Increment& e)
{
  for (int k = 0; k < 100000 && p.mean() == 0; ++k) p = update(law, p, e);
  return p;
}
} // namespace

TEST_CASE("Debris pulled apart carries no pressure before it has closed again", "[materials]")
{
  const MohrCoulomb law = mohr_coulomb(30, 0);
  Point p;
  p.stress = {-10e3, -10e3, -10e3, 0};
  // To twice its volume, sheared and turned on the way.
  for (int k = 0; k < 7000; ++k) p = update(law, p, {4e-5, 6e-5, 3e-5});
  CHECK(p.ratio == Approx(std::exp(0.7)));
  CHECK(p.shear() == 0);
  CHECK(p.mean() == 0);
  p = closed(law, p, {-5e-5, -5e-5, 0});
  // Closed where it was free of stress: by the elastic compression of the first 10 kPa above the start, less
  // a step.
  const double unloaded = std::exp(10e3 / law.bulk_modulus());
  CHECK(p.ratio == Approx(unloaded).margin(1.1e-4));
  CHECK(p.opening() == 0);
  for (int k = 0; k < 10; ++k) p = update(law, p, {-5e-5, -5e-5, 0});
  CHECK(p.mean() < -10e3);
}

TEST_CASE("Cohesive ground opens at its apex and closes at no pressure", "[materials]")
{
  const MohrCoulomb law = mohr_coulomb(30, 10e3);
  Point p;
  for (int k = 0; k < 1000; ++k) p = update(law, p, {1e-5, 1e-5, 0});
  const double apex = 10e3 / std::tan(std::numbers::pi / 6);
  CHECK(p.mean() == Approx(apex));
  const double opening = p.opening();
  CHECK(opening == Approx(0.02 - apex / law.bulk_modulus()));
  p = update(law, p, {-5e-3, -5e-3, 0});
  CHECK(std::fabs(p.mean()) < 1e-9);
  // The elastic expansion goes back first.
  CHECK(p.opening() == Approx(opening - 0.01 + apex / law.bulk_modulus()));
  for (int k = 0; k < 10; ++k) p = update(law, p, {-1e-3, -1e-3, 0});
  CHECK(p.opening() == 0);
  CHECK(p.mean() < -10e3);
}

TEST_CASE("A shear zone pulled apart carries nothing before it has closed again", "[materials]")
{
  SlipWeakening law = domains::slip_weakening(0.56, 0.07, 1.7, 4);
  REQUIRE(law.resolve(1).empty());
  Point p;
  p.stress = {-1e5, -1e5, -1e5, 0};
  for (int k = 0; k < 1000; ++k) p = update(law, p, {2e-4, 3e-4, 1e-4});
  CHECK(p.mean() == 0);
  CHECK(p.shear() == 0);
  p = closed(law, p, {-1e-4, -1e-4, 5e-5});
  CHECK(p.ratio == Approx(std::exp(1e5 / law.bulk_modulus())).margin(2.2e-4));
  CHECK(p.opening() == 0);
}

TEST_CASE("A tension cut-off holds the greatest principal stress", "[materials]")
{
  MohrCoulomb law = mohr_coulomb(30, 10e3);
  law.tension_cutoff = 2e3;
  Point p;
  p.stress = {0, -8e3, 0, 0};
  for (int k = 0; k < 1000; ++k) p = update(law, p, {1e-5, 0, 2e-6});
  CHECK(p.principal()[0] == Approx(2e3).epsilon(1e-12));
  law.tension_cutoff = 1e9; // never above the apex
  p = {};
  for (int k = 0; k < 1000; ++k) p = update(law, p, {1e-5, 1e-5, 0});
  CHECK(p.principal()[0] == Approx(10e3 / std::tan(std::numbers::pi / 6)).epsilon(1e-12));
}

TEST_CASE("A heap of no cohesion on its apex at every step stays finite and free of stress", "[materials]")
{
  Random random(74);
  for (const double friction : {0.0, 30.0, 60.0})
  {
    MohrCoulomb law = mohr_coulomb(friction, 0);
    law.tension_cutoff = 0;
    Point p;
    for (int k = 0; k < 20000; ++k)
    {
      p = update(law, p, {random(-1e-3, 1.2e-3), random(-1e-3, 1.2e-3), random(-1e-3, 1e-3)});
      REQUIRE(std::isfinite(p.stress[0] + p.stress[1] + p.stress[2] + p.stress[3] + p.state[0] + p.state[1]));
      REQUIRE(p.principal()[0] <= 1e-9);
    }
    CHECK(p.opening() > 0);
  }
}

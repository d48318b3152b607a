#include "test/materials/rock.hpp"

using namespace mpm;
using namespace point;
using domains::mohr_coulomb;

TEST_CASE("Mohr-Coulomb parameters that do not go together are refused", "[materials]")
{
  MohrCoulomb law = rock();
  law.friction_residual = 40 * degree;
  CHECK_THAT(law.resolve(1), Catch::StartsWith("friction_angle.residual: is above"));
  law = rock();
  law.cohesion_residual = 1e6;
  CHECK_THAT(law.resolve(1), Catch::StartsWith("cohesion.residual: is above"));
  law = rock();
  law.dilation = 39 * degree;
  CHECK_THAT(law.resolve(1), Catch::StartsWith("dilation_angle: is above"));
  law = rock();
  law.softening_strain = NAN;
  CHECK_THAT(law.resolve(1), Catch::StartsWith("softening: give either"));
  law.softening_displacement = 1.7;
  CHECK(law.resolve(10).empty());
  CHECK(law.softening_strain == Approx(1.7 / (std::sqrt(3.0) * 30)));
  CHECK_THAT(law.note(),
             Catch::Contains("tau = 0.623 sigma_n + 767 kPa") && Catch::Contains("0.324 sigma_n + 0 kPa"));
}

TEST_CASE("Mohr-Coulomb refuses what it would not use, and a strength that snaps back", "[materials]")
{
  const auto problem = [](const auto& change)
  {
    MohrCoulomb law;
    law.density = 2000, law.young = 50e6, law.poisson = 0.3;
    law.friction_peak = 30 * degree, law.cohesion_peak = 10e3;
    change(law);
    return law.resolve(1);
  };
  CHECK(problem([](MohrCoulomb&) {}).empty());
  CHECK_THAT(problem([](MohrCoulomb& l) { l.softening_strain = 0.1; }),
             Catch::StartsWith("softening: has no residual strength"));
  CHECK_THAT(problem([](MohrCoulomb& l) { l.softening_displacement = 0.1; }),
             Catch::StartsWith("softening: has no residual strength"));
  CHECK_THAT(problem([](MohrCoulomb& l) { l.band_width = 1; }),
             Catch::StartsWith("softening: has no residual strength"));
  CHECK_THAT(
      problem([](MohrCoulomb& l) { l.cohesion_residual = 0, l.softening_strain = 0.1, l.band_width = 1; }),
      Catch::StartsWith("softening.band_width: turns a displacement"));
  CHECK_THAT(
      problem([](MohrCoulomb& l) { l.cohesion_residual = 0, l.softening_strain = 0.1, l.band_cells = 1; }),
      Catch::StartsWith("softening.band_cells: turns a displacement"));
  CHECK_THAT(problem([](MohrCoulomb& l) { l.cohesion_residual = 0, l.band_cells = 1; }),
             Catch::StartsWith("softening.band_cells: turns a displacement"));
  CHECK_THAT(problem([](MohrCoulomb& l)
                     { l.cohesion_residual = 0, l.softening_strain = 0.1, l.softening_displacement = 1; }),
             Catch::StartsWith("softening: give either 'displacement' (a length) or 'strain', not both"));
  // The friction of a cell's weight: 19.6 kPa x (30 deg - 5 deg) x cos(5 deg) = 8.5 kPa over sqrt(3) G.
  const auto steep = [&](double strain)
  {
    return problem([&](MohrCoulomb& l)
                   { l.cohesion_peak = 0, l.friction_residual = 5 * degree, l.softening_strain = strain; });
  };
  const double least = 2000 * 9.81 * 25 * degree * std::cos(5 * degree) / (std::sqrt(3.0) * 50e6 / 2.6);
  CHECK_THAT(steep(0.99 * least), Catch::StartsWith("softening: is so steep"));
  CHECK(steep(1.01 * least).empty());
}

TEST_CASE("Mohr-Coulomb tells the pressure above which its strength snaps back", "[materials]")
{
  MohrCoulomb law = mohr_coulomb(30, 0);
  CHECK(std::isinf(law.snap_back_pressure()));
  law.friction_residual = 5 * degree;
  law.softening_strain = 1e-3;
  REQUIRE(law.resolve(0.01).empty());
  const double limit = law.snap_back_pressure();
  // Below it the shear stress passes every strain of the softening; above it jumps.
  const auto widest = [&](double pressure)
  {
    Point p;
    p.stress = {-pressure, -pressure, -pressure, 0};
    double step = 0;
    for (int k = 0; k < 20000; ++k)
    {
      const double before = p.strain();
      p = update(law, p, {0, 0, 5e-7});
      if (before < 1e-3) step = std::max(step, p.strain() - before);
    }
    REQUIRE(p.strain() > 1e-3);
    return step;
  };
  CHECK(widest(0.8 * limit) < 0.05 * 1e-3);
  CHECK(widest(1.3 * limit) > 0.2 * 1e-3);
}

TEST_CASE("Mohr-Coulomb warns of parameters without effect", "[materials]")
{
  MohrCoulomb law = mohr_coulomb(30, 10e3);
  CHECK(law.warnings(1).empty());
  law.tension_cutoff = 17e3;
  CHECK(law.warnings(1).empty());
  law.tension_cutoff = 18e3;
  REQUIRE(law.warnings(1).size() == 1);
  CHECK(law.warnings(1)[0] ==
        "tension_cutoff: 18 kPa is above c cot(phi) = 17.32 kPa, which is all that the ground holds");
  MohrCoulomb equal;
  equal.density = 2000, equal.young = 50e6, equal.poisson = 0.3;
  equal.friction_peak = equal.friction_residual = 30 * degree, equal.cohesion_peak = 10e3;
  equal.softening_strain = 0.1;
  REQUIRE(equal.resolve(1).empty());
  REQUIRE(equal.resolve(1).empty()); // a mixture resolves again
  REQUIRE(equal.warnings(1).size() == 1);
  CHECK_THAT(equal.warnings(1)[0], Catch::StartsWith("softening: has no effect"));
  law = rock();
  law.dilation = 20 * degree;
  REQUIRE(law.warnings(1).size() == 1);
  CHECK_THAT(law.warnings(1)[0],
             Catch::StartsWith("dilation_angle: 20 deg is above friction_angle.residual"));
}

#include "test/domains.hpp"
#include "test/materials/pyramid.hpp"
#include "test/materials/rock.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;
using namespace point;
using domains::mohr_coulomb;
using domains::Random;

namespace
{
/// Excess over the surface of given angle and cohesion, Pa.
double excess(const Point& p, double friction, double cohesion)
{
  const auto s = p.principal();
  return s[0] - s[2] + (s[0] + s[2]) * std::sin(friction) - 2 * cohesion * std::cos(friction);
}

/// A point compressed evenly, then sheared by random steps.
Increment random_increment(Random& random, double size)
{
  return {random(-size, size), random(-size, size), random(-size, size)};
}
} // namespace

TEST_CASE("Mohr-Coulomb returns where geometry in principal space returns", "[materials]")
{
  Random random(71);
  double worst = 0;
  for (const double dilation : {0.0, 10.0, 30.0})
  {
    const MohrCoulomb law = mohr_coulomb(30, 20e3, dilation);
    int compared = 0;
    for (int trial = 0; trial < 60; ++trial)
    {
      Point from;
      const double pressure = random(50e3, 300e3);
      from.stress = {-pressure, -pressure, -pressure * random(0.8, 1.2), 0};
      const Increment e = random_increment(random, 5e-3);
      const Point elastic = update(law, from, e, false), p = update(law, from, e);
      if (p.opening() > 0) continue; // without plastic volume change the planes alone do not meet the apex
      const auto wanted = relax_onto_pyramid(law, elastic.principal(), law.friction_peak, 20e3, law.dilation);
      auto sorted = wanted;
      std::sort(sorted.begin(), sorted.end(), std::greater<>());
      const auto found = p.principal();
      for (int c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(found[c] - sorted[c]));
      ++compared;
    }
    CHECK(compared > 40);
  }
  // The relaxation ends at round-off of the trial stress, 1e6 Pa.
  CHECK(worst < 1e-7);
}

TEST_CASE("Whatever the trial, Mohr-Coulomb ends on or below its surface and the cut-off", "[materials]")
{
  Random random(72);
  for (const double friction : {0.0, 20.0, 38.5, 60.0})
    for (const double dilation : {0.0, 10.0, 60.0})
      for (const double cutoff : {std::numeric_limits<double>::infinity(), 3e3})
      {
        if (dilation > friction) continue;
        MohrCoulomb law = mohr_coulomb(friction, 10e3, dilation);
        law.tension_cutoff = cutoff;
        const double limit = friction > 0 ? std::min(cutoff, 10e3 / std::tan(friction * degree)) : cutoff;
        double over = 0, tension = 0, volume = 0;
        for (int k = 0; k < 4000; ++k)
        {
          Point from;
          from.stress = {random(-1e5, 2e4), random(-1e5, 2e4), random(-1e5, 2e4), random(-5e4, 5e4)};
          const Increment e = random_increment(random, 3e-3);
          const Point elastic = update(law, from, e, false), p = update(law, from, e);
          double scale = 10e3;
          for (int c = 0; c < 4; ++c) scale += std::fabs(elastic.stress[c]) + std::fabs(p.stress[c]);
          over = std::max(over, excess(p, law.friction_peak, 10e3) / scale);
          tension = std::max(tension, (p.principal()[0] - limit) / scale);
          REQUIRE(p.strain() >= 0);
          REQUIRE(p.dissipation() >= 0);
          if (dilation == 0 && p.principal()[0] < limit * 0.999)
            volume = std::max(volume, std::fabs(p.mean() - elastic.mean()) / scale);
        }
        INFO(friction << " " << dilation << " " << cutoff);
        // Roundings of the stresses, some times larger where the dilation is great.
        CHECK(over < 1e-13);
        CHECK(tension < 1e-15);
        CHECK(volume < 1e-15);
      }
}

// The triaxial point is led with exx = eyy, so that z is its axis; the biaxial one at constant sigma_yy.
TEST_CASE("Mohr-Coulomb reaches the limit states of triaxial and biaxial tests", "[materials]")
{
  const MohrCoulomb law = mohr_coulomb(30, 20e3);
  const double sine = 0.5, cohesive = 20e3 * std::cos(30 * degree);

  Point triaxial;
  triaxial.stress = {-200e3, -200e3, -600e3, 0};
  for (int k = 0; k < 500; ++k) triaxial = update(law, triaxial, {1e-6, 1e-6, 0});
  // Extension in x and y while z is held: sigma_z = N sigma_r + 2 c sqrt(N), N = (1 + sin) / (1 - sin) = 3.
  const auto t = triaxial.principal();
  REQUIRE(triaxial.strain() > 1e-4);
  REQUIRE(t[0] < 0);
  CHECK(t[0] == Approx(t[1]).epsilon(1e-12));
  CHECK(std::fabs(t[2] / (3 * t[0] - 2 * 20e3 * std::sqrt(3.0)) - 1) < 1e-6);

  Point biaxial;
  biaxial.stress = {-100e3, -100e3, -100e3, 0};
  for (int k = 0; k < 400; ++k) biaxial = hold_yy(law, biaxial, -5e-5, 0, -100e3);
  REQUIRE(biaxial.strain() > 1e-3);
  const auto b = biaxial.principal();
  const double tau = 0.5 * (b[0] - b[2]), middle = -0.5 * (b[0] + b[2]);
  CHECK(std::fabs(tau / (middle * sine + cohesive) - 1) < 1e-6);
  // tau_max at sigma_3 = 100 kPa: sigma_1 = sigma_3 (1 + sin) / (1 - sin) + 2 c cos / (1 - sin).
  CHECK(std::fabs(-b[2] / (3 * 100e3 + 2 * cohesive / (1 - sine)) - 1) < 1e-6);
}

TEST_CASE(
    "At constant volume Mohr-Coulomb mobilises sin phi in simple shear, and Davis' friction with dilation",
    "[materials]")
{
  for (const double dilation : {0.0, 15.0})
  {
    const MohrCoulomb law = mohr_coulomb(30, 0, dilation);
    Point p;
    p.stress = {-50e3, -100e3, -50e3, 0};
    for (int k = 0; k < 4000; ++k) p = hold_yy(law, p, 0, 2e-5, -100e3);
    // Davis (1968): tau / sigma_n = sin phi cos psi / (1 - sin phi sin psi).
    const double psi = dilation * degree;
    const double wanted = 0.5 * std::cos(psi) / (1 - 0.5 * std::sin(psi));
    CHECK(std::fabs(p.stress[3] / 100e3 / wanted - 1) < 1e-6);
  }
}

TEST_CASE("Mohr-Coulomb softens from peak to residual over its strain", "[materials]")
{
  const MohrCoulomb law = rock();
  Point p;
  p.stress = {-3e6, -3e6, -3e6, 0};
  double peak = 0, strain_at_residual = 0;
  for (int k = 0; k < 40000; ++k)
  {
    const double before = p.strain();
    p = update(law, p, {0, 0, 1e-6}); // the strength is that after the step
    const double share = std::min(p.strain() / law.softening_strain, 1.0);
    const double friction = (38.5 - 19.6 * share) * degree, cohesion = 980e3 * (1 - share);
    if (p.strain() > before) REQUIRE(std::fabs(excess(p, friction, cohesion)) < 1e-13 * 980e3 * 20);
    peak = std::max(peak, p.stress[3]);
    if (share >= 1 && strain_at_residual == 0) strain_at_residual = p.strain();
  }
  CHECK(peak == Approx(3e6 * std::sin(38.5 * degree) + 980e3 * std::cos(38.5 * degree)).epsilon(1e-4));
  CHECK(strain_at_residual == Approx(law.softening_strain).epsilon(1e-3));
  CHECK(p.stress[3] == Approx(3e6 * std::sin(18.9 * degree)).epsilon(1e-9));
}

// In pure shear the direction of flow stays, so that steps of any size end at the same stress, but for 1e-8
// of the strain, over which the strength falls by about as much of itself.
TEST_CASE("The strength of softening ground does not lag behind its steps", "[materials]")
{
  const MohrCoulomb law = rock();
  for (const double strain : {2e-3, 4e-3, 8e-3, 20e-3})
  {
    double fine = 0;
    for (const double step : {1e-5, 1e-3, 2e-3})
    {
      Point p;
      p.stress = {-3e6, -3e6, -3e6, 0};
      for (int k = 0; k < std::lround(strain / step); ++k) p = update(law, p, {0, 0, step});
      if (fine == 0) fine = p.stress[3];
      INFO(strain << " in steps of " << step);
      CHECK(p.stress[3] == Approx(fine).epsilon(3e-8));
    }
  }
}

TEST_CASE("Softening ground ends each step on or below the strength that it has then", "[materials]")
{
  Random random(77);
  for (const double cutoff : {std::numeric_limits<double>::infinity(), 100e3})
    for (const double dilation : {0.0, 15.0})
    {
      MohrCoulomb law = rock();
      law.tension_cutoff = cutoff;
      law.dilation = dilation * degree;
      double over = 0, tension = 0;
      for (int k = 0; k < 20000; ++k)
      {
        Point from;
        from.stress = {random(-5e6, 1e5), random(-5e6, 1e5), random(-5e6, 1e5), random(-2e6, 2e6)};
        from.state[0] = std::max(0.0, random(-0.01, 0.012));
        const Increment e = random_increment(random, 2e-3);
        const Point elastic = update(law, from, e, false), p = update(law, from, e);
        const double share = std::min(p.strain() / law.softening_strain, 1.0);
        double scale = 980e3;
        for (int c = 0; c < 4; ++c) scale += std::fabs(elastic.stress[c]) + std::fabs(p.stress[c]);
        over = std::max(over, excess(p, (38.5 - 19.6 * share) * degree, 980e3 * (1 - share)) / scale);
        const double limit = std::min(cutoff, 980e3 * (1 - share) / std::tan(38.5 * degree));
        tension = std::max(tension, (p.principal()[0] - limit) / scale);
        REQUIRE(p.strain() >= from.strain());
        REQUIRE(p.dissipation() >= 0);
      }
      CHECK(over < 1e-13);
      CHECK(tension < 1e-14);
    }
}

TEST_CASE("What Mohr-Coulomb dissipates is the work done less the elastic energy stored", "[materials]")
{
  const MohrCoulomb law = rock();
  const double G = law.shear_modulus(), K = law.bulk_modulus();
  const auto stored = [&](const Point& p)
  { return p.mean() * p.mean() / (2 * K) + p.shear() * p.shear() / (2 * G); };
  Point p;
  p.stress = {-3e6, -2e6, -3e6, 0};
  const double start = stored(p);
  double work = 0;
  for (int k = 0; k < 40000; ++k)
  {
    const double t = k * 1e-4;
    const Increment e{-2e-7 * std::sin(3 * t), 1e-7 * std::sin(2 * t), 1e-6};
    const Point before = p;
    p = update(law, p, e);
    const auto mean = [&](int c) { return 0.5 * (before.stress[c] + p.stress[c]); };
    work += (mean(0) * e.xx + mean(1) * e.yy + 2 * mean(3) * e.xy) * p.ratio;
  }
  REQUIRE(p.strain() > law.softening_strain);
  // Stress of the step's end against the middle's: half the stress change of a step times its plastic strain.
  CHECK(p.dissipation() == Approx(work + start - stored(p)).epsilon(2e-4));
}

TEST_CASE("Equal peak and residual strength are perfectly plastic Mohr-Coulomb to the last bit",
          "[materials]")
{
  Random random(73);
  const MohrCoulomb perfect = mohr_coulomb(30, 10e3, 5);
  MohrCoulomb equal = perfect;
  equal.softening_strain = 0.02;
  Point a, b;
  a.stress = b.stress = {-50e3, -80e3, -60e3, 0};
  for (int k = 0; k < 5000; ++k)
  {
    const Increment e = random_increment(random, 5e-4);
    a = update(perfect, a, e);
    b = update(equal, b, e);
  }
  CHECK(a.strain() > 0.05);
  CHECK(a.stress == b.stress);
  CHECK(a.state == b.state);
}

TEST_CASE("Below its surface Mohr-Coulomb is elastic, and with cohesion without end too", "[materials]")
{
  Random random(75);
  const MohrCoulomb law = mohr_coulomb(30, 1e9);
  Point p, elastic;
  for (int k = 0; k < 1000; ++k)
  {
    const Increment e = random_increment(random, 1e-3);
    p = update(law, p, e);
    elastic = update(static_cast<const Elastic&>(law), elastic, e);
  }
  CHECK(p.stress == elastic.stress);
  CHECK(p.strain() == 0);
}

TEST_CASE("A batch of Mohr-Coulomb points gives each what it gives one alone", "[materials]")
{
  Random random(76);
  const MohrCoulomb law = rock();
  constexpr int count = 100;
  std::array<double, count> xx, yy, zz, xy, exx, eyy, exy, mass, volume, strain, opening, dissipation,
      opening_xx, opening_yy, opening_xy, cosine, sine;
  std::vector<Point> alone;
  for (int k = 0; k < count; ++k)
  {
    Point p;
    p.stress = {random(-5e6, 1e5), random(-5e6, 1e5), random(-5e6, 1e5), random(-2e6, 2e6)};
    const double torn = std::max(0.0, random(-0.1, 0.1));
    p.state = {std::max(0.0, random(-0.01, 0.02)), torn, 0, 0.5 * torn, 0.3 * torn, 0.2 * torn};
    const Increment e = random_increment(random, 1e-3);
    xx[k] = p.stress[0], yy[k] = p.stress[1], zz[k] = p.stress[2], xy[k] = p.stress[3];
    exx[k] = e.xx, eyy[k] = e.yy, exy[k] = e.xy;
    mass[k] = law.density;
    volume[k] = std::exp(e.xx + e.yy);
    strain[k] = p.state[0], opening[k] = p.state[1], dissipation[k] = 0;
    opening_xx[k] = p.state[3], opening_yy[k] = p.state[4], opening_xy[k] = p.state[5];
    cosine[k] = 1, sine[k] = 0;
    alone.push_back(update(law, p, e));
  }
  double* state[] = {strain.data(),     opening.data(),    dissipation.data(),
                     opening_xx.data(), opening_yy.data(), opening_xy.data()};
  law.update({count, xx.data(), yy.data(), zz.data(), xy.data(), exx.data(), eyy.data(), exy.data(),
              mass.data(), volume.data(), cosine.data(), sine.data()},
             state, true);
  for (int k = 0; k < count; ++k)
  {
    REQUIRE(std::array{xx[k], yy[k], zz[k], xy[k]} == alone[k].stress);
    REQUIRE(std::array{strain[k], opening[k], dissipation[k], opening_xx[k], opening_yy[k], opening_xy[k]} ==
            alone[k].state);
  }
}

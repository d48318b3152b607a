// Sizes and magnitudes of a case, looked at before anything is made.

#include "io/case/size.hpp"
#include "io/common/memory.hpp"
#include "test/io/case_texts.hpp"

#include <chrono>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// All warnings, one a line.
std::string warned(const std::string& text, const std::vector<std::string>& overrides = {})
{
  std::string all;
  for (const std::string& warning : load(text, overrides).warnings) all += warning + "\n";
  return all;
}

} // namespace

TEST_CASE("The expected size of a case is that of its geometry", "[io]")
{
  const CaseSize size = expected_size(load(small));
  CHECK(size.particles == Approx(40 * 10 * 9));
  CHECK(size.columns == Approx(120));
  CHECK(size.nodes > 400);
  const std::string hill = replaced(small, "{points: [[0 m, 10 m]]}",
                                    "{gaussian: {base: 10 m, height: 8 m, centre: 20 m, width: 4 m}}");
  CHECK(expected_size(load(hill)).particles ==
        Approx(9 * (400 + 8 * 4 * std::sqrt(std::numbers::pi))).epsilon(0.01));
  CHECK(memory_needed(size, load(small)) > checkpoint_bytes(size.particles, load(small)));
}

TEST_CASE("A case that no machine holds is refused at once, and says why", "[io]")
{
  const auto start = std::chrono::steady_clock::now();
  const auto refused = [](const std::vector<std::string>& overrides) { return refusal(small, overrides); };
  CHECK_THAT(refused({"grid.spacing=1e-9 m"}),
             Contains("65\n") && Contains("grid.spacing: makes about 3.6e+21 particles in 1.2e+11 columns") &&
                 Contains("use larger cells"));
  CHECK_THAT(refused({"grid.spacing=1e-5 m"}), Contains("particles in"));
  CHECK_THAT(refused({"domain.x=[0 m, 1e12 m]"}), Contains("particles in"));
  CHECK_THAT(refused({"domain.bottom=-1e13 m"}), Contains("65\n"));
  CHECK_THAT(refused({"grid.spacing=1e-200 m"}), Contains("65\n"));
  CHECK_THAT(refused({"domain.x=[1e17 m, 100000000000001000 m]"}),
             Contains("domain.x: coordinates of 1e+17 m"));
  CHECK_THAT(refused({"seismic={duration: 1e15 s}"}), Contains("seismic.duration: makes histories of"));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
}

TEST_CASE("Coordinates of a national grid are taken as they are", "[io]")
{
  const std::string far =
      replaced(replaced(small, "[0 m, 40 m]", "[2600000 m, 2600040 m]"), "[[0 m,", "[[2600000 m,");
  CHECK(load(far).warnings.empty());
}

TEST_CASE("The free memory is known on this machine", "[io]")
{
  const FreeMemory free = free_memory();
  CHECK(free.bytes > 1e6);
  CHECK(std::isfinite(free.bytes));
  CHECK(bytes_text(1.53e9) == "1.5 GB");
  CHECK(bytes_text(2.4e7) == "24 MB");
}

TEST_CASE("Values that no ground has are warned of with what is usual", "[io]")
{
  CHECK(warned(small).empty());
  const auto with = [](const std::string& override) { return warned(small, {override}); };
  CHECK_THAT(
      with("materials.soil.density=1.8 kg/m3"),
      Contains(
          "materials.soil.density: 1.8 kg/m3, where 800 to 4000 kg/m3 is usual: is it in t/m3 or g/cm3?"));
  CHECK_THAT(with("materials.soil.young_modulus=40 kPa"),
             Contains("young_modulus: 0.04 MPa") && Contains("S waves: 2.") && Contains("is strained by "));
  CHECK_THAT(with("materials.soil.poisson_ratio=-0.3"), Contains("poisson_ratio: -0.3"));
  CHECK_THAT(with("static.gravity=9.81 cm/s2"), Contains("static.gravity: 0.0981 m/s2"));
  CHECK_THAT(with("static.gravity=9.81 g"), Contains("static.gravity: 96.2 m/s2"));
  CHECK_THAT(with("static.ramp=10 ms"), Contains("static.ramp: 0.01 s is shorter than"));
  CHECK_THAT(with("grid.spacing=5 m"), Contains("the ground is 2 cells high"));
  CHECK_THAT(with("seismic={duration: 20 ms}"), Contains("seismic.duration: 0.02 s"));
  CHECK_THAT(with("seismic={duration: 20 s, rest_below: 1 m/s}"), Contains("seismic.rest_below: 1 m/s"));
  CHECK(with("seismic={duration: 20 s, rest_below: 1 mm/s}").empty());
  const std::string clay =
      "{model: von_mises, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.45, ";
  CHECK(warned(small, {"materials.soil=" + clay + "strength: {peak: 80 kPa}}"}).empty());
  CHECK_THAT(warned(small, {"materials.soil=" + clay + "strength: {peak: 80 Pa}}"}),
             Contains("strength.peak: 0.08 kPa"));
  CHECK_THAT(warned(small, {"materials.soil=" + clay + "strength: {peak: 80 MPa}}"}),
             Contains("strength.peak: 8e+04 kPa is 2 of young_modulus"));
  CHECK_THAT(warned(small, {"materials.soil=" + clay +
                            "strength: {peak: 80 kPa, residual: 8 kPa}, softening: {displacement: 50 m}}"}),
             Contains("softening.displacement: 50 m"));
}

TEST_CASE("Values that cannot be computed with are refused", "[io]")
{
  CHECK_THAT(refusal(small, {"materials.soil.density=1e-300 kg/m3"}),
             Contains("65\n") && Contains("materials.soil: a density of 1e-300 kg/m3"));
  CHECK_THAT(refusal(small, {"materials.soil.young_modulus=1e300 Pa"}), Contains("65\n"));
}

TEST_CASE(
    "Level ground that yields under its own weight is warned of with the stress ratio that its law allows",
    "[io]")
{
  const auto with = [](const std::string& law, double poisson)
  {
    return warned(small, {"materials.soil={density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: " +
                          std::to_string(poisson) + ", " + law + "}"});
  };
  // mu = 0.6 is sin(phi) = 0.5145: K0 = (1.7321 - 0.5145) / (1.7321 + 1.0290) = 0.4410, nu = 0.3060.
  const std::string slip = "model: slip_weakening, friction: {peak: 0.6}, thickness: 4 m";
  CHECK_THAT(with(slip, 0.25), Contains("K0 = nu/(1 - nu) = 0.333") && Contains("no less than K0 = 0.441 ") &&
                                   Contains("(poisson_ratio 0.306)"));
  CHECK(with(slip, 0.307).empty());
  // Active earth pressure of 30 degrees: 1/3.
  const std::string sand = "model: mohr_coulomb, friction_angle: {peak: 30 deg}, cohesion: {peak: 0 kPa}";
  CHECK_THAT(with(sand, 0.2), Contains("no less than K0 = 0.333 (poisson_ratio 0.25)"));
  CHECK(with(sand, 0.26).empty());
  // A cohesion of c holds 2 c sqrt(N) of 176.6 kPa: K0 = (1 - 2 * 20 * 1.732 / 176.6) / 3 = 0.2026.
  const std::string silt = "model: mohr_coulomb, friction_angle: {peak: 30 deg}, cohesion: {peak: 20 kPa}";
  CHECK_THAT(with(silt, 0.15), Contains("under 177 kPa the law allows no less than K0 = 0.203 "));
  CHECK(with(silt, 0.17).empty());
}

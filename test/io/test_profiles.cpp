// The profiles that every case has, and the cells that they choose.

#include "io/case/profiles.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
/// A slope of one in two, 10 m high, in 4 to 14 m of clay over rock: c_s = sqrt(E / (2 (1 + nu) rho)) = 90.7
/// m/s in the clay.
const std::string slope = R"(schema: seismpm-case/1
grid: {spacing: 1 m}
domain: {x: [0 m, 90 m], bottom: 0 m}
surfaces:
  ground: {points: [[0 m, 18 m], [35 m, 18 m], [55 m, 8 m], [90 m, 8 m]]}
  rockhead: {points: [[0 m, 4 m], [90 m, 4 m]]}
regions:
  - {material: clay, above: rockhead, below: ground}
  - {material: rock, below: rockhead}
materials:
  rock: {model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}
  clay:
    model: von_mises
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.35
    strength: {peak: 64 kPa, residual: 30 kPa}
    softening: {displacement: 0.2 m}
)";
const std::string shaken = slope + R"(seismic:
  duration: 30 s
  filter: {time: 30 s}
  motion: {recorded_as: outcrop, horizontal: built_in}
)";

Case loaded(const std::string& text, const std::string& profile, const std::vector<std::string>& set = {})
{
  const TemporaryFolder folder;
  put(folder.path() / "case.yaml", text);
  return load_case(folder.path() / "case.yaml", set, profile);
}

std::string refusal(const std::string& text, const std::string& profile)
{
  try
  {
    loaded(text, profile);
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "nothing";
}
} // namespace

TEST_CASE("a profile of every case has cells for the waves, the layers and the slide", "[io]")
{
  // Waves of 10 Hz in the clay are 9.07 m long; the slope rises by 10 m, the clay is up to 14 m thick, 9
  // m in the mean: (35 * 14 + 20 * 9 + 35 * 4) / 90.
  const Scales scales = scales_of(loaded(shaken, ""));
  CHECK(scales.softest == Approx(std::sqrt(40e6 / (2 * 1.35 * 1800))));
  CHECK(scales.softest_name == "clay");
  CHECK(scales.layer.value == Approx(9).epsilon(1e-3));
  CHECK(scales.slide.value == Approx(10).epsilon(1e-3));
  CHECK_FALSE(scales.band.known());
  CHECK_FALSE(scales.level);
  // 10 m over 8, 16 and 24 cells; paper: 9.07 m over 36.
  CHECK(loaded(shaken, "quick").grid.spacing == Approx(1.2)); // 75 of them, 1.25 m would be 72
  CHECK(loaded(shaken, "standard").grid.spacing == Approx(0.6));
  CHECK(loaded(shaken, "fine").grid.spacing == Approx(0.4));
  CHECK(loaded(shaken, "paper").grid.spacing == Approx(0.25));
  CHECK(loaded(shaken, "quick").courant_number == 0.7);
  CHECK(loaded(shaken, "quick", {"time_step.courant_number=0.4"}).courant_number == 0.4);
}

TEST_CASE("a profile's cells do not depend on the case's own, nor on its having any", "[io]")
{
  std::string without = shaken;
  without.replace(without.find("grid: {spacing: 1 m}"), 20, "grid: {}");
  const double spacing = loaded(shaken, "standard").grid.spacing;
  CHECK(loaded(shaken, "standard", {"seismic.duration=5 s"}).grid.spacing == spacing);
  CHECK(loaded(without, "standard").grid.spacing == spacing);
  CHECK_THAT(refusal(without, ""), Contains("grid.spacing"));
}

TEST_CASE("a profile obeys grid.frequency, a band's width and --set", "[io]")
{
  const Case fast = loaded(shaken, "standard", {"grid.frequency=30 Hz"});
  CHECK(fast.grid.spacing <= 90.72 / 30 / 10);
  CHECK(fast.grid.spacing >= 0.9 * 90.72 / 30 / 10);
  const Case thin = loaded(shaken, "quick", {"materials.clay.softening.band_width=1.5 m"});
  CHECK(thin.grid.spacing == Approx(0.5));
  const Case own = loaded(shaken, "standard", {"grid.spacing=0.9 m"});
  CHECK(own.grid.spacing == 0.9);
  CHECK(own.grid.particles_per_cell == 2);
}

TEST_CASE("the profile paper is the paper's method, also where a case was meant for another", "[io]")
{
  const Case paper = loaded(shaken, "paper");
  CHECK(paper.grid.particles_per_cell == 3);
  CHECK(paper.grid.interfaces == Interfaces::sharp);
  CHECK_FALSE(paper.grid.average_flow);
  CHECK(paper.seismic.transfer == Transfer::apic);
  CHECK(paper.seismic.inertia == Inertia::lumped);
  CHECK(paper.seismic.filter.time == 0);
  CHECK(loaded(shaken, "paper", {"time_step.courant_number=0.3"}).courant_number == 0.3);
  CHECK(paper.courant_number == 0.5);
  // Without a seismic section there is nothing to say of it, and none is made.
  CHECK(loaded(slope, "paper").seismic.duration == 0);
  CHECK(loaded(slope, "paper").grid.spacing == paper.grid.spacing);
}

TEST_CASE("a case's own profile goes before one of that name that every case has", "[io]")
{
  const std::string with = shaken + "profiles: {quick: {grid.spacing: 2 m}, soft: {grid.spacing: 3 m}}\n";
  const Case own = loaded(with, "quick");
  CHECK(own.grid.spacing == 2);
  CHECK(own.chosen.empty());
  const Case chosen = loaded(with, "standard");
  REQUIRE(chosen.chosen.size() == 2);
  CHECK_THAT(chosen.chosen[0], Contains("grid.spacing 0.6 m, 150 of which") &&
                                   Contains("at most 0.625 m for 16 cells across what can slide (10 m)"));
  CHECK_THAT(refusal(with, "fin"), Contains("the case's profiles are quick, soft; every case has quick, "
                                            "standard, fine, paper; did you mean 'fine'"));
  CHECK_THAT(refusal(shaken, "soft"), Contains("no such profile") && Contains("standard"));
}

TEST_CASE("what is wrong with a case is said before a profile looks at it", "[io]")
{
  CHECK_THAT(refusal(shaken + "oddity: 1\n", "standard"), Contains("oddity"));
  CHECK_THAT(refusal("schema: seismpm-case/1\n", "standard"), Contains("domain"));
}

TEST_CASE("cells that fit are no larger than asked for, divide the width and have few digits", "[io]")
{
  CHECK(fitting_spacing(200, 0.2519) == Approx(0.25));
  CHECK(fitting_spacing(200, 0.42) == Approx(0.4));
  CHECK(fitting_spacing(90, 90) == 90);
  CHECK(fitting_spacing(90, 500) == 90);
  for (double width = 3.7; width < 5000; width *= 1.37)
    for (double target = width / 2000; target < width; target *= 1.31)
    {
      const double h = fitting_spacing(width, target), cells = width / h;
      INFO(width << " " << target << " " << h);
      CHECK(h <= target * (1 + 1e-8));
      CHECK(cells == Approx(std::round(cells)).epsilon(1e-12));
      // The next whole number of cells, or a tenth less for fewer digits.
      CHECK(cells <= std::max(std::ceil(width / target), width / (0.9 * target)));
    }
}

// What is said of ground that particles do not fill as it was drawn.

#include "io/common/error.hpp"
#include "solver/stages/filling_report.hpp"
#include "test/stages/ground.hpp"
#include "test/stages/programs.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;
using Catch::Contains;

namespace
{
/// Rock, a weak layer `weak` m thick on it from its left end to `to` m, and soil; cells of 1 m, two particles
/// each: half a particle spacing is 0.25 m.
std::string layered(const std::string& weak_surface, const std::string& x = "[0 m, 40 m]",
                    const std::string& soil = "soil")
{
  return R"(schema: seismpm-case/1
grid: {spacing: 1 m, particles_per_cell: 2}
domain: {x: [0 m, 40 m], bottom: 0 m}
surfaces:
  rock: {points: [[0 m, 5 m]]}
  weak: )" +
         weak_surface + R"(
  ground: {points: [[0 m, 15 m]]}
regions:
  - {material: weak, above: rock, below: weak, x: )" +
         x + R"(}
  - {material: )" +
         soil + R"(, above: rock, below: ground}
  - {material: rock, below: rock}
materials:
  rock: {model: elastic, density: 2200 kg/m3, young_modulus: 500 MPa, poisson_ratio: 0.25}
  soil: {model: elastic, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.35}
  weak: {model: von_mises, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.35, strength: {peak: 200 kPa}}
)";
}

/// The warnings of a case's filling, one a line; "refused: ..." where it is refused.
std::string said_of(const std::string& text)
{
  const TemporaryFolder folder;
  put(folder / "case.yaml", text);
  const Case case_file = load_case(folder / "case.yaml");
  Log log(Verbosity::quiet);
  try
  {
    report_filling(log, case_file, fill(case_file));
  }
  catch (const Error& error)
  {
    CHECK(error.code == 65);
    return std::string("refused: ") + error.what();
  }
  std::string all;
  for (const std::string& warning : log.warnings()) all += warning + "\n";
  return all;
}
} // namespace

TEST_CASE("a layer without any particle is refused with its location", "[stages]")
{
  CHECK_THAT(said_of(layered("{offset: rock, up: 0.24 m}")),
             Contains("refused: ") &&
                 Contains("case.yaml:9:5: regions[0] (weak): 9.6 m2 are drawn, 0.24 m thick and "
                          "40 m long, and no particle stands for them"));
  CHECK_THAT(said_of(layered("{offset: rock, up: 0.26 m}")), !Contains("refused"));
  // A dyke between two columns' centres.
  CHECK_THAT(said_of(layered("{offset: rock, up: 9 m}", "[10.3 m, 10.6 m]")),
             Contains("refused: ") && Contains("0.3 m long"));
  // Two regions of one material are one layer: what is thin in one has particles with the other.
  CHECK_THAT(said_of(layered("{offset: rock, up: 0.24 m}", "[0 m, 40 m]", "weak")), !Contains("refused"));
  // A corner where two surfaces hardly cross is no layer.
  CHECK_THAT(said_of(layered("{points: [[0 m, 5.01 m], [1 m, 5 m]]}")),
             Contains("smaller than half a particle"));
}

TEST_CASE("a layer that is lost in part is warned of with where", "[stages]")
{
  // 1 m thick at x = 10 m, nothing at 40 m: thinner than 0.25 m from 32.5 m on.
  const std::string thins = said_of(layered("{points: [[0 m, 6 m], [10 m, 6 m], [40 m, 5 m]]}"));
  CHECK_THAT(thins, Contains("regions[0] (weak): its particles have 24.0") &&
                        Contains("where 25 m2 are drawn") &&
                        Contains("over 7.5 m of its 40 m, between x = 32.5 m and 40 m"));
  CHECK_THAT(said_of(layered("{points: [[0 m, 14 m], [40 m, 5 m]]}")), !Contains("are drawn"));
  // Particle columns are half a metre wide.
  CHECK_THAT(said_of(layered("{offset: rock, up: 9 m}", "[10 m, 10.7 m]")), Contains("(-28.6 %)"));
  CHECK_THAT(said_of(layered("{offset: rock, up: 9 m}", "[10 m, 20.2 m]")), !Contains("are drawn"));
}

TEST_CASE("a layer of fewer than three cells that can yield is told of, of four with the affine transfer",
          "[stages]")
{
  const std::string apic = "seismic: {duration: 1 s, transfer: apic}\n";
  CHECK_THAT(said_of(layered("{offset: rock, up: 2 m}")),
             Contains("regions[0] (weak): can yield") && Contains("2 cells thick"));
  CHECK(said_of(layered("{offset: rock, up: 3 m}")).empty());
  CHECK_THAT(said_of(layered("{offset: rock, up: 3 m}") + apic), Contains("3 cells thick"));
  CHECK(said_of(layered("{offset: rock, up: 4 m}") + apic).empty());
  // Five cells high at 45 degrees are 3.54 across; the first of 80 columns counts as level: 3.55.
  const std::string level = layered("{offset: rock, up: 5 m}");
  CHECK(said_of(level + apic).empty());
  const std::string dipping = std::string(level)
                                  .replace(level.find("[[0 m, 5 m]]"), 12, "[[0 m, 45 m], [40 m, 5 m]]")
                                  .replace(level.find("[[0 m, 15 m]]") + 14, 13, "[[0 m, 60 m]]");
  CHECK(said_of(dipping).empty());
  CHECK_THAT(said_of(dipping + apic), Contains("its layer is 3.6 cells thick"));
  CHECK(said_of(layered("{offset: rock, up: 2 m}", "[0 m, 40 m]", "weak")).empty()); // one layer of ten cells
}

TEST_CASE("a base without ground on it is warned of where it would not hold", "[stages]")
{
  const std::string gap = R"(schema: seismpm-case/1
grid: {spacing: 1 m, particles_per_cell: 2}
domain: {x: [0 m, 40 m], bottom: 0 m}
surfaces: {ground: {points: [[0 m, 15 m]]}}
regions: [{material: soil, below: ground, x: [0 m, 10 m]}]
materials: {soil: {model: elastic, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.35}}
seismic: {duration: 1 s, sides: {kind: quiet}, base: {kind: BASE}}
)";
  const auto with = [&](const std::string& base)
  { return said_of(std::string(gap).replace(gap.find("BASE"), 4, base)); };
  CHECK_THAT(with("compliant"), Contains("no ground lies on the base over 30 m, between x = 10 m and 40 m"));
  CHECK(with("fixed").empty());
}

TEST_CASE("both programs and --check refuse a layer without particles", "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml", layered("{offset: rock, up: 0.2 m}") + "seismic: {duration: 1 s}\n");
  for (const Arguments& arguments : {Arguments{bench.path("case.yaml"), "--check"},
                                     Arguments{bench.path("case.yaml"), "--out", bench.path("out")}})
  {
    const Ending ending = bench.run("mpm-static", arguments);
    CHECK(ending.code == 65);
    CHECK_THAT(ending.said, Contains("regions[0] (weak)") && Contains("no particle"));
    CHECK_FALSE(fs::exists(bench / "out"));
  }
  const Ending seismic = bench.run("mpm-seismic", {bench.path("case.yaml"), "--check", "--from", "none.h5"});
  CHECK(seismic.code == 65);
  CHECK_THAT(seismic.said, Contains("no particle"));
}

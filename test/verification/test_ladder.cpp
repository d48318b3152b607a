#include "test/verification/report.hpp"

#include <catch2/catch.hpp>

using namespace mpm::verification;

namespace
{
const std::filesystem::path cases = SOURCE_DIR "/cases/verification";

/// Runs a case and holds every error and every observed order against the bounds of its ladder.yaml, whose
/// reasons stand in the case's README.
void check(std::string_view name, bool full)
{
  const Ladder ladder = load_ladder(name, cases);
  const Result result = climb(ladder_case(name), ladder, full ? ladder.full : ladder.quick);
  for (const Row& row : result.rows)
  {
    INFO(table_line(row));
    CHECK(row.pass());
  }
}
void quick(std::string_view name)
{
  check(name, false);
}
} // namespace

TEST_CASE("The spline adds up to one and has its moments and slopes (V1)", "[verification]")
{
  quick("kernel");
}

TEST_CASE("An affine velocity field survives the way to the grid and back (V2)", "[verification]")
{
  quick("transfer");
}

TEST_CASE("A folded wall, and a corner of two, is the body with its mirrored particles (V3)",
          "[verification]")
{
  quick("mirrored_wall");
}

TEST_CASE("A manufactured motion of large strain comes out, better on a finer grid (V4)", "[verification]")
{
  quick("manufactured");
}

TEST_CASE("A vortex turns and turns back as its closed form, better on a finer grid (V5)", "[verification]")
{
  quick("vortex");
}

TEST_CASE("A column under its own weight has the closed form's stress and settlement (V6)", "[verification]")
{
  quick("self_weight");
}

TEST_CASE("A shear column swings with its period and the damping of the transfer (V7)", "[verification]")
{
  quick("free_vibration");
}

TEST_CASE("Soil on rock amplifies S waves as the closed form says (V8)", "[verification]")
{
  quick("layer");
}

TEST_CASE("Two layers on rock amplify as their recursion says (V9)", "[verification]")
{
  quick("two_layers");
}

TEST_CASE("Layers amplify with the paper's method (V8, V9)", "[verification]")
{
  quick("layer_paper");
}

TEST_CASE("Soil on rock amplifies P waves with the P modulus (V10)", "[verification]")
{
  quick("layer_p");
}

TEST_CASE("Upgoing waves double at the surface and do not come back (V10, V11)", "[verification]")
{
  quick("uniform_column");
}

TEST_CASE("A level layered model moves as its own free-field column, S and P together (V14)",
          "[verification]")
{
  quick("level_site");
}

TEST_CASE("An elastic slope answers a wavelet as finite elements say (V15)", "[verification]")
{
  quick("hill");
}

TEST_CASE("An elastic slope answers as finite elements say with the paper's method (V15)", "[.fine]")
{
  quick("hill_paper");
}

TEST_CASE("The compliant base reflects oblique waves as dashpots do (V12)", "[verification]")
{
  quick("absorption");
}

TEST_CASE("A line load in a small box makes the waves and echoes of finite elements (V13)", "[verification]")
{
  quick("line_load");
}

TEST_CASE("A strip footing fails on clay at the load of limit analysis (V16)", "[verification]")
{
  quick("strip_footing");
}

TEST_CASE("Laws reach the limit states of triaxial, biaxial and shear tests (V17)", "[verification]")
{
  quick("laws");
}

TEST_CASE("A softening band dissipates what the spline's shape makes of its rows (V18)", "[verification]")
{
  quick("shear_band");
}

TEST_CASE("A vertical cut in clay fails near the number of limit analysis (V19)", "[verification]")
{
  quick("vertical_cut");
}

TEST_CASE("Slopes fail at the factors of safety of circles (V19)", "[verification]")
{
  quick("slope");
}

TEST_CASE("A block on a weak layer slides as Newmark's (V20)", "[verification]")
{
  quick("sliding_block");
}

TEST_CASE("A block on a weakening layer slides as Newmark's (V20)", "[verification]")
{
  quick("weakening_slope");
}

TEST_CASE("Water behind a broken dam flows as shallow water and not faster (V21)", "[verification]")
{
  quick("dam_break");
}

TEST_CASE("Columns of sand run out by powers of their height (V22)", "[verification]")
{
  quick("column_collapse");
}

TEST_CASE("Every case of the ladder states a bound for each resolution that it runs", "[verification]")
{
  for (const LadderCase& one : ladder_cases())
  {
    const Ladder ladder = load_ladder(one.name, cases);
    INFO(ladder.name);
    CHECK(!ladder.full.empty());
    CHECK(!ladder.measures.empty());
    CHECK(std::filesystem::exists(ladder.folder / "README.md"));
    for (const Measure& measure : ladder.measures)
      for (const auto* list : {&ladder.quick, &ladder.full})
        for (const double resolution : *list) CHECK(measure.bounds.contains(resolution));
  }
}

TEST_CASE("The whole ladder stays under its bounds", "[.ladder]")
{
  for (const LadderCase& one : ladder_cases()) check(one.name, true);
}

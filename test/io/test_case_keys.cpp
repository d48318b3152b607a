// How keys are read, overridden and refused.

#include "test/io/case_texts.hpp"

using namespace mpm;
using namespace mpm::test;

TEST_CASE("An unknown key is refused with its location, the allowed keys and the nearest one", "[io]")
{
  CHECK(refusal(replaced(small, "poisson_ratio", "poison_ratio")) ==
        "65\n"
        "case.yaml:9:3: materials.soil.poisson_ratio: is missing; it has no default\n"
        "case.yaml:13:5: materials.soil.poison_ratio: unknown key 'poison_ratio'; allowed: model, density, "
        "young_modulus or poisson_ratio; did you mean 'poisson_ratio'?\n");
  CHECK_THAT(refusal(small + "tme_step: {courant_number: 0.5}\n"),
             Contains("case.yaml:14:1: tme_step: unknown key") && Contains("did you mean 'time_step'?"));
}

TEST_CASE("All problems of a file are reported at once, in its order", "[io]")
{
  std::string text = replaced(small, "1800 kg/m3", "1800");
  text = replaced(text, "40 MPa", "-40 MPa");
  text = replaced(text, "spacing: 1 m", "spacing: one");
  text = replaced(text, "schema: seismpm-case/1", "schema: other/1");
  CHECK(refusal(text) ==
        "65\n"
        "case.yaml:1:9: schema: is 'other/1'; this program reads 'seismpm-case/1'\n"
        "case.yaml:2:17: grid.spacing: 'one' is not a number with a unit; units: m, mm, cm or km\n"
        "case.yaml:11:14: materials.soil.density: needs a unit: write '1800 kg/m3'; units: kg/m3, g/cm3 or "
        "t/m3\n"
        "case.yaml:12:20: materials.soil.young_modulus: is -40 MPa; must be above 0 Pa\n");
}

TEST_CASE("A key given twice is refused", "[io]")
{
  CHECK(refusal(small + "grid: {spacing: 2 m}\n") ==
        "65\ncase.yaml:14:1: grid: is given twice, first in line 2; leave one\n");
  CHECK_THAT(refusal(replaced(small, "density: 1800 kg/m3", "density: 1800 kg/m3\n    density: 1 t/m3")),
             Contains("case.yaml:12:5: materials.soil.density: is given twice, first in line 11"));
}

TEST_CASE("A value of the wrong type is refused", "[io]")
{
  CHECK_THAT(refusal(replaced(small, "{spacing: 1 m}", "1 m")),
             Contains("case.yaml:2:7: grid: is a single value; give a map"));
  CHECK_THAT(refusal(replaced(small, "spacing: 1 m", "spacing: [1 m]")),
             Contains("case.yaml:2:17: grid.spacing: is a list; give a number"));
  CHECK_THAT(refusal(replaced(small, "spacing: 1 m", "spacing:")),
             Contains("grid.spacing: has no value; give a number"));
  CHECK_THAT(refusal(replaced(small, "[[0 m, 10 m]]", "[[0 m, 10 m, 3 m]]")),
             Contains("case.yaml:5:21: surfaces.ground.points[0]: has 3 elements; must be two"));
  CHECK_THAT(refusal(replaced(small, "spacing: 1 m", "spacing: 1 m, particles_per_cell: 2.5")),
             Contains("grid.particles_per_cell: is '2.5'; must be a whole number from 1 to 10"));
  CHECK_THAT(refusal(""), Contains("case.yaml:1:1: has no value; give a map"));
  CHECK_THAT(refusal("a: [1, 2\n"), Contains("65\ncase.yaml:2:1: is not YAML: "));
}

TEST_CASE("Parameters that contradict each other are refused at their own line", "[io]")
{
  const std::string soft =
      replaced(small, "model: elastic", "model: von_mises\n    strength: {peak: 70 kPa, residual: 90 kPa}");
  CHECK_THAT(refusal(soft),
             Contains("case.yaml:11:40: materials.soil.strength.residual: is above strength.peak"));
  CHECK_THAT(refusal(replaced(soft, "90 kPa", "9 kPa")),
             Contains("case.yaml:10:5: materials.soil.softening: give either"));
  CHECK_THAT(refusal(replaced(soft, "peak: 70 kPa, ", "")),
             Contains("materials.soil.strength.peak: is missing"));
  CHECK_THAT(refusal(replaced(soft, "{peak: 70 kPa, residual: 90 kPa}", "{peak: 70 kPa, resdual: 90 kPa}")),
             Contains("materials.soil.strength.resdual: unknown key") &&
                 Contains("did you mean 'residual'?"));
}

TEST_CASE("Softening that a law would not use is refused at its own line", "[io]")
{
  const std::string clay =
      replaced(small, "model: elastic", "model: von_mises\n    strength: {peak: 70 kPa}");
  CHECK_NOTHROW(load(clay));
  const auto with = [&](const std::string& more) { return replaced(clay, "{peak: 70 kPa}", more); };
  CHECK_THAT(refusal(with("{peak: 70 kPa}\n    softening: {displacement: 0.2 m}")),
             Contains("65\ncase.yaml:12:16: materials.soil.softening: has no residual strength to soften to; "
                      "give strength.residual"));
  CHECK_THAT(refusal(with("{peak: 70 kPa, residual: 9 kPa}\n    softening: {strain: 0.2, band_width: 2 m}")),
             Contains("65\ncase.yaml:12:42: materials.soil.softening.band_width: turns a displacement"));
  CHECK_THAT(refusal(with("{peak: 70 kPa, residual: 9 kPa}\n    softening: {strain: 0.2, band_cells: 2}")),
             Contains("materials.soil.softening.band_cells: turns a displacement"));
  const Case equal = load(with("{peak: 70 kPa, residual: 70 kPa}\n    softening: {displacement: 0.2 m}"));
  REQUIRE(equal.warnings.size() == 1);
  CHECK_THAT(equal.warnings[0], Contains("materials.soil.softening: has no effect"));
}

TEST_CASE("Friction that snaps back under the ground's own weight is warned of", "[io]")
{
  // 10 m of soil: 10 m x 18 kN/m3 x (1 + nu / (1 - nu)) / 2.
  const auto sand = [](const std::string& strain)
  {
    return replaced(small, "model: elastic",
                    "model: mohr_coulomb\n    friction_angle: {peak: 35 deg, residual: 5 deg}\n"
                    "    cohesion: {peak: 0 kPa}\n    softening: {strain: " +
                        strain + "}");
  };
  CHECK(load(sand("0.1")).warnings.empty());
  const Case steep = load(sand("1e-3"));
  REQUIRE(steep.warnings.size() == 1);
  CHECK_THAT(steep.warnings[0], Contains("materials.soil: weakens so fast that its stress snaps back"));
  CHECK_THAT(refusal(sand("1e-5")), Contains("materials.soil.softening: is so steep"));
}

TEST_CASE("Overrides win, are recorded and are checked under their own name", "[io]")
{
  const Case case_file = load(small, {"grid.spacing=0.5 m", "domain.x[1]=50 m", "regions.0.material=soil",
                                      "seismic.duration=3 s", "output.gauges.points.top=[1 m, 10 m]"});
  CHECK(case_file.grid.spacing == 0.5);
  CHECK(case_file.domain.right == 50);
  CHECK(case_file.seismic.duration == 3);
  CHECK(case_file.output.gauges.points.at(0).y == 10);
  CHECK(case_file.overrides.size() == 5);
  using Setting = std::pair<std::string, std::string>;
  for (const Setting& setting : {Setting{"grid.spacing", "0.5 m"}, Setting{"domain.x[1]", "50 m"},
                                 Setting{"output.gauges.points.top[1]", "10 m"}})
    CHECK(std::count(case_file.settings.begin(), case_file.settings.end(), setting) == 1);

  CHECK(refusal(small, {"grid.spacng=1 m"}) ==
        "65\n--set grid.spacng=1 m: grid.spacng: unknown key 'spacng'; allowed: spacing, frequency, "
        "particles_per_cell, softening, volume_average or interfaces; did you mean 'spacing'?\n");
  CHECK(refusal(small, {"grid.spacing=2"}) ==
        "65\n--set grid.spacing=2: grid.spacing: needs a unit: write '2 m'; units: m, mm, cm or km\n");
  CHECK_THAT(refusal(small, {"grid.spacing"}),
             Contains("--set grid.spacing: is not of the form key.path=value"));
  CHECK_THAT(refusal(small, {"domain.x[2]=1 m"}),
             Contains("domain.x: is a list of 2, counted from 0; it has no '2'"));
  CHECK_THAT(refusal(small, {"grid.spacing.x=1 m"}),
             Contains("grid.spacing: is a single value and has no 'x' below it"));
}

TEST_CASE("A profile is a named set of overrides, and --set goes on top of it", "[io]")
{
  const std::string text = small + R"(profiles:
  fine: {grid.spacing: 0.5 m, grid.particles_per_cell: 4, "domain.x[1]": 50 m}
  soft:
    materials.soil.young_modulus: 20 MPa
    static: {gravity: 1 m/s2, ramp: 2 s}
)";
  CHECK(load(text).settings == load(small).settings);
  CHECK(load(text).profile.empty());

  const Case fine = load(text, {}, "fine");
  CHECK(fine.profile == "fine");
  CHECK(fine.grid.spacing == 0.5);
  CHECK(fine.grid.particles_per_cell == 4);
  CHECK(fine.domain.right == 50);
  CHECK(fine.settings ==
        load(small, {"grid.spacing=0.5 m", "grid.particles_per_cell=4", "domain.x[1]=50 m"}).settings);

  const Case soft = load(text, {"static.ramp=3 s"}, "soft");
  CHECK(soft.materials[0].elastic().young == 20e6);
  CHECK(soft.static_stage.gravity == 1);
  CHECK(soft.static_stage.ramp == 3);
}

TEST_CASE("What a profile holds is checked as the file's own keys, at the profile's lines", "[io]")
{
  const std::string text = small + R"(profiles:
  fine:
    grid.spacing: 0.5
    grid.particle: 4
    domain.x[2]: 3 m
    materials..density: 1 kg/m3
)";
  CHECK(refusal(text, {}, "fine") ==
        "65\n"
        "case.yaml:16:19: grid.spacing: needs a unit: write '0.5 m'; units: m, mm, cm or km\n"
        "case.yaml:17:5: grid.particle: unknown key 'particle'; allowed: spacing, frequency, "
        "particles_per_cell, "
        "softening, volume_average or interfaces; did "
        "you mean "
        "'particles_per_cell'?\n"
        "case.yaml:18:5: domain.x: is a list of 2, counted from 0; it has no '2'\n"
        "case.yaml:19:5: profiles.fine.materials..density: is not of the form key.path: value\n");
  CHECK_THAT(refusal(small + "profiles: [fine]\n"), Contains("case.yaml:14:11: profiles: is not a map"));
  CHECK_THAT(refusal(small + "profiles: {fine: 2}\n"),
             Contains("case.yaml:14:18: profiles.fine: is not a map"));
  CHECK_THAT(refusal(small, {"profiles.fine=1"}), Contains("unknown key 'profiles'"));
}

TEST_CASE("An unknown profile is refused with the known ones", "[io]")
{
  CHECK(refusal(small + "profiles: {fine: {}, coarse: {}}\n", {}, "coarze") ==
        "65\n--profile coarze: no such profile; the case's profiles are fine, coarse; every case "
        "has quick, standard, fine, paper; did you mean 'coarse'?\n");
  CHECK(refusal(small, {}, "fin") ==
        "65\n--profile fin: no such profile; the case has none of its own; every "
        "case has quick, standard, fine, paper; did you mean 'fine'?\n");
}

TEST_CASE("A time step beyond the stable one is refused with the reason", "[io]")
{
  CHECK_THAT(refusal(small + "time_step: {courant_number: 0.8}\n"),
             Contains("case.yaml:14:29: time_step.courant_number: is 0.8; must be above 0 and at most 0.78, "
                      "where loose particles at the surface become unstable"));
  CHECK_THAT(refusal(small + "time_step: {courant_number: 0}\n"),
             Contains("must be above 0 and at most 0.78"));
}

TEST_CASE("A missing case or profile has its own exit code", "[io]")
{
  try
  {
    load_case("no/such/case.yaml");
    FAIL("accepted");
  }
  catch (const Error& error)
  {
    CHECK(error.code == exit_code::input_missing);
  }
  const std::string text = replaced(small, "points: [[0 m, 10 m]]", "file: no.csv");
  CHECK(refusal(text) == "66\ncase.yaml:5:18: surfaces.ground.file: no.csv: no such file; paths are "
                         "relative to the case file\n");
  CHECK(refusal(replaced(text, "40 MPa", "40")).starts_with("65\n"));
}

TEST_CASE("YAML that contains itself comes to an end", "[io]")
{
  CHECK_THAT(refusal("a: &a [*a]\n"), Contains("nested too deeply") || Contains("is not YAML"));
}

TEST_CASE("A word that a material does not know is refused with those it knows", "[io]")
{
  CHECK_THAT(
      refusal(replaced(landslide, "match: plane", "match: plan")),
      Contains(
          "case.yaml:27:12: materials.zone.match: is 'plan'; must be mc or plane; did you mean 'plane'?"));
  CHECK_THAT(
      refusal(replaced(landslide, "friction_angle: {peak: 38.5 deg,", "friction_angle: {peak: 98.5 deg,")),
      Contains("materials.mass.friction_angle.peak: is 98.5 deg; must be"));
  CHECK_THAT(refusal(replaced(landslide, "residual: 0 kPa}", "residual: 990 kPa}")),
             Contains("materials.mass.cohesion.residual: is above cohesion.peak"));
}

TEST_CASE("a record's format, unit and component are keys of the case", "[io]")
{
  const std::string record = small + R"(seismic:
  duration: 1 s
  motion:
    recorded_as: outcrop
    horizontal: {file: a.dat, format: cwb, unit: CM/SEC/SEC, component: N}
)";
  const RecordSource source = load(record).seismic.motion.horizontal->record;
  CHECK(source.format == "cwb");
  CHECK(source.unit == "CM/SEC/SEC");
  CHECK(source.component == "N");
  CHECK_THAT(refusal(replaced(record, "CM/SEC/SEC", "cubits")),
             Contains("unit: is 'cubits'; must be a unit of records"));
  CHECK_THAT(refusal(replaced(record, "cwb", "cbw")), Contains("geonet or bhrc"));
}

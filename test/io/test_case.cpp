#include "test/io/case_texts.hpp"

#include <algorithm>
#include <numbers>

using namespace mpm;
using namespace mpm::test;

TEST_CASE("A small case gets the documented defaults", "[io]")
{
  const Case case_file = load(small);
  CHECK(case_file.name == "case");
  CHECK(case_file.text == small);
  CHECK(case_file.grid.spacing == 1);
  CHECK(case_file.grid.particles_per_cell == 3);
  CHECK(case_file.domain.right == 40);
  CHECK(case_file.static_stage.gravity == 9.81);
  CHECK(case_file.static_stage.until.at_most == 60);
  CHECK(case_file.seismic.duration == 0);
  CHECK(case_file.seismic.sides == SideKind::free_field);
  CHECK(case_file.seismic.motion.horizontal->built_in());
  CHECK_FALSE(case_file.seismic.motion.vertical);
  CHECK(case_file.courant_number == 0.5);
  CHECK(case_file.output.frames.fields == std::vector<std::string>{"displacement", "velocity", "stress"});
  CHECK(case_file.output.checkpoint.every == 600);
  CHECK(case_file.output.checkpoint.adapts);
  CHECK(case_file.output.checkpoint.keep == 2);
  CHECK(case_file.warnings.empty());
  REQUIRE(case_file.materials.size() == 1);
  CHECK(case_file.materials[0].model() == "elastic");
  CHECK(case_file.materials[0].elastic().young == 40e6);
  CHECK(case_file.ground_height(20) == 10);
  CHECK(case_file.longest_period() == Approx(4 * 10 / case_file.materials[0].elastic().shear_speed()));
}

TEST_CASE("The base's spring is none, the ground's own or a time", "[io]")
{
  const auto base = [](const std::string& keys)
  { return small + "seismic: {duration: 1 s, base: {" + keys + "}}\n"; };
  CHECK_FALSE(load(base("kind: compliant")).seismic.spring);
  CHECK_FALSE(load(base("spring: auto")).seismic.spring);
  CHECK(load(base("spring: none")).seismic.spring == 0);
  CHECK(load(base("spring: 500 ms")).seismic.spring == 0.5);
  CHECK_THAT(refusal(base("spring: 0 s")), Contains("seismic.base.spring") && Contains("above 0 s"));
  CHECK_THAT(refusal(base("spring: 5 m")), Contains("seismic.base.spring: must be none, auto or a time"));
  CHECK_THAT(refusal(base("spring: off")), Contains("seismic.base.spring: must be none, auto or a time"));
  CHECK_THAT(refusal(base("kind: fixed, spring: 1 s")), Contains("a fixed base has no spring"));
}

TEST_CASE("Every section of a case is read", "[io]")
{
  const TemporaryFolder folder;
  written(folder, "profiles/rock.csv", "x, y\n# rock\n0, 8\n20, 8 # level\n40, 2\n");
  const Case case_file = load_case(written(folder, "case.yaml", R"(schema: seismpm-case/1
name: full
grid: {spacing: 50 cm, particles_per_cell: 2}
domain: {x: [0 m, 40 m], bottom: -2 m}
surfaces:
  ground: {offset: rockhead, up: 4 m}
  rockhead: {file: profiles/rock.csv}
  hill: {gaussian: {base: 10 m, height: 15 m, centre: 20 m, width: 5 m, side: right}}
regions:
  - {material: rock, above: rockhead, below: ground, x: [0 m, 10 m]}
  - {material: soil, above: rockhead, below: ground}
  - {material: rock, below: rockhead}
materials:
  rock: {model: elastic, density: 2.2 t/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}
  soil:
    model: von_mises
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.495
    strength: {peak: 70 kPa, residual: 39 kPa}
    softening: {displacement: 0.2 m}
static: {gravity: 0 m/s2, ramp: 5 s, damping: 0, until: {unbalanced: 1e-5, kinetic: 1e-9, at_most: 20 s}}
seismic:
  duration: 40 s
  base: {kind: fixed}
  sides: {kind: roller}
  motion:
    recorded_as: upgoing
    horizontal: {file: records/a.txt, format: column, dt: 5 ms, unit: g, quantity: velocity, scale: 1.5}
    vertical: built_in
    baseline: cubic
    taper: 1 s
    high_pass: 0.1 Hz
    end: 12.5 s
time_step: {courant_number: 0.7}
output:
  frames: {every: 1 s, fields: [velocity, plastic_strain]}
  gauges: {every: 0.02 s, points: {crest: [20 m, 12 m], foot: [40 m, 6.2 m]}}
  checkpoint: {every: 2 min, keep: 3}
)"));
  CHECK(case_file.name == "full");
  CHECK(case_file.grid.particle_spacing() == 0.25);
  CHECK(case_file.domain.bottom == -2);
  CHECK(case_file.surfaces[0].name == "ground");
  CHECK(case_file.surfaces[0].height(30) == Approx(9));
  CHECK(case_file.surfaces[2].height(3) == 25);
  CHECK(case_file.regions[0].right == 10);
  CHECK(case_file.regions[2].below == 1);
  CHECK(std::get<VonMises>(case_file.materials[1].law).softening_strain ==
        Approx(0.2 / (std::sqrt(3.0) * 3 * 0.5)));
  CHECK(case_file.static_stage.gravity == 0);
  CHECK(case_file.static_stage.until.at_most == 20);
  CHECK(case_file.seismic.base == BaseKind::fixed);
  CHECK(case_file.seismic.sides == SideKind::roller);
  const MotionSettings& motion = case_file.seismic.motion;
  CHECK(motion.processing.recorded_as == RecordedAs::upgoing);
  CHECK(motion.processing.baseline == Baseline::cubic);
  CHECK(motion.processing.taper == 1);
  CHECK(motion.processing.high_pass == 0.1);
  CHECK(motion.end == MotionEnd::time);
  CHECK(motion.end_time == 12.5);
  CHECK(motion.horizontal->record.file == (folder / "records/a.txt").string());
  CHECK(motion.horizontal->record.dt == 0.005);
  CHECK(motion.horizontal->record.unit == "g");
  CHECK(motion.horizontal->record.quantity == Quantity::velocity);
  CHECK(motion.horizontal->scale == 1.5);
  CHECK(motion.vertical->built_in());
  CHECK(case_file.output.frames.fields == std::vector<std::string>{"velocity", "plastic_strain"});
  CHECK(case_file.output.gauges.points[1].name == "foot");
  CHECK(case_file.output.gauges.points[1].y == 6.2);
  CHECK(case_file.output.checkpoint.every == 120);
  CHECK_FALSE(case_file.output.checkpoint.adapts);
  REQUIRE(case_file.warnings.size() == 1);
  CHECK_THAT(case_file.warnings[0], Contains("poisson_ratio: 0.495 is above 0.49"));
}

TEST_CASE("A case of many sections is understood, and models that do not exist are refused in it", "[io]")
{
  const std::string text = R"(schema: seismpm-case/1
name: gaussian-slope
grid: {spacing: 0.25 m, particles_per_cell: 3}      # per direction
domain: {x: [0 m, 140 m], bottom: 0 m}
surfaces:
  rockhead: {points: [[0 m, 25 m], [50 m, 25 m], [140 m, 10 m]]}
  ground:   {offset: rockhead, up: 10 m}
regions:
  - {material: soil, above: rockhead, below: ground}
  - {material: rock, below: rockhead}
materials:
  rock: {model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}
  soil:
    model: von_mises
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.35
    strength: {peak: 70 kPa, residual: 39 kPa}
    softening: {displacement: 0.2 m}
  slide:
    model: morh_coulomb
    friction_angle: {peak: 38.5 deg, residual: 18.9 deg}
seismic:
  duration: 40 s
  base: {kind: compliant}
  sides: {kind: free_field}
  motion:
    recorded_as: outcrop
    horizontal: {file: records/G06-090.txt, format: column, dt: 0.005 s, unit: g, quantity: acceleration, scale: 1.0}
    baseline: linear
    end: never
output:
  gauges: {every: 0.01 s, points: {crest: [50 m, 35 m], toe: [100 m, 21 m]}}
)";
  const std::string why = refusal(text);
  CHECK_THAT(why, Contains("case.yaml:21:12: materials.slide.model: is 'morh_coulomb'; must be elastic") &&
                      Contains("von_mises"));
  CHECK(std::count(why.begin(), why.end(), '\n') == 2); // exit code, one problem

  const Case case_file =
      load(text, {"materials.slide={model: elastic, density: 1 t/m3, young_modulus: 1 GPa, "
                  "poisson_ratio: 0.2}"});
  CHECK_THAT(case_file.warnings.at(0),
             Contains("surfaces.rockhead: rises or falls by") && Contains("of the right side"));
}

TEST_CASE("The slope's profile 'paper' has the cells and particles of the paper", "[io]")
{
  const Case paper = load_case(std::filesystem::path(SOURCE_DIR) / "cases/slope/case.yaml", {}, "paper");
  CHECK(paper.grid.spacing == 0.25);
  CHECK(paper.grid.particles_per_cell == 3);
}

TEST_CASE("A within motion is refused with the reason, and recorded_as has no default", "[io]")
{
  const std::string shaken =
      small + "seismic:\n  duration: 1 s\n  motion:\n    horizontal: built_in\n    recorded_as: within\n";
  CHECK_THAT(refusal(shaken),
             Contains("case.yaml:18:18: seismic.motion.recorded_as: 'within' is not possible: ") &&
                 Contains("downgoing wave"));
  CHECK_THAT(refusal(replaced(shaken, "    recorded_as: within\n", "")),
             Contains("case.yaml:16:3: seismic.motion.recorded_as: is missing"));
  CHECK_THAT(refusal(replaced(shaken, "built_in", "a.AT2")),
             Contains("case.yaml:17:17: seismic.motion.horizontal: is 'a.AT2'; must be built_in, or a map as "
                      "{file: a.AT2}"));
  CHECK_THAT(refusal(replaced(shaken, "    horizontal: built_in\n", "")),
             Contains("seismic.motion: has no record; give horizontal, vertical or both"));
  CHECK_THAT(refusal(shaken + "    end: newer\n"), Contains("did you mean 'never'?"));
  CHECK_THAT(refusal(shaken + "  sides: {kind: freefield}\n"),
             Contains("seismic.sides.kind: is 'freefield'; must be free_field, quiet or roller; did you mean "
                      "'free_field'?"));
  CHECK(load(replaced(shaken, "within", "outcrop\n    end: self_driven")).seismic.motion.end ==
        MotionEnd::self_driven);
}

TEST_CASE("The paper's transfer has no filter unless the case asks for one", "[io]")
{
  const std::string shaken = small + "seismic:\n  duration: 1 s\n  transfer: apic\n";
  CHECK(load(shaken).seismic.transfer == Transfer::apic);
  CHECK(load(shaken).seismic.filter.time == 0);
  CHECK(load(shaken).seismic.filter.strain == 0);
  CHECK(load(shaken + "  filter: {strain: 0.01}\n").seismic.filter.strain == 0.01);
}

TEST_CASE("Interfaces are averaged and inertia is consistent unless the case says otherwise", "[io]")
{
  const std::string shaken = small + "seismic:\n  duration: 1 s\n";
  const Case usual = load(shaken);
  CHECK(usual.grid.interfaces == Interfaces::averaged);
  CHECK(usual.seismic.inertia == Inertia::consistent);
  CHECK(load(shaken + "  inertia: lumped\n").seismic.inertia == Inertia::lumped);
  CHECK(usual.seismic.rest_below == 0);
  CHECK(load(shaken + "  rest_below: 1 mm/s\n").seismic.rest_below == Approx(1e-3));
  CHECK(load(replaced(shaken, "grid: {", "grid: {interfaces: sharp, ")).grid.interfaces == Interfaces::sharp);
  CHECK_THAT(refusal(shaken + "  inertia: lumpd\n"),
             Contains("must be lumped or consistent; did you mean 'lumped'?"));
}

TEST_CASE("What counts as slid is 1 m and 10 m2 unless the case says otherwise", "[io]")
{
  const SlideSettings usual = load(small).output.slide;
  CHECK(usual.moved == 1);
  CHECK(usual.area == 10);
  CHECK(usual.out_of_place() == 0.1);
  const SlideSettings laboratory =
      load(small + "output: {slide: {moved: 1 cm, area: 50 cm2}}\n").output.slide;
  CHECK(laboratory.moved == 0.01);
  CHECK(laboratory.area == Approx(0.005));
  CHECK_THAT(refusal(small, {"output.slide.moved=0 m"}),
             Contains("output.slide.moved") && Contains("above 0"));
  CHECK_THAT(refusal(small, {"output.slide.moved=-1 m"}), Contains("above 0"));
  CHECK_THAT(refusal(small, {"output.slide.area=0 m2"}), Contains("above 0"));
  CHECK_THAT(refusal(small, {"output.slide.area=10 m"}),
             Contains("output.slide.area: 'm' is no unit of area; units: m2 or cm2"));
  CHECK_THAT(refusal(small, {"output.slide.moved=1"}), Contains("needs a unit: write '1 m'"));
}

TEST_CASE("Mohr-Coulomb and slip weakening are read from their tables", "[io]")
{
  const Case case_file = load(landslide);
  const auto& mass = std::get<MohrCoulomb>(case_file.materials[0].law);
  CHECK(mass.friction_peak == Approx(38.5 * std::numbers::pi / 180));
  CHECK(mass.cohesion_residual == 0);
  CHECK(mass.softening_strain == Approx(1.7 / (std::sqrt(3.0) * 3 * 2)));
  CHECK(mass.dilation == 0);
  const auto& zone = std::get<SlipWeakening>(case_file.materials[1].law);
  CHECK(zone.friction_residual == 0.07);
  CHECK(zone.match == SlipWeakening::plane);
  REQUIRE(case_file.warnings.size() == 1);
  CHECK_THAT(case_file.warnings[0], Contains("materials.zone.thickness: 4 m is 2 cells"));
  CHECK(case_file.output.frames.fields == std::vector<std::string>{"displacement", "velocity", "stress",
                                                                   "plastic_strain", "opening", "dissipation",
                                                                   "opening_xx", "opening_yy", "opening_xy"});
  CHECK(std::get<SlipWeakening>(load(replaced(landslide, "    match: plane\n", "")).materials[1].law).match ==
        SlipWeakening::mc);
}

TEST_CASE("A record that is missing is told with where it can be had", "[io]")
{
  const Case case_file = load(small + R"(seismic:
  duration: 1 s
  motion:
    recorded_as: outcrop
    horizontal: {file: records/none.AT2, origin: "the archive, record 7"}
)");
  CHECK(case_file.seismic.motion.horizontal->record.origin == "the archive, record 7");
  try
  {
    read_record(case_file.seismic.motion.horizontal->record);
    FAIL("was read");
  }
  catch (const Error& error)
  {
    CHECK(error.code == exit_code::input_missing);
    CHECK_THAT(error.what(), Contains("records/none.AT2: no such file; it comes from the archive, record 7"));
  }
}

TEST_CASE("a run's length is a time, or goes with its record", "[io]")
{
  const auto seismic = [](const std::string& duration)
  { return load(small + "seismic: {duration: " + duration + "}\n").seismic; };
  CHECK(seismic("24 s").duration == 24);
  CHECK(std::isnan(seismic("24 s").after_record));
  CHECK(seismic("record").after_record == 0);
  CHECK(std::isnan(seismic("record").duration));
  for (const std::string text : {"record + 10 s", "record+10s", "record +10 s", "'record + 10 s'"})
    CHECK(seismic(text).after_record == 10);
  CHECK(seismic("record + 1 min").after_record == 60);
  CHECK(load(small + "seismic: {duration: 1 s}\n", {"seismic.duration=record + 2 s"}).seismic.after_record ==
        2);
  for (const std::string text :
       {"record 10 s", "record - 10 s", "record + 10", "record + -1 s", "records", "record +"})
    CHECK_THAT(refusal(small + "seismic: {duration: " + text + "}\n"),
               Contains("65\n") && Contains("seismic.duration") && Contains("'record + 10 s'"));
  CHECK_THAT(refusal(small + "seismic: {duration: record, base: {kind: fixed}}\n"), Contains("a fixed base"));
}

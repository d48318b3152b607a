#include "io/case.hpp"

#include "io/error.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

using namespace mpm;

namespace
{
/// A folder of its own for each test, removed at the end.
struct Folder
{
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("seismpm-test-case-" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }

  std::filesystem::path write(const std::string& name, const std::string& text) const
  {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
    return path / name;
  }
};

Case load(const std::string& text, const std::vector<std::string>& overrides = {},
          const std::string& profile = {})
{
  const Folder folder;
  return load_case(folder.write("case.yaml", text), overrides, profile);
}

/// The messages, without the folder; the exit code goes first.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {},
                    const std::string& profile = {})
{
  const Folder folder;
  try
  {
    load_case(folder.write("case.yaml", text), overrides, profile);
  }
  catch (const Error& error)
  {
    std::string all = error.what();
    const std::string prefix = folder.path.string() + "/";
    for (auto at = all.find(prefix); at != std::string::npos; at = all.find(prefix))
      all.erase(at, prefix.size());
    return std::to_string(error.code) + "\n" + all + "\n";
  }
  return "accepted";
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

const std::string small = R"(schema: seismpm-case/1
grid: {spacing: 1 m}
domain: {x: [0 m, 40 m], bottom: 0 m}
surfaces:
  ground: {points: [[0 m, 10 m]]}
regions:
  - {material: soil, below: ground}
materials:
  soil:
    model: elastic
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.35
)";

using Catch::Contains;
} // namespace

TEST_CASE("A small case gets the documented defaults", "[io]")
{
  const Case scene = load(small);
  CHECK(scene.name == "case");
  CHECK(scene.text == small);
  CHECK(scene.grid.spacing == 1);
  CHECK(scene.grid.particles_per_cell == 3);
  CHECK(scene.domain.right == 40);
  CHECK(scene.statics.gravity == 9.81);
  CHECK(scene.statics.until.at_most == 60);
  CHECK(scene.seismic.duration == 0);
  CHECK(scene.seismic.sides == SideKind::free_field);
  CHECK(scene.seismic.motion.horizontal->built_in());
  CHECK_FALSE(scene.seismic.motion.vertical);
  CHECK(scene.safety == 0.5);
  CHECK(scene.output.frames.fields == std::vector<std::string>{"displacement", "velocity", "stress"});
  CHECK(scene.output.checkpoint.every == 600);
  CHECK(scene.output.checkpoint.keep == 2);
  CHECK(scene.warnings.empty());
  REQUIRE(scene.materials.size() == 1);
  CHECK(scene.materials[0].model() == "elastic");
  CHECK(scene.materials[0].elastic().young == 40e6);
  CHECK(scene.ground_height(20) == 10);
  CHECK(scene.longest_period() == Approx(4 * 10 / scene.materials[0].elastic().shear_speed()));
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
  const Folder folder;
  folder.write("profiles/rock.csv", "x, y\n# rock\n0, 8\n20, 8 # level\n40, 2\n");
  const Case scene = load_case(folder.write("case.yaml", R"(schema: seismpm-case/1
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
time_step: {safety: 0.7}
output:
  frames: {every: 1 s, fields: [velocity, plastic_strain]}
  gauges: {every: 0.02 s, points: {crest: [20 m, 12 m], foot: [40 m, 6.2 m]}}
  checkpoint: {every: 2 min, keep: 3}
)"));
  CHECK(scene.name == "full");
  CHECK(scene.grid.particle_spacing() == 0.25);
  CHECK(scene.domain.bottom == -2);
  CHECK(scene.surfaces[0].name == "ground");
  CHECK(scene.surfaces[0].height(30) == Approx(9));
  CHECK(scene.surfaces[2].height(3) == 25);
  CHECK(scene.regions[0].right == 10);
  CHECK(scene.regions[2].below == 1);
  CHECK(std::get<VonMises>(scene.materials[1].law).band_width == Approx(1.45 * 0.5));
  CHECK(scene.statics.gravity == 0);
  CHECK(scene.statics.until.at_most == 20);
  CHECK(scene.seismic.base == BaseKind::fixed);
  CHECK(scene.seismic.sides == SideKind::roller);
  const MotionSettings& motion = scene.seismic.motion;
  CHECK(motion.processing.recorded_as == RecordedAs::upgoing);
  CHECK(motion.processing.baseline == Baseline::cubic);
  CHECK(motion.processing.taper == 1);
  CHECK(motion.processing.high_pass == 0.1);
  CHECK(motion.end == MotionEnd::time);
  CHECK(motion.end_time == 12.5);
  CHECK(motion.horizontal->record.file == (folder.path / "records/a.txt").string());
  CHECK(motion.horizontal->record.dt == 0.005);
  CHECK(motion.horizontal->record.unit == "g");
  CHECK(motion.horizontal->record.quantity == Quantity::velocity);
  CHECK(motion.horizontal->scale == 1.5);
  CHECK(motion.vertical->built_in());
  CHECK(scene.output.frames.fields == std::vector<std::string>{"velocity", "plastic_strain"});
  CHECK(scene.output.gauges.points[1].name == "foot");
  CHECK(scene.output.gauges.points[1].y == 6.2);
  CHECK(scene.output.checkpoint.every == 120);
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Contains("poisson_ratio: 0.495 is above 0.49"));
}

TEST_CASE("The README's example is understood, but for the models that do not exist", "[io]")
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

  const Case scene = load(text, {"materials.slide={model: elastic, density: 1 t/m3, young_modulus: 1 GPa, "
                                 "poisson_ratio: 0.2}"});
  CHECK_THAT(scene.warnings.at(0),
             Contains("surfaces.rockhead: rises or falls by") && Contains("of the right side"));
}

TEST_CASE("An unknown key is refused with its place, the allowed keys and the nearest one", "[io]")
{
  CHECK(refusal(replaced(small, "poisson_ratio", "poison_ratio")) ==
        "65\n"
        "case.yaml:9:3: materials.soil.poisson_ratio: is missing; it has no default\n"
        "case.yaml:13:5: materials.soil.poison_ratio: unknown key 'poison_ratio'; allowed: model, density, "
        "young_modulus or poisson_ratio; did you mean 'poisson_ratio'?\n");
  CHECK_THAT(refusal(small + "tme_step: {safety: 0.5}\n"),
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

TEST_CASE("Overrides win, are recorded and are checked under their own name", "[io]")
{
  const Case scene = load(small, {"grid.spacing=0.5 m", "domain.x[1]=50 m", "regions.0.material=soil",
                                  "seismic.duration=3 s", "output.gauges.points.top=[1 m, 10 m]"});
  CHECK(scene.grid.spacing == 0.5);
  CHECK(scene.domain.right == 50);
  CHECK(scene.seismic.duration == 3);
  CHECK(scene.output.gauges.points.at(0).y == 10);
  CHECK(scene.overrides.size() == 5);
  using Setting = std::pair<std::string, std::string>;
  CHECK(scene.settings.at(1) == Setting{"grid.spacing", "0.5 m"});
  CHECK(scene.settings.at(3) == Setting{"domain.x[1]", "50 m"});
  CHECK(scene.settings.back() == Setting{"output.gauges.points.top[1]", "10 m"});

  CHECK(refusal(small, {"grid.spacng=1 m"}) ==
        "65\n--set grid.spacng=1 m: grid.spacng: unknown key 'spacng'; allowed: spacing, "
        "particles_per_cell, volume_average or interfaces; did you mean 'spacing'?\n");
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
  CHECK(soft.statics.gravity == 1);
  CHECK(soft.statics.ramp == 3);
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
        "case.yaml:17:5: grid.particle: unknown key 'particle'; allowed: spacing, particles_per_cell, "
        "volume_average or interfaces; did "
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
        "65\n--profile coarze: no such profile; the case's profiles are fine, coarse; did you mean "
        "'coarse'?\n");
  CHECK(refusal(small, {}, "fine") == "65\n--profile fine: no such profile; the case has no profiles\n");
}

TEST_CASE("The slope's profile 'paper' and its paper.yaml are one case", "[io]")
{
  const std::filesystem::path folder = std::filesystem::path(SOURCE_DIR) / "cases/slope";
  CHECK(load_case(folder / "case.yaml", {}, "paper").settings == load_case(folder / "paper.yaml").settings);
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

TEST_CASE("The share of FLIP ends when ground slides unless the case keeps it", "[io]")
{
  const std::string shaken = small + "seismic:\n  duration: 1 s\n  flip_blend: 0.9\n";
  CHECK(load(shaken).seismic.flip_ends == FlipEnds::on_slide);
  CHECK(load(shaken + "  flip_ends: never\n").seismic.flip_ends == FlipEnds::never);
  CHECK_THAT(refusal(shaken + "  flip_ends: newer\n"),
             Contains("seismic.flip_ends: is 'newer'; must be on_slide or never; did you mean 'never'?"));
}

TEST_CASE("Interfaces are sharp and inertia is lumped unless the case says otherwise", "[io]")
{
  const std::string shaken = small + "seismic:\n  duration: 1 s\n";
  const Case usual = load(shaken);
  CHECK(usual.grid.interfaces == Interfaces::sharp);
  CHECK(usual.seismic.inertia == Inertia::lumped);
  CHECK(load(shaken + "  inertia: consistent\n").seismic.inertia == Inertia::consistent);
  CHECK(usual.seismic.rest_below == 0);
  CHECK(load(shaken + "  rest_below: 1 mm/s\n").seismic.rest_below == Approx(1e-3));
  CHECK(load(replaced(shaken, "grid: {", "grid: {interfaces: averaged, ")).grid.interfaces ==
        Interfaces::averaged);
  CHECK_THAT(refusal(shaken + "  inertia: lumpd\n"),
             Contains("must be lumped or consistent; did you mean 'lumped'?"));
}

TEST_CASE("Surfaces and regions have to fit together", "[io]")
{
  const std::string circle =
      replaced(small, "{points: [[0 m, 10 m]]}",
               "{offset: a, up: 1 m}\n  a: {offset: b, up: 1 m}\n  b: {offset: a, up: 1 m}");
  CHECK(refusal(circle) == "65\n"
                           "case.yaml:6:15: surfaces.a.offset: offsets go round in a circle: a -> b -> a\n"
                           "case.yaml:7:15: surfaces.b.offset: offsets go round in a circle: b -> a -> b\n");
  CHECK_THAT(
      refusal(replaced(small, "below: ground", "below: grund")),
      Contains("case.yaml:7:29: regions[0].below: is 'grund'; must be ground; did you mean 'ground'?"));
  CHECK_THAT(refusal(replaced(small, "material: soil", "material: sand")),
             Contains("case.yaml:7:16: regions[0].material: is 'sand'; must be soil"));
  CHECK_THAT(refusal(replaced(small, ", below: ground", "")),
             Contains("case.yaml:7:5: regions[0].below: is missing"));
  CHECK_THAT(refusal(replaced(small, "[[0 m, 10 m]]", "[[5 m, 10 m], [5 m, 11 m]]")),
             Contains("surfaces.ground.points: x must grow"));
  CHECK_THAT(refusal(replaced(small, "{points:", "{file: a.csv, points:")),
             Contains("exactly one of points, offset, file or gaussian"));
  CHECK_THAT(
      refusal(replaced(small, "[0 m, 40 m]", "[0 m, 40.3 m]")),
      Contains("case.yaml:3:13: domain.x: is 40.3 m wide; must be a whole number of cells of 1 m, as 40 m"));
  CHECK_THAT(refusal(replaced(small, "[0 m, 40 m]", "[40 m, 0 m]")),
             Contains("domain.x: the right side must lie right"));
  CHECK_THAT(refusal(replaced(small, "bottom: 0 m", "bottom: 10 m")), Contains("regions: hold no ground"));
}

TEST_CASE("Odd but possible ground is warned of", "[io]")
{
  CHECK_THAT(load(small + "static: {gravity: 0 m/s2}\n",
                  {"regions=[{material: soil, below: ground}, {material: soil, below: ground}]"})
                 .warnings.at(0),
             Contains("regions[1]: holds no ground"));
  const std::string hollow = replaced(small, "  ground:", "  low: {points: [[0 m, 3 m]]}\n  ground:");
  CHECK_THAT(load(replaced(hollow, "below: ground", "above: low, below: ground")).warnings.at(0),
             Contains("leave a hollow in the ground at x = 0.5 m"));
}

TEST_CASE("A side that cuts a slope face is refused, unless it is no free-field side", "[io]")
{
  const std::string face = replaced(small, "[[0 m, 10 m]]", "[[0 m, 10 m], [37 m, 10 m], [40 m, 12 m]]");
  CHECK_THAT(refusal(face),
             Contains("case.yaml:3:13: domain.x: cuts a slope face: the ground rises or falls by 2 m within "
                      "4 m of the right side"));
  CHECK(load(face + "seismic: {duration: 1 s, sides: {kind: quiet}}\n").domain.right == 40);
  const std::string uneven = replaced(small, "[[0 m, 10 m]]", "[[0 m, 10 m], [30 m, 10 m], [40 m, 12 m]]");
  CHECK_THAT(load(uneven).warnings.at(0), Contains("wants level layers"));
}

TEST_CASE("A gauge outside the ground is refused", "[io]")
{
  const std::string text = small + "output: {gauges: {points: {up: [5 m, 10.6 m]}}}\n";
  CHECK_THAT(refusal(text), Contains("case.yaml:14:32: output.gauges.points.up: lies outside the ground, "
                                     "which reaches here from 0 m to 10 m"));
  CHECK_THAT(refusal(text, {"output.gauges.points.up=[41 m, 5 m]"}), Contains("lies beside the domain"));
  CHECK(load(text, {"output.gauges.points.up[1]=10.5 m"}).output.gauges.points.size() == 1);
}

TEST_CASE("A time step beyond the stable one is refused with the reason", "[io]")
{
  CHECK_THAT(refusal(small + "time_step: {safety: 0.8}\n"),
             Contains("case.yaml:14:21: time_step.safety: is above 0.78"));
  CHECK_THAT(refusal(small + "time_step: {safety: 0}\n"), Contains("must be above 0 and at most 1"));
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
  CHECK(refusal(text) == "66\ncase.yaml:5:18: surfaces.ground.file: no.csv cannot be read; paths are "
                         "relative to the case file\n");
  CHECK(refusal(replaced(text, "40 MPa", "40")).starts_with("65\n"));
}

TEST_CASE("A profile file with a bad row is refused with file and row", "[io]")
{
  const Folder folder;
  folder.write("p.csv", "x,y\n0,1\n1;2;3\n");
  const auto path = folder.write("case.yaml", replaced(small, "points: [[0 m, 10 m]]", "file: p.csv"));
  CHECK_THROWS_WITH(load_case(path), Contains("p.csv:3: must be two numbers"));
}

TEST_CASE("YAML that contains itself comes to an end", "[io]")
{
  CHECK_THAT(refusal("a: &a [*a]\n"), Contains("nested too deeply") || Contains("is not YAML"));
}

namespace
{
const std::string landslide = R"(schema: seismpm-case/1
grid: {spacing: 2 m}
domain: {x: [0 m, 40 m], bottom: 0 m}
surfaces:
  zone: {points: [[0 m, 10 m]]}
  ground: {points: [[0 m, 20 m]]}
regions:
  - {material: zone, below: zone}
  - {material: mass, below: ground}
materials:
  mass:
    model: mohr_coulomb
    density: 2450 kg/m3
    young_modulus: 3.6 GPa
    poisson_ratio: 0.3
    friction_angle: {peak: 38.5 deg, residual: 18.9 deg}
    cohesion: {peak: 980 kPa, residual: 0 kPa}
    softening: {displacement: 1.7 m}
  zone:
    model: slip_weakening
    density: 2450 kg/m3
    young_modulus: 1 GPa
    poisson_ratio: 0.3
    friction: {peak: 0.56, residual: 0.07}
    critical_slip: 1.7 m
    thickness: 4 m
    match: plane
)";
} // namespace

TEST_CASE("Mohr-Coulomb and slip weakening are read from their tables", "[io]")
{
  const Case scene = load(landslide);
  const auto& mass = std::get<MohrCoulomb>(scene.materials[0].law);
  CHECK(mass.friction_peak == Approx(38.5 * std::numbers::pi / 180));
  CHECK(mass.cohesion_residual == 0);
  CHECK(mass.softening_strain == Approx(1.7 / (std::sqrt(3.0) * 1.45 * 2)));
  CHECK(mass.dilation == 0);
  const auto& zone = std::get<SlipWeakening>(scene.materials[1].law);
  CHECK(zone.friction_residual == 0.07);
  CHECK(zone.match == SlipWeakening::plane);
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Contains("materials.zone.thickness: 4 m is 2 cells"));
  CHECK(scene.output.frames.fields == std::vector<std::string>{"displacement", "velocity", "stress",
                                                               "plastic_strain", "opening", "dissipation"});
  CHECK(std::get<SlipWeakening>(load(replaced(landslide, "    match: plane\n", "")).materials[1].law).match ==
        SlipWeakening::mc);
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

TEST_CASE("A record that is missing is told with where it can be had", "[io]")
{
  const Case scene = load(small + R"(seismic:
  duration: 1 s
  motion:
    recorded_as: outcrop
    horizontal: {file: records/none.AT2, origin: "the archive, record 7"}
)");
  CHECK(scene.seismic.motion.horizontal->record.origin == "the archive, record 7");
  try
  {
    read_record(scene.seismic.motion.horizontal->record);
    FAIL("was read");
  }
  catch (const Error& error)
  {
    CHECK(error.code == exit_code::input_missing);
    CHECK_THAT(error.what(), Contains("records/none.AT2: no such file; it comes from the archive, record 7"));
  }
}

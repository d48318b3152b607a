// Surfaces, regions and what stands in them.

#include "test/io/case_texts.hpp"

using namespace mpm;
using namespace mpm::test;

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

TEST_CASE("A profile file with a bad row is refused with file and row", "[io]")
{
  const TemporaryFolder folder;
  written(folder, "p.csv", "x,y\n0,1\n1;2;3\n");
  const auto path = written(folder, "case.yaml", replaced(small, "points: [[0 m, 10 m]]", "file: p.csv"));
  CHECK_THROWS_WITH(load_case(path), Contains("p.csv:3: must be two numbers"));
}

namespace
{
/// The ground of a profile file, or why it is refused.
Polyline ground_of(const std::string& profile)
{
  const TemporaryFolder folder;
  written(folder, "p.csv", profile);
  const auto path = written(folder, "case.yaml", replaced(small, "points: [[0 m, 10 m]]", "file: p.csv"));
  return std::get<Polyline>(load_case(path).surfaces[0].shape);
}
std::string ground_refusal(const std::string& profile)
{
  try
  {
    ground_of(profile);
  }
  catch (const Error& error)
  {
    CHECK(error.code == exit_code::bad_input);
    return error.what();
  }
  return "accepted";
}
} // namespace

TEST_CASE("a profile file is read in the unit of its heading", "[io]")
{
  const std::string rows = "0, 30\n100, 30\n";
  for (std::string heading : {"", "x, y\n", "x (m), y (m)\n", "# x (m), y (m)\n",
                              "Distance [m]; Elevation [m]\n", "x_m y_m\n", "# section A-A\nx y\n"})
  {
    INFO(heading);
    CHECK(ground_of(heading + rows).x == std::vector<double>{0, 100});
  }
  for (std::string heading :
       {"x (ft), y (ft)\n", "# x (ft), y (ft)\n", "x_ft, y_ft\n", "x (Feet) y (Feet)\n", "# units: ft\n",
        "# survey of 2001\n# coordinates in feet\n", "# Distance (ft), Level (ft)\n", "# ft\n", "x,y # ft\n",
        "ft, ft\n", "x; y in ft\n", "x y (ft)\n", "x/ft, y/ft\n"})
  {
    INFO(heading);
    const Polyline line = ground_of(heading + rows);
    CHECK(line.x[1] == Approx(30.48).epsilon(1e-15));
    CHECK(line.y[1] == Approx(9.144).epsilon(1e-15));
  }
  CHECK(ground_of("x (km), y (m)\n0 10\n0.05 10\r\n").x[1] == Approx(50));
  CHECK_THAT(ground_refusal("x (rods), y (m)\n" + rows), Contains("p.csv:1: states the unit 'rods'"));
  CHECK_THAT(ground_refusal("# units: rods\n" + rows), Contains("p.csv:1: states a unit that is not known"));
  CHECK_THAT(ground_refusal("# levels in ft\nx (m), y (m)\n" + rows), Contains("p.csv:3: is below"));
  CHECK_THAT(ground_refusal("# in m along x and ft in height\n" + rows),
             Contains("names the unit ft beside m"));
  CHECK_THAT(ground_refusal("# y, x\n" + rows), Contains("p.csv:1: has 'y' before 'x'"));
  CHECK_THAT(ground_refusal("x (m), depth (m)\n" + rows), Contains("p.csv:1: has depths"));
  CHECK_THAT(ground_refusal("y, x\n" + rows), Contains("p.csv:1: has 'y' before 'x'"));
}

TEST_CASE("a damaged point of a profile file is no heading", "[io]")
{
  for (std::string first : {"nan, 10", "0, nan", "O.5, 10", "0, l0", "-, 10", "0; 1O", "0,5 10,2", "0",
                            "0 10 3", "0,,10", "a, 10"})
  {
    INFO(first);
    CHECK_THAT(ground_refusal(first + "\n20, 10\n40, 10\n"), Contains("p.csv:1: "));
  }
}

TEST_CASE("a line of the ground that lies wholly beside the domain is refused", "[io]")
{
  CHECK_THAT(ground_refusal("250000, 10\n250020, 12\n250040, 10\n"),
             Contains("surfaces.ground.file: lies beside the domain, from x = 250000 m to 250040 m"));
  CHECK_THAT(refusal(replaced(small, "[[0 m, 10 m]]", "[[-50 m, 10 m], [-10 m, 12 m]]")),
             Contains("surfaces.ground.points: lies beside the domain"));
  CHECK(load(replaced(small, "[[0 m, 10 m]]", "[[-50 m, 10 m], [-10 m, 10 m]]")).domain.right == 40); // level
}

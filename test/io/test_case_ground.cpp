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

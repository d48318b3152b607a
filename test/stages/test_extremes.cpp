// Extremes of the two programs that no other test holds; cases/verification/ATLAS.md lists them all.

#include "test/stages/block.hpp"
#include "test/stages/ground.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
constexpr double height = 10, density = 2000, young = 50e6; // m, kg/m3, Pa

/// A column of elastic ground between walls, 4 m wide.
const std::string column = R"(schema: seismpm-case/1
name: column
grid: {spacing: 1 m, particles_per_cell: 2}
domain: {x: [0 m, 4 m], bottom: 0 m}
surfaces: {ground: {points: [[0 m, 10 m]]}}
regions: [{material: soil, below: ground}]
materials: {soil: {model: elastic, density: 2000 kg/m3, young_modulus: 50 MPa, poisson_ratio: 0.3}}
static: {gravity: 9.81 m/s2, ramp: 2 s}
)";

class Column
{
public:
  Column() { put(bench_ / "case.yaml", column); }
  Ending run(const std::string& out, const Arguments& settings) const
  {
    Arguments all{bench_.path("case.yaml"), "--out", bench_.path(out), "--threads", "1"};
    for (const std::string& setting : settings) all.insert(all.end(), {"--set", setting});
    return bench_.run("mpm-static", all);
  }
  /// Particles of the final state: their y, settlement and vertical stress.
  struct Row
  {
    double y, settlement, stress;
  };
  std::vector<Row> rows(const std::string& out) const
  {
    const h5::File file = open_complete(bench_ / out / "final.h5");
    const auto place = file.read_doubles("particles/position"),
               reference = file.read_doubles("particles/reference"),
               stress = file.read_doubles("particles/stress");
    std::vector<Row> all;
    for (std::size_t k = 0; 2 * k < place.size(); ++k)
      all.push_back({reference[2 * k + 1], reference[2 * k + 1] - place[2 * k + 1], stress[4 * k + 1]});
    return all;
  }

private:
  Bench bench_;
};

/// Mean settlement over the closed form's, rho g (H y - y^2 / 2) / M, of the upper half.
double settlement(const std::vector<Column::Row>& rows, double poisson)
{
  const double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  double sum = 0, exact = 0;
  for (const auto& [y, down, stress] : rows)
    if (y > 0.5 * height)
    {
      sum += down;
      exact += density * 9.81 * (height * y - y * y / 2) / modulus;
    }
  return sum / exact;
}
} // namespace

// The bounds are those of a linear closed form at a strain of 0.3 %, and of one particle a cell.
TEST_CASE("Four and ten particles a cell and a Poisson's ratio of 0.499 settle as the closed form",
          "[stages]")
{
  const Column column;
  std::map<std::string, double> found;
  for (const auto& [name, setting, poisson] :
       {std::tuple("4", "grid.particles_per_cell=4", 0.3),
        std::tuple("10", "grid.particles_per_cell=10", 0.3),
        std::tuple("nearly incompressible", "materials.soil.poisson_ratio=0.499", 0.499)})
  {
    const Ending ending = column.run(name, {setting});
    INFO(name << ": " << ending.said);
    REQUIRE(ending.code == 0);
    found[name] = settlement(column.rows(name), poisson);
  }
  CHECK(std::fabs(found["10"] - found["4"]) < 0.002);
  CHECK(std::fabs(found["nearly incompressible"] - 1) < 0.01);
}

TEST_CASE("known weakness: one particle a cell settles as the closed form, and its nodes never balance",
          "[stages]")
{
  const Column column;
  const Ending usual = column.run("usual", {"grid.particles_per_cell=1", "static.until.at_most=5 s"});
  CHECK(usual.code == 81);
  CHECK_THAT(usual.said,
             Contains("grid.particles_per_cell: with 1 there are fewer stresses than nodes to balance"));
  const Ending lax = column.run(
      "lax", {"grid.particles_per_cell=1", "static.until.unbalanced=0.05", "static.until.kinetic=1e-8"});
  INFO(lax.said);
  REQUIRE(lax.code == 0);
  CHECK(std::fabs(settlement(column.rows("lax"), 0.3) - 1) < 0.03);
}

TEST_CASE("Gravity that comes in one step, and damping of 0.99, lead to the same stresses", "[stages]")
{
  const Column column;
  REQUIRE(column.run("usual", {}).code == 0);
  const auto usual = column.rows("usual");
  for (const std::string setting : {"static.ramp=1 ms", "static.damping=0.99"})
  {
    const Ending ending = column.run(setting.substr(0, 9), {setting});
    INFO(setting << ": " << ending.said);
    REQUIRE(ending.code == 0);
    const auto rows = column.rows(setting.substr(0, 9));
    double difference = 0;
    for (std::size_t k = 0; k < rows.size(); ++k)
      difference = std::max(difference, std::fabs(rows[k].stress - usual[k].stress));
    CHECK(difference < 1e-3 * density * 9.81 * height);
  }
  const Ending none = column.run("none", {"static.damping=1"});
  CHECK(none.code == 65);
  CHECK_THAT(none.said, Contains("static.damping"));
}

TEST_CASE("Gravity of a millionth and of a hundred times the earth's strains ground in proportion",
          "[stages]")
{
  const Column column;
  REQUIRE(column.run("earth", {}).code == 0);
  const double usual = settlement(column.rows("earth"), 0.3);
  for (const double factor : {1e-7, 100.0})
  {
    const std::string out = fmt::format("{}", factor);
    const Ending ending = column.run(out, {fmt::format("static.gravity={} m/s2", 9.81 * factor)});
    INFO(factor << ": " << ending.said);
    REQUIRE(ending.code == 0);
    CHECK(settlement(column.rows(out), 0.3) / factor == Approx(usual).epsilon(factor > 1 ? 0.25 : 0.01));
  }
}

TEST_CASE("A motion of 5 and of 50 g at 20 Hz moves elastic ground in proportion, and clay to finite places",
          "[stages]")
{
  const Block block;
  put(block / "shake.txt", sine(49, 20));
  const auto peak = [&](const std::string& out)
  {
    double most = 0;
    for (const double v : open_complete(block / out / "history.h5").read_doubles("gauges/velocity"))
      most = std::max(most, std::fabs(v));
    return most;
  };
  for (const auto& [out, scale] : {std::pair("small", "1e-3"), std::pair("5g", "1"), std::pair("50g", "10")})
  {
    const Ending ending = block.run(out, {"--scale", scale});
    INFO(ending.said);
    REQUIRE(ending.code == 0);
  }
  CHECK(peak("5g") == Approx(1e3 * peak("small")).epsilon(0.01));
  CHECK(peak("50g") == Approx(1e4 * peak("small")).epsilon(0.1));
  const Ending clay = block.run("clay", {"--scale", "10", "--set", "materials.rock.model=von_mises", "--set",
                                         "materials.rock.strength={peak: 50 kPa}"});
  INFO(clay.said);
  REQUIRE(clay.code == 0);
  CHECK(std::isfinite(peak("clay")));
}

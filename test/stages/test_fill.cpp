#include "solver/stages/fill.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace mpm;

namespace
{
/// Ground of one material under a surface.
Case hill_case(Surface surface, double spacing, int per_cell)
{
  Case case_file;
  case_file.grid = {.spacing = spacing, .particles_per_cell = per_cell};
  case_file.domain = {-20, 60, 0};
  case_file.surfaces = {std::move(surface)};
  case_file.materials = {{"soil", Elastic{}, {}}};
  case_file.regions = {{.material = 0, .above = {}, .below = 0}};
  return case_file;
}

double total(const Filling& filling, int material = -1)
{
  long double sum = 0; // hundreds of thousands of terms, and 1e-12 asked for
  for (const Seed& s : filling.seeds)
    if (material < 0 || s.material == material) sum += s.volume;
  return static_cast<double>(sum);
}
} // namespace

TEST_CASE("Level ground on the lattice is filled with equal particles at sub-cell centres", "[stages]")
{
  const Filling filling = fill(hill_case({"flat", Polyline{{0}, {10}}, 0}, 1, 2));
  REQUIRE(filling.seeds.size() == 80u * 10 * 4);
  CHECK(filling.seeds[0].x == -19.75);
  CHECK(filling.seeds[0].y == 0.25);
  CHECK(filling.seeds[1].y == 0.75);
  for (const Seed& s : filling.seeds) REQUIRE(s.volume == 0.25);
}

TEST_CASE("The area of a Gaussian hill is exact", "[stages]")
{
  const double h = GENERATE(1.0, 0.25);
  const int n = GENERATE(2, 3);
  const GaussianHill hill{10, 15, 20, 12, GENERATE(GaussianHill::Side::both, GaussianHill::Side::right)};
  const Filling filling = fill(hill_case({"hill", hill, 0.37}, h, n));
  const double root = 15 * 12 * std::sqrt(std::numbers::pi) / 2;
  const double half = root * std::erf(40.0 / 12);
  const double left = hill.side == GaussianHill::Side::both ? half : 15 * 40;
  const double exact = 80 * 10.37 + left + half;
  CHECK(std::abs(total(filling) / exact - 1) < 1e-12);
  CHECK(std::abs(filling.regions[0].area / exact - 1) < 1e-12);
  CHECK(filling.regions[0].lost.length == 0);
  const double d = h / n;
  for (const Seed& s : filling.seeds)
  {
    REQUIRE(s.volume >= 0.5 * d * d * (1 - 1e-9));
    REQUIRE(s.volume <= 1.5 * d * d * (1 + 1e-9));
  }
}

TEST_CASE("Every column has the mass and the centre of mass of its geometry", "[stages]")
{
  const Case case_file = hill_case({"slope", Polyline{{0, 40}, {11.13, 3.21}}, 0}, 0.5, 3);
  const Filling filling = fill(case_file);
  const double d = case_file.grid.particle_spacing();
  for (std::size_t i = 0, end; i < filling.seeds.size(); i = end)
  {
    const double x = filling.seeds[i].x;
    double volume = 0, moment = 0;
    for (end = i; end < filling.seeds.size() && filling.seeds[end].x == x; ++end)
    {
      volume += filling.seeds[end].volume;
      moment += filling.seeds[end].volume * filling.seeds[end].y;
    }
    const double mean = case_file.surfaces[0].mean_height(x - d / 2, x + d / 2);
    REQUIRE(volume == Approx(d * mean).epsilon(1e-12));
    REQUIRE(moment == Approx(d * mean * mean / 2).epsilon(1e-12));
  }
}

TEST_CASE("Each material of a layered slope has the area of its geometry", "[stages]")
{
  Case case_file = hill_case({"rockhead", Polyline{{0, 40}, {11.13, 3.21}}, 0}, 0.5, 3);
  case_file.surfaces.push_back({"ground", Polyline{{0, 40}, {11.13, 3.21}}, 2.718});
  case_file.materials.push_back({"rock", Elastic{}, {}});
  case_file.regions = {{.material = 0, .above = 0, .below = 1}, {.material = 1, .above = {}, .below = 0}};
  const Filling filling = fill(case_file);
  CHECK(total(filling, 0) == Approx(80 * 2.718).epsilon(1e-12));
  CHECK(total(filling, 1) == Approx(20 * 11.13 + 40 * (11.13 + 3.21) / 2 + 20 * 3.21).epsilon(1e-12));
}

TEST_CASE("Regions of one material are filled as one", "[stages]")
{
  Case case_file = hill_case({"ground", Polyline{{0}, {10}}, 0}, 1, 2);
  case_file.surfaces.push_back({"inside", Polyline{{0}, {3.3}}, 0});
  case_file.regions = {{.material = 0, .above = 1, .below = 0}, {.material = 0, .above = {}, .below = 1}};
  const Filling filling = fill(case_file);
  for (const Seed& s : filling.seeds) REQUIRE(s.volume == 0.25);
}

TEST_CASE("A region between two x takes its columns, first match wins", "[stages]")
{
  Case case_file = hill_case({"ground", Polyline{{0}, {10}}, 0}, 1, 2);
  case_file.materials.push_back({"block", Elastic{}, {}});
  case_file.regions = {{.material = 1, .above = {}, .below = 0, .left = 0, .right = 5},
                       {.material = 0, .above = {}, .below = 0}};
  CHECK(total(fill(case_file), 1) == Approx(50).epsilon(1e-12));
  CHECK(total(fill(case_file), 0) == Approx(750).epsilon(1e-12));
}

TEST_CASE("A layer too thin for a particle is reported as lost", "[stages]")
{
  Case case_file = hill_case({"rockhead", Polyline{{0}, {10}}, 0}, 1, 2);
  case_file.surfaces.push_back({"ground", Polyline{{0}, {10}}, GENERATE(0.2, 0.24999, 0.25001)});
  case_file.materials.push_back({"skin", Elastic{}, {}});
  case_file.regions = {{.material = 1, .above = 0, .below = 1}, {.material = 0, .above = {}, .below = 0}};
  const Filling filling = fill(case_file);
  const double area = 80 * case_file.surfaces[1].up;
  CHECK(drawn_regions(case_file)[0].area == Approx(area).epsilon(1e-9));
  CHECK(drawn_regions(case_file)[0].length == Approx(80).epsilon(1e-9));
  const bool lost = case_file.surfaces[1].up < 0.25;
  CHECK(total(filling, 1) == Approx(lost ? 0 : area).epsilon(1e-9));
  CHECK(filling.regions[0].area == Approx(lost ? 0 : area).epsilon(1e-9));
  CHECK(filling.regions[0].lost.length == Approx(lost ? 80 : 0));
  CHECK(filling.regions[0].filled.length == Approx(lost ? 0 : 80));
}

TEST_CASE("Surfaces have their exact mean over any stretch", "[stages]")
{
  const Surface line{"line", Polyline{{0, 1, 3}, {0, 2, 1}}, 1};
  CHECK(line.mean_height(-2, 5) == Approx(1 + (0 + 1 + 3 + 2) / 7.0));
  CHECK(line.mean_height(0.5, 0.75) == Approx(1 + 1.25));
  CHECK(line.mean_height(1, 2) == Approx(1 + 1.75));
  const Surface hill{"hill", GaussianHill{1, 2, 3, 4, GaussianHill::Side::left}, 0};
  double sum = 0;
  for (int i = 0; i < 10000; ++i) sum += hill.height(-5 + (i + 0.5) * 1e-3);
  CHECK(hill.mean_height(-5, 5) == Approx(sum / 10000).epsilon(1e-8));
}

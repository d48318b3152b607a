// The frames of a run.

#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <numeric>

using namespace mpm;
using namespace mpm::test;

TEST_CASE("rows of the frames of a run are the same particles at all times", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("a").code == 0);
  const h5::File state = open_complete(bench / "a/final.h5");
  const auto id = state.read_ints("particles/id");
  std::vector<std::size_t> order(id.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return id[a] < id[b]; });
  REQUIRE_FALSE(std::is_sorted(id.begin(), id.end())); // the solver has an order of its own

  const h5::File first = open_complete(bench / "a/frame-00000.hdf");
  const h5::File last = open_complete(bench / "a/frame-00012.hdf");
  const auto ids = last.read_ints("particles/id");
  CHECK(first.read_ints("particles/id") == ids);
  CHECK(std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end());
  CHECK(last.read_strings("material_names") == std::vector<std::string>{"rock", "clay"});
  CHECK(first.read_ints("particles/material") == last.read_ints("particles/material"));

  const auto position = state.read_doubles("particles/position"),
             stress = state.read_doubles("particles/stress");
  const auto points = last.read_doubles("particles/position"), p = last.read_doubles("particles/p"),
             q = last.read_doubles("particles/q"), xy = last.read_doubles("particles/stress_xy");
  int wrong = 0;
  for (std::size_t k = 0; k < ids.size(); ++k)
  {
    const double* s = &stress[4 * order[k]];
    const double mean = -(s[0] + s[1] + s[2]) / 3;
    const double mises = std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) +
                                          std::pow(s[2] - s[0], 2) + 6 * s[3] * s[3]));
    const auto is = [](double stored, double wanted) { return stored == Approx(wanted).epsilon(1e-6); };
    const bool right = id[order[k]] == ids[k] && is(points[3 * k], position[2 * order[k]]) &&
                       is(points[3 * k + 1], position[2 * order[k] + 1]) && is(p[k], mean) &&
                       is(q[k], mises) && is(xy[k], s[3]);
    wrong += right ? 0 : 1;
  }
  CHECK(wrong == 0);
}

#include "io/results/history.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace mpm;
using namespace mpm::test;

namespace
{
const Axis component{"component", {"x", "y"}};

/// Two gauges and an energy on one clock, the free field on a slower one.
struct Example
{
  History history;
  History::Clock slow;
  History::Series velocity, kinetic, column;

  explicit Example(std::vector<std::string> gauges = {"crest", "Böschungsfuß"})
  {
    slow = history.add_clock();
    velocity = history.add_series("/gauges/velocity", "m/s", {{"gauge", gauges}, component});
    kinetic = history.add_series("/energy/kinetic", "J");
    column = history.add_series("/free_field/left/surface_velocity", "m/s", {component}, slow);
  }

  void run(int from, int to)
  {
    for (int i = from; i < to; ++i)
    {
      history.start_row(0.01 * i);
      history.record(velocity, std::array{1.0 * i, 2.0 * i, 3.0 * i, 4.0 * i});
      history.record(kinetic, 0.5 * i);
      if (i % 2 != 0) continue;
      history.start_row(0.01 * i, slow);
      history.record(column, std::array{-1.0 * i, 0.0});
    }
  }
};
} // namespace

TEST_CASE("series come back with their shape, axes and units", "[io]")
{
  const TemporaryFolder folder;
  Example example;
  example.run(0, 5);
  example.history.write(folder / "history.h5", {});

  const h5::File file = open_complete(folder / "history.h5");
  CHECK(file.shape("gauges/velocity") == std::vector<hsize_t>{5, 2, 2});
  CHECK(file.read_doubles("gauges/velocity")[4 * 4 + 3] == 16);
  CHECK(file.read_strings("gauges/gauge") == std::vector<std::string>{"crest", "Böschungsfuß"});
  CHECK(file.read_strings("gauges/component") == component.labels);
  CHECK(file.attribute_string("units", "gauges/velocity") == "m/s");
  CHECK(file.read_doubles("energy/time").size() == 5);
  CHECK(file.shape("energy/kinetic") == std::vector<hsize_t>{5});
  CHECK(file.read_doubles("free_field/left/time") == std::vector<double>{0, 0.02, 0.04});
}

TEST_CASE("every dimension of a series has its scale, as xarray needs", "[io]")
{
  const TemporaryFolder folder;
  Example example;
  example.run(0, 2);
  example.history.write(folder / "history.h5", {});
  const h5::File file = open_complete(folder / "history.h5");
  CHECK(file.has_attribute("DIMENSION_LIST", "gauges/velocity"));
  for (const char* scale : {"gauges/time", "gauges/gauge", "gauges/component", "energy/time"})
  {
    CHECK(file.attribute_string("CLASS", scale) == "DIMENSION_SCALE");
    CHECK(file.attribute_string("NAME", scale) == std::filesystem::path(scale).filename());
  }
}

TEST_CASE("a history resumed from a checkpoint has no gap and no double", "[io]")
{
  const TemporaryFolder folder;
  Example whole, first, second;
  whole.run(0, 10);
  first.run(0, 6);
  write_file_atomically(folder / "checkpoint.h5",
                        [&](h5::File& file)
                        {
                          h5::Group group = file.create_group("history");
                          first.history.save(group);
                        });
  second.history.load(open_complete(folder / "checkpoint.h5").open_group("history"));
  CHECK(second.history.rows() == 6);
  second.run(6, 10);
  CHECK(second.history.times() == whole.history.times());
  CHECK(second.history.times(second.slow) == whole.history.times(whole.slow));
  CHECK(second.history.values(second.velocity) == whole.history.values(whole.velocity));
  CHECK(second.history.values(second.column) == whole.history.values(whole.column));
}

TEST_CASE("a history of other gauges is refused and leaves the own one alone", "[io]")
{
  const TemporaryFolder folder;
  Example theirs({"crest", "toe"}), ours;
  theirs.run(0, 4);
  theirs.history.write(folder / "history.h5", {});
  CHECK(code_of([&] { ours.history.load(open_complete(folder / "history.h5")); }) == exit_code::bad_input);
  CHECK(ours.history.rows() == 0);
}

TEST_CASE("a history without rows or gauges is written and read", "[io]")
{
  const TemporaryFolder folder;
  const std::vector<std::string> none;
  Example empty(none), again(none);
  empty.history.write(folder / "history.h5", {});
  again.history.load(open_complete(folder / "history.h5"));
  CHECK(again.history.rows() == 0);
}

TEST_CASE("a row at a time already recorded is refused", "[io]")
{
  Example example;
  example.run(0, 3);
  CHECK(code_of([&] { example.history.start_row(0.02); }) == exit_code::bug);
}

TEST_CASE("a value left out of a row reads NaN", "[io]")
{
  Example example;
  example.history.start_row(0);
  example.history.start_row(1);
  example.history.record(example.kinetic, 2);
  CHECK(std::isnan(example.history.values(example.kinetic)[0]));
  CHECK(example.history.values(example.kinetic)[1] == 2);
}

TEST_CASE("two series of one group cannot disagree about its axes or clock", "[io]")
{
  Example example;
  auto& history = example.history;
  CHECK(code_of([&] { history.add_series("gauges/a", "m", {{"gauge", {"toe"}}}); }) == exit_code::bug);
  CHECK(code_of([&] { history.add_series("gauges/b", "m", {}, example.slow); }) == exit_code::bug);
  CHECK(code_of([&] { history.add_series("gauges/velocity", "m/s"); }) == exit_code::bug);
  CHECK(code_of([&] { history.add_series("lonely", "m"); }) == exit_code::bug);
}

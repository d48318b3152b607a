#include "io/results/frames.hpp"
#include "test/read_json.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

namespace
{
Frame three_particles()
{
  Frame frame;
  frame.time = 12.5;
  frame.step = 61000;
  frame.points = {0, 0, 0, 1.5, 0, 0, 3, 0.25, 0};
  frame.fields = {{"velocity", "m/s", 2, {1, 2, 3, 4, 5, 6}}, {"plastic_strain", "1", 1, {0, 0.5, 1}}};
  frame.ids = {7, 8, 9};
  frame.materials = {0, 0, 1};
  return frame;
}
} // namespace

TEST_CASE("a frame is a VTKHDF 1.0 grid with one vertex a particle", "[io]")
{
  const TemporaryFolder folder;
  write_frame(folder / frame_name(3), three_particles(), {});
  const h5::File file = open_complete(folder / "frame-00003.hdf");
  const h5::Group grid = file.open_group("VTKHDF");
  CHECK(grid.attribute_ints("Version") == std::vector<std::int64_t>{1, 0});
  CHECK(grid.attribute_string("Type") == "UnstructuredGrid");
  CHECK(grid.read_ints("NumberOfPoints") == std::vector<std::int64_t>{3});
  CHECK(grid.read_ints("NumberOfCells") == std::vector<std::int64_t>{3});
  CHECK(grid.read_ints("NumberOfConnectivityIds") == std::vector<std::int64_t>{3});
  CHECK(grid.read_ints("Connectivity") == std::vector<std::int64_t>{0, 1, 2});
  CHECK(grid.read_ints("Offsets") == std::vector<std::int64_t>{0, 1, 2, 3});
  CHECK(grid.read_ints("Types") == std::vector<std::int64_t>{1, 1, 1});
  CHECK(grid.shape("Points") == std::vector<hsize_t>{3, 3});
  CHECK(grid.shape("PointData/velocity") == std::vector<hsize_t>{3, 2});
}

TEST_CASE("a frame gives its fields under plain names with units", "[io]")
{
  const TemporaryFolder folder;
  const Frame frame = three_particles();
  write_frame(folder / "a.hdf", frame, {});
  const h5::File file = open_complete(folder / "a.hdf");
  CHECK(file.attribute_double("time") == frame.time);
  CHECK(file.attribute_int("step") == frame.step);
  const h5::Group particles = file.open_group("particles");
  CHECK(particles.children() ==
        std::vector<std::string>{"component", "id", "material", "plastic_strain", "position", "velocity"});
  CHECK(particles.read_strings("component") == std::vector<std::string>{"x", "y", "z"});
  CHECK(particles.read_doubles("velocity") == frame.fields[0].values);
  CHECK(particles.attribute_string("units", "velocity") == "m/s");
  CHECK(particles.read_ints("id") == frame.ids);
}

TEST_CASE("a frame is in the order of its ids, which are its points' global ids", "[io]")
{
  const TemporaryFolder folder;
  Frame frame = three_particles();
  frame.ids = {42, 7, 9};
  frame.materials = {2, 0, 1};
  write_frame(folder / "a.hdf", frame, {});
  const h5::File file = open_complete(folder / "a.hdf");
  const h5::Group particles = file.open_group("particles");
  CHECK(particles.read_ints("id") == std::vector<std::int64_t>{7, 9, 42});
  CHECK(particles.read_ints("material") == std::vector<std::int64_t>{0, 1, 2});
  CHECK(particles.read_doubles("position") == std::vector<double>{1.5, 0, 0, 3, 0.25, 0, 0, 0, 0});
  CHECK(particles.read_doubles("velocity") == std::vector<double>{3, 4, 5, 6, 1, 2});
  CHECK(particles.read_doubles("plastic_strain") == std::vector<double>{0.5, 1, 0});
  const h5::Group data = file.open_group("VTKHDF/PointData");
  CHECK(data.attribute_string("Attribute", "id") == "GlobalIds");
  CHECK(data.attribute_string("GlobalIds") == "id");
}

TEST_CASE("a frame names materials and components", "[io]")
{
  const TemporaryFolder folder;
  Frame frame = three_particles();
  frame.material_names = {"clay", "Löss"};
  frame.fields.push_back(
      {"stress", "Pa", 4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, {"xx", "yy", "zz", "xy"}});
  frame.fields.push_back({"p", "Pa", 1, {1, 2, 3}});
  write_frame(folder / "a.hdf", frame, {});
  const h5::File file = open_complete(folder / "a.hdf");
  CHECK(file.read_strings("material_names") == frame.material_names);
  CHECK(file.read_strings("VTKHDF/FieldData/material_names") == frame.material_names);
  const h5::Group particles = file.open_group("particles");
  CHECK(particles.attribute_string("names", "material") == "clay Löss");
  CHECK(particles.read_doubles("stress") == frame.fields[2].values);
  CHECK(particles.attribute_string("components", "stress") == "xx yy zz xy");
  CHECK(particles.read_doubles("stress_yy") == std::vector<double>{2, 6, 10});
  CHECK(particles.read_doubles("stress_xy") == std::vector<double>{4, 8, 12});
  CHECK(particles.attribute_string("units", "stress_xy") == "Pa");
  CHECK_THAT(particles.attribute_string("long_name", "p"), Catch::Matchers::Contains("compression positive"));
}

TEST_CASE("a field that does not fit its particles is refused", "[io]")
{
  const TemporaryFolder folder;
  Frame frame = three_particles();
  frame.fields[1].values.pop_back();
  CHECK(code_of([&] { write_frame(folder / "a.hdf", frame, {}); }) == exit_code::bug);
  CHECK_FALSE(std::filesystem::exists(folder / "a.hdf"));
}

TEST_CASE("a frame without particles is a valid file", "[io]")
{
  const TemporaryFolder folder;
  write_frame(folder / "a.hdf", {}, {});
  CHECK(open_complete(folder / "a.hdf").shape("particles/position") == std::vector<hsize_t>{0, 3});
}

TEST_CASE("the series file names every frame with its time", "[io]")
{
  const TemporaryFolder folder;
  write_series(folder.path(), {{frame_name(0), 0.0}, {frame_name(1), 0.5}});
  const auto series = read_json(folder / "frames.hdf.series");
  CHECK(series["file-series-version"] == "1.0");
  CHECK(series["files"].size() == 2);
  CHECK(series["files"][1]["name"] == "frame-00001.hdf");
  CHECK(series["files"][1]["time"] == 0.5);
}

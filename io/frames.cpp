#include "io/frames.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <numeric>

namespace mpm
{
namespace
{
constexpr h5::WriteOptions small{.compress = true, .as_float = true};
constexpr std::uint8_t vtk_vertex = 1;

/// Every point is a cell of its own.
void write_vertices(h5::Group& grid, std::size_t points)
{
  std::vector<std::int64_t> offsets(points + 1);
  std::iota(offsets.begin(), offsets.end(), 0);
  const std::span<const std::int64_t> all = offsets;
  const std::array<std::int64_t, 1> count = {std::int64_t(points)};
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    grid.write(name, count, {}, "1");
  grid.write("Connectivity", all.first(points), {}, "1", small);
  grid.write("Offsets", all, {}, "1", small);
  grid.write("Types", std::vector<std::uint8_t>(points, vtk_vertex), {}, "1", small);
}

std::vector<hsize_t> shape_of(const Frame::Field& field, std::size_t points)
{
  if (field.components == 1) return {points};
  return {points, hsize_t(field.components)};
}

/// VTK wants its own layout; a second name for the same data costs nothing.
void link_plain_names(h5::File& file)
{
  file.hard_link("VTKHDF/Points", "particles/position");
  for (const auto& name : file.children("VTKHDF/PointData"))
    file.hard_link("VTKHDF/PointData/" + name, "particles/" + name);
}

void fill(h5::File& file, const Frame& frame, const Provenance& provenance)
{
  write_provenance(file, provenance, "seismpm-frame/1");
  file.attribute("time", frame.time);
  file.attribute("step", frame.step);

  const std::size_t points = frame.points.size() / 3;
  h5::Group grid = file.create_group("VTKHDF");
  grid.attribute("Version", std::vector<std::int64_t>{1, 0});
  grid.attribute_ascii("Type", "UnstructuredGrid");
  grid.write("Points", frame.points, {points, 3}, "m", small);
  write_vertices(grid, points);
  grid.write("FieldData/TimeValue", std::array{frame.time}, {}, "s");

  h5::Group data = grid.create_group("PointData");
  for (const auto& field : frame.fields)
    data.write(field.name, field.values, shape_of(field, points), field.unit, small);
  if (!frame.ids.empty()) data.write("id", frame.ids, {points}, "1", small);
  if (!frame.materials.empty()) data.write("material", frame.materials, {points}, "1", small);
  link_plain_names(file);
}
} // namespace

std::string frame_name(std::int64_t number)
{
  return fmt::format("frame-{:05}.hdf", number);
}

std::string write_frame(const std::filesystem::path& path, const Frame& frame, const Provenance& provenance)
{
  return write_file_atomically(path, [&](h5::File& file) { fill(file, frame, provenance); });
}

void write_series(const std::filesystem::path& folder,
                  const std::vector<std::pair<std::string, double>>& frames)
{
  auto files = nlohmann::ordered_json::array();
  for (const auto& [name, time] : frames) files.push_back({{"name", name}, {"time", time}});
  const nlohmann::ordered_json series = {{"file-series-version", "1.0"}, {"files", files}};
  write_text_atomically(folder / "frames.hdf.series", series.dump(1) + "\n");
}
} // namespace mpm

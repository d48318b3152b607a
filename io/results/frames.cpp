#include "io/results/frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace mpm
{
namespace
{
// For pictures 7 digits are enough; the state in full precision is in the checkpoints.
constexpr h5::WriteOptions small{.compress = true, .as_float = true};
// VTK_VERTEX of vtkCellType.h
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

/// Indices of the particles in the order of their ids.
std::vector<std::size_t> order_of(const Frame& frame, std::size_t points)
{
  std::vector<std::size_t> order(points);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (frame.ids.size() == points)
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return frame.ids[a] < frame.ids[b]; });
  return order;
}

/// Rows of `width` values each, put in order. What has another size is left as it is, to be refused.
template <class T>
std::vector<T> ordered(const std::vector<T>& values, const std::vector<std::size_t>& order, std::size_t width)
{
  if (values.size() != order.size() * width) return values;
  std::vector<T> result;
  result.reserve(values.size());
  for (const std::size_t k : order)
    result.insert(result.end(), values.begin() + k * width, values.begin() + (k + 1) * width);
  return result;
}

/// A field in the order of the ids, and each of its named components as a field of its own.
void write_field(h5::Group& data, const Frame::Field& field, const std::vector<std::size_t>& order)
{
  const std::size_t points = order.size(), width = field.components;
  const std::vector<double> values = ordered(field.values, order, width);
  std::vector<hsize_t> shape{points};
  if (width > 1) shape.push_back(width);
  data.write(field.name, values, shape, field.unit, small);
  if (field.component_names.empty()) return;
  data.attribute("components", fmt::format("{}", fmt::join(field.component_names, " ")), field.name);
  for (std::size_t c = 0; c < width; ++c)
  {
    std::vector<double> one(points);
    for (std::size_t k = 0; k < points; ++k) one[k] = values[k * width + c];
    data.write(field.name + "_" + field.component_names[c], one, {points}, field.unit, small);
  }
}

/// VTK has global ids as an attribute of the array (from 9.4 on) or of its group.
void write_ids(h5::Group& data, const std::vector<std::int64_t>& ids)
{
  data.write("id", ids, {ids.size()}, "1", small);
  data.attribute_ascii("Attribute", "GlobalIds", "id");
  data.attribute_ascii("GlobalIds", "id");
}

// ParaView colours by number; the names stand beside it as field data, and in an attribute for people.
void write_materials(h5::Group& grid, h5::Group& data, const std::vector<std::int64_t>& materials,
                     const std::vector<std::string>& names)
{
  data.write("material", materials, {materials.size()}, "1", small);
  if (names.empty()) return;
  data.attribute("names", fmt::format("{}", fmt::join(names, " ")), "material");
  grid.write_strings_for_vtk("FieldData/material_names", names);
}

/// VTK wants its own layout; a second name for the same data costs nothing.
void link_plain_names(h5::File& file)
{
  file.hard_link("VTKHDF/Points", "particles/position");
  for (const auto& name : file.children("VTKHDF/PointData"))
    file.hard_link("VTKHDF/PointData/" + name, "particles/" + name);
  if (file.exists("VTKHDF/FieldData/material_names"))
    file.hard_link("VTKHDF/FieldData/material_names", "material_names");
}

/// Ids and the names of components are the axes, by which readers of netCDF-4 know the dimensions.
void name_axes(h5::File& file, const Frame& frame)
{
  if (frame.ids.empty()) return;
  const auto attach = [&](const std::string& name, const std::vector<std::string>& components)
  {
    const std::string axis = components.size() == 3 ? "component" : name + "_component";
    file.attach_scale("particles/" + name, "particles/id", 0);
    if (components.empty()) return;
    if (!file.exists("particles/" + axis)) file.write_strings("particles/" + axis, components);
    file.attach_scale("particles/" + name, "particles/" + axis, 1);
  };
  const std::vector<std::string> vector{"x", "y", "z"};
  attach("position", vector);
  if (!frame.materials.empty()) attach("material", {});
  for (const auto& field : frame.fields)
  {
    attach(field.name, field.components == 3 ? vector : field.component_names);
    for (const auto& component : field.component_names) attach(field.name + "_" + component, {});
  }
}

/// Everything that a frame holds, under the names of VTKHDF and under plain ones.
void fill(h5::File& file, const Frame& frame, const Provenance& provenance)
{
  write_provenance(file, provenance, "seismpm-frame/1");
  file.attribute("time", frame.time);
  file.attribute("step", frame.step);

  const std::size_t points = frame.points.size() / 3;
  const std::vector<std::size_t> order = order_of(frame, points);
  h5::Group grid = file.create_group("VTKHDF");
  grid.attribute("Version", std::vector<std::int64_t>{1, 0});
  grid.attribute_ascii("Type", "UnstructuredGrid");
  grid.write("Points", ordered(frame.points, order, 3), {points, 3}, "m", small);
  write_vertices(grid, points);
  grid.write("FieldData/TimeValue", std::array{frame.time}, {}, "s");

  h5::Group data = grid.create_group("PointData");
  for (const auto& field : frame.fields) write_field(data, field, order);
  if (!frame.ids.empty()) write_ids(data, ordered(frame.ids, order, 1));
  if (!frame.materials.empty())
    write_materials(grid, data, ordered(frame.materials, order, 1), frame.material_names);
  link_plain_names(file);
  name_axes(file, frame);
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

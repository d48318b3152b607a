// What is written is little-endian with fixed sizes, whatever the machine, and texts are UTF-8 of variable
// length, which h5py and xarray read as they are.

#include "io/results/hdf5_calls.hpp"
#include "io/results/long_names.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::h5
{
namespace
{
// The checksum is of a chunk, and a chunk is read whole: about 8 MB, so that a damaged byte is found in what
// is read and a frame of a million particles has a handful.
constexpr hsize_t chunk_elements = hsize_t(1) << 20;

/// The type of texts, of variable length.
Handle utf8_string()
{
  Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

/// Whole rows of the first dimension, about `chunk_elements` in all.
std::vector<hsize_t> chunk_shape(std::vector<hsize_t> dims)
{
  const hsize_t row = product(dims) / dims[0];
  dims[0] = std::clamp(chunk_elements / row, hsize_t(1), dims[0]);
  return dims;
}

/// Chunks with a checksum and, if asked, compression; shuffled, since neighbours share their first bytes.
Handle dataset_layout(const std::vector<hsize_t>& dims, bool compress)
{
  Handle layout = properties(H5P_DATASET_CREATE);
  if (product(dims) == 0) return layout; // nothing to guard, and a chunk cannot be empty
  const std::vector<hsize_t> chunk = chunk_shape(dims);
  H5Pset_chunk(layout.id(), int(chunk.size()), chunk.data());
  if (compress)
  {
    H5Pset_shuffle(layout.id());
    H5Pset_deflate(layout.id(), 1);
  }
  H5Pset_fletcher32(layout.id());
  return layout;
}
} // namespace

/// Numbers in memory, and the types that they have there and in the file.
struct Group::Numbers
{
  const void* data;
  std::size_t count;
  hid_t memory;
  hid_t stored;
};

void Group::write_numbers(const std::string& name, const Numbers& numbers, std::vector<hsize_t> dims,
                          std::string_view units, WriteOptions options)
{
  if (dims.empty()) dims = {numbers.count};
  if (product(dims) != numbers.count)
    throw Error(exit_code::bug, fmt::format("{}: {} values do not fill the shape [{}]", where(name),
                                            numbers.count, fmt::join(dims, ", ")));
  const Handle space = simple_space(dims);
  const Handle layout = dataset_layout(dims, options.compress);
  const Handle link = with_groups_on_the_way();
  const Handle data{written(H5Dcreate2(group_.id(), name.c_str(), numbers.stored, space.id(), link.id(),
                                       layout.id(), H5P_DEFAULT),
                            where(name)),
                    H5Dclose};
  if (numbers.count > 0)
    written(H5Dwrite(data.id(), numbers.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data), where(name));
  attribute("units", units, name);
  if (const std::string_view words = long_name_of(name); !words.empty()) attribute("long_name", words, name);
}

void Group::write(const std::string& name, std::span<const double> values, std::vector<hsize_t> dims,
                  std::string_view units, WriteOptions options)
{
  const hid_t stored = options.as_float ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
  write_numbers(name, {values.data(), values.size(), H5T_NATIVE_DOUBLE, stored}, std::move(dims), units,
                options);
}

void Group::write(const std::string& name, std::span<const std::int64_t> values, std::vector<hsize_t> dims,
                  std::string_view units, WriteOptions options)
{
  write_numbers(name, {values.data(), values.size(), H5T_NATIVE_INT64, H5T_STD_I64LE}, std::move(dims), units,
                options);
}

void Group::write(const std::string& name, std::span<const std::int32_t> values, std::vector<hsize_t> dims,
                  std::string_view units, WriteOptions options)
{
  write_numbers(name, {values.data(), values.size(), H5T_NATIVE_INT32, H5T_STD_I32LE}, std::move(dims), units,
                options);
}

void Group::write(const std::string& name, std::span<const std::uint8_t> values, std::vector<hsize_t> dims,
                  std::string_view units, WriteOptions options)
{
  write_numbers(name, {values.data(), values.size(), H5T_NATIVE_UINT8, H5T_STD_U8LE}, std::move(dims), units,
                options);
}

void Group::write_text(const std::string& name, const std::string& text)
{
  const Handle type = utf8_string();
  const Handle space{H5Screate(H5S_SCALAR), H5Sclose};
  const Handle link = with_groups_on_the_way();
  const Handle data{written(H5Dcreate2(group_.id(), name.c_str(), type.id(), space.id(), link.id(),
                                       H5P_DEFAULT, H5P_DEFAULT),
                            where(name)),
                    H5Dclose};
  const char* pointer = text.c_str();
  written(H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer), where(name));
}

void Group::write_strings(const std::string& name, const std::vector<std::string>& texts)
{
  write_texts(name, texts, utf8_string());
}

void Group::write_strings_for_vtk(const std::string& name, const std::vector<std::string>& texts)
{
  Handle type = utf8_string();
  H5Tset_cset(type.id(), H5T_CSET_ASCII);
  write_texts(name, texts, type);
}

// Texts have no checksum: HDF5 keeps those of variable length beside the dataset. The file's seal guards
// them.
void Group::write_texts(const std::string& name, const std::vector<std::string>& texts, const Handle& type)
{
  const Handle space = simple_space({texts.size()});
  const Handle link = with_groups_on_the_way();
  const Handle data{written(H5Dcreate2(group_.id(), name.c_str(), type.id(), space.id(), link.id(),
                                       H5P_DEFAULT, H5P_DEFAULT),
                            where(name)),
                    H5Dclose};
  std::vector<const char*> pointers;
  for (const auto& text : texts) pointers.push_back(text.c_str());
  if (!texts.empty())
    written(H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), where(name));
}

// The one place where attributes are made, after the name of the object that they belong to.
void Group::put_attribute(const std::string& name, const std::string& of, hid_t type, hid_t memory,
                          const Handle& space, const void* data)
{
  const std::string path = where(of) + "@" + name;
  const Handle attribute{written(H5Acreate_by_name(group_.id(), of.c_str(), name.c_str(), type, space.id(),
                                                   H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                 path),
                         H5Aclose};
  if (data) written(H5Awrite(attribute.id(), memory, data), path);
}

void Group::write_attribute(const std::string& name, std::int64_t value, const std::string& of)
{
  put_attribute(name, of, H5T_STD_I64LE, H5T_NATIVE_INT64, {H5Screate(H5S_SCALAR), H5Sclose}, &value);
}

void Group::write_attribute(const std::string& name, double value, const std::string& of)
{
  put_attribute(name, of, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {H5Screate(H5S_SCALAR), H5Sclose}, &value);
}

void Group::attribute(const std::string& name, std::string_view value, const std::string& of)
{
  const Handle type = utf8_string();
  const std::string text(value);
  const char* pointer = text.c_str();
  put_attribute(name, of, type.id(), type.id(), {H5Screate(H5S_SCALAR), H5Sclose}, &pointer);
}

void Group::attribute(const std::string& name, const char* value, const std::string& of)
{
  attribute(name, std::string_view(value), of);
}

void Group::attribute(const std::string& name, const std::vector<double>& values, const std::string& of)
{
  put_attribute(name, of, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, simple_space({values.size()}),
                values.empty() ? nullptr : values.data());
}

void Group::attribute(const std::string& name, const std::vector<std::int64_t>& values, const std::string& of)
{
  put_attribute(name, of, H5T_STD_I64LE, H5T_NATIVE_INT64, simple_space({values.size()}),
                values.empty() ? nullptr : values.data());
}

// Of fixed length and without a final zero: VTK compares the bytes.
void Group::attribute_ascii(const std::string& name, std::string_view value, const std::string& of)
{
  const Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(type.id(), value.size());
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  put_attribute(name, of, type.id(), type.id(), {H5Screate(H5S_SCALAR), H5Sclose}, value.data());
}
} // namespace mpm::h5

#pragma once
// A thin layer over the HDF5 C API: handles close themselves, every failed call throws `Error`, every
// numeric dataset carries `units` and a Fletcher-32 checksum.

#include "io/common/error.hpp"

#include <hdf5.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpm::h5
{
/// An HDF5 identifier that closes itself.
class Handle
{
public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept
  {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle()
  {
    if (id_ >= 0) close_(id_);
  }
  /// As HDF5's functions take it; negative: none.
  hid_t id() const { return id_; }

private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

struct WriteOptions
{
  bool compress = false; ///< shuffle and gzip level 1
  bool as_float = false; ///< store doubles as 32-bit floats
};

/// A group of an open file. Names are paths relative to it ("a/b"); groups on the way are created.
/// A group being written does not outlive its file.
class Group
{
public:
  Group create_group(const std::string& name);
  /// `Error` bad_input where there is none.
  Group open_group(const std::string& name) const;
  /// Whether there is a group or dataset of that name.
  bool exists(const std::string& name) const;
  /// Names of the groups and datasets in `group`, sorted.
  std::vector<std::string> children(const std::string& group = ".") const;

  /// Empty `dims` means one row of all the values. `units` is "1" for a pure number.
  void write(const std::string& name, std::span<const double>, std::vector<hsize_t> dims,
             std::string_view units, WriteOptions = {});
  void write(const std::string& name, std::span<const std::int64_t>, std::vector<hsize_t> dims,
             std::string_view units, WriteOptions = {});
  void write(const std::string& name, std::span<const std::int32_t>, std::vector<hsize_t> dims,
             std::string_view units, WriteOptions = {});
  void write(const std::string& name, std::span<const std::uint8_t>, std::vector<hsize_t> dims,
             std::string_view units, WriteOptions = {});
  /// A single text, and a list of them, in UTF-8; texts carry no units.
  void write_text(const std::string& name, const std::string& text);
  void write_strings(const std::string& name, const std::vector<std::string>&);
  /// The same bytes under the name of ASCII, as which alone VTK reads them.
  void write_strings_for_vtk(const std::string& name, const std::vector<std::string>&);

  // Reading. `Error` bad_input where a dataset is missing, of another type or damaged.

  /// Extents, the slowest first; empty for a single value.
  std::vector<hsize_t> shape(const std::string& name) const;
  /// All values in one row, the last dimension fastest; whole numbers too.
  std::vector<double> read_doubles(const std::string& name) const;
  std::vector<std::int64_t> read_ints(const std::string& name) const;
  std::string read_text(const std::string& name) const;
  std::vector<std::string> read_strings(const std::string& name) const;

  /// Attributes of the group itself, or of the object named by `of`.
  template <std::integral T>
  void attribute(const std::string& name, T value, const std::string& of = ".")
  {
    write_attribute(name, std::int64_t(value), of);
  }
  template <std::floating_point T>
  void attribute(const std::string& name, T value, const std::string& of = ".")
  {
    write_attribute(name, double(value), of);
  }
  void attribute(const std::string& name, std::string_view value, const std::string& of = ".");
  void attribute(const std::string& name, const char* value, const std::string& of = ".");
  void attribute(const std::string& name, const std::vector<double>&, const std::string& of = ".");
  void attribute(const std::string& name, const std::vector<std::int64_t>&, const std::string& of = ".");
  /// A fixed-length ASCII string, which VTK insists on.
  void attribute_ascii(const std::string& name, std::string_view value, const std::string& of = ".");

  bool has_attribute(const std::string& name, const std::string& of = ".") const;
  double attribute_double(const std::string& name, const std::string& of = ".") const;
  std::int64_t attribute_int(const std::string& name, const std::string& of = ".") const;
  std::string attribute_string(const std::string& name, const std::string& of = ".") const;
  std::vector<double> attribute_doubles(const std::string& name, const std::string& of = ".") const;
  std::vector<std::int64_t> attribute_ints(const std::string& name, const std::string& of = ".") const;

  /// A second name for a dataset.
  void hard_link(const std::string& target, const std::string& link);
  /// Makes the dataset `scale` the axis of dimension `dimension` of `dataset`, under the scale's own name.
  void attach_scale(const std::string& dataset, const std::string& scale, unsigned dimension);

  /// FILE: /path/of/name, for messages.
  std::string where(const std::string& name = "") const;

protected:
  Group() = default;
  Group(Handle group, std::string file, std::string path);
  Handle group_;

private:
  struct Numbers; ///< of any type, for the one function that writes them
  void write_texts(const std::string& name, const std::vector<std::string>&, const Handle& type);
  void write_numbers(const std::string& name, const Numbers&, std::vector<hsize_t> dims,
                     std::string_view units, WriteOptions);
  void write_attribute(const std::string& name, std::int64_t, const std::string& of);
  void write_attribute(const std::string& name, double, const std::string& of);
  void put_attribute(const std::string& name, const std::string& of, hid_t type, hid_t memory,
                     const Handle& space, const void* data);
  Handle dataset(const std::string& name) const;
  Handle open_attribute(const std::string& name, const std::string& of) const;

  std::string file_; ///< for messages
  std::string path_; ///< of this group in the file
};

/// An open file and its root group.
class File : public Group
{
public:
  /// Opens for reading, without locks.
  static File open(const std::filesystem::path&);
  /// A new file in memory; `path` serves messages only.
  static File in_memory(const std::filesystem::path&);
  /// The bytes of a file in memory, as they belong on disk. Valid until the file changes.
  std::span<const std::byte> image();

private:
  File(Handle file, Handle root, std::string name);
  Handle file_;
};
} // namespace mpm::h5

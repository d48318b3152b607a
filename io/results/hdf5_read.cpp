// Reading trusts nothing: a file that is damaged, or of another program, may claim any size, type or number
// of values, and has to end in a message that names file and dataset.

#include "io/results/hdf5_calls.hpp"

#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <new>

namespace mpm::h5
{
namespace
{
/// Dataset or attribute, seen alike.
struct Stored
{
  hid_t id;
  bool is_attribute;
  std::string where;

  Handle type() const
  {
    return {readable(is_attribute ? H5Aget_type(id) : H5Dget_type(id), where), H5Tclose};
  }
  Handle space() const
  {
    return {readable(is_attribute ? H5Aget_space(id) : H5Dget_space(id), where), H5Sclose};
  }
  /// How many values there are, each of `size` bytes at least. A file may claim any number, and memory is
  /// taken only for what it has room for: a byte for a byte, or 1032 for one where it is packed by deflate.
  std::size_t count(std::size_t size = 1) const
  {
    const hssize_t claimed = H5Sget_simple_extent_npoints(space().id());
    const double most = double(file_size()) * (is_packed() ? 1032 : 1);
    if (claimed < 0 || double(claimed) * double(size) > most)
      read_error(where, fmt::format("it claims {} values, more than the file has room for", claimed));
    return std::size_t(claimed);
  }
  hsize_t file_size() const
  {
    const Handle file{readable(H5Iget_file_id(id), where), H5Fclose};
    hsize_t size = 0;
    readable(H5Fget_filesize(file.id(), &size), where);
    return size;
  }
  bool is_packed() const
  {
    if (is_attribute) return false;
    const Handle layout{readable(H5Dget_create_plist(id), where), H5Pclose};
    unsigned flags = 0;
    std::size_t parameters = 0;
    return H5Pget_filter_by_id2(layout.id(), H5Z_FILTER_DEFLATE, &flags, &parameters, nullptr, 0, nullptr,
                                nullptr) >= 0;
  }
  void read(hid_t memory, void* out, hid_t transfer = H5P_DEFAULT) const
  {
    readable(is_attribute ? H5Aread(id, memory, out) : H5Dread(id, memory, H5S_ALL, H5S_ALL, transfer, out),
             where);
  }
};

/// Where HDF5 puts the texts of a dataset: no more of them than the file has room for, since many may be one
/// and the same in it.
struct TextMemory
{
  std::size_t left;
  std::vector<std::unique_ptr<char[]>> texts;

  /// Called from C: null where there is no memory, which ends the reading.
  static void* take(std::size_t size, void* self)
  {
    auto& memory = *static_cast<TextMemory*>(self);
    if (size > memory.left) return nullptr;
    memory.left -= size;
    return memory.texts.emplace_back(new (std::nothrow) char[size]).get();
  }
};

template <class T>
/// All values in one row; HDF5 converts them to the type `memory`. Fractions are refused where whole numbers
/// belong.
std::vector<T> numbers(const Stored& stored, hid_t memory, bool fractions_too)
{
  const H5T_class_t kind = H5Tget_class(stored.type().id());
  if (kind != H5T_INTEGER && !(fractions_too && kind == H5T_FLOAT))
    read_error(stored.where, fractions_too ? "it holds no numbers" : "it holds no whole numbers");
  std::vector<T> values(stored.count());
  if (!values.empty()) stored.read(memory, values.data());
  return values;
}

/// All texts, of variable length as this program writes them or of a fixed one as others do.
std::vector<std::string> strings(const Stored& stored)
{
  const Handle type = stored.type();
  if (H5Tget_class(type.id()) != H5T_STRING) read_error(stored.where, "it holds no text");
  const Handle space = stored.space();
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type.id()) > 0)
  {
    std::vector<char*> pointers(stored.count());
    if (pointers.empty()) return texts;
    if (stored.is_attribute && pointers.size() > 1)
      read_error(stored.where, "several texts where one belongs");
    TextMemory memory{stored.file_size(), {}};
    const Handle transfer = properties(H5P_DATASET_XFER);
    H5Pset_vlen_mem_manager(
        transfer.id(), TextMemory::take, &memory, [](void*, void*) {}, nullptr);
    stored.read(type.id(), pointers.data(), transfer.id());
    for (const char* text : pointers) texts.emplace_back(text ? text : "");
    // HDF5 has allocated the text of an attribute itself.
    if (stored.is_attribute) H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, pointers.data());
    return texts;
  }
  const std::size_t length = H5Tget_size(type.id()), count = stored.count(length);
  std::vector<char> bytes(count * length);
  if (!bytes.empty()) stored.read(type.id(), bytes.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    const char* text = bytes.data() + i * length;
    texts.emplace_back(text, strnlen(text, length));
  }
  return texts;
}

template <class T>
/// The value of what has to be a single one.
T only(const std::vector<T>& values, const std::string& where)
{
  if (values.size() != 1) read_error(where, fmt::format("{} values where one belongs", values.size()));
  return values.front();
}
} // namespace

std::vector<hsize_t> Group::shape(const std::string& name) const
{
  const Handle data = dataset(name);
  const Handle space = Stored{data.id(), false, where(name)}.space();
  std::vector<hsize_t> dims(std::size_t(H5Sget_simple_extent_ndims(space.id())));
  H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr);
  return dims;
}

std::vector<double> Group::read_doubles(const std::string& name) const
{
  const Handle data = dataset(name);
  return numbers<double>({data.id(), false, where(name)}, H5T_NATIVE_DOUBLE, true);
}

std::vector<std::int64_t> Group::read_ints(const std::string& name) const
{
  const Handle data = dataset(name);
  return numbers<std::int64_t>({data.id(), false, where(name)}, H5T_NATIVE_INT64, false);
}

std::vector<std::string> Group::read_strings(const std::string& name) const
{
  const Handle data = dataset(name);
  return strings({data.id(), false, where(name)});
}

std::string Group::read_text(const std::string& name) const
{
  return only(read_strings(name), where(name));
}

bool Group::has_attribute(const std::string& name, const std::string& of) const
{
  // Negative when the object itself is missing: then there is no attribute either.
  return H5Aexists_by_name(group_.id(), of.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

Handle Group::open_attribute(const std::string& name, const std::string& of) const
{
  const std::string path = where(of) + "@" + name;
  if (!exists(of) || !has_attribute(name, of)) read_error(path, "it is missing");
  return {readable(H5Aopen_by_name(group_.id(), of.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), path),
          H5Aclose};
}

std::vector<double> Group::attribute_doubles(const std::string& name, const std::string& of) const
{
  const Handle attribute = open_attribute(name, of);
  return numbers<double>({attribute.id(), true, where(of) + "@" + name}, H5T_NATIVE_DOUBLE, true);
}

std::vector<std::int64_t> Group::attribute_ints(const std::string& name, const std::string& of) const
{
  const Handle attribute = open_attribute(name, of);
  return numbers<std::int64_t>({attribute.id(), true, where(of) + "@" + name}, H5T_NATIVE_INT64, false);
}

double Group::attribute_double(const std::string& name, const std::string& of) const
{
  return only(attribute_doubles(name, of), where(of) + "@" + name);
}

std::int64_t Group::attribute_int(const std::string& name, const std::string& of) const
{
  return only(attribute_ints(name, of), where(of) + "@" + name);
}

std::string Group::attribute_string(const std::string& name, const std::string& of) const
{
  const Handle attribute = open_attribute(name, of);
  const std::string path = where(of) + "@" + name;
  return only(strings({attribute.id(), true, path}), path);
}
} // namespace mpm::h5

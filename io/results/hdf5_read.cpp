// Reading trusts nothing: a file that is damaged, or of another program, may claim any size, type or number
// of values, and has to end in a message that names file and dataset.

#include "io/results/hdf5_calls.hpp"

#include <cstring>
#include <fmt/format.h>

namespace mpm::h5
{
namespace
{
/// A damaged file may claim any size.
template <class T>
std::vector<T> room_for(hssize_t count, const std::string& where)
{
  try
  {
    return std::vector<T>(std::size_t(count));
  }
  catch (const std::exception&)
  {
    read_error(where, fmt::format("it claims {} values", count));
  }
}

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
  void read(hid_t memory, void* out) const
  {
    readable(is_attribute ? H5Aread(id, memory, out)
                          : H5Dread(id, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out),
             where);
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
  auto values = room_for<T>(H5Sget_simple_extent_npoints(stored.space().id()), stored.where);
  if (!values.empty()) stored.read(memory, values.data());
  return values;
}

/// All texts, of variable length as this program writes them or of a fixed one as others do.
std::vector<std::string> strings(const Stored& stored)
{
  const Handle type = stored.type();
  if (H5Tget_class(type.id()) != H5T_STRING) read_error(stored.where, "it holds no text");
  const Handle space = stored.space();
  const hssize_t count = H5Sget_simple_extent_npoints(space.id());
  std::vector<std::string> texts;
  if (count == 0) return texts;
  if (H5Tis_variable_str(type.id()) > 0)
  {
    auto pointers = room_for<char*>(count, stored.where);
    stored.read(type.id(), pointers.data());
    for (const char* text : pointers) texts.emplace_back(text ? text : "");
    // HDF5 has allocated the texts; they are copied and given back.
    H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, pointers.data());
    return texts;
  }
  const std::size_t length = H5Tget_size(type.id());
  auto bytes = room_for<char>(count * hssize_t(length), stored.where);
  stored.read(type.id(), bytes.data());
  for (hssize_t i = 0; i < count; ++i)
  {
    const char* text = bytes.data() + std::size_t(i) * length;
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
  if (!has_attribute(name, of)) read_error(path, "it is missing");
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

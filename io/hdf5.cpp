#include "io/hdf5.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <numeric>
#include <unistd.h>

namespace mpm
{
namespace fs = std::filesystem;

namespace h5
{
namespace
{
constexpr hsize_t chunk_elements = hsize_t(1) << 20;
constexpr std::size_t memory_increment = std::size_t(8) << 20;

/// What HDF5 itself says about the last failure: the innermost entry of its error stack.
std::string reason()
{
  std::string text;
  const auto innermost = [](unsigned, const H5E_error2_t* entry, void* out) -> herr_t
  {
    auto& text = *static_cast<std::string*>(out);
    if (text.empty() && entry->desc) text = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &text);
  H5Eclear2(H5E_DEFAULT);
  return text.empty() ? "HDF5 gives no reason" : text;
}

[[noreturn]] void write_error(const std::string& where)
{
  throw Error(exit_code::write_failed, fmt::format("{}: cannot write: {}", where, reason()));
}

[[noreturn]] void read_error(const std::string& where, const std::string& why)
{
  throw Error(
      exit_code::bad_input,
      fmt::format("{}: cannot read: {}; the file is damaged or of another kind, use another", where, why));
}

hid_t written(hid_t status, const std::string& where)
{
  if (status < 0) write_error(where);
  return status;
}

hid_t readable(hid_t status, const std::string& where)
{
  if (status < 0) read_error(where, reason());
  return status;
}

Handle properties(hid_t kind)
{
  return {H5Pcreate(kind), H5Pclose};
}

Handle file_access()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Handle access = properties(H5P_FILE_ACCESS);
  H5Pset_file_locking(access.id(), false, true);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V110);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_WEAK);
  return access;
}

Handle with_groups_on_the_way()
{
  Handle link = properties(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(link.id(), 1);
  return link;
}

Handle utf8_string()
{
  Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

Handle simple_space(const std::vector<hsize_t>& dims)
{
  return {H5Screate_simple(int(dims.size()), dims.data(), nullptr), H5Sclose};
}

hsize_t product(const std::vector<hsize_t>& dims)
{
  return std::accumulate(dims.begin(), dims.end(), hsize_t(1), std::multiplies{});
}

/// Whole rows of the first dimension, about `chunk_elements` in all.
std::vector<hsize_t> chunk_shape(std::vector<hsize_t> dims)
{
  const hsize_t row = product(dims) / dims[0];
  dims[0] = std::clamp(chunk_elements / row, hsize_t(1), dims[0]);
  return dims;
}

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
std::vector<T> numbers(const Stored& stored, hid_t memory, bool fractions_too)
{
  const H5T_class_t kind = H5Tget_class(stored.type().id());
  if (kind != H5T_INTEGER && !(fractions_too && kind == H5T_FLOAT))
    read_error(stored.where, fractions_too ? "it holds no numbers" : "it holds no whole numbers");
  auto values = room_for<T>(H5Sget_simple_extent_npoints(stored.space().id()), stored.where);
  if (!values.empty()) stored.read(memory, values.data());
  return values;
}

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
T only(const std::vector<T>& values, const std::string& where)
{
  if (values.size() != 1) read_error(where, fmt::format("{} values where one belongs", values.size()));
  return values.front();
}
} // namespace

struct Group::Numbers
{
  const void* data;
  std::size_t count;
  hid_t memory;
  hid_t stored;
};

Group::Group(Handle group, std::string file, std::string path)
    : group_(std::move(group)), file_(std::move(file)), path_(std::move(path))
{
}

std::string Group::where(const std::string& name) const
{
  const std::string path = name.empty() || name == "." ? path_ : path_ + "/" + name;
  return file_ + ": " + (path.empty() ? "/" : path);
}

Group Group::create_group(const std::string& name)
{
  const Handle link = with_groups_on_the_way();
  Handle group{
      written(H5Gcreate2(group_.id(), name.c_str(), link.id(), H5P_DEFAULT, H5P_DEFAULT), where(name)),
      H5Gclose};
  return {std::move(group), file_, path_ + "/" + name};
}

Group Group::open_group(const std::string& name) const
{
  if (!exists(name)) read_error(where(name), "it is missing");
  Handle group{readable(H5Gopen2(group_.id(), name.c_str(), H5P_DEFAULT), where(name)), H5Gclose};
  return {std::move(group), file_, path_ + "/" + name};
}

bool Group::exists(const std::string& name) const
{
  // H5Lexists fails, instead of saying no, when a group on the way is missing.
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
    if (H5Lexists(group_.id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(group_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Group::children(const std::string& group) const
{
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t
  {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  readable(H5Literate_by_name(group_.id(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names,
                              H5P_DEFAULT),
           where(group));
  return names;
}

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
  const Handle type = utf8_string();
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

Handle Group::dataset(const std::string& name) const
{
  if (!exists(name)) read_error(where(name), "it is missing");
  return {readable(H5Dopen2(group_.id(), name.c_str(), H5P_DEFAULT), where(name)), H5Dclose};
}

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

std::vector<std::uint8_t> Group::read_bytes(const std::string& name) const
{
  const Handle data = dataset(name);
  return numbers<std::uint8_t>({data.id(), false, where(name)}, H5T_NATIVE_UINT8, false);
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

void Group::put_attribute(const std::string& name, const std::string& of, hid_t type, hid_t memory,
                          const Handle& space, const void* data)
{
  const std::string place = where(of) + "@" + name;
  const Handle attribute{written(H5Acreate_by_name(group_.id(), of.c_str(), name.c_str(), type, space.id(),
                                                   H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                 place),
                         H5Aclose};
  if (data) written(H5Awrite(attribute.id(), memory, data), place);
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

void Group::attribute_ascii(const std::string& name, std::string_view value, const std::string& of)
{
  const Handle type{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(type.id(), value.size());
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  put_attribute(name, of, type.id(), type.id(), {H5Screate(H5S_SCALAR), H5Sclose}, value.data());
}

bool Group::has_attribute(const std::string& name, const std::string& of) const
{
  return H5Aexists_by_name(group_.id(), of.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

Handle Group::open_attribute(const std::string& name, const std::string& of) const
{
  const std::string place = where(of) + "@" + name;
  if (!has_attribute(name, of)) read_error(place, "it is missing");
  return {readable(H5Aopen_by_name(group_.id(), of.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), place),
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
  const std::string place = where(of) + "@" + name;
  return only(strings({attribute.id(), true, place}), place);
}

void Group::hard_link(const std::string& target, const std::string& link)
{
  const Handle creation = with_groups_on_the_way();
  written(H5Lcreate_hard(group_.id(), target.c_str(), group_.id(), link.c_str(), creation.id(), H5P_DEFAULT),
          where(link));
}

void Group::attach_scale(const std::string& dataset_name, const std::string& scale_name, unsigned dimension)
{
  const Handle data = dataset(dataset_name);
  const Handle scale = dataset(scale_name);
  const std::string axis = fs::path(scale_name).filename();
  if (H5DSis_scale(scale.id()) <= 0) written(H5DSset_scale(scale.id(), axis.c_str()), where(scale_name));
  written(H5DSattach_scale(data.id(), scale.id(), dimension), where(dataset_name));
}

File::File(Handle file, Handle root, std::string name)
    : Group(std::move(root), std::move(name), ""), file_(std::move(file))
{
}

File File::open(const fs::path& path)
{
  const Handle access = file_access();
  Handle file{readable(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), path), H5Fclose};
  Handle root{readable(H5Gopen2(file.id(), "/", H5P_DEFAULT), path), H5Gclose};
  return {std::move(file), std::move(root), path};
}

File File::in_memory(const fs::path& path)
{
  const Handle access = file_access();
  written(H5Pset_fapl_core(access.id(), memory_increment, false), path);
  Handle file{written(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), path), H5Fclose};
  Handle root{written(H5Gopen2(file.id(), "/", H5P_DEFAULT), path), H5Gclose};
  return {std::move(file), std::move(root), path};
}

std::span<const std::byte> File::image()
{
  written(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), where());
  void** memory = nullptr; // for the in-memory driver, HDF5's handle is the address of its buffer
  written(H5Fget_vfd_handle(file_.id(), H5P_DEFAULT, reinterpret_cast<void**>(&memory)), where());
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0); // the part in use
  if (size < 0) write_error(where());
  return {static_cast<const std::byte*>(*memory), std::size_t(size)};
}
} // namespace h5

namespace
{
/// A file descriptor that closes itself.
struct Descriptor
{
  int fd;
  explicit Descriptor(int fd) : fd(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor()
  {
    if (fd >= 0) ::close(fd);
  }
};

[[noreturn]] void disk_error(const fs::path& path, int error)
{
  throw Error(exit_code::write_failed,
              fmt::format("{}: cannot write: {}; make room or mend the disk, then run again", path.string(),
                          std::strerror(error)));
}

void write_synced(const fs::path& path, std::span<const std::byte> bytes)
{
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.fd < 0) disk_error(path, errno);
  while (!bytes.empty())
  {
    const ssize_t count = ::write(file.fd, bytes.data(), std::min(bytes.size(), std::size_t(1) << 28));
    if (count < 0 && errno != EINTR) disk_error(path, errno);
    if (count > 0) bytes = bytes.subspan(std::size_t(count));
  }
  if (::fsync(file.fd) != 0) disk_error(path, errno);
}

void sync_folder(const fs::path& folder)
{
  const Descriptor opened(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const bool failed = opened.fd < 0 || ::fsync(opened.fd) != 0;
  if (failed && errno != EINVAL && errno != ENOTSUP)
    disk_error(folder, errno); // some file systems have no such sync
}

void replace_file(const fs::path& path, std::span<const std::byte> bytes)
{
  fs::path temporary = path;
  temporary += ".tmp";
  try
  {
    write_synced(temporary, bytes);
    if (std::rename(temporary.c_str(), path.c_str()) != 0) disk_error(path, errno);
  }
  catch (const Error&)
  {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
  sync_folder(path.parent_path());
}
} // namespace

std::string utc_now()
{
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

std::string host_name()
{
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

void write_provenance(h5::Group& root, const Provenance& provenance, std::string_view schema)
{
  root.attribute("schema", schema);
  root.attribute("program", provenance.program);
  root.attribute("version", provenance.version);
  root.attribute("git", provenance.git);
  root.attribute("build", provenance.build);
  root.attribute("command", provenance.command);
  root.attribute("created", provenance.created);
  root.attribute("host", provenance.host);
  root.attribute("sign", "tension positive; x right, y up");
}

void write_file_atomically(const fs::path& path, const std::function<void(h5::File&)>& fill)
{
  h5::File file = h5::File::in_memory(path);
  fill(file);
  file.attribute("complete", 1);
  replace_file(path, file.image());
}

void write_text_atomically(const fs::path& path, std::string_view text)
{
  replace_file(path, std::as_bytes(std::span(text)));
}

h5::File open_complete(const fs::path& path)
{
  if (::access(path.c_str(), R_OK) != 0)
    throw Error(exit_code::input_missing,
                fmt::format("{}: cannot be read: {}; check the path and its permissions", path.string(),
                            std::strerror(errno)));
  const auto refuse = [&](const char* what)
  { throw Error(exit_code::bad_input, fmt::format("{}: {}; use another", path.string(), what)); };

  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (H5Fis_hdf5(path.c_str()) <= 0) refuse("not an HDF5 file, or its beginning is damaged");
  h5::File file = h5::File::open(path);
  if (!file.has_attribute("complete") || file.attribute_int("complete") != 1)
    refuse("the file is not complete");
  return file;
}
} // namespace mpm

#include "test/fuzz/state_edits.hpp"

#include "io/results/hdf5.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace mpm::fuzz
{
namespace
{
using h5::Handle;

/// Numbers that break things, taken where the change's own is not meant.
constexpr std::array<double, 12> usual{0,
                                       -1,
                                       1,
                                       2,
                                       1e300,
                                       -1e300,
                                       1e-300,
                                       2147483648.0,
                                       9.3e18,
                                       std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::quiet_NaN(),
                                       4294967296.0};

/// One change, as its bytes say it.
struct Change
{
  std::uint8_t what;
  std::uint8_t number; ///< of `usual`, or above them the own one
  std::uint16_t object;
  std::uint32_t element;
  double own;

  double value() const { return number < usual.size() ? usual[number] : own; }
};
constexpr std::size_t change_bytes = 16;

Change take_change(std::string_view& bytes)
{
  std::array<char, change_bytes> raw{};
  const std::size_t count = std::min(bytes.size(), raw.size());
  std::copy_n(bytes.begin(), count, raw.begin());
  bytes.remove_prefix(count);
  Change change;
  std::memcpy(&change.what, &raw[0], 1);
  std::memcpy(&change.number, &raw[1], 1);
  std::memcpy(&change.object, &raw[2], 2);
  std::memcpy(&change.element, &raw[4], 4);
  std::memcpy(&change.own, &raw[8], 8);
  return change;
}

/// Paths of the datasets and groups of a file, sorted, without the root.
std::vector<std::string> objects_of(hid_t file)
{
  std::vector<std::string> paths;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t
  {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, take, &paths);
  return paths;
}

std::vector<std::string> attributes_of(hid_t object)
{
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t
  {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names);
  return names;
}

/// A dataset of numbers taken out of a file, to be put back otherwise.
struct Numbers
{
  std::vector<hsize_t> shape;
  std::vector<double> values;
  bool whole = false; ///< integers
};

bool read(hid_t file, const std::string& path, Numbers& numbers)
{
  const Handle data{H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (data.id() < 0) return false;
  const Handle type{H5Dget_type(data.id()), H5Tclose}, space{H5Dget_space(data.id()), H5Sclose};
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return false;
  numbers.whole = kind == H5T_INTEGER;
  numbers.shape.resize(std::size_t(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  H5Sget_simple_extent_dims(space.id(), numbers.shape.data(), nullptr);
  const hssize_t count = H5Sget_simple_extent_npoints(space.id());
  if (count < 0 || count > 100'000) return false; // one that an earlier change has made
  numbers.values.resize(std::size_t(count));
  return H5Dread(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.values.data()) >= 0;
}

/// Puts a dataset in the place of what is there.
void put(hid_t file, const std::string& path, const Numbers& numbers, hid_t type, hid_t layout = H5P_DEFAULT)
{
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const Handle space{H5Screate_simple(int(numbers.shape.size()), numbers.shape.data(), nullptr), H5Sclose};
  const Handle data{H5Dcreate2(file, path.c_str(), type, space.id(), H5P_DEFAULT, layout, H5P_DEFAULT),
                    H5Dclose};
  if (!numbers.values.empty())
    H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.values.data());
}

hid_t type_of(const Numbers& numbers)
{
  return numbers.whole ? H5T_STD_I64LE : H5T_IEEE_F64LE;
}

void change_value(hid_t file, const std::string& path, const Change& change, bool add)
{
  Numbers numbers;
  if (!read(file, path, numbers) || numbers.values.empty()) return;
  double& value = numbers.values[change.element % numbers.values.size()];
  value = add ? value + change.value() : change.value();
  put(file, path, numbers, type_of(numbers));
}

/// The first extent becomes another; values are repeated or cut.
void change_size(hid_t file, const std::string& path, const Change& change)
{
  Numbers numbers;
  if (!read(file, path, numbers) || numbers.shape.empty()) return;
  const hsize_t row = numbers.shape[0] ? numbers.values.size() / numbers.shape[0] : 1;
  numbers.shape[0] = change.element % (2 * numbers.shape[0] + 3);
  const std::vector<double> before = numbers.values;
  numbers.values.resize(std::size_t(row * numbers.shape[0]));
  for (std::size_t k = 0; k < numbers.values.size(); ++k)
    numbers.values[k] = before.empty() ? change.value() : before[k % before.size()];
  put(file, path, numbers, type_of(numbers));
}

void change_type(hid_t file, const std::string& path, const Change& change)
{
  Numbers numbers;
  if (!read(file, path, numbers)) return;
  const std::array<hid_t, 6> types{H5T_IEEE_F64BE, H5T_IEEE_F32LE, H5T_STD_I8LE,
                                   H5T_STD_U64LE,  H5T_STD_B32LE,  H5T_UNIX_D32LE};
  if (change.number % 8 < types.size()) return put(file, path, numbers, types[change.number % 8]);
  numbers.values.clear();
  const Handle text{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(text.id(), change.number % 8 == 6 ? H5T_VARIABLE : 7);
  put(file, path, numbers, text.id());
}

/// A shape that is claimed, and no data behind it.
void claim(hid_t file, const std::string& path, const Change& change, bool outside)
{
  Numbers numbers;
  if (!read(file, path, numbers)) numbers.shape = {1};
  const Handle layout{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
  if (outside) // the numbers are said to stand in another file
    H5Pset_external(layout.id(), "case.yaml", 0, H5F_UNLIMITED);
  else
  {
    const std::vector<hsize_t> chunk(numbers.shape.size(), 8);
    if (!chunk.empty()) H5Pset_chunk(layout.id(), int(chunk.size()), chunk.data());
    if (!numbers.shape.empty()) numbers.shape[0] = hsize_t(change.element) << change.number % 24;
  }
  numbers.values.clear();
  put(file, path, numbers, type_of(numbers), layout.id());
}

/// Another thing under a name.
void change_link(hid_t file, const std::string& path, const std::string& other, const Change& change)
{
  switch (change.number % 5)
  {
  case 0: // exchanged
    H5Lmove(file, path.c_str(), file, "exchanged", H5P_DEFAULT, H5P_DEFAULT);
    H5Lmove(file, other.c_str(), file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    H5Lmove(file, "exchanged", file, other.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    return;
  case 1:
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    H5Lcreate_soft(("/" + other).c_str(), file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    return;
  case 2:
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    H5Lcreate_external("static/final.h5", ("/" + other).c_str(), file, path.c_str(), H5P_DEFAULT,
                       H5P_DEFAULT);
    return;
  case 3:
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
    (void)Handle(H5Gcreate2(file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    return;
  default:
    H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  }
}

void change_attribute(hid_t file, const std::string& path, const Change& change)
{
  const Handle object{H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose};
  const std::vector<std::string> names = attributes_of(object.id());
  if (names.empty()) return;
  const std::string& name = names[change.element % names.size()];
  const std::uint32_t how = change.element / names.size() % 4;
  H5Adelete(object.id(), name.c_str());
  if (how == 3) return;
  const hsize_t count = how == 2 ? change.number % 4 : 1;
  const Handle space{how == 2 ? H5Screate_simple(1, &count, nullptr) : H5Screate(H5S_SCALAR), H5Sclose};
  const hid_t type = how == 0 ? H5T_STD_I64LE : H5T_IEEE_F64LE;
  const Handle attribute{H5Acreate2(object.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose};
  const std::vector<double> values(4, change.value());
  H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, values.data());
}

void apply(hid_t file, const Change& change)
{
  const std::vector<std::string> objects = objects_of(file);
  if (objects.empty()) return;
  const std::string& path = objects[change.object % objects.size()];
  switch (change.what % 12)
  {
  case 0:
  case 1:
  case 2:
  case 3:
    return change_value(file, path, change, change.what % 2);
  case 4:
    return change_size(file, path, change);
  case 5:
    return change_type(file, path, change);
  case 6:
    return claim(file, path, change, false);
  case 7:
    return claim(file, path, change, true);
  case 8:
    return change_link(file, path, objects[change.element % objects.size()], change);
  default:
    return change_attribute(file, path, change);
  }
}
} // namespace

std::string edited(const std::string& file, std::string_view changes)
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::string copy = file;
  const Handle opened{H5LTopen_file_image(copy.data(), copy.size(), H5LT_FILE_IMAGE_OPEN_RW), H5Fclose};
  if (opened.id() < 0) throw std::runtime_error("HDF5 does not open the state");
  while (!changes.empty()) apply(opened.id(), take_change(changes));
  H5Fflush(opened.id(), H5F_SCOPE_GLOBAL);
  std::string bytes(std::size_t(std::max<ssize_t>(0, H5Fget_file_image(opened.id(), nullptr, 0))), '\0');
  H5Fget_file_image(opened.id(), bytes.data(), bytes.size());
  return bytes;
}
} // namespace mpm::fuzz

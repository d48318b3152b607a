// HDF5 reports failures as negative numbers and keeps the reason on a stack of its own; here both become an
// Error.

#include "io/results/hdf5_calls.hpp"

#include <fmt/format.h>
#include <numeric>

namespace mpm::h5
{
namespace
{
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
  // The filters are checksums and, before them, compression; HDF5 1.14 does not name the one that fails.
  if (text.find("filter returned failure") != std::string::npos)
    text = "a checksum or compressed data do not fit (" + text + ")";
  return text.empty() ? "HDF5 gives no reason" : text;
}
} // namespace

// Not said: what to do. Whoever writes the file knows whether a checkpoint is whole, and says it.
void write_error(const std::string& where)
{
  throw Error(exit_code::write_failed, fmt::format("{}: cannot write: {}", where, reason()));
}

void read_error(const std::string& where, const std::string& why)
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

// "a/b/c" makes a and a/b where they are missing.
Handle with_groups_on_the_way()
{
  Handle link = properties(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(link.id(), 1);
  return link;
}

Handle simple_space(const std::vector<hsize_t>& dims)
{
  return {H5Screate_simple(int(dims.size()), dims.data(), nullptr), H5Sclose};
}

hsize_t product(const std::vector<hsize_t>& dims)
{
  return std::accumulate(dims.begin(), dims.end(), hsize_t(1), std::multiplies{});
}
} // namespace mpm::h5

#pragma once
// Inside the HDF5 layer: calls that throw when they fail.

#include "io/results/hdf5.hpp"

#include <vector>

namespace mpm::h5
{
/// Throws Error write_failed with what HDF5 itself says.
[[noreturn]] void write_error(const std::string& where);
/// Throws Error bad_input.
[[noreturn]] void read_error(const std::string& where, const std::string& why);
/// The status of a call that writes, and of one that reads; negative ones throw.
hid_t written(hid_t status, const std::string& where);
hid_t readable(hid_t status, const std::string& where);

Handle properties(hid_t kind);
Handle with_groups_on_the_way();
Handle simple_space(const std::vector<hsize_t>& dims);
hsize_t product(const std::vector<hsize_t>& dims);
} // namespace mpm::h5

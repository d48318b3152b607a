#pragma once
// Result files that are well-formed and yet wrong: changed by hand, their seal made to fit again.

#include "io/common/digest.hpp"
#include "io/results/files.hpp"
#include "test/temporary_folder.hpp"

namespace mpm::test
{
/// The length of the line at the end of a result file.
inline constexpr std::size_t seal_length = 98;

/// What a result file holds before its seal, and the other way round.
inline std::string unsealed(const std::string& bytes)
{
  const auto at = bytes.rfind("\nsha256 of all before this line: ");
  return at != std::string::npos && bytes.size() - at == seal_length ? bytes.substr(0, at) : bytes;
}
inline std::string sealed(const std::string& bytes)
{
  return bytes + "\nsha256 of all before this line: " + sha256(bytes) + "\n";
}

/// Changes a file through the HDF5 library, `edit(h5::Handle&)`, and seals it again.
template <class Edit>
void edit_sealed(const std::filesystem::path& path, const Edit& edit)
{
  {
    h5::Handle file{H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose};
    if (file.id() < 0) throw std::runtime_error(path.string() + ": HDF5 does not open it");
    edit(file);
  }
  put(path, sealed(unsealed(contents(path))));
}
} // namespace mpm::test

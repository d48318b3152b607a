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

/// Lets a file say something else in an attribute that is a text, of a group ("/": the root).
inline void claim(const std::filesystem::path& path, const std::string& group, const std::string& attribute,
                  const char* text)
{
  const auto good = [](hid_t status)
  {
    if (status < 0) throw std::runtime_error("HDF5 refuses");
    return status;
  };
  edit_sealed(path,
              [&](const h5::Handle& file)
              {
                const h5::Handle of{good(H5Gopen(file.id(), group.c_str(), H5P_DEFAULT)), H5Gclose};
                good(H5Adelete(of.id(), attribute.c_str()));
                const h5::Handle type{good(H5Tcopy(H5T_C_S1)), H5Tclose};
                good(H5Tset_size(type.id(), H5T_VARIABLE));
                const h5::Handle space{good(H5Screate(H5S_SCALAR)), H5Sclose};
                const h5::Handle made{good(H5Acreate(of.id(), attribute.c_str(), type.id(), space.id(),
                                                     H5P_DEFAULT, H5P_DEFAULT)),
                                      H5Aclose};
                good(H5Awrite(made.id(), type.id(), &text));
              });
}
} // namespace mpm::test

// Opening and making files and groups. A file is put together in memory and leaves it by one plain write
// (write_file_atomically), so that a full disk is met by a call that tells the reason.

#include "io/results/hdf5_calls.hpp"

#include <hdf5_hl.h>

namespace mpm::h5
{
namespace
{
// By how much the file in memory grows.
constexpr std::size_t memory_increment = std::size_t(8) << 20;

/// Without HDF5's own messages on stderr and its file locks, which network file systems often lack. The
/// format is kept to what HDF5 1.10 reads; weakly closed, so that an open group does not make the close of
/// its file fail.
Handle file_access()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Handle access = properties(H5P_FILE_ACCESS);
  H5Pset_file_locking(access.id(), false, true);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V110);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_WEAK);
  return access;
}
} // namespace

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
  if (!exists(name)) read_error(where(name), "it is missing, or a link");
  Handle group{readable(H5Gopen2(group_.id(), name.c_str(), H5P_DEFAULT), where(name)), H5Gclose};
  return {std::move(group), file_, path_ + "/" + name};
}

bool Group::exists(const std::string& name) const
{
  if (name == ".") return true;
  // H5Lexists fails, instead of saying no, when a group on the way is missing. We make hard links alone;
  // others may lead to another file.
  for (std::size_t end = 0; end != std::string::npos;)
  {
    end = name.find('/', end + 1);
    const std::string path = name.substr(0, end);
    H5L_info_t link{};
    if (H5Lexists(group_.id(), path.c_str(), H5P_DEFAULT) <= 0 ||
        H5Lget_info(group_.id(), path.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      return false;
  }
  return true;
}

std::vector<std::string> Group::children(const std::string& group) const
{
  if (!exists(group)) read_error(where(group), "it is missing, or a link");
  std::vector<std::string> names;
  // A C function is called for each name; it may not throw.
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

Handle Group::dataset(const std::string& name) const
{
  if (!exists(name)) read_error(where(name), "it is missing, or a link");
  Handle data{readable(H5Dopen2(group_.id(), name.c_str(), H5P_DEFAULT), where(name)), H5Dclose};
  const Handle layout{readable(H5Dget_create_plist(data.id()), where(name)), H5Pclose};
  if (H5Pget_external_count(layout.id()) > 0 || H5Pget_layout(layout.id()) == H5D_VIRTUAL)
    read_error(where(name), "its values are said to stand in another file");
  return data;
}

// A second name for the same data: it costs nothing, and reading either is the same.
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
  // Its own name is what xarray calls the dimension.
  const std::string axis = std::filesystem::path(scale_name).filename();
  if (H5DSis_scale(scale.id()) <= 0) written(H5DSset_scale(scale.id(), axis.c_str()), where(scale_name));
  written(H5DSattach_scale(data.id(), scale.id(), dimension), where(dataset_name));
}

File::File(Handle file, Handle root, std::string name)
    : Group(std::move(root), std::move(name), ""), file_(std::move(file))
{
}

File File::open(const std::filesystem::path& path)
{
  const Handle access = file_access();
  Handle file{readable(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), path), H5Fclose};
  Handle root{readable(H5Gopen2(file.id(), "/", H5P_DEFAULT), path), H5Gclose};
  return {std::move(file), std::move(root), path};
}

File File::in_memory(const std::filesystem::path& path)
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
} // namespace mpm::h5

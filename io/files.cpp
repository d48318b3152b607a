#include "io/files.hpp"

#include "io/descriptor.hpp"
#include "io/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

namespace mpm
{
namespace fs = std::filesystem;

namespace
{
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
  if (const std::string problem = why_no_input(path); !problem.empty())
    throw Error(exit_code::input_missing, fmt::format("{}: {}", path.string(), problem));
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

// A result file is written in full beside its name, brought to the disk, and only then given its name:
// rename() swaps it in one step, so that whoever looks, after a crash too, finds the old file or the new one
// and never a part. The folder is synced after that, because the name is kept there and not in the file.

#include "io/results/files.hpp"

#include "io/common/descriptor.hpp"
#include "io/common/digest.hpp"
#include "io/common/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <initializer_list>
#include <unistd.h>

namespace mpm
{
namespace fs = std::filesystem;

namespace
{
using Bytes = std::span<const std::byte>;

// The seal is a line of text behind the end that HDF5 knows of: HDF5 takes no notice, `tail -c 98` shows it,
// and `head -c -98 FILE | sha256sum` checks it.
constexpr std::string_view seal_words = "\nsha256 of all before this line: ";
constexpr std::size_t digest_length = 64;
constexpr std::size_t seal_length = seal_words.size() + digest_length + 1;

std::string seal_of(const std::string& digest)
{
  return std::string(seal_words) + digest + "\n";
}

[[noreturn]] void disk_error(const fs::path& path, int error)
{
  throw Error(exit_code::write_failed,
              fmt::format("{}: cannot write: {}; make room or mend the disk, then run again", path.string(),
                          std::strerror(error)));
}

/// Whatever stands at `path` goes first: a link there is not written through.
void write_synced(const fs::path& path, std::initializer_list<Bytes> parts)
{
  // O_EXCL then makes sure that the file is new and our own.
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) disk_error(path, errno);
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (file.fd < 0) disk_error(path, errno);
  for (Bytes bytes : parts)
    while (!bytes.empty())
    {
      // In parts of 256 MB: write() takes no more than 2 GB at once.
      const ssize_t count = ::write(file.fd, bytes.data(), std::min(bytes.size(), std::size_t(1) << 28));
      if (count < 0 && errno != EINTR) disk_error(path, errno);
      if (count > 0) bytes = bytes.subspan(std::size_t(count));
    }
  // Some file systems tell a full disk only now.
  if (::fsync(file.fd) != 0) disk_error(path, errno);
}

/// Puts the parts, one after the other, in the place of the file at `path`.
void replace_file(const fs::path& path, std::initializer_list<Bytes> parts)
{
  fs::path temporary = path;
  temporary += ".tmp";
  try
  {
    write_synced(temporary, parts);
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

[[noreturn]] void refuse(const fs::path& path, const char* what)
{
  throw Error(exit_code::bad_input, fmt::format("{}: {}; use another", path.string(), what));
}

/// The digest that a file's seal holds and the bytes before it have.
std::string check_seal(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::size_t left = std::size_t(fs::file_size(path));
  // Not even room for the seal.
  if (left < seal_length) refuse(path, "the file is not complete");
  // The seal first: a file that was cut short is known by its last bytes, however large it is.
  std::string seal(seal_length, '\0');
  file.seekg(std::streamoff(left - seal_length)).read(seal.data(), std::streamsize(seal_length));
  if (!file) refuse(path, "it cannot be read to its end");
  if (!seal.starts_with(seal_words))
    refuse(path, "the file is not complete: no digest stands at its end (older versions wrote none)");
  file.seekg(0);
  Sha256 digest;
  // Read in parts: a state may be larger than the memory that is left.
  std::string part(std::size_t(1) << 20, '\0');
  for (left -= seal_length; left > 0 && file; left -= std::size_t(file.gcount()))
  {
    file.read(part.data(), std::streamsize(std::min(left, part.size())));
    digest.add(std::string_view(part).substr(0, std::size_t(file.gcount())));
  }
  if (!file) refuse(path, "it cannot be read to its end");
  const std::string found = digest.hexadecimal();
  if (seal != seal_of(found)) refuse(path, "the file is damaged: it is not what was written");
  return found;
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

std::string write_file_atomically(const fs::path& path, const std::function<void(h5::File&)>& fill)
{
  h5::File file = h5::File::in_memory(path);
  fill(file);
  const Bytes image = file.image();
  const std::string digest = sha256({reinterpret_cast<const char*>(image.data()), image.size()});
  const std::string seal = seal_of(digest);
  replace_file(path, {image, std::as_bytes(std::span(seal))});
  return digest;
}

void sync_folder(const fs::path& folder)
{
  const Descriptor opened(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const bool failed = opened.fd < 0 || ::fsync(opened.fd) != 0;
  if (failed && errno != EINVAL && errno != ENOTSUP)
    disk_error(folder, errno); // some file systems have no such sync
}

void write_text_atomically(const fs::path& path, std::string_view text)
{
  replace_file(path, {std::as_bytes(std::span(text))});
}

h5::File open_complete(const fs::path& path, std::string* digest)
{
  if (const std::string problem = why_no_input(path); !problem.empty())
    throw Error(exit_code::input_missing, fmt::format("{}: {}", path.string(), problem));
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (H5Fis_hdf5(path.c_str()) <= 0) refuse(path, "not an HDF5 file, or its beginning is damaged");
  const std::string found = check_seal(path);
  if (digest) *digest = found;
  return h5::File::open(path);
}
} // namespace mpm

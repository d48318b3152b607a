// `mpm-static <(generate)` or a case on a device would wait for ever, or never end: inputs are regular files.
// They are looked at before they are opened and once more after it, in case the name has come to mean
// something else.

#include "io/common/input_file.hpp"

#include "io/common/descriptor.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mpm
{
namespace
{
/// An open file, or why there is none.
struct Opened
{
  Descriptor file;
  std::string problem;
};

/// What a thing is that is no regular file, and what to do.
std::string kind_of(mode_t mode)
{
  if (S_ISDIR(mode)) return "is a folder; name a file in it";
  if (S_ISFIFO(mode) || S_ISSOCK(mode))
    return "is a pipe; write what comes through it to a file and name that";
  return "is a device; name a regular file";
}

/// Opens without waiting for a writer at the other end of a pipe.
Opened open_input(const std::filesystem::path& path)
{
  struct stat status = {};
  const auto reason = []
  { return errno == ENOENT ? "no such file" : fmt::format("cannot be read: {}", std::strerror(errno)); };
  if (::stat(path.c_str(), &status) != 0) return {Descriptor(-1), reason()};
  if (!S_ISREG(status.st_mode)) return {Descriptor(-1), kind_of(status.st_mode)};
  Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (file.fd < 0) return {Descriptor(-1), reason()};
  if (::fstat(file.fd, &status) != 0) return {Descriptor(-1), reason()};
  if (!S_ISREG(status.st_mode)) return {Descriptor(-1), kind_of(status.st_mode)};
  return {std::move(file), {}};
}
} // namespace

std::string why_no_input(const std::filesystem::path& path)
{
  return open_input(path).problem;
}

InputText read_input(const std::filesystem::path& path, std::size_t most)
{
  const Opened opened = open_input(path);
  if (!opened.problem.empty()) return {{}, opened.problem};
  std::string text;
  for (;;)
  {
    // In parts of 1 MB, and not by the size that the file claims: that of /proc is 0, and another may be
    // growing.
    const std::size_t had = text.size(), want = std::size_t(1) << 20;
    text.resize(had + want);
    const ssize_t count = ::read(opened.file.fd, text.data() + had, want);
    text.resize(had + std::size_t(std::max<ssize_t>(count, 0)));
    if (count == 0) return {std::move(text), {}};
    if (count < 0 && errno != EINTR)
      return {{}, fmt::format("cannot be read to its end: {}; check the disk", std::strerror(errno))};
    if (text.size() > most)
      return {{},
              fmt::format("is larger than {} MB, more than such a file ever is; is it the right one?",
                          most >> 20)};
  }
}
} // namespace mpm

#pragma once

#include <unistd.h>

#include <utility>

namespace mpm
{
/// A file descriptor that closes itself; negative: none.
struct Descriptor
{
  int fd;

  explicit Descriptor(int fd) : fd(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd(std::exchange(other.fd, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor()
  {
    if (fd >= 0) ::close(fd);
  }
};
} // namespace mpm

// Lets a program die or its disk fail at one of its calls of the file system. To be preloaded (LD_PRELOAD):
//   FAULT_FOLDER  only calls on paths in this folder count
//   FAULT_AT      the number of the call, from 1; 0: none
//   FAULT_MODE    kill: dies before it; torn: writes half and dies; EIO: the call fails; ENOSPC: it and all
//                 later calls that take room fail
//   FAULT_COUNT   file that gets the number of calls when the program ends

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace
{
int calls = 0;

std::string setting(const char* name)
{
  const char* value = std::getenv(name);
  return value ? value : "";
}

bool counts(const char* path)
{
  const std::string folder = setting("FAULT_FOLDER");
  return !folder.empty() && path && std::string(path).rfind(folder, 0) == 0;
}

bool counts(int fd)
{
  char path[4096] = {};
  const std::string link = "/proc/self/fd/" + std::to_string(fd);
  return readlink(link.c_str(), path, sizeof path - 1) > 0 && counts(path);
}

enum class Fate
{
  lives,
  fails,
  tears,
};

Fate next(bool takes_room, bool can_tear = false)
{
  const int at = std::atoi(setting("FAULT_AT").c_str());
  const std::string mode = setting("FAULT_MODE");
  ++calls;
  const bool now = calls == at;
  if (now && mode == "torn" && can_tear) return Fate::tears;
  if (now && (mode == "kill" || mode == "torn")) kill(getpid(), SIGKILL);
  if (now && mode == "EIO") return errno = EIO, Fate::fails;
  if (at > 0 && calls >= at && mode == "ENOSPC" && takes_room) return errno = ENOSPC, Fate::fails;
  return Fate::lives;
}

template <class Function>
Function real(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

__attribute__((destructor)) void tell()
{
  const std::string file = setting("FAULT_COUNT");
  if (file.empty()) return;
  if (FILE* out = std::fopen(file.c_str(), "w"))
  {
    std::fprintf(out, "%d\n", calls);
    std::fclose(out);
  }
}

template <class Path>
int on_path(const char* name, Path path)
{
  if (counts(path) && next(false) == Fate::fails) return -1;
  return real<int (*)(Path)>(name)(path);
}
} // namespace

extern "C"
{
  int open(const char* path, int flags, ...)
  {
    va_list more;
    va_start(more, flags);
    const int mode = (flags & O_CREAT) ? va_arg(more, int) : 0;
    va_end(more);
    if ((flags & (O_CREAT | O_WRONLY | O_RDWR)) && counts(path) && next(flags & O_CREAT) == Fate::fails)
      return -1;
    return real<int (*)(const char*, int, ...)>("open")(path, flags, mode);
  }
  ssize_t write(int fd, const void* bytes, size_t count)
  {
    const auto write_really = real<ssize_t (*)(int, const void*, size_t)>("write");
    if (!counts(fd)) return write_really(fd, bytes, count);
    const Fate fate = next(true, true);
    if (fate == Fate::fails) return -1;
    if (fate == Fate::tears)
    {
      write_really(fd, bytes, count / 2);
      kill(getpid(), SIGKILL);
    }
    return write_really(fd, bytes, count);
  }
  int fsync(int fd)
  {
    if (counts(fd) && next(false) == Fate::fails) return -1;
    return real<int (*)(int)>("fsync")(fd);
  }
  int rename(const char* from, const char* to)
  {
    if (counts(from) && next(true) == Fate::fails) return -1;
    return real<int (*)(const char*, const char*)>("rename")(from, to);
  }
  int unlink(const char* path)
  {
    return on_path("unlink", path);
  }
  int remove(const char* path)
  {
    return on_path("remove", path);
  }
}

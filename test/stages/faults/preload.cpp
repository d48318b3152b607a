// Lets a program die or its disk fail at one of its calls of the file system. To be preloaded (LD_PRELOAD):
//   FAULT_FOLDER  only calls on paths in this folder count
//   FAULT_AT      the number of the call, from 1; 0: none
//   FAULT_MODE    kill: dies before it; group: its process group does; torn: writes half and dies; read: the
//                 call fails with EIO, and only reads count; EIO: it fails; ENOSPC, EDQUOT: it and all later
//                 calls that take room fail; EROFS: it and all later calls fail
//   FAULT_COUNT   file that holds the number of calls so far, an int; processes that share it count on
//   FAULT_CLOCK   seconds by which the time of day is wrong

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <map>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{
template <class Function>
Function real(const char* name)
{
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::string setting(const char* name)
{
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The number of calls so far: in the file, or of this process alone.
std::atomic<int>& calls()
{
  static std::atomic<int> own{0};
  static std::atomic<int>* const shared = []
  {
    const std::string file = setting("FAULT_COUNT");
    if (file.empty()) return &own;
    const int fd =
        real<int (*)(const char*, int, ...)>("open")(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0 || real<int (*)(int, off_t)>("ftruncate")(fd, sizeof own) != 0) std::abort();
    void* memory = mmap(nullptr, sizeof own, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (memory == MAP_FAILED) std::abort();
    close(fd);
    return static_cast<std::atomic<int>*>(memory);
  }();
  return *shared;
}

bool counts(const char* path)
{
  static const std::string folder = setting("FAULT_FOLDER");
  return !folder.empty() && path && std::string(path).rfind(folder, 0) == 0;
}

std::string path_of(int fd)
{
  char path[4096] = {};
  const std::string link = "/proc/self/fd/" + std::to_string(fd);
  return readlink(link.c_str(), path, sizeof path - 1) > 0 ? path : "";
}

bool counts(int fd)
{
  return counts(path_of(fd).c_str());
}

/// A path below an open folder, as the ...at calls have it.
bool counts(int folder, const char* path)
{
  if (!path) return false;
  return path[0] == '/' || folder == AT_FDCWD ? counts(path) : counts((path_of(folder) + "/" + path).c_str());
}

enum class Fate
{
  lives,
  fails,
  tears,
};

enum class Call
{
  reads,
  changes,
  takes_room,
};

Fate next(Call call, bool can_tear = false)
{
  static const int at = std::atoi(setting("FAULT_AT").c_str());
  static const std::string mode = setting("FAULT_MODE");
  static const std::map<std::string, int> errors{
      {"read", EIO}, {"EIO", EIO}, {"ENOSPC", ENOSPC}, {"EDQUOT", EDQUOT}, {"EROFS", EROFS}};
  if ((call == Call::reads) != (mode == "read")) return Fate::lives;
  const int number = ++calls();
  if (at <= 0 || number < at) return Fate::lives;
  if (number == at && mode == "torn" && can_tear) return Fate::tears;
  if (number == at && (mode == "kill" || mode == "torn")) kill(getpid(), SIGKILL);
  if (number == at && mode == "group") kill(0, SIGKILL);
  const auto error = errors.find(mode);
  if (error == errors.end()) return Fate::lives;
  const bool stays = mode == "EROFS" || ((mode == "ENOSPC" || mode == "EDQUOT") && call == Call::takes_room);
  const bool once = number == at && mode != "ENOSPC" && mode != "EDQUOT";
  if (!stays && !once) return Fate::lives;
  errno = error->second;
  return Fate::fails;
}

template <class... Arguments>
int unless(bool counted, Call call, const char* name, Arguments... arguments)
{
  if (counted && next(call) == Fate::fails) return -1;
  return real<int (*)(Arguments...)>(name)(arguments...);
}

template <class... Offset>
ssize_t write_with(const char* name, int fd, const void* bytes, size_t count, Offset... offset)
{
  const auto write_really = real<ssize_t (*)(int, const void*, size_t, Offset...)>(name);
  if (!counts(fd)) return write_really(fd, bytes, count, offset...);
  const Fate fate = next(Call::takes_room, true);
  if (fate == Fate::fails) return -1;
  if (fate == Fate::tears)
  {
    write_really(fd, bytes, count / 2, offset...);
    kill(getpid(), SIGKILL);
  }
  return write_really(fd, bytes, count, offset...);
}

template <class... Offset>
ssize_t read_with(const char* name, int fd, void* bytes, size_t count, Offset... offset)
{
  if (counts(fd) && next(Call::reads) == Fate::fails) return -1;
  return real<ssize_t (*)(int, void*, size_t, Offset...)>(name)(fd, bytes, count, offset...);
}

bool changes(int flags)
{
  return flags & (O_CREAT | O_WRONLY | O_RDWR);
}

Call kind(int flags)
{
  return flags & O_CREAT ? Call::takes_room : Call::changes;
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
    if (changes(flags) && counts(path) && next(kind(flags)) == Fate::fails) return -1;
    return real<int (*)(const char*, int, ...)>("open")(path, flags, mode);
  }
  int open64(const char* path, int flags, ...)
  {
    va_list more;
    va_start(more, flags);
    const int mode = (flags & O_CREAT) ? va_arg(more, int) : 0;
    va_end(more);
    return open(path, flags, mode);
  }
  ssize_t write(int fd, const void* bytes, size_t count)
  {
    return write_with("write", fd, bytes, count);
  }
  ssize_t pwrite(int fd, const void* bytes, size_t count, off_t offset)
  {
    return write_with("pwrite", fd, bytes, count, offset);
  }
  ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t offset)
  {
    return write_with("pwrite64", fd, bytes, count, offset);
  }
  ssize_t read(int fd, void* bytes, size_t count)
  {
    return read_with("read", fd, bytes, count);
  }
  ssize_t pread(int fd, void* bytes, size_t count, off_t offset)
  {
    return read_with("pread", fd, bytes, count, offset);
  }
  ssize_t pread64(int fd, void* bytes, size_t count, off64_t offset)
  {
    return read_with("pread64", fd, bytes, count, offset);
  }
  int fsync(int fd)
  {
    return unless(counts(fd), Call::changes, "fsync", fd);
  }
  int ftruncate(int fd, off_t length)
  {
    return unless(counts(fd), Call::changes, "ftruncate", fd, length);
  }
  int ftruncate64(int fd, off64_t length)
  {
    return unless(counts(fd), Call::changes, "ftruncate64", fd, length);
  }
  int rename(const char* from, const char* to)
  {
    return unless(counts(from), Call::takes_room, "rename", from, to);
  }
  int unlink(const char* path)
  {
    return unless(counts(path), Call::changes, "unlink", path);
  }
  int unlinkat(int folder, const char* path, int flags)
  {
    return unless(counts(folder, path), Call::changes, "unlinkat", folder, path, flags);
  }
  int remove(const char* path)
  {
    return unless(counts(path), Call::changes, "remove", path);
  }
  int mkdir(const char* path, mode_t mode)
  {
    return unless(counts(path), Call::takes_room, "mkdir", path, mode);
  }
  int clock_gettime(clockid_t clock, timespec* now)
  {
    static const long wrong = std::atol(setting("FAULT_CLOCK").c_str());
    const int result = real<int (*)(clockid_t, timespec*)>("clock_gettime")(clock, now);
    if (clock == CLOCK_REALTIME && result == 0) now->tv_sec += wrong;
    return result;
  }
}

// What the kernel and the limits around this process say, as files of /proc and of the control groups. A
// machine in a container reports the host's memory in /proc/meminfo, so that all of them have to be asked.

#include "io/common/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sys/resource.h>

namespace mpm
{
namespace
{
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number in a file of one number; infinite when there is none ("max").
double number_in(const std::filesystem::path& path)
{
  std::ifstream file(path);
  double value = 0;
  return file >> value ? value : unlimited;
}

/// A line "KEY: N kB" of a file of /proc, in bytes; infinite when there is none.
double entry(const char* path, const std::string& key)
{
  std::ifstream file(path);
  for (std::string word; file >> word;)
    if (double value = 0; word == key && file >> value) return 1024 * value;
  return unlimited;
}

/// What the control groups of the process, and those around them, leave it.
double left_in_groups()
{
  double least = unlimited;
  std::ifstream file("/proc/self/cgroup"); // NUMBER:CONTROLLERS:PATH
  for (std::string line; std::getline(file, line);)
  {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool old = controllers.find("memory") != std::string::npos;
    if (!old && !controllers.empty()) continue;
    const std::filesystem::path root = old ? "/sys/fs/cgroup/memory" : "/sys/fs/cgroup";
    std::filesystem::path group = std::filesystem::path(line.substr(second + 1)).relative_path();
    // A group is limited by those around it too.
    for (;; group = group.parent_path())
    {
      const auto at = root / group;
      const double most = number_in(at / (old ? "memory.limit_in_bytes" : "memory.max"));
      const double used = number_in(at / (old ? "memory.usage_in_bytes" : "memory.current"));
      if (most < unlimited && used < unlimited) least = std::min(least, std::max(0.0, most - used));
      if (group.empty()) break;
    }
  }
  return least;
}

double left_of_limit(int resource, const std::string& used)
{
  rlimit limit{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return unlimited;
  // Limits are of address space, of which a part is taken already.
  const double taken = entry("/proc/self/status", used);
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - (taken < unlimited ? taken : 0));
}
} // namespace

FreeMemory free_memory()
{
  const std::array found{
      FreeMemory{entry("/proc/meminfo", "MemAvailable:"), "this machine has free"},
      FreeMemory{left_in_groups(), "the memory limit of this process's control group leaves"},
      FreeMemory{left_of_limit(RLIMIT_AS, "VmSize:"), "the limit of address space (ulimit -v) leaves"},
      FreeMemory{left_of_limit(RLIMIT_DATA, "VmData:"), "the limit of data (ulimit -d) leaves"}};
  return *std::min_element(found.begin(), found.end(),
                           [](const FreeMemory& a, const FreeMemory& b) { return a.bytes < b.bytes; });
}

std::string bytes_text(double bytes)
{
  if (bytes < 1e9) return fmt::format("{:.0f} MB", bytes / 1e6);
  return bytes < 1e12 ? fmt::format("{:.1f} GB", bytes / 1e9) : fmt::format("{:.3g} GB", bytes / 1e9);
}
} // namespace mpm

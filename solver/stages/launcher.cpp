// What stands in bin where each program is installed for several sets of instructions (scripts/package):
// starts the program of its own name that is made for the best instructions this processor has.
//
//   bin/mpm-static  ->  lib/seismpm/x86-64-v4/mpm-static
//   SEISMPM_ARCH=x86-64-v3 mpm-static ...     the same bits on nodes that differ

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <unistd.h>
#include <vector>

namespace
{
/// Sets of instructions that this processor has, the best first. What tells them apart is asked for, not all
/// that they name.
std::vector<std::string> instruction_sets()
{
  std::vector<std::string> sets;
  if (const char* chosen = std::getenv("SEISMPM_ARCH"); chosen && *chosen) return {chosen};
#ifdef __x86_64__
  __builtin_cpu_init();
  const bool v3 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    sets.emplace_back("x86-64-v4");
  if (v3) sets.emplace_back("x86-64-v3");
  sets.emplace_back("x86-64");
#endif
  return sets;
}
} // namespace

int main(int, char** argv)
{
  std::error_code unknown;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::filesystem::path folder = self.parent_path().parent_path() / "lib/seismpm";
  for (const std::string& set : instruction_sets())
    if (const auto program = folder / set / self.filename(); std::filesystem::exists(program, unknown))
    {
      execv(program.c_str(), argv);
      std::cerr << program.string() << ": cannot be started: " << std::strerror(errno) << '\n';
      return 66;
    }
  std::cerr << argv[0] << ": " << folder.string()
            << " has none for this processor or $SEISMPM_ARCH; install seismpm again, or build it here\n";
  return 66;
}

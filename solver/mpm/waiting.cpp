#include "solver/mpm/waiting.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace mpm::parallel
{
namespace
{
struct Setting
{
  const char* name;
  const char* value; ///< null: the user's alone
};

// libgomp: as long a spin as it allows itself where there are more threads than processors. It outlasts the
// pauses within a step; all of a step's threads that share processors with other work would spin them away
// with the usual 300 000. libomp counts in ms, and spins for 200 of them.
constexpr std::array settings{Setting{"GOMP_SPINCOUNT", "1000"}, Setting{"KMP_BLOCKTIME", "0"},
                              Setting{"OMP_WAIT_POLICY", nullptr}};
} // namespace

void wait_briefly(char** argv)
{
  for (const Setting& setting : settings)
    if (std::getenv(setting.name)) return;
  std::error_code unknown;
  // By its own name, so that ps and top show that.
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (unknown) return;
  for (const Setting& setting : settings)
    if (setting.value) setenv(setting.name, setting.value, 1);
  execv(self.c_str(), argv); // where that is not possible the run goes on as it is
}
} // namespace mpm::parallel

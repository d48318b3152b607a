// How the programs' threads wait, as OpenMP's runtime itself tells it.

#include <catch2/catch.hpp>

#include <cstdio>
#include <string>

namespace
{
/// What the runtime says of its settings when mpm-static starts, environment given.
std::string runtime_settings(const std::string& environment)
{
  // --check, as libomp starts with the first parallel loop.
  const std::string command =
      "env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT -u KMP_BLOCKTIME OMP_DISPLAY_ENV=verbose " + environment +
      " " BINARY_DIR "/mpm-static " SOURCE_DIR "/cases/slope/case.yaml --profile quick --check 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string said;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe)) said += buffer;
  REQUIRE(pclose(pipe) == 0);
  return said;
}

/// Whether threads spin as briefly as the programs ask for: libgomp, libomp, libomp 19, which leaves its
/// quote open.
bool spins_briefly(const std::string& settings)
{
  for (const char* brief : {"GOMP_SPINCOUNT = '1000'", "KMP_BLOCKTIME='0'", "KMP_BLOCKTIME='0ms"})
    if (settings.find(brief) != std::string::npos) return true;
  return false;
}
} // namespace

TEST_CASE("threads spin briefly where the user does not say how they wait", "[mpm][long]")
{
  const std::string usual = runtime_settings("");
  INFO(usual);
  CHECK(spins_briefly(usual));
  for (const std::string wish : {"OMP_WAIT_POLICY=active", "GOMP_SPINCOUNT=77", "KMP_BLOCKTIME=5"})
    CHECK(!spins_briefly(runtime_settings(wish)));
}

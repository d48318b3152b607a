// How the programs' threads wait, as OpenMP's runtime itself tells it.

#include <catch2/catch.hpp>

#include <cstdio>
#include <string>

using Catch::Matchers::Contains;

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
} // namespace

TEST_CASE("threads spin briefly where the user does not say how they wait", "[mpm]")
{
  const std::string usual = runtime_settings("");
  INFO(usual);
  CHECK((usual.find("GOMP_SPINCOUNT = '1000'") != std::string::npos ||
         usual.find("KMP_BLOCKTIME='0'") != std::string::npos));
  for (const std::string wish : {"OMP_WAIT_POLICY=active", "GOMP_SPINCOUNT=77", "KMP_BLOCKTIME=5"})
    CHECK_THAT(runtime_settings(wish),
               !Contains("GOMP_SPINCOUNT = '1000'") && !Contains("KMP_BLOCKTIME='0'"));
}

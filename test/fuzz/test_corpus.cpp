// What fuzzing has found once stays found: all inputs of the corpus once more, in every build.

#include "test/fuzz/targets.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace mpm;
using namespace mpm::test;

TEST_CASE("what fuzzing once found is refused or read as meant", "[fuzz]")
{
  for (const fuzz::Target& target : fuzz::targets)
  {
    std::vector<std::filesystem::path> inputs;
    for (const auto& file : std::filesystem::directory_iterator(
             std::string(SOURCE_DIR) + "/test/fuzz/corpus/" + std::string(target.name)))
      inputs.push_back(file.path());
    std::ranges::sort(inputs);
    CHECK(inputs.size() > 0);
    for (const auto& input : inputs)
    {
      INFO(input);
      CHECK_NOTHROW(target.run(contents(input)));
    }
  }
}

#include "test/read_json.hpp"

#include <fstream>

namespace mpm::test
{
nlohmann::json read_json(const std::filesystem::path& file)
{
  std::ifstream text(file);
  return nlohmann::json::parse(text);
}
} // namespace mpm::test

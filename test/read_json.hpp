#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace mpm::test
{
/// What a JSON file holds. One file of the tests has the parser, which takes seconds to compile.
nlohmann::json read_json(const std::filesystem::path& file);
} // namespace mpm::test

#include "solver/stages/identity.hpp"

#include "io/case/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace mpm
{
namespace
{
/// Whether a key says what the ground is, before anything is done to it.
bool shapes_ground(std::string_view key)
{
  return std::ranges::any_of(std::array<std::string_view, 6>{"grid.", "domain.", "surfaces.", "regions",
                                                             "materials.", "static.gravity"},
                             [&](std::string_view part) { return key.starts_with(part); });
}

/// The form of the file, what people call the case, and what its cells were chosen by.
bool is_label(std::string_view key)
{
  return key == "schema" || key == "name" || key == "grid.frequency";
}

/// Where a record comes from and how it is written: the motion's digest tells what was made of it.
bool tells_record(std::string_view key)
{
  return key.starts_with(horizontal_record) || key.starts_with(vertical_record);
}

/// A number to 15 digits: 70 cm and 0.7 m are one length, though the one is 0.7000000000000001 m in binary.
std::string rounded(const std::string& value)
{
  double number = 0;
  const auto [end, failure] = std::from_chars(value.data(), value.data() + value.size(), number);
  const std::string rest(end, value.data() + value.size());
  return failure == std::errc{} && (rest.empty() || rest[0] == ' ') ? fmt::format("{:.15g}{}", number, rest)
                                                                    : value;
}

/// The kinds of base and sides, which the case need not give.
RunFolder::Identity edges(const Case& case_file)
{
  static constexpr std::array bases{"compliant", "fixed"};
  static constexpr std::array sides{"free_field", "quiet", "roller"};
  return {{"seismic.base.kind", bases.at(static_cast<std::size_t>(case_file.seismic.base))},
          {"seismic.sides.kind", sides.at(static_cast<std::size_t>(case_file.seismic.sides))}};
}
} // namespace

RunFolder::Identity static_settings(const Case& case_file)
{
  RunFolder::Identity identity{{"stage", "static"}};
  for (const auto& [key, value] : case_file.settings)
  {
    const bool of_the_shaking = key.starts_with("seismic.") || key.starts_with("time_step.");
    if (!is_label(key) && !of_the_shaking && !key.starts_with("output."))
      identity.emplace_back(key, rounded(value));
  }
  for (auto& edge : edges(case_file)) identity.push_back(std::move(edge)); // they make the columns
  return identity;
}

RunFolder::Identity seismic_settings(const Case& case_file)
{
  RunFolder::Identity identity{{"stage", "seismic"}};
  for (const auto& [key, value] : case_file.settings)
  {
    const bool changes_no_result = key.starts_with("output.checkpoint.");
    const bool of_the_state = key.starts_with("static.") && key != "static.gravity"; // its digest tells it
    if (is_label(key) || changes_no_result || of_the_state || tells_record(key)) continue;
    const bool resolved_late = key == "seismic.duration"; // "record + 10 s" depends on the record
    identity.emplace_back(
        key, rounded(resolved_late ? quantity_text(case_file.seismic.duration, Dimension::time) : value));
  }
  return identity;
}

std::vector<std::string> ground_settings(const Case& case_file)
{
  std::vector<std::string> lines;
  for (const auto& [key, value] : case_file.settings)
    if (shapes_ground(key) && !is_label(key)) lines.push_back(key + " = " + rounded(value));
  for (const auto& [key, value] : edges(case_file)) lines.push_back(key + " = " + value);
  std::ranges::sort(lines);
  return lines;
}
} // namespace mpm

// Time steps that headers and comments state. They are not needed where a format has a field for the step,
// but a sentence that says another step is a sign that file and field do not belong together.

#include "io/records/statements.hpp"
#include "io/records/words.hpp"

#include <algorithm>
#include <array>

namespace mpm::records
{
std::optional<StatedStep> take_step(std::string_view text, bool rate)
{
  std::optional<StepUnit> unit;
  const auto skip = [&]
  {
    while (!text.empty() && (is_blank(text[0]) || text[0] == '=' || text[0] == ':')) text.remove_prefix(1);
  };
  // A unit in brackets before the number: "Sampling interval (ms) 10".
  skip();
  if (const std::string_view inside = bracket(text); !inside.empty())
  {
    if (!(unit = parse_step_unit(inside))) return {};
    text.remove_prefix(inside.size() + 2);
    skip();
  }
  // The number with its exponent, then what stands directly behind it.
  std::size_t end = 0;
  const auto is_at = [&](std::size_t i, std::string_view chars)
  { return i < text.size() && chars.find(text[i]) != std::string_view::npos; };
  while (is_at(end, "+-.0123456789")) ++end;
  if (is_at(end, "eEdD") && is_at(end + 1 + is_at(end + 1, "+-"), "0123456789"))
    for (end += 1 + is_at(end + 1, "+-"); is_at(end, "0123456789");) ++end;
  std::string_view number = text.substr(0, end), rest = text.substr(end);
  const auto value = take_number(number);
  if (!value || !number.empty() || !(*value > 0)) return {};
  // "1/200" and "10%" are no plain numbers.
  if (!rest.empty() && is_at(end, "/*^%")) return {};
  rest = trimmed(rest);
  std::string_view word = bracket(rest);
  if (word.empty()) word = rest.substr(0, std::min(rest.find_first_of(" \t,;=:)]"), rest.size()));
  const auto behind = parse_step_unit(word);
  // "(ms) 10 s": two units that are not the same tell nothing.
  if (unit && behind && (unit->rate != behind->rate || unit->per_second != behind->per_second)) return {};
  if (!unit) unit = behind;
  if ((unit ? unit->rate : rate) && *value < 1) return {}; // no sampling rate
  StatedStep step{0, unit.has_value(), behind ? "" : std::string(word)};
  step.seconds = (unit ? *unit : StepUnit{1, rate}).seconds(*value);
  return step;
}

void refuse_bare_step(const RecordSource& source, const Line& line, double step)
{
  if (step >= 1)
    refuse(source, line,
           "has a time step of " + number(step) +
               " without a unit; write SEC or MSEC behind it, or a "
               "step in s");
}

std::vector<SaidStep> steps_said_by(const std::vector<Line>& lines)
{
  constexpr std::array<std::pair<std::string_view, bool>, 14> keys{
      std::pair{std::string_view("sampling rate"), true},
      {"sampling frequency", true},
      {"sample rate", true},
      {"sampling freq", true},
      {"samplerate", true},
      {"sampling interval", false},
      {"sample interval", false},
      {"sampling period", false},
      {"sampling step", false},
      {"time step", false},
      {"timestep", false},
      {"time interval", false},
      {"delta t", false},
      {"dt", false}};
  std::vector<SaidStep> steps;
  for (const Line& line : lines)
  {
    const std::string text = lower(line.text);
    // The step of the instrument is not that of the values once they have been resampled.
    constexpr std::array<std::string_view, 4> others{"original", "raw", "recorder", "instrument"};
    if (std::ranges::any_of(others,
                            [&](std::string_view word) { return find_word(text, word) != text.npos; }))
      continue;
    for (const auto& [key, rate] : keys)
    {
      const std::size_t at = find_word(text, key);
      if (at == text.npos) continue;
      bool joined = false;
      if (const auto step = take_step(without_joints(line.text.substr(at + key.size()), joined), rate))
        steps.push_back({step->seconds, step->has_unit, step->unknown, line});
      break;
    }
  }
  return steps;
}
} // namespace mpm::records

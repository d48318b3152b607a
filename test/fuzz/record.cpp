// A record that is read holds at least two finite values at a positive step, and reads back to the same bits
// when it is written as PEER does with all its digits. A short one also makes a motion, finite or refused.

#include "io/common/error.hpp"
#include "io/records/reader.hpp"
#include "test/fuzz/targets.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace mpm::fuzz
{
namespace
{
constexpr std::size_t most_of_motion = 64; // values: filters and spectra of long ones take their time

bool finite(const std::vector<double>& values)
{
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Takes a part off the front.
std::string take(std::string_view& text, char end)
{
  const std::size_t at = std::min(text.find(end), text.size());
  std::string part(text.substr(0, at));
  text.remove_prefix(std::min(at + 1, text.size()));
  return part;
}

RecordSource source_of(std::string_view line)
{
  RecordSource source;
  source.file = take(line, '|');
  if (const std::string format = take(line, '|'); !format.empty()) source.format = format;
  if (const std::string dt = take(line, '|'); !dt.empty()) source.dt = std::strtod(dt.c_str(), nullptr);
  source.unit = take(line, '|');
  source.component = take(line, '|');
  return source;
}

std::string as_peer(const Record& record)
{
  std::string text = "MADE\nMADE\n";
  text += record.quantity == Quantity::acceleration ? "ACCELERATION TIME SERIES IN UNITS OF M/S/S\n"
          : record.quantity == Quantity::velocity   ? "VELOCITY TIME SERIES IN UNITS OF M/S\n"
                                                    : "DISPLACEMENT TIME SERIES IN UNITS OF M\n";
  text += fmt::format("NPTS= {}, DT= {:.17g} SEC\n", record.values.size(), record.dt);
  for (const double value : record.values) text += fmt::format("{:.17e}\n", value);
  return text;
}
} // namespace

void try_record(std::string_view bytes)
try
{
  const std::string line = take(bytes, '\n');
  const Record record = parse_record(bytes, source_of(line));
  hold(record.values.size() >= 2, "a record of less than two values");
  hold(std::isfinite(record.dt) && record.dt > 0, fmt::format("a step of {} s", record.dt));
  hold(finite(record.values), "a value that is not finite");
  // A step beyond 1 s without a unit is refused in a file.
  if (record.dt < 1)
  {
    const Record again = parse_record(as_peer(record), {.file = "again"});
    hold(again.values == record.values && again.dt == record.dt && again.quantity == record.quantity,
         "another record when it is read again");
  }
  if (record.values.size() > most_of_motion) return;
  GroundMotion motion;
  try
  {
    motion = make_ground_motion(record, {.high_pass = record.values.size() % 2 ? 0.1 : 0});
  }
  catch (const std::runtime_error&)
  {
    return; // told by load_motion as an Error
  }
  hold(finite(motion.velocity) && finite(motion.acceleration), "a motion that is not finite");
}
catch (const Error& error)
{
  hold(error.code == exit_code::bad_input, fmt::format("exit code {}: {}", error.code, error.what()));
}
} // namespace mpm::fuzz

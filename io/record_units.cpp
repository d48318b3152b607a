#include "io/record_units.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace mpm::records
{
namespace
{
constexpr std::array units{
    RecordUnit{"g", Quantity::acceleration, standard_gravity},
    RecordUnit{"gal", Quantity::acceleration, 0.01},
    RecordUnit{"cm/s2", Quantity::acceleration, 0.01},
    RecordUnit{"m/s2", Quantity::acceleration, 1},
    RecordUnit{"cm/s", Quantity::velocity, 0.01},
    RecordUnit{"m/s", Quantity::velocity, 1},
    RecordUnit{"cm", Quantity::displacement, 0.01},
    RecordUnit{"m", Quantity::displacement, 1},
};

/// A unit as written in a header ("CM/SEC**2", "(g)", "m/s/s") in the spelling of the table.
const RecordUnit* unit_named(std::string_view text)
{
  std::string name = lower(text);
  const auto replace = [&](std::string_view from, std::string_view to)
  {
    for (std::size_t at = 0; (at = name.find(from, at)) != std::string::npos; at += to.size())
      name.replace(at, from.size(), to);
  };
  replace("sec", "s");
  replace("**", "");
  replace("^", "");
  replace("/s/s", "/s2");
  const auto found = std::ranges::find(units, std::string_view(name), &RecordUnit::name);
  return found == units.end() ? nullptr : &*found;
}

std::optional<Quantity> quantity_in(const std::string& lower_line)
{
  if (lower_line.find("acceleration") != std::string::npos) return Quantity::acceleration;
  if (lower_line.find("velocity") != std::string::npos) return Quantity::velocity;
  if (lower_line.find("displacement") != std::string::npos) return Quantity::displacement;
  return {};
}
} // namespace

Said said_by_units_line(const std::vector<Line>& header)
{
  for (const Line& line : header)
  {
    const std::string text = lower(line.text);
    std::size_t at = text.find("units");
    if (at == std::string::npos) continue;
    at += 5;
    const auto skip_blanks = [&]
    {
      while (at < text.size() && std::string_view(" \t:=([").find(text[at]) != std::string_view::npos) ++at;
    };
    skip_blanks();
    if (text.compare(at, 3, "of ") == 0) at += 3;
    if (text.compare(at, 4, "are ") == 0) at += 4;
    skip_blanks();
    const std::size_t end = std::min(text.find_first_of(" \t.,;)]", at), text.size());
    return {unit_named(std::string_view(text).substr(at, end - at)), quantity_in(text), line};
  }
  return {};
}

Said said_by_column_header(const Line& line)
{
  Said said{nullptr, quantity_in(lower(line.text)), line};
  for (std::size_t at = 0; (at = line.text.find_first_of("([", at)) != std::string_view::npos; ++at)
  {
    const std::size_t end = line.text.find_first_of(")]", at);
    if (end == std::string_view::npos) break;
    if (const RecordUnit* unit = unit_named(line.text.substr(at + 1, end - at - 1))) said.unit = unit;
  }
  return said;
}

const RecordUnit* unit_by_extension(const std::string& file)
{
  const std::string extension = lower(std::filesystem::path(file).extension().string());
  if (extension == ".at2") return unit_named("g");
  if (extension == ".vt2") return unit_named("cm/s");
  if (extension == ".dt2") return unit_named("cm");
  return nullptr;
}

RecordUnit agreed_unit(const RecordSource& source, const Said& said, const RecordUnit* by_extension)
{
  const RecordUnit* const given = source.unit.empty() ? nullptr : unit_named(source.unit);
  if (!source.unit.empty() && !given)
    refuse(source, "unknown unit '" + source.unit + "'; use g, gal, m/s2, cm/s2, m/s, cm/s, m or cm");
  if (said.unit && said.quantity && said.unit->quantity != *said.quantity)
    refuse(source, said.line,
           "the header calls it " + std::string(name_of(*said.quantity)) + " in " +
               std::string(said.unit->name) + ", which do not go together; mend the header");
  if (said.unit && by_extension && said.unit->quantity != by_extension->quantity)
    refuse(source, said.line,
           "the header says " + std::string(said.unit->name) + ", the file's extension " +
               std::string(name_of(by_extension->quantity)) + "; rename the file or mend it");
  if (given && said.unit && (given->si != said.unit->si || given->quantity != said.unit->quantity))
    refuse(source, said.line,
           "the file is in " + std::string(said.unit->name) + " and the case says " + source.unit +
               "; correct unit in the case");
  const RecordUnit* const of_file = said.unit ? said.unit : by_extension;
  const RecordUnit* const unit = given ? given : of_file;
  if (!unit) refuse(source, "its unit is not in the file; give unit, e.g. unit: g");
  const auto held = of_file ? std::optional(of_file->quantity) : said.quantity;
  if (held && *held != unit->quantity)
    refuse(source, "it holds " + std::string(name_of(*held)) + ", and unit " + std::string(unit->name) +
                       " is one of " + std::string(name_of(unit->quantity)) + "; correct unit in the case");
  if (source.quantity && *source.quantity != unit->quantity)
    refuse(source, "its unit " + std::string(unit->name) + " is one of " +
                       std::string(name_of(unit->quantity)) + " and the case says " +
                       std::string(name_of(*source.quantity)) + "; correct quantity or unit");
  return *unit;
}
} // namespace mpm::records

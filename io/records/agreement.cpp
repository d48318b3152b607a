// Four may say what the values are: the header, the file's extension, the case, and the quantity asked for. A
// wrong unit is the commonest and the most expensive mistake with records, a factor of 981 between g and gal,
// so that any two of them that differ are refused.

#include "io/records/statements.hpp"

#include <cmath>
#include <filesystem>

namespace mpm::records
{
std::optional<RecordUnit> unit_by_extension(const std::string& file)
{
  const std::string extension = lower(std::filesystem::path(file).extension().string());
  if (extension == ".at2") return parse_unit("g");
  if (extension == ".vt2") return parse_unit("cm/s");
  if (extension == ".dt2") return parse_unit("cm");
  return {};
}

namespace
{
/// The header against itself and the extension.
void check_header(const RecordSource& source, const Said& said, const std::optional<RecordUnit>& by_extension)
{
  if (!said.unknown.empty())
    refuse(source, said.line,
           "states the unit " + shown(said.unknown) + ", which is not known; write it as " +
               std::string(offered_units));
  // "ACCELERATION IN CM/S"
  if (said.unit && said.quantity && said.unit->quantity != *said.quantity)
    refuse(source, said.line,
           "the header calls it " + std::string(name_of(*said.quantity)) + " in " + said.unit->name +
               ", which do not go together; mend the header");
  const auto held = said.unit ? std::optional(said.unit->quantity) : said.quantity;
  if (held && by_extension && *held != by_extension->quantity)
    refuse(source, said.line,
           "the header says " + (said.unit ? said.unit->name : std::string(name_of(*held))) +
               ", the file's extension " + std::string(name_of(by_extension->quantity)) +
               "; rename the file or mend it");
}
} // namespace

RecordUnit agreed_unit(const RecordSource& source, const Said& said,
                       const std::optional<RecordUnit>& by_extension)
{
  // The case may add to what the file says, and repeat it, but not change it.
  const auto given = source.unit.empty() ? std::nullopt : parse_unit(source.unit);
  if (!source.unit.empty() && !given)
    refuse(source, "unknown unit '" + source.unit + "'; use " + std::string(offered_units));
  check_header(source, said, by_extension);
  if (given && said.unit && !(*given == *said.unit))
    refuse(source, said.line,
           "the file is in " + said.unit->name + " and the case says " + source.unit +
               "; correct unit in the case");
  const auto of_file = said.unit ? said.unit : by_extension;
  const auto unit = given ? given : of_file;
  if (!unit) refuse(source, "its unit is not in the file; give unit, e.g. unit: g");
  // "gal" in a title states nothing, but nobody writes it above values in g.
  if (!said.unit && said.mention && !(said.mention->unit == *unit))
    refuse(source, said.mention->line,
           "names " + said.mention->unit.name + ", and the unit is taken to be " + unit->name +
               "; write 'UNITS OF ...' into the header");
  const auto held = of_file ? std::optional(of_file->quantity) : said.quantity;
  if (held && *held != unit->quantity)
    refuse(source, "it holds " + std::string(name_of(*held)) + ", and unit " + unit->name + " is one of " +
                       std::string(name_of(unit->quantity)) + "; correct unit in the case");
  if (source.quantity && *source.quantity != unit->quantity)
    refuse(source, "its unit " + unit->name + " is one of " + std::string(name_of(unit->quantity)) +
                       " and the case says " + std::string(name_of(*source.quantity)) +
                       "; correct quantity or unit");
  return *unit;
}

double agreed_dt(const RecordSource& source, const Line& line, double dt, double tolerance)
{
  if (std::isnan(source.dt)) return dt;
  // The case's number is taken: the file's may have been rounded in print.
  if (!(std::abs(dt - source.dt) <= tolerance * dt))
    refuse(source, line,
           "the file's dt is " + number(dt) + " s and the case says " + number(source.dt) +
               " s; leave dt out of the case");
  return source.dt;
}

void check_steps(const RecordSource& source, const std::vector<Line>& lines, double dt)
{
  for (const SaidStep& step : steps_said_by(lines))
    // A word behind the number that is no unit makes it another thing: "dt = 0.01 approx".
    if (step.unknown.empty() && !(std::abs(step.seconds - dt) <= 1e-3 * dt))
      refuse(source, step.line,
             "states a time step of " + number(step.seconds) + " s, and the file's is " + number(dt) +
                 " s; mend the header");
}
} // namespace mpm::records

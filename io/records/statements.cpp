// What prose says of the unit. Headers hold several units, of instruments, peaks and filters beside that of
// the values, so that each statement is ranked by how surely it speaks of the values, and the surest one
// decides. One that is as sure and says another unit makes the header contradict itself.

#include "io/records/statements.hpp"

#include "io/records/words.hpp"

#include <algorithm>
#include <array>

namespace mpm::records
{
namespace
{
/// How surely a line speaks of the recorded values; the first that occurs decides.
enum Rank
{
  of_the_values, ///< names the quantity: "ACCELERATION IN UNITS OF G"
  of_the_file,   ///< "units: g"
  in_passing,    ///< the word units in a title
  of_another,    ///< an instrument's, a peak's
  mentioned,     ///< an acceleration's unit by itself: it may not contradict what the unit is taken to be
};

/// A unit that a line states, or the words that stand where it should.
struct Statement
{
  Rank rank;
  std::optional<RecordUnit> unit;
  std::string unknown;
  Line line;
};

/// Whether a word behind a unit makes it another: "g X 10", "g /100", "cm per".
bool goes_on(std::string_view word)
{
  constexpr std::array<std::string_view, 7> joints{"x", "by", "per", "times", "over", "squared", "cubed"};
  if (std::ranges::find(joints, std::string_view(lower(word))) != joints.end()) return true;
  return word.find_first_of("/*^%") != word.npos || word.starts_with("10") ||
         (word.size() > 1 && (word[0] == '-' || word[0] == '+') && is_digit(word[1]));
}

/// The unit at the front of a phrase, and what is stated where that is none.
Statement unit_at(std::string_view text, Rank rank, const Line& line)
{
  std::vector<std::string_view> words = words_of(phrase(text));
  if (!words.empty() && parse_step_unit(words[0]) && words[0].size() == phrase(text).size()) // "s, m/s2"
  {
    const std::size_t comma = text.find_first_of(",;");
    return comma == text.npos ? Statement{rank, {}, {}, line} : unit_at(text.substr(comma + 1), rank, line);
  }
  const auto is = [&](std::size_t i, Names names)
  { return i < words.size() && std::ranges::find(names, std::string_view(lower(words[i]))) != names.end(); };
  if (is(0, {"s", "sec", "secs", "seconds"}) && is(1, {"and"})) words.erase(words.begin(), words.begin() + 2);
  if (words.empty()) return {rank, {}, {}, line};
  // Units have blanks in them, "cm / sec / sec": the longest run of words that is one counts.
  const auto first_words = [&](std::size_t n)
  {
    const std::string_view last = words[n - 1];
    return std::string_view(words[0].data(), std::size_t(last.data() + last.size() - words[0].data()));
  };
  for (std::size_t n = std::min<std::size_t>(words.size(), 7); n > 0; --n)
    if (const auto unit = parse_unit(first_words(n)))
    {
      if (n == words.size() || !goes_on(words[n])) return {rank, unit, {}, line};
      break;
    }
  return {rank, {}, std::string(first_words(std::min<std::size_t>(words.size(), 4))), line};
}

/// A unit that follows the quantity: "ACCELERATION IN CM/S/S", "Velocity (cm/s)", "ACCELERATION, G".
void add_after_quantity(std::vector<Statement>& found, const Line& line, std::size_t end)
{
  // First a bracket anywhere behind the quantity, then plain words directly behind it.
  std::string_view rest = line.text.substr(end);
  for (std::size_t at = 0; (at = rest.find_first_of("([", at)) != rest.npos; ++at)
  {
    const std::string_view inside = bracket(rest.substr(at));
    if (at > 0 && rest[at - 1] == '/') continue; // cm/(s*s)
    const bool directly = trimmed(rest.substr(0, at)).empty();
    const auto unit = parse_unit(inside);
    if (unit || hints_at_unit(inside) || (directly && !is_label(inside)))
      found.push_back({of_the_values, unit, unit ? "" : std::string(inside), line});
  }
  if (!found.empty()) return;
  for (std::string_view word : {"time series", "time history", "time-history", "data", "record", "values"})
    if (const std::size_t at = lower(rest).find(word); at != rest.npos) rest.remove_prefix(at + word.size());
  if (const std::size_t in = behind_in(rest); in != rest.npos) rest.remove_prefix(in);
  bool joined = false;
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t,;:=-"), rest.size()));
  Statement statement = unit_at(without_joints(rest, joined), of_the_values, line);
  if (statement.unit || hints_at_unit(statement.unknown)) found.push_back(std::move(statement));
}

/// "DATA IN GAL", "values are in cm/s2".
void add_after_data(std::vector<Statement>& found, const Line& line, const std::string& text)
{
  if (!has_word(text, {"data", "values", "value", "amplitude", "amplitudes"})) return;
  const std::size_t in = behind_in(text);
  if (in == text.npos) return;
  Statement statement = unit_at(line.text.substr(in), of_the_file, line);
  if (statement.unit || hints_at_unit(statement.unknown)) found.push_back(std::move(statement));
}

/// Units of acceleration by themselves in a line of anything else.
void add_mentions(std::vector<Statement>& found, const Line& line)
{
  for (std::string_view word : cells_of(line.text, " \t,;:()[]="))
  {
    const auto unit = parse_unit(word);
    const bool sure = word.find('/') != word.npos || lower(word) == "gal" || lower(word) == "gals";
    if (unit && sure && unit->quantity == Quantity::acceleration)
      found.push_back({mentioned, unit, {}, line});
  }
}

/// Whether words speak of an instrument or a peak, not of the recorded values.
bool is_of_another(std::string_view text)
{
  return has_word(text, {"peak", "max", "maximum", "min", "minimum", "pga", "pgv", "pgd", "rms", "instrument",
                         "sensor", "recorder", "sensitivity", "digitizer", "threshold"}) &&
         text.find("time h") == text.npos && text.find("time s") == text.npos;
}

// From the surest to the least: each way is tried only where those before it had nothing to go by.
std::vector<Statement> statements_in(const Line& line)
{
  std::vector<Statement> found;
  const std::string text = lower(line.text);
  const auto quantity = quantity_word(text);
  bool has_units = false;
  for (std::string_view word : {"units", "unit"})
    for (std::size_t at = 0; (at = find_word(text, word, at)) != text.npos; at += word.size())
    {
      if (trimmed(std::string_view(text).substr(0, at)).ends_with("time")) continue;
      has_units = true;
      bool joined = false;
      std::string_view rest = without_joints(line.text.substr(at + word.size()), joined);
      if (const auto named = quantity_word(lower(rest));
          named && named->begin == 0) // "UNITS OF ACCELERATION: G"
        rest = without_joints(rest.substr(named->end), joined);
      const bool other = is_of_another(text.substr(0, at));
      const Rank rank = other ? of_another : quantity ? of_the_values : joined ? of_the_file : in_passing;
      found.push_back(unit_at(rest, rank, line));
    }
  if (!has_units && quantity && !is_of_another(text)) add_after_quantity(found, line, quantity->end);
  if (!has_units && !quantity && !is_of_another(text)) add_after_data(found, line, text);
  if (found.empty() && !has_units && !is_of_another(text)) add_mentions(found, line);
  std::erase_if(found, [](const Statement& s) { return !s.unit && s.unknown.empty(); });
  return found;
}

/// "VELOCITY TIME HISTORY": a line that says what is recorded, if not in which unit.
std::optional<Quantity> recorded_quantity(const Line& line)
{
  const std::string text = lower(line.text);
  const auto word = quantity_word(text);
  if (!word) return {};
  const std::string_view rest = trimmed(std::string_view(text).substr(word->end));
  const bool says =
      rest.starts_with("time series") || rest.starts_with("time history") || rest.starts_with("time-history");
  return says ? std::optional(word->quantity) : std::nullopt;
}

/// For messages: the unit, or the words that are none.
std::string name(const Statement& statement)
{
  return statement.unit ? statement.unit->name : shown(statement.unknown);
}
} // namespace

Said said_by(const RecordSource& source, const std::vector<Line>& lines)
{
  Said said;
  std::vector<Statement> all;
  // All lines first: the surest statement may be the last.
  for (const Line& line : lines)
  {
    std::ranges::move(statements_in(line), std::back_inserter(all));
    if (const auto quantity = recorded_quantity(line); quantity && !said.quantity)
    {
      said.quantity = quantity;
      said.line = line;
    }
  }
  for (const Statement& statement : all)
    if (statement.rank == mentioned && !said.mention) said.mention = Mention{*statement.unit, statement.line};
  std::erase_if(all, [](const Statement& s) { return s.rank >= of_another; });
  if (all.empty()) return said;
  const Statement best = *std::ranges::min_element(all, {}, &Statement::rank);
  // A title that merely holds the word units does not contradict a line that names the quantity.
  for (const Statement& other : all)
  {
    if (other.rank == in_passing && best.rank != in_passing) continue;
    const bool differs = best.unit && other.unit ? !(*best.unit == *other.unit)
                                                 : other.rank == best.rank && name(best) != name(other);
    if (differs)
      refuse(source, other.line,
             "states the unit " + name(other) + ", and line " + std::to_string(best.line.number) + " " +
                 name(best) + "; mend the header");
  }
  if (best.rank == in_passing && !best.unit && !hints_at_unit(best.unknown))
    return said; // "UNITED UNITS LTD."
  said.unit = best.unit;
  said.unknown = best.unknown;
  said.line = best.line;
  if (const auto word = quantity_word(lower(best.line.text))) said.quantity = word->quantity;
  return said;
}

Said said_by_column(const Line& line, std::string_view name)
{
  Said said{{}, {}, {}, line};
  const std::string text = lower(name);
  if (const auto word = quantity_word(text)) said.quantity = word->quantity;
  // The last bracket that is a unit: "acc (station 5) (g)".
  for (std::size_t at = 0; (at = name.find_first_of("([", at)) != name.npos; ++at)
  {
    const std::string_view inside = bracket(name.substr(at));
    if (const auto unit = parse_unit(inside))
      said.unit = unit;
    else if (!is_label(inside))
      said.unknown = inside;
  }
  if (said.unit && !hints_at_unit(said.unknown)) said.unknown.clear(); // "acc (station 5) (g)"
  if (said.unit || !said.unknown.empty()) return said;
  if (said.unit = parse_unit(name); said.unit) return said;
  // "a_g", "acc in g", "acc g": what is behind the last blank or underscore.
  std::size_t tail = std::min(name.find_last_of(" \t_") + 1, name.size()); // npos + 1 is 0
  if (const std::size_t in = behind_in(text); in != text.npos && in > 2) tail = in;
  const std::string_view before = name.substr(0, tail);
  const auto unit = parse_unit(name.substr(tail));
  // "10 g" and "%_g" are other units than g.
  const bool changed = std::ranges::any_of(before, is_digit) || hints_at_unit(before);
  if (unit && !changed)
    said.unit = unit;
  else if (unit || hints_at_unit(name))
    said.unknown = name;
  return said;
}
} // namespace mpm::records

// A unit is cut into words and signs, and these are compared: there are too many spellings for a list.
// Whoever writes another one is told the list of those that are offered.

#include "io/records/units.hpp"

#include "io/records/text.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace mpm::records
{
namespace
{
/// A unit of length and what it is called.
struct Length
{
  std::string_view symbol;
  double si;
  std::array<std::string_view, 5> words;
};
constexpr std::array lengths{
    Length{"m", 1, {"m", "meter", "meters", "metre", "metres"}},
    Length{"cm", 0.01, {"cm", "cms", "centimeter", "centimeters", "centimetre"}},
    Length{"mm", 0.001, {"mm", "mms", "millimeter", "millimeters", "millimetre"}},
    Length{"um", 1e-6, {"um", "micron", "microns", "micrometer", "micrometers"}},
    Length{"nm", 1e-9, {"nm", "nanometer", "nanometers", "nanometre", "nanometres"}},
    Length{"km", 1000, {"km", "kilometer", "kilometers", "kilometre", "kilometres"}},
    Length{"in", 0.0254, {"in", "inch", "inches", "in", "in"}},
    Length{"ft", 0.3048, {"ft", "foot", "feet", "ft", "ft"}},
};

/// Units that are not made of length and time.
struct Whole
{
  std::string_view word;
  RecordUnit unit;
};
const std::array whole_units{
    Whole{"g", {"g", Quantity::acceleration, standard_gravity}},
    Whole{"gs", {"g", Quantity::acceleration, standard_gravity}},
    Whole{"mg", {"mg", Quantity::acceleration, standard_gravity / 1000}},
    Whole{"millig", {"mg", Quantity::acceleration, standard_gravity / 1000}},
    Whole{"gal", {"gal", Quantity::acceleration, 0.01}},
    Whole{"gals", {"gal", Quantity::acceleration, 0.01}},
    Whole{"mgal", {"mgal", Quantity::acceleration, 1e-5}},
    Whole{"milligal", {"mgal", Quantity::acceleration, 1e-5}},
    Whole{"kine", {"cm/s", Quantity::velocity, 0.01}},
    Whole{"kines", {"cm/s", Quantity::velocity, 0.01}},
};

/// Lower case in ASCII: raised digits, dots and signs of UTF-8 and Latin-1 as plain ones.
std::string plain(std::string_view text)
{
  std::string out(text);
  const auto replace = [&](std::string_view from, std::string_view to)
  {
    for (std::size_t at = 0; (at = out.find(from, at)) != std::string::npos; at += to.size())
      out.replace(at, from.size(), to);
  };
  // In UTF-8: raised 2 and 1, middle dot, micro sign, Greek mu, raised minus, minus, dot operator.
  replace("\xC2\xB2", "2");
  replace("\xC2\xB9", "1");
  replace("\xC2\xB7", "*");
  replace("\xC2\xB5", "u");
  replace("\xCE\xBC", "u");
  replace("\xE2\x81\xBB", "-");
  replace("\xE2\x88\x92", "-");
  replace("\xE2\x8B\x85", "*");
  // In Latin-1: raised 2, middle dot.
  replace("\xB2", "2");
  replace("\xB7", "*");
  replace("**", "^");
  replace("'", "");
  return lower(out);
}

/// Words, whole numbers and signs of a unit; "per" is a slash, "squared" is "^ 2".
std::vector<std::string> tokens_of(std::string_view text)
{
  std::vector<std::string> tokens;
  const std::string all = plain(text);
  for (std::size_t at = 0; at < all.size();)
  {
    const std::size_t start = at;
    // Letters, digits or a single sign: "cm/s2" is cm, /, s, 2.
    if (is_letter(all[at]))
      while (at < all.size() && is_letter(all[at])) ++at;
    else if (is_digit(all[at]))
      while (at < all.size() && is_digit(all[at])) ++at;
    else
      ++at;
    std::string token = all.substr(start, at - start);
    if (token == "per") token = "/";
    if (token == "squared" || token == "sq")
    {
      tokens.push_back("^");
      token = "2";
    }
    if (!is_blank(token[0])) tokens.push_back(std::move(token));
  }
  return tokens;
}

bool is_second(const std::string& word)
{
  return word == "s" || word == "sec" || word == "secs" || word == "second" || word == "seconds";
}

/// The power of time that a length is divided by: "/ s / s", "/ s ^ 2", "/ ( s * s )", "s - 2"; -1 if it is
/// anything else.
int time_power(std::vector<std::string> tokens)
{
  std::erase_if(tokens, [](const std::string& t)
                { return t == "^" || t == "(" || t == ")" || t == "{" || t == "}"; });
  if (tokens.empty()) return 0;
  // Brackets and carets gone, every spelling of the second s: what is left is one of a few.
  std::string form;
  for (const std::string& token : tokens) form += is_second(token) ? "s" : token;
  if (form == "/s") return 1;
  if (form == "/s2" || form == "/s/s" || form == "/s*s") return 2;
  if (form.starts_with("*") || form.starts_with(".")) form.erase(0, 1);
  if (form == "s-1") return 1;
  if (form == "s-2" || form == "s-1s-1" || form == "s-1*s-1") return 2;
  return -1;
}

std::optional<RecordUnit> unit_of_length(const std::vector<std::string>& tokens)
{
  const auto length = std::ranges::find_if(
      lengths, [&](const Length& l) { return std::ranges::find(l.words, tokens[0]) != l.words.end(); });
  if (length == lengths.end()) return {};
  const int power = time_power({tokens.begin() + 1, tokens.end()});
  if (power < 0) return {};
  // A length over no, one or two times is a displacement, a velocity or an acceleration.
  const std::array<std::string_view, 3> over{"", "/s", "/s2"};
  const std::array quantity{Quantity::displacement, Quantity::velocity, Quantity::acceleration};
  return RecordUnit{std::string(length->symbol) + std::string(over[power]), quantity[power], length->si};
}
} // namespace

std::string_view bare(std::string_view text)
{
  constexpr std::string_view around = " \t\v\f()[]{}\"'";
  const std::size_t begin = text.find_first_not_of(around);
  if (begin == std::string_view::npos) return {};
  // A bracket within the unit stays: "cm/(s*s)".
  std::size_t end = text.find_last_not_of(text.find('(', begin) == std::string_view::npos ? around : " \t");
  return text.substr(begin, end - begin + 1);
}

std::optional<RecordUnit> parse_unit(std::string_view text)
{
  std::vector<std::string> tokens = tokens_of(bare(text));
  if (!tokens.empty() && tokens.back() == ".") tokens.pop_back();
  if (tokens.empty()) return {};
  const bool percent = tokens[0] == "%";
  if (percent) tokens.erase(tokens.begin());
  if (tokens.empty()) return {};
  const auto whole = std::ranges::find(whole_units, std::string_view(tokens[0]), &Whole::word);
  if (whole == whole_units.end()) return percent ? std::nullopt : unit_of_length(tokens);
  RecordUnit unit = whole->unit;
  if (tokens.size() == 1 && !percent) return unit;
  if (unit.name != "g") return {};
  if (percent && tokens.size() == 1) return RecordUnit{"%g", Quantity::acceleration, standard_gravity / 100};
  // "G/10": the unit of BHRC and of others who wanted integers.
  const bool power_of_ten = tokens.size() == 3 && tokens[1] == "/" &&
                            (tokens[2] == "10" || tokens[2] == "100" || tokens[2] == "1000");
  if (percent || !power_of_ten) return {};
  return RecordUnit{"g/" + tokens[2], Quantity::acceleration, standard_gravity / std::stod(tokens[2])};
}

std::optional<StepUnit> parse_step_unit(std::string_view text)
{
  std::string name = plain(bare(text));
  if (name.ends_with('.')) name.pop_back();
  std::erase(name, ' ');
  const auto is_one_of = [&](std::initializer_list<std::string_view> names)
  { return std::ranges::find(names, std::string_view(name)) != names.end(); };
  if (is_second(name)) return StepUnit{1, false};
  if (is_one_of({"ms", "msec", "msecs", "millisec", "millisecond", "milliseconds"}))
    return StepUnit{1000, false};
  if (is_one_of({"us", "usec", "microsec", "microsecond", "microseconds"})) return StepUnit{1e6, false};
  if (is_one_of({"hz", "hertz", "sps", "samples/s", "samples/sec", "samples/second", "samplespersecond",
                 "samplespersec", "1/s", "pts/sec", "points/sec"}))
    return StepUnit{1, true};
  return {};
}
} // namespace mpm::records

// Damaged and rewritten records with a known truth: each is read as the truth, or refused.

#include "test/io/record_samples.hpp"
#include "test/io/record_texts.hpp"

#include <algorithm>
#include <random>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// A number from 0 to below n; the same on every machine.
std::size_t below(std::mt19937& random, std::size_t n)
{
  return random() % n;
}

std::vector<std::string> lines_of(const std::string& text)
{
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines, const std::string& end = "\n")
{
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

bool is_data(const std::string& line)
{
  return line.find_first_not_of(" 0123456789.,+-E") == std::string::npos &&
         line.find_first_of("0123456789") != std::string::npos;
}

/// A place where one of `chars` stands.
std::size_t place_of(std::mt19937& random, const std::string& text, std::string_view chars)
{
  std::size_t at = below(random, text.size());
  while (chars.find(text[at]) == std::string_view::npos) at = (at + 1) % text.size();
  return at;
}

struct Mutant
{
  std::string what, text;
  double factor = 1;          ///< of the values that are right
  bool may_end_early = false; ///< a file that counts nothing may end after any line
};

/// What a file says of unit, step and count in other words; factor 0: a contradiction or nothing known.
struct Rewrite
{
  std::string from, to;
  double factor;
};
const std::vector<Rewrite> rewrites{{"CM/S/S", "cm/sec**2", 1},
                                    {"CM/S/S", "GALS", 1},
                                    {"CM/S/S", "MM/S/S", 0.1},
                                    {"CM/S/S", "m/s²", 100},
                                    {"CM/S/S", "IN/SEC/SEC", 2.54},
                                    {"CM/S/S", "G/10", 98.0665},
                                    {"CM/S/S", "CUBITS/S/S", 0},
                                    {"CM/S/S", "CM/S", 0},
                                    {"CM/S/S", "COUNTS", 0},
                                    {"UNITS OF G", "UNITS OF %G", .01},
                                    {"UNITS OF G", "UNITS OF MG", .001},
                                    {"UNITS OF G", "UNITS OF G*10", 0},
                                    {"UNITS OF G", "UNITS OF CM", 0},
                                    {"DT= .01000 SEC", "DT= 10 MSEC", 1},
                                    {"DT= .01000 SEC", "DT= 100 HZ", 1},
                                    {"DT= .01000 SEC", "DT= 10 JIFFIES", 0},
                                    {"DT= .01000 SEC", "DT= 10", 0},
                                    {"NPTS=   400", "NPTS=   399", 0},
                                    {"NPTS=   400", "NPTS=   401", 0},
                                    {"NPTS=    400", "NPTS=    200", 0},
                                    {"NPTS=    400", "NPTS=  4OO", 0},
                                    {"(cm/s2)", "(gal)", 1},
                                    {"(cm/s2)", "(m/s/s)", 100},
                                    {"(cm/s2)", "(cm/m2)", 0},
                                    {"100 Hz", "10 ms", 1},
                                    {"100 Hz", "0.01 s", 1},
                                    {"100 Hz", "100 rpm/3", 0},
                                    {"\n400\n", "\n399\n", 0},
                                    {"\n400\n", "\n401\n", 0},
                                    {"time (s)", "time (h)", 0},
                                    {"time (s)", "index", 0},
                                    {"Duration Time(s)  4", "Duration Time(s)  3", 0},
                                    {"100Hz", "200Hz", 0},
                                    {"2000(gal)", "1000(gal)", 0},
                                    {"NDATA: 400", "NDATA: 380", 0},
                                    {"0.010000", "0.020000", 0},
                                    {"cm/s^2", "m/s^2", 0},
                                    {"cm/s^2", "furlongs", 0},
                                    {"units=cm/sec2(04)", "units=cm/sec (05)", 0},
                                    {"    400  acc", "    408  acc", 0},
                                    {"approx    4", "approx   14", 0},
                                    {"   400 points of accel", "   384 points of accel", 0},
                                    {"in cm/sec2", "in cm/sec", 0},
                                    {"in units of g", "in units of m/s2", 0},
                                    {"100 pts/sec", "200 Pts/hour", 0},
                                    {"RecordLength(sec): 4", "RecordLength(sec): 9", 0},
                                    {"SampleRate(Hz): 100", "SampleRate(Hz): 50", 0},
                                    {"       400", "       390", 0},
                                    {"2 CORRECTED ACC", "4 CORRECTED ACC", 0},
                                    {"gal. DC", "g. DC", 0},
                                    {"0.010 sec", "0.005 sec", 0},
                                    {"points   400", "points   300", 0},
                                    {"OF POINTS =    400", "OF POINTS =    300", 0},
                                    {"G/10", "G/100/2", 0},
                                    {"mm/s/s at", "cm/s/s at", 0}};

Mutant rewritten(std::mt19937& random, const std::string& text)
{
  std::vector<Rewrite> fitting;
  for (const Rewrite& rewrite : rewrites)
    if (text.find(rewrite.from) != std::string::npos) fitting.push_back(rewrite);
  const Rewrite& rewrite = fitting.at(below(random, fitting.size()));
  Mutant mutant{rewrite.from + " -> " + rewrite.to, text, rewrite.factor};
  mutant.text.replace(mutant.text.find(rewrite.from), rewrite.from.size(), rewrite.to);
  return mutant;
}

Mutant mutant_of(std::mt19937& random, const Sample& sample)
{
  const std::string& text = sample.text;
  std::vector<std::string> lines = lines_of(text);
  std::size_t line = below(random, lines.size());
  const auto numbers = [&]
  {
    while (!is_data(lines[line])) line = (line + 1) % lines.size();
    return line;
  };
  std::string changed = text;
  switch (below(random, 14))
  {
  case 0:
    changed[place_of(random, text, "0123456789")] = "OlxSBZ"[below(random, 6)];
    return {"a digit a letter", changed};
  case 1:
    changed[place_of(random, text, ".")] = ',';
    return {"a point a comma", changed};
  case 2:
  {
    std::string& data = lines[numbers()];
    const std::size_t at = data.find_first_not_of(" ,", below(random, data.size()));
    if (at == std::string::npos) return {"nothing", text};
    const std::size_t begin = data.find_last_of(" ,", at) + 1,
                      end = std::min(data.find_first_of(" ,", at), data.size());
    data.replace(begin, end - begin,
                 std::vector<std::string>{"nan", "****", "inf", "1e999"}[below(random, 4)]);
    return {"a number none", joined(lines)};
  }
  case 3:
  {
    const bool at_end = line + 1 == lines.size();
    if (sample.name == "two_column" && line == 2) ++line; // a first value that is missing shows nowhere
    lines.erase(lines.begin() + long(line));
    return {"line " + std::to_string(line + 1) + " dropped", joined(lines), 1, at_end};
  }
  case 4:
    lines.insert(lines.begin() + long(line), lines[line]);
    return {"line " + std::to_string(line + 1) + " doubled", joined(lines)};
  case 5:
    changed.resize(1 + below(random, text.size() - 1));
    return {"cut off at " + std::to_string(changed.size()), changed, 1, true};
  case 6:
    for (std::string& data : lines)
      if (is_data(data)) data += " 7.0";
    return {"a column more", joined(lines)};
  case 7:
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (is_data(lines[i])) lines[i] = std::to_string(i) + " " + lines[i];
    return {"an index before", joined(lines)};
  case 8:
    return {"CR LF", joined(lines, "\r\n")};
  case 9:
    return {"blanks at the ends", joined(lines, "  \n") + "\n\n"};
  case 10:
  {
    std::string& data = lines[numbers()];
    const std::size_t blank = data.find_first_of(" ,", data.find_first_of("0123456789"));
    if (blank != std::string::npos) data.erase(blank, data.find_first_not_of(" ,", blank) - blank);
    return {"numbers that touch", joined(lines)};
  }
  case 11:
    changed.insert(below(random, text.size()), 1, "*#?!&"[below(random, 5)]);
    return {"a stray sign", changed};
  default:
    return rewritten(random, text);
  }
}

/// Values and step are those of the truth; or of its beginning, where that is all that can be asked.
bool is_truth(const Record& record, const Record& truth, const Mutant& mutant)
{
  if (mutant.factor == 0 || std::abs(record.dt - truth.dt) > 1e-12 || record.quantity != truth.quantity)
    return false;
  if (record.values.size() > truth.values.size()) return false;
  if (record.values.size() < truth.values.size() && !mutant.may_end_early) return false;
  for (std::size_t i = 0; i < record.values.size(); ++i)
    if (std::abs(record.values[i] - mutant.factor * truth.values[i]) >
        1e-12 * std::abs(mutant.factor * truth.values[i]))
      return false;
  return true;
}
} // namespace

TEST_CASE("mutants of each format are read as the truth or refused", "[io]")
{
  for (const Sample& sample : samples())
  {
    const Record truth = parse_record(sample.text, sample.source);
    std::mt19937 random(20240229);
    int read = 0, refused = 0;
    for (int i = 0; i < 200; ++i)
    {
      Mutant mutant = mutant_of(random, sample);
      mutant.may_end_early = mutant.may_end_early && sample.name == "two_column"; // others count their values
      INFO(sample.source.file << ": mutant " << i << ", " << mutant.what);
      const Failure failure = failure_of(
          [&]
          {
            const Record record = parse_record(mutant.text, sample.source);
            CHECK(is_truth(record, truth, mutant));
            ++read;
          });
      refused += failure.code == exit_code::bad_input;
    }
    INFO(sample.source.file << ": " << read << " read, " << refused << " refused");
    CHECK(read + refused == 200);
    CHECK(read >= 25); // what changes nothing, or is said in other words, is not refused
    CHECK(refused >= 80);
  }
}

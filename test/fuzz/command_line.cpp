// A command line that is taken is taken again, to the same options, when these are written out as one.

#include "solver/stages/command_line.hpp"

#include "io/common/error.hpp"
#include "test/fuzz/targets.hpp"

#include <fmt/format.h>
#include <iostream>
#include <sstream>

namespace mpm::fuzz
{
namespace
{
/// Keeps what is printed off the screen.
class Hush
{
public:
  Hush() : before_(std::cout.rdbuf(text_.rdbuf())) {}
  ~Hush() { std::cout.rdbuf(before_); }

private:
  std::ostringstream text_;
  std::streambuf* before_;
};

std::optional<Options> parsed(std::vector<std::string> words)
{
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  Options options;
  options.program = words.front();
  const auto code = parse_command_line(static_cast<int>(words.size()), argv.data(), options, "version");
  hold(!code || *code == exit_code::done, "an exit code beside an answer");
  return code ? std::nullopt : std::optional(options);
}

/// The options as words, each with its value behind a sign, so that no value is taken for an option.
std::vector<std::string> words_of(const Options& o)
{
  std::vector<std::string> words{o.program, o.case_file.string()};
  const auto add = [&](const char* name, const std::string& value)
  {
    if (!value.empty()) words.push_back(std::string(name) + "=" + value);
  };
  const auto flag = [&](const char* name, bool given)
  {
    if (given) words.push_back(name);
  };
  add("--out", o.out);
  add("--from", o.from);
  add("--motion", o.motion);
  add("--vertical", o.vertical);
  if (std::isfinite(o.record_dt)) add("--record-dt", fmt::format("{}", o.record_dt));
  add("--record-unit", o.record_unit);
  add("--record-format", o.record_format);
  add("--record-component", o.record_component);
  add("--vertical-component", o.vertical_component);
  if (o.scale != 1) add("--scale", fmt::format("{}", o.scale));
  add("--profile", o.profile);
  for (const std::string& override_text : o.overrides) add("--set", override_text);
  if (o.threads) add("--threads", std::to_string(o.threads));
  if (o.max_wall != 0) add("--max-wall", fmt::format("{} s", o.max_wall));
  flag("--check", o.check);
  flag("--print-case", o.print_case);
  flag("--fresh", o.fresh);
  flag("--quiet", o.verbosity == Verbosity::quiet);
  flag("--verbose", o.verbosity == Verbosity::verbose);
  return words;
}
} // namespace

void try_command_line(std::string_view bytes)
try
{
  std::vector<std::string> words(1);
  for (const char c : bytes)
    if (c == '\n' || c == '\0')
      words.emplace_back();
    else
      words.back() += c;
  words.front() = words.front().ends_with("seismic") ? "mpm-seismic" : "mpm-static";
  const Hush hush;
  const std::optional<Options> options = parsed(words);
  if (!options) return;
  const std::vector<std::string> written = words_of(*options);
  std::optional<Options> again;
  try
  {
    again = parsed(written);
  }
  catch (const Error& error)
  {
    throw Broken(
        fmt::format("{} is refused when it is given again: {}", fmt::join(written, " "), error.what()));
  }
  hold(again && words_of(*again) == written, fmt::format("other options from {}", fmt::join(written, " ")));
}
catch (const Error& error)
{
  hold(error.code == exit_code::usage, fmt::format("exit code {}: {}", error.code, error.what()));
}
} // namespace mpm::fuzz

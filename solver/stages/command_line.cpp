#include "solver/stages/command_line.hpp"

#include "example.hpp"
#include "io/case/key_table.hpp"
#include "io/case/schema.hpp"
#include "io/case/units.hpp"
#include "io/common/error.hpp"
#include "io/common/printable.hpp"
#include "io/common/suggestion.hpp"
#include "io/records/reader.hpp"
#include "solver/stages/completion.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>

namespace mpm
{
namespace
{
constexpr int most_threads = 4096;

/// What is read once it is known which options were given: numbers and times as they were typed.
struct Typed
{
  std::string scale, record_dt, threads, max_wall, keys;
  bool quiet = false, verbose = false, schema = false, example = false, print_record = false;
};

[[noreturn]] void refuse(const std::string& option, const std::string& why)
{
  throw Error(exit_code::usage, option + ": " + why);
}

/// The only reading of numbers: decimal, finite, nothing behind them but a unit of the dimension.
double number(const std::string& option, const std::string& text, Dimension dimension)
{
  const Quantified read = parse_quantity(text, dimension);
  if (read.problem.empty()) return read.value;
  const bool comma = text.find(',') != std::string::npos;
  refuse(option + " '" + text + "'", read.problem + (comma ? "; decimals follow a point: 1.5" : ""));
}

/// A number above 0, in SI.
double positive(const std::string& option, const std::string& text, Dimension dimension)
{
  const double value = number(option, text, dimension);
  if (!(value > 0)) refuse(option + " '" + text + "'", "must be above 0");
  return value;
}

/// A number of threads.
int count(const std::string& option, const std::string& text)
{
  const double value = number(option, text, Dimension::none);
  if (value != std::floor(value) || value < 1 || value > most_threads)
    refuse(option + " '" + text + "'", "must be a whole number from 1 to " + std::to_string(most_threads));
  return static_cast<int>(value);
}

/// Options that mpm-seismic alone has.
void add_seismic_options(CLI::App& app, Options& options, Typed& typed)
{
  app.add_option("--from", options.from, "final.h5 of the static stage")->type_name("FILE");
  app.add_option("--motion", options.motion, "record instead of the case's horizontal one")
      ->type_name("FILE");
  app.add_option("--vertical", options.vertical, "record instead of the case's vertical one")
      ->type_name("FILE");
  app.add_option("--record-dt", typed.record_dt,
                 "time step in s of a --motion or --vertical that does not tell it")
      ->type_name("S");
  app.add_option("--record-unit", options.record_unit,
                 "unit of a --motion or --vertical that does not tell it (g, m/s2, gal)")
      ->type_name("U");
  app.add_option("--record-format", options.record_format,
                 "format of a --motion or --vertical that does not show it (shake)")
      ->type_name("F");
  app.add_option("--record-component", options.record_component,
                 "component of a --motion that holds several, as the file names it")
      ->type_name("C");
  app.add_option("--vertical-component", options.vertical_component,
                 "component of a --vertical that holds several")
      ->type_name("C");
  app.add_option("--scale", typed.scale, "factor on the motion, on top of the case's")->type_name("F");
  app.add_flag("--print-record", typed.print_record,
               "print the record of --motion in PEER's format, on stdout; run nothing");
}

/// Options that both programs have.
void add_common_options(CLI::App& app, Options& options, Typed& typed)
{
  app.add_option("CASE", options.case_file, "case file (YAML), required")->type_name("");
  app.add_option("--out", options.out, "output folder")->type_name("DIR");
  app.add_flag("--check", options.check, "validate and predict the cost, on stdout; run nothing");
  app.add_flag("--print-case", options.print_case,
               "print the case with every default written out, on stdout; run nothing");
  app.add_option("--keys", typed.keys,
                 "print the keys of the case file, those below PATH if given, on stdout")
      ->type_name("[PATH]")
      ->expected(0, 1);
  app.add_flag("--schema", typed.schema, "print a JSON Schema of the case file, for editors");
  app.add_flag("--example", typed.example, "print a case to start from");
  app.add_option("--threads", typed.threads, "threads (default: OMP_NUM_THREADS, else all)")->type_name("N");
  app.add_option("--profile", options.profile, "apply one of the case's profiles; --set goes on top")
      ->type_name("NAME");
  app.add_option("--set", "key.path=value: override a key of the case; repeatable")
      ->type_name("KEY=VALUE")
      ->type_size(1)
      ->expected(1)
      ->take_all();
  app.add_option("--max-wall", typed.max_wall, "stop with a checkpoint after this time (2h, 90min, 1800s)")
      ->type_name("TIME");
  app.add_flag("--fresh", options.fresh, "start anew in a folder that holds results");
  app.add_flag("--quiet", typed.quiet, "warnings and errors only");
  app.add_flag("--verbose", typed.verbose, "details too");
}

/// Long names of all options, without dashes.
std::vector<std::string> names_of(const CLI::App& app)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  return names;
}

/// What is left over: an option that there is not, or a second case.
void refuse_leftovers(const CLI::App& app, bool seismic)
{
  const std::vector<std::string> left = app.remaining();
  if (left.empty()) return;
  const auto option =
      std::find_if(left.begin(), left.end(), [](const std::string& word) { return word.starts_with("-"); });
  if (option == left.end())
    refuse("'" + left.front() + "'",
           "is one argument too many: there is one case, and options begin with --");
  const std::string typed = option->substr(0, option->find('='));
  const std::string name = typed.substr(std::min(typed.find_first_not_of('-'), typed.size()));
  CLI::App others;
  Options ignored;
  Typed ignored_too;
  add_seismic_options(others, ignored, ignored_too);
  const std::vector<std::string> theirs = names_of(others);
  if (!seismic && std::find(theirs.begin(), theirs.end(), name) != theirs.end())
    refuse(typed, "is an option of mpm-seismic; the static state does not depend on the motion");
  const std::string best = nearest(name, names_of(app));
  refuse(typed, "there is no such option" + (best.empty() ? "" : "; did you mean '--" + best + "'?") +
                    "; see --help");
}

/// An option takes the next word as its value, whatever that is.
void refuse_no_values(const CLI::App& app)
{
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
    {
      if (value.find_first_not_of(" \t") == std::string::npos)
        refuse(option->get_name(), "is empty; give a value, or leave the option out");
      if (value.size() > 1 && value[0] == '-' && value.find_first_of("0123456789.") != 1)
        refuse(option->get_name(), "needs a value, and '" + value +
                                       "' looks like an option; for a file of that "
                                       "name write ./" +
                                       value);
    }
}

/// "a.b[0]" and "a.b.0" are one key.
std::string key_of(const std::string& override_text)
{
  std::string key = override_text.substr(0, override_text.find('='));
  std::erase(key, ']');
  std::replace(key.begin(), key.end(), '[', '.');
  return key;
}

/// Overrides must say something, and none may undo one before it, as `--set a.b=1 --set a={c: 2}` would.
void check_overrides(const std::vector<std::string>& overrides)
{
  for (auto now = overrides.begin(); now != overrides.end(); ++now)
  {
    const std::size_t sign = now->find('=');
    if (sign == std::string::npos || now->find_first_not_of(" \t", sign + 1) == std::string::npos)
      refuse("--set " + *now, "has no value; write --set key.path=value");
    for (auto before = overrides.begin(); before != now; ++before)
      if (*before != *now && (key_of(*before) + ".").starts_with(key_of(*now) + "."))
        refuse("--set " + *now, "undoes --set " + *before + "; leave one of them");
  }
}

/// Options that ask for something together.
void check_pairs(const CLI::App& app, const Typed& typed, const Options& options)
{
  if (options.out.empty() && !options.check && !options.print_case)
    refuse("--out", "is missing: where shall the results go?");
  if (typed.quiet && typed.verbose) refuse("--quiet", "contradicts --verbose; leave one of them");
  if (!options.seismic()) return;
  for (const auto& [name, file] :
       {std::pair{"--record-component", "--motion"}, std::pair{"--vertical-component", "--vertical"}})
    if (app.count(name) && !app.count(file))
      refuse(name, std::string("applies to a record of ") + file +
                       ", and there is none; for a record of the case set "
                       "its key component");
  if (app.count("--motion") || app.count("--vertical")) return;
  for (const std::string name : {"--record-dt", "--record-unit", "--record-format"})
    if (app.count(name))
      refuse(name, "applies to a record of --motion or --vertical, and there is neither; for a record of the "
                   "case use --set seismic.motion.horizontal." +
                       name.substr(std::string("--record-").size()));
}

/// Answers --keys: the keys at and below a path, all for an empty one.
void print_keys(const std::string& path)
{
  std::cout << text_of(case_keys(path));
  if (path.empty()) std::cout << "\nUnits:\n" << units_text();
}

/// Answers --print-record, without a case.
void print_record(const CLI::App& app, const Options& options)
{
  for (const std::string name : {"CASE", "--vertical", "--vertical-component", "--scale", "--out", "--from"})
    if (app.count(name)) refuse(name, "does not go with --print-record, which prints the record as it is");
  if (options.motion.empty()) refuse("--print-record", "prints the record of --motion; give --motion FILE");
  RecordSource source{.file = options.motion, .dt = options.record_dt, .unit = options.record_unit};
  source.component = options.record_component;
  if (!options.record_format.empty()) source.format = options.record_format;
  const Record record = read_record(source);
  for (const auto* said : {&record.notes, &record.warnings})
    for (const std::string& text : *said) std::cerr << printable(text) << '\n';
  std::cout << peer_text(record) << std::flush;
}

/// Numbers, times and lists; the library has read words and files already.
void read_values(const CLI::App& app, const Typed& typed, Options& options)
{
  const auto given = [](const std::string& text) { return !text.empty(); };
  if (given(typed.threads)) options.threads = count("--threads", typed.threads);
  if (given(typed.max_wall)) options.max_wall = positive("--max-wall", typed.max_wall, Dimension::time);
  if (given(typed.record_dt)) options.record_dt = positive("--record-dt", typed.record_dt, Dimension::none);
  if (given(typed.scale)) options.scale = number("--scale", typed.scale, Dimension::none);
  options.overrides = app.get_option("--set")->results();
  check_overrides(options.overrides);
  if (typed.quiet) options.verbosity = Verbosity::quiet;
  if (typed.verbose) options.verbosity = Verbosity::verbose;
}
} // namespace

std::optional<int> parse_command_line(int argc, char** argv, Options& options, const std::string& version)
try
{
  const bool seismic = options.seismic();
  CLI::App app(seismic ? "Shakes a slope from its static state, and follows the slide."
                       : "Finds the static state of a slope under gravity.",
               options.program);
  Typed typed;
  add_common_options(app, options, typed);
  if (seismic) add_seismic_options(app, options, typed);
  for (CLI::Option* option : app.get_options()) option->disable_flag_override(); // no --fresh=false
  app.set_version_flag("--version", version);
  app.allow_extras();
  if (argc > 1 && std::string_view(argv[1]) == "--complete")
  {
    std::cout << completion(app, {argv + 2, argv + argc}, case_values);
    return exit_code::done;
  }
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success& end)
  {
    return app.exit(end);
  }
  catch (const CLI::ArgumentMismatch& error)
  {
    const std::string what = error.what(), option = what.substr(0, what.find(':'));
    const bool missing = what.ends_with("missing");
    refuse(option, missing ? "needs a value; see --help" : "is given more than once; leave one of them");
  }
  catch (const CLI::ParseError& error)
  {
    throw Error(exit_code::usage, std::string(error.what()) + "; see --help");
  }
  refuse_leftovers(app, seismic);
  if (app.count("--keys"))
  {
    print_keys(typed.keys);
    return exit_code::done;
  }
  if (typed.schema || typed.example)
  {
    std::cout << (typed.schema ? case_schema() : std::string(example_case));
    return exit_code::done;
  }
  refuse_no_values(app);
  if (typed.print_record)
  {
    read_values(app, typed, options);
    print_record(app, options);
    return exit_code::done;
  }
  if (!app.count("CASE")) refuse("CASE", "is missing: give a case file; see --help");
  read_values(app, typed, options);
  check_pairs(app, typed, options);
  return std::nullopt;
}
catch (const Error& error)
{
  throw Error(error.code, options.program + ": " + error.what());
}
} // namespace mpm

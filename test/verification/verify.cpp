// seismpm-verify: runs the verification ladder, writes its table and its curves.
//
//   seismpm-verify --out run/verification
//   seismpm-verify --out run/verification --only layer,self_weight
//   seismpm-verify --list

#include "test/verification/report.hpp"

#include "solver/mpm/parallel.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <iostream>

using namespace mpm::verification;

namespace
{
struct Options
{
  std::string out;
  std::vector<std::string> only;
  bool list = false, quick = false;
  int threads = 1;
};

void list_cases()
{
  for (const LadderCase& one : ladder_cases())
    std::cout << fmt::format("{:<18} {}\n", one.name, load_ladder(one.name).title);
}

int verify(const Options& options)
{
  mpm::parallel::use_threads(options.threads);
  std::vector<const LadderCase*> wanted;
  for (const std::string& name : options.only) wanted.push_back(&ladder_case(name));
  if (wanted.empty())
    for (const LadderCase& one : ladder_cases()) wanted.push_back(&one);
  std::vector<Result> results;
  bool pass = true;
  for (const LadderCase* one : wanted)
  {
    const Ladder ladder = load_ladder(one->name);
    results.push_back(climb(*one, ladder, options.quick ? ladder.quick : ladder.full));
    for (const Row& row : results.back().rows)
    {
      std::cerr << table_line(row) << '\n';
      pass = pass && row.pass();
    }
  }
  write_table(options.out, results);
  write_curves(options.out, results);
  return pass ? 0 : 1;
}
} // namespace

int main(int argc, char** argv)
{
  Options options;
  CLI::App app{
      "Runs the verification ladder of cases/verification: exit code 0 when every row passes, 1 when not"};
  app.add_option("--out", options.out, "folder for RESULTS.md and results.json");
  app.add_option("--only", options.only, "these cases only")->delimiter(',');
  app.add_option("--threads", options.threads, "threads")->capture_default_str();
  app.add_flag("--quick", options.quick, "the coarse resolutions of the default tests");
  app.add_flag("--list", options.list, "names and titles of the cases");
  CLI11_PARSE(app, argc, argv);
  try
  {
    if (options.list) return list_cases(), 0;
    if (options.out.empty()) throw std::runtime_error("seismpm-verify: --out is missing: give a folder");
    return verify(options);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 2;
  }
}

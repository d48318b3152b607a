// seismpm-verify: runs the verification ladder, writes its table and its curves.
//
//   seismpm-verify --out run/verification
//   seismpm-verify --out run/verification --only layer,self_weight
//   seismpm-verify --list

#include "test/verification/report.hpp"

#include "solver/mpm/parallel.hpp"
#include "solver/stages/completion.hpp"
#include "solver/stages/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <atomic>
#include <future>
#include <iostream>
#include <mutex>

using namespace mpm::verification;

namespace
{
struct Options
{
  std::string out, cases;
  std::vector<std::string> only;
  bool list = false, quick = false;
  int threads = 1, jobs = 1;
};

/// cases/verification of the tree in which the program was built, or of what it is installed with.
std::filesystem::path find_cases()
{
  namespace fs = std::filesystem;
  for (fs::path above = fs::read_symlink("/proc/self/exe"); above.has_relative_path();)
  {
    above = above.parent_path();
    for (const char* cases : {"cases/verification", "share/seismpm/cases/verification"})
      if (fs::exists(above / cases)) return above / cases;
  }
  throw std::runtime_error("seismpm-verify: there is no cases/verification around the program; give --cases");
}

void list_cases(const Options& options)
{
  for (const LadderCase& one : ladder_cases())
    std::cout << fmt::format("{:<18} {}\n", one.name, load_ladder(one.name, options.cases).title);
}

/// What the shell may complete.
std::vector<mpm::Candidate> values_of(const CLI::Option& option, const std::string& typed,
                                      const std::vector<std::string>& before)
{
  if (option.check_lname("only"))
  {
    std::vector<mpm::Candidate> names;
    for (const LadderCase& one : ladder_cases()) names.push_back({std::string(one.name), "case"});
    return names;
  }
  return mpm::case_values(option, typed, before);
}

/// Runs cases side by side in so many jobs, the last first: they take longest.
std::vector<Result> climb_all(const Options& options, const std::vector<const LadderCase*>& wanted)
{
  std::vector<Result> results(wanted.size());
  std::atomic<std::size_t> taken = 0;
  std::mutex printing;
  const auto work = [&]
  {
    mpm::parallel::use_threads(options.threads); // of loops that this thread starts
    for (std::size_t k; (k = taken++) < wanted.size();)
    {
      const std::size_t at = wanted.size() - 1 - k;
      const Ladder ladder = load_ladder(wanted[at]->name, options.cases);
      results[at] = climb(*wanted[at], ladder, options.quick ? ladder.quick : ladder.full);
      const std::lock_guard lock(printing);
      for (const Row& row : results[at].rows) std::cerr << table_line(row) << '\n';
    }
  };
  std::vector<std::future<void>> jobs;
  for (int k = 0; k < options.jobs; ++k) jobs.push_back(std::async(std::launch::async, work));
  for (auto& job : jobs) job.get();
  return results;
}

int verify(const Options& options)
{
  std::vector<const LadderCase*> wanted;
  for (const std::string& name : options.only) wanted.push_back(&ladder_case(name));
  if (wanted.empty())
    for (const LadderCase& one : ladder_cases()) wanted.push_back(&one);
  const std::vector<Result> results = climb_all(options, wanted);
  bool pass = true;
  for (const Result& result : results)
    for (const Row& row : result.rows) pass = pass && row.pass();
  write_table(options.out, results);
  write_curves(options.out, results);
  return pass ? 0 : 1;
}
} // namespace

int main(int argc, char** argv)
{
  Options options;
  CLI::App app{
      "Runs the verification ladder of cases/verification: exit code 0 when every row passes, 1 when not",
      "seismpm-verify"};
  app.set_version_flag("--version",
                       fmt::format("seismpm-verify {} ({})", mpm::version::number, mpm::version::git));
  app.add_option("--out", options.out, "folder for RESULTS.md and results.json")->type_name("DIR");
  app.add_option("--cases", options.cases, "folder of the cases (default: found around the program)")
      ->type_name("DIR");
  app.add_option("--only", options.only, "these cases only")->delimiter(',');
  app.add_option("--threads", options.threads, "threads of each job")->capture_default_str();
  app.add_option("--jobs", options.jobs, "cases that run side by side")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--quick", options.quick, "the coarse resolutions of the default tests");
  app.add_flag("--list", options.list, "names and titles of the cases");
  if (argc > 1 && std::string_view(argv[1]) == "--complete")
  {
    std::cout << mpm::completion(app, {argv + 2, argv + argc}, values_of);
    return 0;
  }
  CLI11_PARSE(app, argc, argv);
  try
  {
    if (options.cases.empty()) options.cases = find_cases().string();
    if (options.list) return list_cases(options), 0;
    if (options.out.empty()) throw std::runtime_error("seismpm-verify: --out is missing: give a folder");
    return verify(options);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 2;
  }
}

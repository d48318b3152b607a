#include "solver/stages/program.hpp"

#include "io/common/printable.hpp"
#include "io/common/signals.hpp"
#include "solver/mpm/domain.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/waiting.hpp"
#include "solver/stages/resolved_case.hpp"
#include "solver/stages/session.hpp"
#include "solver/stages/version.hpp"

#include <filesystem>
#include <iostream>

namespace mpm
{
namespace
{
std::string version_text(const std::string& program)
{
  return fmt::format("{} {} ({})\nbuild: {}", program, version::number, version::git, version::options);
}

/// What can go wrong while there is a log.
int run_stage(Session& session, int (*stage)(Session&))
try
{
  if (session.options.print_case)
  {
    std::cout << resolved_case(session.case_file, session.options) << std::flush;
    return exit_code::done;
  }
  return stage(session);
}
catch (const Error& error)
{
  session.log.error("{}", error.what());
  return error.code;
}
catch (const Diverged& error)
{
  session.log.error("{}; use a smaller {} or grid.spacing", error.what(), session.options.courant_key());
  return exit_code::diverged;
}
} // namespace

int run_program(int argc, char** argv, const std::string& name, int (*stage)(Session&))
try
{
  parallel::wait_briefly(argv); // may start the program again, and so comes first
  install_signal_handlers();
  Options options;
  options.program = name;
  for (int k = 0; k < argc; ++k) options.command += (k ? " " : "") + std::string(argv[k]);
  if (const auto answered = parse_command_line(argc, argv, options, version_text(name))) return *answered;
  if (options.threads > 0) parallel::use_threads(options.threads);
  Session session(options);
  return run_stage(session, stage);
}
catch (const Error& error)
{
  std::cerr << printable(error.what()) << '\n';
  return error.code;
}
catch (const std::bad_alloc&)
{
  std::cerr << name
            << ": memory is not enough: use larger cells (grid.spacing) or a smaller domain, or free memory; "
               "--check tells what a case needs\n";
  return exit_code::bad_input;
}
catch (const std::filesystem::filesystem_error& error)
{
  // A folder that goes away under a run, for one.
  std::cerr << name << ": " << printable(error.what())
            << "; the last checkpoint is whole where it is still there, and the same command goes on\n";
  return exit_code::write_failed;
}
catch (const std::exception& error)
{
  std::cerr << name << ": " << printable(error.what())
            << " (a bug of ours: please report it with the command and the case)\n";
  return exit_code::bug;
}
} // namespace mpm

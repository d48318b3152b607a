#include "solver/stages/session.hpp"

#include "io/common/signals.hpp"
#include "solver/stages/version.hpp"

namespace mpm
{
namespace
{
constexpr double checkpoint_share = 0.02; // of the wall time, for writing checkpoints
} // namespace

Session::Session(Options given)
    : options(std::move(given)), log(options.verbosity, options.check ? Screen::answer : Screen::messages)
{
  case_file = load_case(options.case_file, options.overrides, options.profile);
  checkpoints_ =
      Pace(case_file.output.checkpoint.every, case_file.output.checkpoint.adapts ? checkpoint_share : 0);
  for (const std::string& reason : case_file.chosen) log.info("profile {}: {}", case_file.profile, reason);
  if (!case_file.chosen.empty()) facts["profile_chose"] = case_file.chosen;
  for (const std::string& warning : case_file.warnings) log.warn("{}", warning);
}

void Session::open_folder(const RunFolder::Identity& identity)
{
  folder = std::make_unique<RunFolder>(options.out, identity, options.fresh);
  log.open(*folder / "log.txt");
  if (!folder->locked())
    log.warn("{}: the file system has no locks: keep other runs out", options.out.string());
  log.info("{}", options.command);
}

bool Session::must_stop() const
{
  return interruption_requested() || (options.max_wall > 0 && wall_seconds() >= options.max_wall);
}

bool Session::checkpoint_due() const
{
  return checkpoints_.due();
}

void Session::write_checkpoint(const std::function<void()>& write)
{
  checkpoints_.write(write);
  const CheckpointSettings& checkpoint = case_file.output.checkpoint;
  const double cost = checkpoints_.cost();
  if (told_of_cost_ || cost <= checkpoint_share * checkpoint.every) return;
  told_of_cost_ = true;
  const std::string took = fmt::format("a checkpoint took {:.2g} s to write", cost);
  if (checkpoint.adapts)
    log.info("{}: the next ones come every {:.0f} s or so, which is {:.0f} % of the time", took,
             checkpoints_.interval(), 100 * checkpoint_share);
  else
    log.info("{}, {:.0f} % of the {:.3g} s between two; output.checkpoint.every: auto makes them rarer", took,
             100 * cost / checkpoint.every, checkpoint.every);
}

Provenance Session::provenance() const
{
  return {options.program, version::number, version::git, version::options,
          options.command, utc_now(),       host_name()};
}

double Session::wall_seconds() const
{
  return std::chrono::duration<double>(Wall::now() - start_).count();
}
} // namespace mpm

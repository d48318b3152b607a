#include "solver/stages/session.hpp"

#include "io/common/signals.hpp"
#include "solver/stages/version.hpp"

namespace mpm
{
namespace
{
constexpr double checkpoint_share = 0.02; // of the wall time, for writing checkpoints

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
} // namespace

Session::Session(Options given)
    : options(std::move(given)), log(options.verbosity, options.check ? Screen::answer : Screen::messages)
{
  case_file = load_case(options.case_file, options.overrides, options.profile);
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

double Session::checkpoint_interval() const
{
  const CheckpointSettings& checkpoint = case_file.output.checkpoint;
  return checkpoint.adapts ? std::max(checkpoint.every, checkpoint_cost_ / checkpoint_share)
                           : checkpoint.every;
}

bool Session::checkpoint_due() const
{
  return seconds_since(last_checkpoint_) >= checkpoint_interval();
}

void Session::write_checkpoint(const std::function<void()>& write)
{
  const Wall::time_point begin = Wall::now();
  write();
  checkpoint_cost_ = seconds_since(begin);
  last_checkpoint_ = Wall::now();
  const CheckpointSettings& checkpoint = case_file.output.checkpoint;
  if (told_of_cost_ || checkpoint_cost_ <= checkpoint_share * checkpoint.every) return;
  told_of_cost_ = true;
  const std::string took = fmt::format("a checkpoint took {:.2g} s to write", checkpoint_cost_);
  if (checkpoint.adapts)
    log.info("{}: the next ones come every {:.0f} s or so, which is {:.0f} % of the time", took,
             checkpoint_interval(), 100 * checkpoint_share);
  else
    log.info("{}, {:.0f} % of the {:.3g} s between two; output.checkpoint.every: auto makes them rarer", took,
             100 * checkpoint_cost_ / checkpoint.every, checkpoint.every);
}

Provenance Session::provenance() const
{
  return {options.program, version::number, version::git, version::options,
          options.command, utc_now(),       host_name()};
}

double Session::wall_seconds() const
{
  return seconds_since(start_);
}
} // namespace mpm

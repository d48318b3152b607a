// Which state a run goes on from, and whether it can be one of its own.

#include "io/results/domain_state.hpp"
#include "io/run_folder/finish_mark.hpp"
#include "solver/mpm/simd.hpp"
#include "solver/stages/session.hpp"

#include <cmath>

namespace mpm
{
namespace
{
/// Whether `dt` is a step that the case begins with, halved as often as it takes.
bool is_step_of_case(double dt, double first)
{
  if (!(std::isfinite(dt) && dt > 0 && dt <= first * (1 + 1e-9))) return false;
  const double halvings = std::log2(first / dt);
  return std::fabs(halvings - std::round(halvings)) < 1e-6;
}

void load_clock(const h5::Group& group, Clock& clock, double at_most)
{
  const double first_step = clock.dt;
  const auto refuse = [&](const std::string& what)
  {
    throw Error(exit_code::bad_input, fmt::format("{}: {}; no run of this case comes there, use another file",
                                                  group.where(), what));
  };
  clock.step = group.attribute_int("step");
  clock.dt = group.attribute_double("dt");
  clock.start_time = group.attribute_double("start_time");
  clock.start_step = group.attribute_int("start_step");
  if (!is_step_of_case(clock.dt, first_step))
    refuse(fmt::format("dt is {} s, where the case begins with {} s", clock.dt, first_step));
  if (clock.start_step < 0 || clock.step < clock.start_step ||
      !(std::isfinite(clock.start_time) && clock.start_time >= 0))
    refuse(fmt::format("step {} after step {} at {} s", clock.step, clock.start_step, clock.start_time));
  if (group.attribute_double("time") != clock.time())
    refuse(fmt::format("step {} is at {} s, not at {} s", clock.step, clock.time(),
                       group.attribute_double("time")));
  if (!(clock.time() <= at_most + first_step))
    refuse(fmt::format("step {} is at {} s, after the end of the run", clock.step, clock.time()));
}
} // namespace

bool Session::finished_already()
{
  if (!has_finish_mark(folder->path())) return false;
  const std::string what = broken_mark(folder->path());
  if (what.empty())
  {
    folder->prune(0); // what a kill after the mark has left
    log.info("{}: is finished already; --fresh starts anew", folder->path().string());
    return true;
  }
  log.warn("{}: {}: the run is not finished any more", folder->path().string(), what);
  remove_finish_mark(folder->path());
  return false;
}

h5::File Session::open_state(const std::filesystem::path& path)
{
  h5::File file = open_complete(path);
  const auto refuse = [&](const std::string& what)
  { throw Error(exit_code::bad_input, fmt::format("{}: {}", path.string(), what)); };
  const std::string schema = file.attribute_string("schema");
  if (schema != checkpoint_schema) refuse(fmt::format("is a {}, not a {}", schema, checkpoint_schema));
  const std::string other = difference(file.read_strings("identity"), folder->identity_lines());
  if (!other.empty()) refuse("is of another run: it " + other);
  if (path.filename() == "final.h5" && file.attribute_int("last", "clock") != 1)
    refuse("is not the last state of its run");
  const std::string vectors = file.attribute_string("vectors", "clock");
  if (vectors != vector_path)
    log.warn("{} was computed with {} instructions, this build uses {}: the run goes on, but not bit for "
             "bit as one on one machine",
             path.string(), vectors, vector_path);
  return file;
}

bool Session::resume(const std::function<void(const h5::File&)>& load)
{
  write_text_atomically(*folder / resolved_name, resolved_case());
  std::vector<std::filesystem::path> unusable;
  std::string lost; // a result file that a state needs beside it
  bool found = false;
  for (const auto& path : folder->states())
  {
    try
    {
      const h5::File file = open_state(path);
      load(file);
      at_end_ = file.attribute_int("last", "clock") == 1;
      log.recall(file.read_strings("warnings"));
      log.info("goes on from {}", path.string());
      found = true;
      break;
    }
    catch (const std::runtime_error& error)
    {
      const auto* ours = dynamic_cast<const Error*>(&error);
      if (ours && ours->code == exit_code::folder_taken && lost.empty()) lost = error.what();
      log.warn("{}; trying an older one", error.what());
      unusable.push_back(path);
    }
  }
  if (!found && !lost.empty()) throw Error(exit_code::folder_taken, lost);
  if (!found && !unusable.empty())
    log.warn("{}: no state in it is whole: the run starts from the beginning", folder->path().string());
  for (const auto& path : unusable) folder->set_aside(path);
  return found;
}

void load_model(const h5::File& file, Model& model, Clock& clock, double at_most)
{
  load_clock(file.open_group("clock"), clock, at_most);
  model.for_each_domain(
      [&](Domain& domain, const std::string& column)
      {
        if (column.empty())
          load_domain(file, domain);
        else
          load_domain(file.open_group("free_field/" + column), domain);
      });
  check_particles(*model.main, model.reference_volume);
}
} // namespace mpm

#include "solver/stages/checkpoint.hpp"

#include "io/results/domain_state.hpp"
#include "solver/mpm/simd.hpp"
#include "solver/stages/identity.hpp"
#include "solver/stages/resolved_case.hpp"

#include <cmath>

namespace mpm
{
namespace
{
/// What a person, or a program without the case, needs to know of the run.
void save_run(h5::File& file, const Session& session)
{
  const Case& case_file = session.case_file;
  write_provenance(file, session.provenance(), checkpoint::schema);
  file.write_text(checkpoint::case_text, case_file.text);
  file.attribute("sha256", sha256(case_file.text), checkpoint::case_text);
  file.attribute("path", case_file.path.string(), checkpoint::case_text);
  file.attribute("profile", case_file.profile, checkpoint::case_text);
  file.write_strings(checkpoint::overrides, case_file.overrides);
  file.write_text(checkpoint::case_resolved, resolved_case(case_file, session.options));
  file.write_strings(checkpoint::ground, ground_settings(case_file));
  file.write_strings(checkpoint::identity, session.folder->identity_lines());
  file.write_strings(checkpoint::warnings, session.log.warnings());
}

/// `start_time` and `start_step` too: t = t_0 + (k - k_0) dt must come out the same to the last bit.
void save_clock(h5::Group group, const Clock& clock, std::string_view stage, bool last)
{
  group.attribute("stage", stage);
  group.attribute("last", last);
  group.attribute("vectors", vector_path);
  group.attribute("step", clock.step);
  group.attribute("time", clock.time());
  group.attribute("dt", clock.dt);
  group.attribute("start_time", clock.start_time);
  group.attribute("start_step", clock.start_step);
}

/// Whether `dt` is a step that the case begins with, halved as often as it takes.
bool is_step_of_case(double dt, double first)
{
  if (!(std::isfinite(dt) && dt > 0 && dt <= first * (1 + 1e-9))) return false;
  const double halvings = std::log2(first / dt);
  return std::fabs(halvings - std::round(halvings)) < 1e-6;
}

/// A file may be whole and yet no run's: made by hand, or of a case that has changed without its identity.
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

/// A state of another layout is whole, and of use to the version that wrote it. What to do with it, and the
/// exit code, are the caller's.
void check_schema(const h5::File& file, const std::filesystem::path& path, int code, std::string_view advice)
{
  const std::string schema = file.attribute_string("schema");
  if (schema == checkpoint::schema) return;
  throw Error(code,
              fmt::format("{}: its schema is {}, where this version reads {}; it was written by version "
                          "{} ({}): {}",
                          path.string(), schema, checkpoint::schema, file.attribute_string("version"),
                          file.attribute_string("git"), advice));
}

/// Where the state of a column is kept.
std::string group_of(Edge side)
{
  return fmt::format("{}/{}", checkpoint::columns, side_name(side));
}

/// Calls load(group, domain) for the ground and the columns.
void load_domains(const h5::File& state, const Model& model, void (*load)(const h5::Group&, Domain&))
{
  load(state, *model.main);
  for (const Edge side : both_sides)
    if (const FreeFieldColumn* column = model.column(side))
      load(state.open_group(group_of(side)), *column->domain);
}
} // namespace

void write_checkpoint(Session& session, const std::string& name, const Model& model, const Clock& clock,
                      const std::function<void(h5::File&)>& fill)
{
  write_file_atomically(*session.folder / name,
                        [&](h5::File& file)
                        {
                          save_run(file, session);
                          save_clock(file.create_group(checkpoint::clock), clock, session.options.stage(),
                                     name == final_name);
                          save_domain(file, *model.main);
                          for (const Edge side : both_sides)
                            if (const FreeFieldColumn* column = model.column(side))
                            {
                              h5::Group group = file.create_group(group_of(side));
                              save_domain(group, *column->domain);
                            }
                          fill(file);
                        });
}

bool is_last(const h5::File& state)
{
  return state.attribute_int("last", checkpoint::clock) == 1;
}

h5::File open_state(Session& session, const std::filesystem::path& path)
{
  h5::File file = open_complete(path);
  const auto refuse = [&](const std::string& what)
  { throw Error(exit_code::bad_input, fmt::format("{}: {}", path.string(), what)); };
  check_schema(file, path, exit_code::folder_taken,
               "finish the run with that, start anew with --fresh or choose another --out");
  const std::string other =
      difference(file.read_strings(checkpoint::identity), session.folder->identity_lines());
  if (!other.empty()) refuse("is of another run: it " + other);
  if (path.filename() == final_name && !is_last(file)) refuse("is not the last state of its run");
  // Sums over vectors of four and of eight doubles round differently.
  const std::string vectors = file.attribute_string("vectors", checkpoint::clock);
  if (vectors != vector_path)
    session.log.warn(
        "{} was computed with {} instructions, this build uses {}: the run goes on, but not bit for "
        "bit as one on one machine",
        path.string(), vectors, vector_path);
  return file;
}

void load_model(const h5::File& state, Model& model, Clock& clock, double at_most)
{
  load_clock(state.open_group(checkpoint::clock), clock, at_most);
  load_domains(state, model, load_domain);
  check_health(model);
}

std::string load_static_state(const Session& session, Model& model)
{
  std::string digest;
  const h5::File file = open_complete(session.options.from, &digest);
  const auto refuse = [&](const std::string& why)
  { throw Error(exit_code::bad_input, session.options.from.string() + ": " + why); };
  check_schema(file, session.options.from, exit_code::bad_input, "run mpm-static of this one");
  if (!file.exists(checkpoint::relaxation) || file.attribute_string("stage", checkpoint::clock) != "static")
    refuse("is no static state; give the final.h5 of mpm-static");
  if (!is_last(file)) refuse("the ground had not settled yet; give the final.h5 of mpm-static");
  const std::string other =
      difference(file.read_strings(checkpoint::ground), ground_settings(session.case_file));
  if (!other.empty()) refuse(other + "; run mpm-static for this case");
  load_domains(file, model, load_particles);
  try
  {
    check_health(model);
  }
  catch (const Diverged& error)
  {
    refuse(error.what());
  }
  return digest;
}
} // namespace mpm

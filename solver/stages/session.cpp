#include "solver/stages/session.hpp"

#include "io/common/signals.hpp"
#include "io/results/domain_state.hpp"
#include "io/run_folder/finish_mark.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/waiting.hpp"

#include <cmath>
#include <iostream>

namespace mpm
{
namespace
{
std::string version_text(const std::string& program)
{
  return fmt::format("{} {} ({})\nbuild: {}", program, SEISMPM_VERSION, SEISMPM_GIT, SEISMPM_BUILD);
}
} // namespace

bool Clock::passed(double every) const
{
  const auto multiples = [every](double t) { return std::floor(t / every + 1e-6); };
  return multiples(time()) > multiples(time() - dt);
}

Session::Session(Options given)
    : options(std::move(given)), log(options.verbosity, options.check ? Screen::answer : Screen::messages)
{
  case_file = load_case(options.case_file, options.overrides, options.profile);
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

double Session::wall_seconds() const
{
  return std::chrono::duration<double>(Wall::now() - start_).count();
}

bool Session::must_stop() const
{
  return interruption_requested() || (options.max_wall > 0 && wall_seconds() >= options.max_wall);
}

bool Session::checkpoint_due() const
{
  return std::chrono::duration<double>(Wall::now() - last_checkpoint_).count() >=
         case_file.output.checkpoint.every;
}

Provenance Session::provenance() const
{
  return {options.program, SEISMPM_VERSION, SEISMPM_GIT, SEISMPM_BUILD,
          options.command, utc_now(),       host_name()};
}

void Session::write_checkpoint(const std::string& name, std::string_view stage, Model& model,
                               const Clock& clock, const std::function<void(h5::File&)>& fill)
{
  write_file_atomically(*folder / name,
                        [&](h5::File& file)
                        {
                          write_provenance(file, provenance(), checkpoint_schema);
                          file.write_text("case", case_file.text);
                          file.attribute("sha256", sha256(case_file.text), "case");
                          file.attribute("path", case_file.path.string(), "case");
                          file.attribute("profile", case_file.profile, "case");
                          file.write_strings("overrides", case_file.overrides);
                          file.write_text("case_resolved", resolved_case());
                          file.write_strings("ground", ground_settings(case_file));
                          file.write_strings("identity", folder->identity_lines());
                          file.write_strings("warnings", log.warnings());
                          h5::Group time = file.create_group("clock");
                          time.attribute("stage", stage);
                          time.attribute("last", name == "final.h5");
                          time.attribute("vectors", vector_path);
                          time.attribute("step", clock.step);
                          time.attribute("time", clock.time());
                          time.attribute("dt", clock.dt);
                          time.attribute("start_time", clock.start_time);
                          time.attribute("start_step", clock.start_step);
                          model.for_each_domain(
                              [&](Domain& domain, const std::string& column)
                              {
                                if (column.empty()) return save_domain(file, domain);
                                h5::Group group = file.create_group("free_field/" + column);
                                save_domain(group, domain);
                              });
                          fill(file);
                        });
  last_checkpoint_ = Wall::now();
}

void Session::loop_begins(std::int64_t step, const Model& model)
{
  stop_at_a_step();
  earlier_ = model.main->measures.times.seconds();
  loop_start_ = Wall::now();
  first_step_ = step;
}

void Session::finish(std::string_view stage, int exit, const Model& model, const Clock& clock,
                     nlohmann::json more, std::vector<std::string> results)
{
  const double loop = std::chrono::duration<double>(Wall::now() - loop_start_).count();
  const double steps = static_cast<double>(clock.step - first_step_);
  const double particles = model.main->particles.size();
  nlohmann::json summary{
      {"name", case_file.name},
      {"stage", stage},
      {"exit", exit},
      {"time", clock.time()},
      {"steps", clock.step},
      {"dt", clock.dt},
      {"particles", model.main->particles.size()},
      {"threads", parallel::threads()},
      {"wall_seconds", wall_seconds()},
      {"ns_per_particle_step", 1e9 * loop * parallel::threads() / std::max(1.0, particles * steps)},
      {"warnings", log.warnings()},
      {"case_sha256", sha256(case_file.text)},
      {"profile", case_file.profile},
      {"overrides", case_file.overrides},
      {"version", SEISMPM_VERSION},
      {"git", SEISMPM_GIT},
      {"build", SEISMPM_BUILD},
      {"vectors", vector_path},
      {"command", options.command}};
  const double per_step = 1e9 * parallel::threads() / std::max(1.0, particles * steps);
  std::string phases;
  for (std::size_t k = 0; k < phase_names.size(); ++k)
  {
    const double cost = per_step * (model.main->measures.times.seconds()[k] - earlier_[k]);
    summary["phases"][std::string(phase_names[k])] = cost;
    phases += fmt::format("{}{} {:.1f}", k ? ", " : "", phase_names[k], cost);
  }
  summary.update(facts);
  summary.update(more);
  write_text_atomically(*folder / "summary.json", summary.dump(2) + "\n");
  if (exit == exit_code::done)
  {
    results.insert(results.end(), {"final.h5", "summary.json", "identity.json", resolved_name});
    write_finish_mark(folder->path(), results);
    folder->prune(0);
  }
  log.info("{} ends with {} after {}: {} steps, {:.1f} ns per particle-step and core", stage, exit,
           duration_text(wall_seconds()), clock.step - first_step_,
           summary["ns_per_particle_step"].get<double>());
  log.info("of it {} ns", phases);
}

void check_step(Session& session, const Model& model, double courant_number, Clock& clock)
{
  const double h = session.case_file.grid.spacing, speed = greatest_wave_speed(*model.main);
  const double limit = courant_number < fast_courant_number ? fast_courant_number : stable_courant_number;
  if (clock.dt * speed <= limit * h) return;
  clock.change_step(clock.dt / 2);
  session.log.warn(
      "t = {:.3f} s: the ground has loosened to a wave speed of {:.0f} m/s; the step is halved to {:.3e} s{}",
      clock.time(), speed, clock.dt,
      session.options.seismic() ? ", which doubles the numerical damping of waves" : "");
}

int run_program(int argc, char** argv, const std::string& name, int (*stage)(Session&))
{
  parallel::wait_briefly(argv);
  Options options;
  options.program = name;
  for (int k = 0; k < argc; ++k) options.command += (k ? " " : "") + std::string(argv[k]);
  install_signal_handlers();
  try
  {
    if (const auto answered = parse_command_line(argc, argv, options, version_text(name))) return *answered;
    if (options.threads > 0) parallel::use_threads(options.threads);
    Session session(options);
    try
    {
      if (options.print_case) return std::cout << session.resolved_case() << std::flush, exit_code::done;
      return stage(session);
    }
    catch (const Error& error)
    {
      session.log.error("{}", error.what());
      return error.code;
    }
    catch (const Diverged& error)
    {
      session.log.error("{}; use a smaller {} or grid.spacing", error.what(), options.safety_key());
      return exit_code::diverged;
    }
  }
  catch (const Error& error)
  {
    std::cerr << error.what() << '\n';
    return error.code;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr
        << name
        << ": memory is not enough: use larger cells (grid.spacing) or a smaller domain, or free memory; "
           "--check tells what a case needs\n";
    return exit_code::bad_input;
  }
  catch (const std::exception& error)
  {
    std::cerr << name << ": " << error.what()
              << " (a bug of ours: please report it with the command and the case)\n";
    return exit_code::bug;
  }
}
} // namespace mpm

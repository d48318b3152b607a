#include "solver/stages/session.hpp"

#include "io/checkpoint.hpp"
#include "io/finish_mark.hpp"
#include "io/signals.hpp"
#include "io/units.hpp"
#include "solver/mpm/parallel.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>

namespace mpm
{
namespace
{
constexpr double courant_limit = 0.7;    // beyond it the step is shortened (METHODS section 7),
constexpr double stability_limit = 0.78; // or beyond this one in a case that starts that fast

/// "2h", "90 min", "1800 s", in s.
double parse_wall_time(std::string text)
{
  const std::size_t unit = text.find_first_not_of("0123456789.");
  if (unit != std::string::npos && unit > 0 && text[unit] != ' ') text.insert(unit, " ");
  const Quantified time = parse_quantity(text, Dimension::time);
  if (time.problem.empty() && time.value > 0) return time.value;
  throw Error(exit_code::usage, "--max-wall: '" + text + "' is no time; write 2h, 90min or 1800s");
}

std::string version_text(const std::string& program)
{
  return fmt::format("{} {} ({})\nbuild: {}", program, SEISMPM_VERSION, SEISMPM_GIT, SEISMPM_BUILD);
}

/// Fills `options`; returns an exit code when the command line already answers everything.
std::optional<int> parse(int argc, char** argv, Options& options)
{
  const bool seismic = options.program == "mpm-seismic";
  CLI::App app(seismic ? "Shakes a slope from its static state, and follows the slide."
                       : "Finds the static state of a slope under gravity.",
               options.program);
  std::string wall;
  bool quiet = false, verbose = false;
  app.add_option("CASE", options.case_file, "case file (YAML)")->required();
  app.add_option("--out", options.out, "output folder");
  if (seismic)
  {
    app.add_option("--from", options.from, "final.h5 of the static stage");
    app.add_option("--motion", options.motion, "record instead of the case's horizontal one");
    app.add_option("--vertical", options.vertical, "record instead of the case's vertical one");
    app.add_option("--record-dt", options.record_dt, "time step in s of a --motion that does not tell it");
    app.add_option("--record-unit", options.record_unit,
                   "unit of a --motion that does not tell it (g, m/s2, gal)");
    app.add_option("--scale", options.scale, "factor on the motion");
  }
  app.add_flag("--check", options.check, "validate and predict the cost; run nothing");
  app.add_flag("--print-case", options.print_case,
               "print the case with every default written out; run nothing");
  app.add_option("--threads", options.threads, "threads (default: OMP_NUM_THREADS, else all)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--profile", options.profile, "apply one of the case's profiles; --set goes on top");
  app.add_option("--set", options.overrides, "key.path=value: override a key of the case")
      ->expected(1)
      ->take_all();
  app.add_option("--max-wall", wall, "stop with a checkpoint after this time (2h, 90min, 1800s)");
  app.add_flag("--fresh", options.fresh, "start anew in a folder that holds results");
  app.add_flag("--quiet", quiet, "warnings and errors only");
  app.add_flag("--verbose", verbose, "details too");
  app.set_version_flag("--version", version_text(options.program));
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success& end)
  {
    return app.exit(end);
  }
  catch (const CLI::ParseError& error)
  {
    std::cerr << options.program << ": " << error.what() << "; see --help\n";
    return exit_code::usage;
  }
  if (app.count("--max-wall")) options.max_wall = parse_wall_time(wall);
  if (quiet) options.verbosity = Verbosity::quiet;
  if (verbose) options.verbosity = Verbosity::verbose;
  if (options.out.empty() && !options.check && !options.print_case)
    throw Error(exit_code::usage, options.program + ": --out is missing: where shall the results go?");
  return std::nullopt;
}
} // namespace

bool Clock::passed(double every) const
{
  const auto multiples = [every](double t) { return std::floor(t / every + 1e-6); };
  return multiples(time()) > multiples(time() - dt);
}

Session::Session(Options given) : options(std::move(given)), log(options.verbosity)
{
  scene = load_case(options.case_file, options.overrides, options.profile);
  for (const std::string& warning : scene.warnings) log.warn("{}", warning);
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
         scene.output.checkpoint.every;
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
                          file.write_text("case", scene.text);
                          file.attribute("sha256", sha256(scene.text), "case");
                          file.attribute("path", scene.path.string(), "case");
                          file.attribute("profile", scene.profile, "case");
                          file.write_strings("overrides", scene.overrides);
                          file.write_text("case_resolved", resolved_case());
                          file.write_strings("ground", ground_settings(scene));
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
  earlier_ = model.main->times.seconds();
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
      {"name", scene.name},
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
      {"case_sha256", sha256(scene.text)},
      {"profile", scene.profile},
      {"overrides", scene.overrides},
      {"version", SEISMPM_VERSION},
      {"git", SEISMPM_GIT},
      {"build", SEISMPM_BUILD},
      {"vectors", vector_path},
      {"command", options.command}};
  const double per_step = 1e9 * parallel::threads() / std::max(1.0, particles * steps);
  std::string phases;
  for (std::size_t k = 0; k < phase_names.size(); ++k)
  {
    const double cost = per_step * (model.main->times.seconds()[k] - earlier_[k]);
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

void check_step(Session& session, const Model& model, double safety, Clock& clock)
{
  const double h = session.scene.grid.spacing, speed = greatest_wave_speed(*model.main);
  const double limit = safety < courant_limit ? courant_limit : stability_limit;
  if (clock.dt * speed <= limit * h) return;
  clock.change_step(clock.dt / 2);
  session.log.warn(
      "t = {:.3f} s: the ground has loosened to a wave speed of {:.0f} m/s; the step is halved to {:.3e} s, "
      "which doubles the numerical damping of waves",
      clock.time(), speed, clock.dt);
}

int run_program(int argc, char** argv, const std::string& name, int (*stage)(Session&))
{
  Options options;
  options.program = name;
  for (int k = 0; k < argc; ++k) options.command += (k ? " " : "") + std::string(argv[k]);
  install_signal_handlers();
  try
  {
    if (const auto answered = parse(argc, argv, options)) return *answered;
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
      session.log.error("{}", error.what());
      return exit_code::diverged;
    }
  }
  catch (const Error& error)
  {
    std::cerr << error.what() << '\n';
    return error.code;
  }
  catch (const std::exception& error)
  {
    std::cerr << name << ": " << error.what()
              << " (a bug of ours: please report it with the command and the case)\n";
    return exit_code::bug;
  }
}
} // namespace mpm

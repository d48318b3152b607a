#include "solver/stages/summary.hpp"

#include "io/run_folder/finish_mark.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/simd.hpp"
#include "solver/stages/checkpoint.hpp"
#include "solver/stages/version.hpp"

namespace mpm
{
// Phases are timed since the program began: what went before the loop is taken off.
Summary::Summary(Session& session, const Model& model, const Clock& clock)
    : session_(session), model_(model), clock_(clock), first_step_(clock.step),
      earlier_(model.main->measures.times.seconds())
{
}

/// What every summary tells, whatever the stage.
nlohmann::json Summary::run_facts(int exit) const
{
  const Case& case_file = session_.case_file;
  return {{"name", case_file.name},
          {"stage", session_.options.stage()},
          {"exit", exit},
          {"time", clock_.time()},
          {"steps", clock_.step},
          {"dt", clock_.dt},
          {"particles", model_.main->particles.size()},
          {"threads", parallel::threads()},
          {"wall_seconds", session_.wall_seconds()},
          {"warnings", session_.log.warnings()},
          {"case_sha256", sha256(case_file.text)},
          {"profile", case_file.profile},
          {"overrides", case_file.overrides},
          {"version", version::number},
          {"git", version::git},
          {"build", version::options},
          {"vectors", vector_path},
          {"command", session_.options.command}};
}

void Summary::finish(int exit, const nlohmann::json& more, std::vector<std::string> results) const
{
  const double loop = std::chrono::duration<double>(Wall::now() - start_).count();
  const double particle_steps =
      static_cast<double>(clock_.step - first_step_) * model_.main->particles.size();
  // Core time in ns per particle-step: 1e9 t N_threads / (N_particles N_steps).
  const double per_step = 1e9 * parallel::threads() / std::max(1.0, particle_steps);
  nlohmann::json summary = run_facts(exit);
  summary["ns_per_particle_step"] = per_step * loop;
  std::string phases;
  for (std::size_t k = 0; k < phase_names.size(); ++k)
  {
    const double cost = per_step * (model_.main->measures.times.seconds()[k] - earlier_[k]);
    summary["phases"][std::string(phase_names[k])] = cost;
    phases += fmt::format("{}{} {:.1f}", k ? ", " : "", phase_names[k], cost);
  }
  summary.update(session_.facts);
  summary.update(more);
  const RunFolder& folder = *session_.folder;
  // Paths may be of any bytes, and JSON is UTF-8.
  write_text_atomically(folder / "summary.json",
                        summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  if (exit == exit_code::done)
  {
    // Last of all, since it says that all other files are whole; checkpoints are then no longer needed.
    results.insert(results.end(), {final_name, "summary.json", "identity.json", resolved_name});
    write_finish_mark(folder.path(), results);
    folder.prune(0);
  }
  session_.log.info("{} ends with {} after {}: {} steps, {:.1f} ns per particle-step and core",
                    session_.options.stage(), exit, duration_text(session_.wall_seconds()),
                    clock_.step - first_step_, per_step * loop);
  session_.log.info("of it {} ns", phases);
}
} // namespace mpm

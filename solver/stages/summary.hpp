#pragma once

#include "solver/stages/clock.hpp"
#include "solver/stages/model.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// Measures what the loop of a stage costs, from its construction on, and writes summary.json when it ends.
class Summary
{
public:
  /// All three must outlive it.
  Summary(Session& session, const Model& model, const Clock& clock);

  /// Writes summary.json with the stage's own facts `more`, and ends the run's log. With `exit` done, marks
  /// the folder as finished by the files named in `results` beside those that every run has.
  void finish(int exit, const nlohmann::json& more, std::vector<std::string> results = {}) const;

private:
  using Wall = std::chrono::steady_clock;
  using Seconds = std::array<double, phase_names.size()>;
  nlohmann::json run_facts(int exit) const;

  Session& session_;
  const Model& model_;
  const Clock& clock_;
  Wall::time_point start_ = Wall::now();
  std::int64_t first_step_;
  Seconds earlier_; ///< time spent in each phase before the loop, s
};
} // namespace mpm

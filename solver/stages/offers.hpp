#pragma once
// What `--check` answers to "what do I get for what?": the chosen settings beside the profiles.

#include "solver/stages/cost.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
struct IncomingWave;

/// What is known of the chosen settings, from which the cost of others follows.
struct Chosen
{
  double particles = 0;
  double dt = 0;       ///< s
  double duration = 0; ///< model time that the stage takes, s
  double before = 0;   ///< s of work until the first step: reading, filling
  StepCost step;
  const IncomingWave* wave = nullptr; ///< null: no waves are looked at
};

/// Logs a row for the chosen settings and for each profile: cells, particles, memory, steps, time on this
/// machine undisturbed, frequency carried in the softest ground, classes of error; then what the classes
/// mean.
void report_offers(Session& session, const Chosen& chosen);
} // namespace mpm

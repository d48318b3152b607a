#pragma once
// What a stage costs on this machine, before it is run.

#include "solver/stages/clock.hpp"
#include "solver/stages/model.hpp"

#include <cstdint>

namespace mpm
{
/// Time of a step, s, as measured.
struct StepCost
{
  double wall = 0;
  double processor = 0; ///< the part of it in which a thread computed, mean of all threads

  /// Whether other programs take a good part of the processors, so that a run alone would be faster.
  bool disturbed() const { return processor < 0.85 * wall; }
  double undisturbed() const { return disturbed() ? processor : wall; } ///< s
};

/// Time that the processors have worked for this process, s.
double processor_seconds();

/// Steps a model that is ready for its stage, but for gravity, on the spot and takes the time of a step: the
/// median of small groups of steps, so that what comes between a few of them does not count.
StepCost probe(Model& model, const Clock& clock);

/// How often a stage does what is not in every step.
struct Occasions
{
  std::int64_t steps = 0;
  double skipped = 0;     ///< of these, in whole steps' worth of ground that rests
  double yielding = 0;    ///< share of the ground that may yield and flow, which costs more then
  double samples = 0;     ///< of slide and energies
  double looks = 0;       ///< at particles, energies and wave speeds
  double frames = 0;      ///< files of all particles
  double frame_bytes = 0; ///< of a particle in a frame
  double states = 0;      ///< checkpoints and the final state, without those by the clock on the wall
  double state_bytes = 0; ///< of a particle in a state
};

/// Time of a stage in s, from the time of a step (s; `serial`: on one thread) and what else is done, all of
/// it on one thread. What is written is put together, summed up (SHA-256) and copied.
double stage_time(const Occasions& occasions, double step, double serial, double particles);
} // namespace mpm

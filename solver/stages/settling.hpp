#pragma once

#include "solver/stages/session.hpp"

namespace mpm
{
/// How long the static stage will take, in model time.
struct Settling
{
  double time = 0;      ///< s
  bool settles = false; ///< whether coarser grids did
  double spacing = 0;   ///< of the finer of these, m
};

/// Runs the static stage on two grids so coarse that it costs next to nothing, and takes the times of its two
/// phases from there to the case's cells. Elastic ground: its slowest modes fade in a time of their own,
/// whatever the cells, see time_to_fade(), and the light nodes of a ragged surface in a number of steps, so
/// that their time goes with the cells; which of the two rules, the two grids show. Ground that yields
/// settles in a number of steps: stress passes from cell to cell. `particles`: of the case.
Settling expected_settling(const Session& session, double particles);

/// Time of a phase (s) on cells of `spacing` m, from the times on two coarser ones; both times positive.
struct Tried
{
  double spacing, time;
};
double carried_over(Tried coarse, Tried finer, double spacing);

/// Time in s in which local damping `damping` brings a mode of period `period` (s) to `share` of its
/// amplitude. A force f that drives the motion counts (1 - b) f, one that holds it back (1 + b) f, so that a
/// half swing from rest to rest is two quarter swings of other frequencies: it takes
/// (T / 4) (1 / sqrt(1 - b) + 1 / sqrt(1 + b)) and ends at sqrt((1 - b) / (1 + b)) of where it began.
double time_to_fade(double damping, double period, double share);
} // namespace mpm

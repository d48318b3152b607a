#pragma once

#include "io/case/case.hpp"
#include "solver/mpm/domain.hpp"
#include "test/verification/ladder.hpp"

#include <functional>

namespace mpm::verification
{
/// How ground is made weaker until it fails.
struct StrengthReduction
{
  double stands, falls; ///< what is halved: safe below, failed above
  double tolerance;     ///< of the answer
  double height;        ///< m, displacements over which are plotted and judged
  double gone;          ///< displacement over the height at which ground has failed
  double duration;      ///< s, after which ground must have come to rest or be on its way
  std::function<void(Domain&, double)> weaken; ///< gives the domain's materials the strength of a trial
};

/// Displacement by trial, over the height, and the trial at failure.
struct Failure
{
  Curve curve;
  double at;
};

/// Lets the case settle elastically under gravity and tries strengths from there, each without damping,
/// which would hold back what fails: it has failed when a point has moved by more than `gone`. The ground has
/// to be so stiff that yielding alone moves it less.
Failure find_failure(const Case& case_file, const StrengthReduction& reduction);
} // namespace mpm::verification

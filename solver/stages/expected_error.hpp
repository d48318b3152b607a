#pragma once
// What error a grid is likely to make, from errors that were measured on other cases with known answers.

#include "boundaries/ground_motion/incoming_wave.hpp"
#include "io/case/case.hpp"

namespace mpm
{
/// An error as a share of what it is an error of, or why it is not known.
struct ExpectedError
{
  double share = NAN;
  std::string unknown; ///< empty: it is known

  /// A to D, see error_classes; ? where it is not known.
  char letter() const;
};

/// Upper bounds of the classes A, B and C, each some three times the one before. Two digitisations of one
/// record differ by 2 %; 6 % in a spectrum are not seen beside what the ground's stiffness leaves open; a
/// fifth of a run-out is what strengths measured well leave open. Beyond, the cells are the greater
/// uncertainty.
inline constexpr std::array error_classes{0.02, 0.06, 0.2};

/// Root mean square of the velocity's error at the surface over that of the velocity, without any yielding:
/// the wave's lag and loss on its way through the ground, (../mpm/dispersion.hpp) over the frequencies of
/// the motion, and what a surface or an interface that is not level adds. `dt`: the step, s.
ExpectedError expected_wave_error(const Case& case_file, double dt, const IncomingWave& wave);

/// Of how far a slide goes, from the cells across what can slide.
ExpectedError expected_run_out_error(const Case& case_file);
} // namespace mpm

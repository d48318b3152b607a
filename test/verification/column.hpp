#pragma once
// Free-field columns of a case, settled or shaken, for cases that one dimension answers.

#include "solver/stages/time_step.hpp"

#include <complex>
#include <filesystem>

namespace mpm::verification
{
/// case.yaml of the folder with grid.spacing at `spacing` m.
Case case_at(const std::filesystem::path& folder, double spacing);

/// The wave that the case's seismic.motion names, as the program would make it.
std::shared_ptr<IncomingWave> wave_of(const Case& case_file);

/// Velocity of the ground surface; entry k is at (k + 1) every.
struct Trace
{
  double every = 0;         ///< s
  std::vector<double> x, y; ///< m/s
};

/// Shakes the case's left column alone, from stress-free ground, and samples its surface.
Trace shake_column(const Case& case_file, std::shared_ptr<const IncomingWave> wave, double every);

/// Fourier transform of samples, the first at `start` s.
std::complex<double> transform(const std::vector<double>& samples, double every, double start,
                               double frequency);
} // namespace mpm::verification

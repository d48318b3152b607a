#pragma once
// What a run costs in memory, known before anything is made.

#include "io/case/case.hpp"

namespace mpm
{
/// How large a run of a case is: known from its geometry, without making it.
struct CaseSize
{
  double particles = 0; ///< of the domain; those of the columns are few
  double nodes = 0;     ///< of the grid
  double columns = 0;   ///< of particles across the domain
  double samples = 0;   ///< numbers in the histories
};

/// Estimate from strips of the geometry, no more than a thousand; the ground's area is exact to how even it
/// is within one.
CaseSize expected_size(const Case& case_file);

/// Memory of a run at its greatest, in bytes: a frame or a checkpoint is put together while the state is
/// held.
double memory_needed(const CaseSize& size, const Case& case_file);

/// Size of a particle in a frame, in bytes.
double frame_bytes(const Case& case_file);

/// Size of a checkpoint, in bytes.
double checkpoint_bytes(double particles, const Case& case_file);
} // namespace mpm

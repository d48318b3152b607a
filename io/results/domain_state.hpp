#pragma once

#include "io/results/hdf5.hpp"
#include "solver/mpm/domain.hpp"

namespace mpm
{
/// Writes a domain's whole state: particles in the solver's order, history variables, which particles belong
/// to which block, what its boundaries remember, and its gauges.
void save_domain(h5::Group& group, Domain& domain);

/// The reverse, into a domain of the same case with the same boundaries; rebuilds grid and bindings.
/// Throws Error (bad_input) when the checkpoint is of another case.
void load_domain(const h5::Group& group, Domain& domain);

/// Loads particles and history only: the boundaries are another stage's.
void load_particles(const h5::Group& group, Domain& domain);
} // namespace mpm

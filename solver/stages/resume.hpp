#pragma once
// Whether a folder's run is finished, has states to go on from, or is to begin.

#include "io/results/hdf5.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// Whether the folder holds the finished run, with all its files whole; says so. What is not whole is told,
/// and the run is no longer finished.
bool finished_already(Session& session);

/// Where a stage starts.
enum class Start
{
  afresh, ///< no state is there
  midway, ///< a state was loaded
  at_end, ///< the last state was loaded: only what is written after it may be missing
};

/// Loads the best state in the folder: the final one, else the newest checkpoint that is whole and of this
/// run. `load` takes it from the file, or throws; then the state is told, passed over for an older one and
/// set aside in the end, so that pruning keeps the good ones. What `load` has spoiled is made good by
/// `begin_anew`, before another state is tried and when none is left. `Error` folder_taken when all that a
/// state lacks is a result file that goes with it, which cannot be made again, and when the states are those
/// of another version of the program.
Start resume(Session& session, const std::function<void()>& begin_anew,
             const std::function<void(const h5::File&)>& load);
} // namespace mpm

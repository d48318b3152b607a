#pragma once

namespace mpm::version
{
// What the programs were built from and how; the build system fills it in.
extern const char* const number;  ///< of the project
extern const char* const git;     ///< commit, with a mark when the tree had changes
extern const char* const options; ///< compiler, its options, HDF5
} // namespace mpm::version

#pragma once
// What makes a run this run and no other: its settings with every default written out. Left out is what
// changes no result, or is told by something else that is in. A folder and its states belong to one identity.

#include "io/case/case.hpp"
#include "io/run_folder/run_folder.hpp"

namespace mpm
{
/// Keys below which the case tells its records.
inline constexpr std::string_view horizontal_record = "seismic.motion.horizontal",
                                  vertical_record = "seismic.motion.vertical";

/// Settings of a run of the static stage: those of the ground and of `static`, and the kinds of base and
/// sides, on which the free-field columns depend.
RunFolder::Identity static_settings(const Case& case_file);

/// Settings of a run of the seismic stage. Its static state and its records are not among them: they come in
/// by their digests.
RunFolder::Identity seismic_settings(const Case& case_file);

/// The settings that shape the ground itself, as sorted lines `key = value`: what static and seismic stage
/// must share.
std::vector<std::string> ground_settings(const Case& case_file);
} // namespace mpm

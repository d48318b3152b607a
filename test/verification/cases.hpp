#pragma once
// The cases of the ladder: one function each, which runs the folder's case at one resolution.

#include "test/verification/ladder.hpp"

namespace mpm::verification
{
Findings run_kernel(const std::filesystem::path& folder, double spacing);
Findings run_transfer(const std::filesystem::path& folder, double spacing);
Findings run_mirrored_wall(const std::filesystem::path& folder, double spacing);
Findings run_manufactured(const std::filesystem::path& folder, double spacing);
Findings run_vortex(const std::filesystem::path& folder, double spacing);
Findings run_self_weight(const std::filesystem::path& folder, double spacing);
Findings run_free_vibration(const std::filesystem::path& folder, double spacing);
Findings run_level_site(const std::filesystem::path& folder, double spacing);
Findings run_uniform_column(const std::filesystem::path& folder, double spacing);
/// Amplification of layered ground: cases layer, layer_p, two_layers.
Findings run_site(const std::filesystem::path& folder, double spacing);
/// The layer at one spacing; the resolution is the Courant number.
Findings run_layer_courant(const std::filesystem::path& folder, double courant);
Findings run_layer_flip(const std::filesystem::path& folder, double share);
/// An elastic slope against finite elements.
Findings run_hill(const std::filesystem::path& folder, double spacing);
} // namespace mpm::verification

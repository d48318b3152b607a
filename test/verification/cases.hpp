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
/// The layer and the two layers with the paper's method.
Findings run_layer_paper(const std::filesystem::path& folder, double spacing);
/// Packets of P and S waves that meet the compliant base at an angle.
Findings run_absorption(const std::filesystem::path& folder, double spacing);
/// The same at angles near grazing.
Findings run_absorption_steep(const std::filesystem::path& folder, double spacing);
/// A load on the surface of a small box against one four times as large.
Findings run_line_load(const std::filesystem::path& folder, double spacing);
/// An elastic slope against finite elements.
Findings run_hill(const std::filesystem::path& folder, double spacing);
/// The same with the paper's method.
Findings run_hill_paper(const std::filesystem::path& folder, double spacing);
/// Laws led to their limit states; the resolution is the strain of a step.
Findings run_laws(const std::filesystem::path& folder, double step);
/// A rigid strip pressed into clay.
Findings run_strip_footing(const std::filesystem::path& folder, double spacing);
/// A band of softening clay in a shear box.
Findings run_shear_band(const std::filesystem::path& folder, double spacing);
/// Clay of falling strength in a vertical cut.
Findings run_vertical_cut(const std::filesystem::path& folder, double spacing);
/// Slopes of falling strength.
Findings run_slope(const std::filesystem::path& folder, double spacing);
/// An infinite slope on a weak layer under shaking.
Findings run_sliding_block(const std::filesystem::path& folder, double spacing);
/// The same on a layer whose friction falls with slip.
Findings run_weakening_slope(const std::filesystem::path& folder, double spacing);
/// A block of finite length on such a layer.
Findings run_finite_block(const std::filesystem::path& folder, double spacing);
/// Water behind a dam that vanishes.
Findings run_dam_break(const std::filesystem::path& folder, double spacing);
/// Columns of dry sand that are let go.
Findings run_column_collapse(const std::filesystem::path& folder, double spacing);
} // namespace mpm::verification

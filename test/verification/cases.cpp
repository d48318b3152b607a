#include "test/verification/cases.hpp"

#include <array>

namespace mpm::verification
{
std::span<const LadderCase> ladder_cases()
{
  static constexpr std::array cases{
      LadderCase{"kernel", run_kernel},                     // V1
      LadderCase{"transfer", run_transfer},                 // V2
      LadderCase{"mirrored_wall", run_mirrored_wall},       // V3
      LadderCase{"manufactured", run_manufactured},         // V4
      LadderCase{"vortex", run_vortex},                     // V5
      LadderCase{"self_weight", run_self_weight},           // V6
      LadderCase{"free_vibration", run_free_vibration},     // V7
      LadderCase{"layer", run_site},                        // V8
      LadderCase{"layer_courant", run_layer_courant},       // V8
      LadderCase{"two_layers", run_site},                   // V9
      LadderCase{"layer_paper", run_layer_paper},           // V8, V9
      LadderCase{"layer_p", run_site},                      // V10
      LadderCase{"uniform_column", run_uniform_column},     // V10, V11
      LadderCase{"absorption", run_absorption},             // V12
      LadderCase{"absorption_steep", run_absorption_steep}, // V12
      LadderCase{"line_load", run_line_load},               // V13
      LadderCase{"level_site", run_level_site},             // V14
      LadderCase{"hill", run_hill},                         // V15
      LadderCase{"hill_paper", run_hill_paper},             // V15
      LadderCase{"strip_footing", run_strip_footing},       // V16
      LadderCase{"laws", run_laws},                         // V17
      LadderCase{"shear_band", run_shear_band},             // V18
      LadderCase{"vertical_cut", run_vertical_cut},         // V19
      LadderCase{"slope", run_slope},                       // V19
      LadderCase{"sliding_block", run_sliding_block},       // V20
      LadderCase{"weakening_slope", run_weakening_slope},   // V20
      LadderCase{"finite_block", run_finite_block},         // V20
      LadderCase{"dam_break", run_dam_break},               // V21
      LadderCase{"column_collapse", run_column_collapse},   // V22
  };
  return cases;
}
} // namespace mpm::verification

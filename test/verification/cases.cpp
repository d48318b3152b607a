#include "test/verification/cases.hpp"

#include <array>

namespace mpm::verification
{
std::span<const LadderCase> ladder_cases()
{
  static constexpr std::array cases{
      LadderCase{"self_weight", run_self_weight},       // V6
      LadderCase{"layer", run_site},                    // V8
      LadderCase{"layer_courant", run_layer_courant},   // V8
      LadderCase{"two_layers", run_site},               // V9
      LadderCase{"layer_p", run_site},                  // V10
      LadderCase{"uniform_column", run_uniform_column}, // V10, V11
      LadderCase{"hill", run_hill},                     // V15
  };
  return cases;
}
} // namespace mpm::verification

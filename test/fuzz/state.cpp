// A state that is well-formed, sealed and of this case, and yet changed, is refused, or the run goes on from
// it without leaving its memory; that it diverges is told.

#include "test/fuzz/state_edits.hpp"
#include "test/fuzz/states.hpp"
#include "test/fuzz/targets.hpp"

namespace mpm::fuzz
{
void try_state(std::string_view bytes)
{
  if (bytes.empty()) return;
  const unsigned kind = static_cast<unsigned char>(bytes.front()) % state_kinds;
  const std::string file = edited(state_bytes(static_cast<StateKind>(kind)), bytes.substr(1, 20 * 16));
  try_checkpoint(std::string(1, static_cast<char>(2 * kind + 1)) + file);
}
} // namespace mpm::fuzz

#pragma once
// States of a small run, and what the programs do to take them up.

#include <string>
#include <string_view>

namespace mpm::fuzz
{
/// A state that the programs read.
enum class StateKind
{
  from,              ///< the final state of the static stage, that `--from` names
  static_checkpoint, ///< of the static stage
  seismic_checkpoint
};
inline constexpr int state_kinds = 3;

/// The file of a run of this process's own, made at the first call, without its seal.
const std::string& state_bytes(StateKind kind);

/// Takes up a state from its bytes, sealed or not, as the programs do, and goes on for some steps. `Error`
/// where it is refused, Diverged where the steps find what is wrong.
void take_up(StateKind kind, const std::string& bytes);
} // namespace mpm::fuzz

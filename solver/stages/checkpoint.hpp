#pragma once
// The states of a run as files: what they tell of the run, the clock and the domains. Their layout stands in
// io/results/checkpoint_layout.hpp.

#include "io/results/checkpoint_layout.hpp"
#include "solver/stages/clock.hpp"
#include "solver/stages/model.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// Writes the state that the stage has come to into the run's folder, as final_name or a checkpoint_name(),
/// whole or not at all; `fill` adds what is the stage's own. `Error` write_failed.
void write_checkpoint(Session& session, const std::string& name, const Model& model, const Clock& clock,
                      const std::function<void(h5::File&)>& fill);

/// Opens a state of this very run: its layout and identity must fit, and the last state must say that it is.
/// Warns when it was computed with other instructions. `Error` bad_input; folder_taken when its schema is
/// another version's, which can still finish the run.
h5::File open_state(Session& session, const std::filesystem::path& path);
/// Whether a state is the last of its stage.
bool is_last(const h5::File& state);

/// Loads clock and domains from a state of the same stage, which cannot be later than `at_most` (s). The
/// clock holds the step with which the case begins. `Error` bad_input when no run of the case can have left
/// such a state.
void load_model(const h5::File& state, Model& model, Clock& clock, double at_most);

/// Loads particles and their history from the final state of mpm-static that `--from` names; boundaries and
/// clock are the seismic stage's own. Returns the digest of the file. `Error` bad_input when it is no static
/// state, had not settled or is of other ground.
std::string load_static_state(const Session& session, Model& model);
} // namespace mpm

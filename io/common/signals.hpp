#pragma once
// Signals that ask for an end. A handler may do next to nothing, so that it only leaves a note for the time
// loop.

namespace mpm
{
/// Until stop_at_a_step() a signal that asks for an end (SIGTERM, SIGINT, SIGUSR1, SIGUSR2, SIGXCPU, SIGHUP
/// unless it is ignored, as nohup has it) ends the program at once with exit_code::interrupted: nothing has
/// been computed yet. A closed pipe (SIGPIPE) and a file's greatest size (SIGXFSZ) show where a write fails.
void install_signal_handlers();
/// From here on these signals ask the run to stop at the end of a step; asking again changes nothing.
void stop_at_a_step();
/// Whether one has come; the time loop asks after every step.
bool interruption_requested();
} // namespace mpm

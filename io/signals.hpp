#pragma once

namespace mpm
{
/// SIGTERM, SIGUSR1 and SIGINT ask the run to stop at the end of a step; asking again changes nothing.
void install_signal_handlers();
bool interruption_requested();
} // namespace mpm

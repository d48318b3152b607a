#pragma once

#include <string>

namespace mpm
{
class Session;

/// The `main` of both programs: reads the command line, runs `stage` and maps every way in which it may end
/// to an exit code. `Error` carries its own, what diverges is 80, too little memory bad input, a file system
/// that fails 74; anything else that is thrown is a bug of ours. The message goes to the log once there is
/// one, to stderr before.
int run_program(int argc, char** argv, const std::string& name, int (*stage)(Session&));
} // namespace mpm

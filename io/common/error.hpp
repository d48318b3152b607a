#pragma once

#include <stdexcept>
#include <string>

namespace mpm
{
/// What a program's exit status tells the script that started it.
namespace exit_code
{
inline constexpr int done = 0;
inline constexpr int usage = 64;         ///< wrong command line
inline constexpr int bad_input = 65;     ///< bad case, record or checkpoint
inline constexpr int input_missing = 66; ///< input missing or unreadable
inline constexpr int bug = 70;           ///< our bug
inline constexpr int folder_taken = 73;  ///< output folder is another run's
inline constexpr int write_failed = 74;  ///< write failed, last checkpoint intact
inline constexpr int interrupted = 75;   ///< stopped with a valid checkpoint: run again
inline constexpr int diverged = 80;      ///< diverged, last good checkpoint kept
inline constexpr int not_converged = 81; ///< static stage did not converge
} // namespace exit_code

/// *Where: what, and what to do*, with the exit status it leads to. Caught once, in `main`.
struct Error : std::runtime_error
{
  int code; ///< one of `exit_code`

  /// `what` is a whole sentence for the user, without a line end.
  Error(int code, const std::string& what) : std::runtime_error(what), code(code) {}
};
} // namespace mpm

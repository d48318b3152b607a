#pragma once
// What is fuzzed: each reader of the programs behind a function that takes the bytes of one input. An input
// is refused with an `Error` or read as meant, and then has to hold what the target's file says. Anything
// else leaves the function as an exception, which libFuzzer and the tests take for a finding.

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mpm::fuzz
{
/// An input that was accepted and does not hold what it has to.
struct Broken : std::logic_error
{
  using std::logic_error::logic_error;
};

inline void hold(bool what, const std::string& message)
{
  if (!what) throw Broken(message);
}

/// A case, and after lines `%%% NAME` the files beside it; `%%% --set KEY=VALUE` and `%%% --profile NAME` are
/// options.
void try_case(std::string_view bytes);
/// A record; its first line is `FILE|FORMAT|DT|UNIT|COMPONENT`, all but FILE may be empty.
void try_record(std::string_view bytes);
/// Which state a result file is taken for, and its bytes.
void try_checkpoint(std::string_view bytes);
/// Changes to states of small runs, made through HDF5 and sealed; see state_edits.hpp.
void try_state(std::string_view bytes);
/// A program's name and its arguments, one a line.
void try_command_line(std::string_view bytes);

struct Target
{
  std::string_view name; ///< of the executable (fuzz-NAME) and the folder of the corpus
  void (*run)(std::string_view);
};
inline constexpr std::array targets{Target{"case", try_case}, Target{"record", try_record},
                                    Target{"checkpoint", try_checkpoint}, Target{"state", try_state},
                                    Target{"command_line", try_command_line}};
} // namespace mpm::fuzz

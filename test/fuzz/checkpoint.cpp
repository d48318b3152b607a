// A result file of any bytes is refused, unless its seal fits. Behind a seal that was made to fit stands HDF5
// itself, whose readers of its own structures are not ours to mend; what a well-formed file may say wrongly
// is the target `state`.

#include "io/common/error.hpp"
#include "test/fuzz/states.hpp"
#include "test/fuzz/targets.hpp"

namespace mpm::fuzz
{
void try_checkpoint(std::string_view bytes)
try
{
  if (bytes.empty()) return;
  const std::string file(bytes.substr(1));
  take_up(static_cast<StateKind>(static_cast<unsigned char>(bytes.front()) % state_kinds), file);
}
catch (const Error& error)
{
  hold(error.code == exit_code::bad_input || error.code == exit_code::folder_taken,
       std::to_string(error.code) + ": " + error.what());
}
} // namespace mpm::fuzz

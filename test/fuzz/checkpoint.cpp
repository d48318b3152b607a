// A result file of any bytes is refused, unless its seal fits; with a seal that fits it is refused or taken
// up.

#include "io/common/error.hpp"
#include "solver/mpm/domain.hpp"
#include "test/fuzz/states.hpp"
#include "test/fuzz/targets.hpp"
#include "test/sealed.hpp"

namespace mpm::fuzz
{
namespace
{
void try_one(StateKind kind, const std::string& bytes)
try
{
  take_up(kind, bytes);
}
catch (const Error& error)
{
  hold(error.code == exit_code::bad_input || error.code == exit_code::folder_taken,
       std::to_string(error.code) + ": " + error.what());
}
catch (const Diverged&)
{
}
} // namespace

void try_checkpoint(std::string_view bytes)
{
  if (bytes.empty()) return;
  const unsigned first = static_cast<unsigned char>(bytes.front());
  const std::string file(bytes.substr(1));
  try_one(static_cast<StateKind>(first / 2 % state_kinds),
          first % 2 ? test::sealed(test::unsealed(file)) : file);
}
} // namespace mpm::fuzz

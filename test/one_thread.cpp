// Tests run side by side, so each takes one thread; those about threads ask for more. main() is Catch2's.

#include "solver/mpm/parallel.hpp"

namespace
{
[[maybe_unused]] const bool set = (mpm::parallel::use_threads(1), true);
}

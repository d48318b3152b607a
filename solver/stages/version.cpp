#include "solver/stages/version.hpp"

namespace mpm::version
{
const char* const number = SEISMPM_VERSION;
const char* const git = SEISMPM_GIT;
const char* const options = SEISMPM_BUILD;
} // namespace mpm::version

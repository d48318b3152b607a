#pragma once

namespace mpm::parallel
{
/// Makes threads that wait for others spin for some microseconds only and then sleep, unless the environment
/// says how they wait (OMP_WAIT_POLICY, GOMP_SPINCOUNT, KMP_BLOCKTIME). OpenMP's runtime reads that when it
/// is loaded, so the process starts anew, once, as the same process with the same arguments: call it first in
/// `main`.
void wait_briefly(char** argv);
} // namespace mpm::parallel

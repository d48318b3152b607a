#pragma once
// The only door to OpenMP. Nothing here lets a result depend on the number of threads: loops write to
// places of their own, and maxima and sums are gathered by the caller in a fixed order.

#include <omp.h>

namespace mpm::parallel
{
inline void use_threads(int count)
{
  omp_set_dynamic(0);
  omp_set_num_threads(count);
}

inline int threads()
{
  return omp_get_max_threads();
}

/// Processors that this process may use.
inline int processors()
{
  return omp_get_num_procs();
}

/// Calls f(i) for i in [0, count), in any order and on any thread. f must not throw.
template <class Function>
void for_each(int count, const Function& f)
{
#pragma omp parallel for schedule(dynamic) if (count > 1)
  for (int i = 0; i < count; ++i) f(i);
}

/// Runs the given functions at the same time, each in its own thread, and waits for all.
template <class First, class Second>
void together(const First& first, const Second& second)
{
  if (threads() == 1)
  {
    first();
    second();
    return;
  }
#pragma omp parallel sections num_threads(2)
  {
#pragma omp section
    first();
#pragma omp section
    second();
  }
}
} // namespace mpm::parallel

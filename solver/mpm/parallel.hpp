#pragma once
// The only door to OpenMP. Nothing here lets a result depend on the number of threads: loops write to
// places of their own, and maxima and sums are gathered by the caller in a fixed order.

#include <algorithm>
#include <omp.h>
#include <vector>

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

/// Calls f(i) for i in [0, count), in any order and on any thread; each thread takes one stretch, so that
/// loops over the same things find them in the same core's caches. f must not throw.
template <class Function>
void for_each(int count, const Function& f)
{
#pragma omp parallel for schedule(static) if (count > 1)
  for (int i = 0; i < count; ++i) f(i);
}

/// The same, with stretches of about the same sum of cost(i), an integer.
template <class Cost, class Function>
void for_each(int count, const Cost& cost, const Function& f)
{
  std::vector<long> before{0}; // costs of the items before each
  for (int i = 0; i < count; ++i) before.push_back(before.back() + cost(i));
  const long total = before.back();
#pragma omp parallel if (count > 1)
  {
    const int thread = omp_get_thread_num(), team = omp_get_num_threads();
    const auto first_of = [&](int t)
    {
      const auto at = std::lower_bound(before.begin(), before.end(), total * t / team);
      return std::min(static_cast<int>(at - before.begin()), count);
    };
    const int end = thread + 1 == team ? count : first_of(thread + 1);
    for (int i = first_of(thread); i < end; ++i) f(i);
  }
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

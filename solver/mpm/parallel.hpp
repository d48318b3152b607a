#pragma once
// The only door to OpenMP. Nothing here lets a result depend on the number of threads: each item of a loop
// writes what no other one does, and the caller gathers sums and maxima in a fixed order.

#include <algorithm>
#include <array>
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

/// How items 0, 1, .. are shared out: each thread takes one stretch of them, of about the same cost, so that
/// loops over the same things find them in the same core's caches.
class Shares
{
public:
  /// Takes in the next item; `cost` in particles, or what takes as long.
  void add(long cost) { before_.push_back(before_.back() + cost); }
  int size() const { return static_cast<int>(before_.size()) - 1; }
  long cost() const { return before_.back(); }
  /// First item of a thread's stretch, as near to its part of the cost as items allow; for thread = team the
  /// end.
  int first(int thread, int team) const
  {
    if (thread == team) return size();
    const long part = cost() * thread / team;
    const int next =
        static_cast<int>(std::lower_bound(before_.begin(), before_.end(), part) - before_.begin());
    return next > 0 && part - before_[next - 1] < before_[next] - part ? next - 1 : next;
  }

private:
  std::vector<long> before_{0}; ///< cost of the items before each, and of all
};

/// Whether a loop is worth waking threads for, which takes as long as some hundred particles.
inline bool pays(long cost)
{
  return cost > 200 && threads() > 1 && !omp_in_parallel();
}

/// Items that may be done at the same time.
struct Group
{
  std::vector<int> items;
  Shares shares;

  void add(int item, long cost)
  {
    items.push_back(item);
    shares.add(cost);
  }
  /// Calls f(i) for the items of one thread of a team.
  template <class Function>
  void stretch(int thread, int team, const Function& f) const
  {
    const int end = shares.first(thread + 1, team);
    for (int i = shares.first(thread, team); i < end; ++i) f(items[i]);
  }
};

/// Calls f(i) for all items, in any order and on any thread. f must not throw.
template <class Function>
void for_each(const Group& group, const Function& f)
{
  if (!pays(group.shares.cost())) return group.stretch(0, 1, f);
#pragma omp parallel
  group.stretch(omp_get_thread_num(), omp_get_num_threads(), f);
}

/// Calls f(i) for i in [0, count), each of which costs as much as `cost` particles.
template <class Function>
void for_each(int count, int cost, const Function& f)
{
  const auto stretch = [&](int thread, int team)
  {
    const int end = static_cast<int>(static_cast<long>(count) * (thread + 1) / team);
    for (int i = static_cast<int>(static_cast<long>(count) * thread / team); i < end; ++i) f(i);
  };
  if (!pays(static_cast<long>(count) * cost)) return stretch(0, 1);
#pragma omp parallel
  stretch(omp_get_thread_num(), omp_get_num_threads());
}

/// Calls f(i) for the items of one group after the other.
template <std::size_t n, class Function>
void for_each_in_turn(const std::array<Group, n>& groups, const Function& f)
{
  long cost = 0;
  for (const Group& group : groups) cost += group.shares.cost();
  if (!pays(cost))
  {
    for (const Group& group : groups) group.stretch(0, 1, f);
    return;
  }
#pragma omp parallel
  for (const Group& group : groups)
  {
    group.stretch(omp_get_thread_num(), omp_get_num_threads(), f);
#pragma omp barrier
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

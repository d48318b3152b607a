#pragma once

#include <algorithm>
#include <chrono>

namespace mpm
{
/// When something is due to be written that a run writes now and then, by the time on the wall: nothing of
/// the results depends on it.
class Pace
{
public:
  /// Every so many seconds; with a `share` above 0 as much more rarely as makes writing take no more than
  /// that of the time.
  explicit Pace(double every, double share = 0) : every_(every), share_(share) {}

  bool due() const { return since(last_) >= interval(); }
  double interval() const { return share_ > 0 ? std::max(every_, cost_ / share_) : every_; } ///< s
  double cost() const { return cost_; } ///< of the last time, s

  template <class Write>
  void write(const Write& write_it)
  {
    const Wall::time_point begin = Wall::now();
    write_it();
    cost_ = since(begin);
    last_ = Wall::now();
  }

private:
  using Wall = std::chrono::steady_clock;
  static double since(Wall::time_point start)
  {
    return std::chrono::duration<double>(Wall::now() - start).count();
  }

  double every_, share_;
  Wall::time_point last_ = Wall::now();
  double cost_ = 0;
};
} // namespace mpm

#pragma once

#include <algorithm>
#include <cmath>

namespace mpm
{
/// An argument and a function's value there.
struct Sample
{
  double at, value;
};

/// Root of a continuous function that is positive at low.at and not at high.at, where it is within
/// `tolerance` of 0 or the interval at round-off: regula falsi that halves the weight of an end that stays
/// (Illinois; Dowell & Jarratt, BIT 11 (1971) 168), and the interval where three steps have not.
template <class Function>
double find_root(Sample low, Sample high, double tolerance, const Function& f)
{
  int stays = 0; // 1: the high end stayed last time, -1: the low one
  double size = std::fabs(high.at - low.at);
  for (int k = 1; k <= 90; ++k)
  {
    const double now = std::fabs(high.at - low.at);
    if (now <= 4e-16 * std::max(std::fabs(low.at), std::fabs(high.at))) break;
    const bool slow = k % 3 == 0 && now > 0.5 * size;
    if (k % 3 == 0) size = now;
    const double secant = (low.at * high.value - high.at * low.value) / (high.value - low.value);
    const bool inside = secant > std::min(low.at, high.at) && secant < std::max(low.at, high.at);
    const double x = inside && !slow ? secant : 0.5 * (low.at + high.at);
    const double value = f(x);
    if (std::fabs(value) <= tolerance) return x;
    if (value > 0)
    {
      low = {x, value};
      if (stays == 1) high.value *= 0.5;
      stays = 1;
    }
    else
    {
      high = {x, value};
      if (stays == -1) low.value *= 0.5;
      stays = -1;
    }
  }
  return high.at;
}
} // namespace mpm

#include "boundaries/ground_motion/incoming_wave.hpp"

namespace mpm
{
std::size_t sample_count(double step, double until)
{
  return 1 + static_cast<std::size_t>(std::max(0.0, std::floor(until / step * (1 + 1e-9))));
}

GroundMotion sampled(const GroundMotion& motion, const Fade& fade, double step, double until)
{
  GroundMotion result{step, {}, {}, motion.report};
  const std::size_t count = sample_count(step, until);
  for (std::size_t k = 0; k < count; ++k)
  {
    const double t = step * double(k), share = fade.share(t), v = motion.upgoing_velocity(t);
    result.velocity.push_back(share * v);
    result.acceleration.push_back(share * motion.upgoing_acceleration(t) + fade.slope(t) * v);
  }
  return result;
}

double common_step(const IncomingWave& wave)
{
  constexpr int most_parts = 20;
  if (!wave.horizontal && !wave.vertical) return 0;
  const double one = (wave.horizontal ? wave.horizontal : wave.vertical)->straight_step(),
               other = (wave.vertical ? wave.vertical : wave.horizontal)->straight_step();
  const double less = std::min(one, other), more = std::max(one, other);
  const auto divides = [&](int parts)
  {
    const double ratio = more / (less / parts);
    return std::abs(ratio - std::round(ratio)) < 1e-6 * ratio;
  };
  int parts = 1;
  while (parts < most_parts && !divides(parts)) ++parts;
  return less / parts;
}
} // namespace mpm

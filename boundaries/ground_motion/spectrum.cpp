#include "boundaries/ground_motion/spectrum.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <bit>

namespace mpm
{
MotionSpectrum::MotionSpectrum(const GroundMotion& motion)
{
  std::vector<double> padded = motion.acceleration; // zeros at the end add no intensity
  const std::size_t length = std::bit_ceil(std::max<std::size_t>(padded.size(), 2));
  padded.resize(length, 0.0);
  std::vector<std::complex<double>> lines;
  Eigen::FFT<double>().fwd(lines, padded);
  resolution_ = 1 / (motion.dt * static_cast<double>(length));
  share_below_.assign(length / 2 + 2, 0);
  for (std::size_t k = 0; k <= length / 2; ++k) // lines in between stand for their mirror image too
    share_below_[k + 1] = share_below_[k] + std::norm(lines[k]) * (k == 0 || k == length / 2 ? 1 : 2);
  const double total = share_below_.back();
  for (double& share : share_below_) share = total > 0 ? share / total : 1;
}

double MotionSpectrum::share_above(double frequency) const
{
  const double at = std::clamp(frequency / resolution_ + 0.5, 0.0, double(share_below_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(at), share_below_.size() - 2);
  const double part = at - double(k);
  return 1 - ((1 - part) * share_below_[k] + part * share_below_[k + 1]);
}

double MotionSpectrum::frequency_with_above(double share) const
{
  const auto next = std::ranges::lower_bound(share_below_, 1 - share);
  if (next == share_below_.begin() || next == share_below_.end()) return 0;
  const double before = *(next - 1), part = (1 - share - before) / (*next - before);
  return std::max(0.0, resolution_ * (double(next - 1 - share_below_.begin()) + part - 0.5));
}
} // namespace mpm

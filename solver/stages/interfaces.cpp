#include "solver/stages/interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace mpm
{
namespace
{
constexpr double reach = 0.5;     // cells to each side
constexpr int levels = 16;        // of a share
constexpr double rounding = 1e-6; // of a level: where shares lie between two, all columns go the same way

/// Integral of the hat of unit area over (-1, 1), from -1 to t.
double hat_below(double t)
{
  t = std::clamp(t, -1.0, 1.0);
  return t < 0 ? 0.5 * (1 + t) * (1 + t) : 1 - 0.5 * (1 - t) * (1 - t);
}

/// The ground as rectangles: a seed fills its particle column over a height of volume / width.
class Surroundings
{
public:
  Surroundings(const Case& case_file, const std::vector<Seed>& seeds, std::size_t materials)
      : seeds_(seeds), left_(case_file.domain.left), size_(case_file.grid.particle_spacing()),
        hat_(reach * case_file.grid.spacing), materials_(materials)
  {
    for (std::size_t k = 0; k < seeds.size(); ++k)
    {
      const auto column = static_cast<std::size_t>(std::floor((seeds[k].x - left_) / size_));
      begin_.resize(std::max(begin_.size(), column + 2), k);
      begin_.back() = k + 1;
    }
  }

  /// Shares of the materials around a seed, in levels; they add up to `levels`.
  std::vector<int> shares(const Seed& seed) const
  {
    std::vector<double> weight(materials_, 0.0);
    const auto own = static_cast<long>(std::floor((seed.x - left_) / size_));
    const long far = static_cast<long>(std::ceil(hat_ / size_ + 0.5));
    for (long c = std::max(0L, own - far); c <= std::min(own + far, columns() - 1); ++c)
    {
      const double across = weight_between(static_cast<double>(c - own) * size_, size_);
      if (across > 0) add_column(c, seed.y, across, weight);
    }
    double all = 0;
    for (const double w : weight) all += w;
    std::vector<int> result(materials_, 0);
    int others = 0;
    for (std::size_t m = 0; m < materials_; ++m)
      if (static_cast<int>(m) != seed.material)
        others += result[m] = static_cast<int>(levels * weight[m] / all + 0.5 + rounding);
    result[seed.material] = levels - others;
    return result;
  }

private:
  long columns() const { return static_cast<long>(begin_.size()) - 1; }
  double weight_between(double middle, double extent) const
  {
    return hat_below((middle + 0.5 * extent) / hat_) - hat_below((middle - 0.5 * extent) / hat_);
  }
  void add_column(long column, double y, double across, std::vector<double>& weight) const
  {
    const auto first = seeds_.begin() + static_cast<long>(begin_[column]),
               end = seeds_.begin() + static_cast<long>(begin_[column + 1]);
    auto at = std::lower_bound(first, end, y - hat_,
                               [&](const Seed& s, double low) { return s.y + s.volume / size_ < low; });
    for (; at != end && at->y - at->volume / size_ < y + hat_; ++at)
      weight[at->material] += across * weight_between(at->y - y, at->volume / size_);
  }

  const std::vector<Seed>& seeds_;
  double left_, size_, hat_;
  std::size_t materials_;
  std::vector<std::size_t> begin_; ///< first seed of each column, and one past the last
};

/// A material with the moduli of a mixture, harmonic means of G and of M = lambda + 2 G:
/// 1/G = sum s_m / G_m, 1/M = sum s_m / M_m; itself if its law does not admit them.
Material mix(const std::vector<Material>& materials, int own, const std::vector<int>& shares, double spacing)
{
  double shear = 0, pressure = 0; // compliances, 1/Pa
  for (std::size_t m = 0; m < shares.size(); ++m)
  {
    const Elastic& law = materials[m].elastic();
    shear += shares[m] / (levels * law.shear_modulus());
    pressure += shares[m] / (levels * law.p_modulus());
  }
  const double G = 1 / shear, lame = 1 / pressure - 2 * G, poisson = lame / (2 * (lame + G));
  Material result = materials[own];
  result.origin = own;
  const bool admitted = std::visit(
      [&](auto& law)
      {
        law.young = 2 * G * (1 + poisson);
        law.poisson = poisson;
        return law.resolve(spacing).empty();
      },
      result.law);
  if (!admitted) result.law = materials[own].law;
  return result;
}
} // namespace

void average_interfaces(const Case& case_file, std::vector<Seed>& seeds, std::vector<Material>& materials)
{
  const std::vector<Seed> pure = seeds;
  const Surroundings surroundings(case_file, pure, case_file.materials.size());
  std::map<std::pair<int, std::vector<int>>, int> known;
  for (Seed& seed : seeds)
  {
    const std::vector<int> shares = surroundings.shares(seed);
    const int own = seed.material;
    if (shares[own] == levels) continue;
    const auto [at, is_new] = known.try_emplace({own, shares}, static_cast<int>(materials.size()));
    if (is_new)
    {
      materials.push_back(mix(case_file.materials, own, shares, case_file.grid.spacing));
      materials.back().name += " ~" + std::to_string(known.size());
    }
    seed.material = at->second;
  }
}
} // namespace mpm

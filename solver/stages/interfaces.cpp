#include "solver/stages/interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace mpm
{
namespace
{
constexpr double reach = 0.75;      // cells to each side
constexpr double kink_reach = 0.85; // as far as the splines smooth what has been averaged
constexpr int levels = 32;          // of a share
constexpr double rounding = 1e-6;   // of a level: where shares lie between two, all columns go the same way

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

/// Index of the material whose law a mixture has. Under one traction the ground at an interface is no
/// stronger than the weaker side, so that a material that cannot yield takes the law of what can, of most of
/// it.
int giver_of_law(const std::vector<Material>& materials, int own, const std::vector<int>& shares)
{
  const auto yields = [&](int m) { return materials[m].model() != Elastic::model; };
  int result = own;
  for (int m = 0; m < static_cast<int>(shares.size()); ++m)
    if (!yields(own) && yields(m) && shares[m] > 0 && (result == own || shares[m] > shares[result]))
      result = m;
  return result;
}

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
  result.law_of = giver_of_law(materials, own, shares);
  result.law = materials[result.law_of].law;
  const bool admitted = std::visit(
      [&](auto& law)
      {
        law.density = materials[own].elastic().density;
        law.young = 2 * G * (1 + poisson);
        law.poisson = poisson;
        return law.resolve(spacing).empty();
      },
      result.law);
  if (admitted) return result;
  result.law = materials[own].law;
  result.law_of = own;
  return result;
}

/// Index of the material at a point of the undeformed ground, which goes on beyond its edges as it is there;
/// -1 where there is none at all.
int material_at(const Case& case_file, double x, double y)
{
  const double inside = std::clamp(x, case_file.domain.left, case_file.domain.right);
  int found = -1;
  for (const Layer& layer : case_file.layers(inside, inside))
    if (found < 0 || layer.bottom <= y) found = case_file.regions[layer.region].material;
  return found;
}

/// Sums over the hat around a point: how often each material is met, and the mean way in it.
struct Ways
{
  double points = 0; ///< weight of all points
  std::vector<double> share, x, y;
};

Ways ways_around(const Case& case_file, double x, double y)
{
  constexpr int across = 32, along = 16; // points of the hat's width, and of a way
  const double hat = kink_reach * case_file.grid.spacing;
  const std::size_t materials = case_file.materials.size();
  Ways ways{0, std::vector<double>(materials, 0.0), std::vector<double>(materials, 0.0),
            std::vector<double>(materials, 0.0)};
  const auto at = [&](int k) { return (2 * k + 1.0) / across - 1; };
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
    {
      const double dx = hat * at(i), dy = hat * at(j);
      const int there = material_at(case_file, x + dx, y + dy);
      if (there < 0) continue;
      const double weight = (1 - std::fabs(at(i))) * (1 - std::fabs(at(j)));
      ways.points += weight;
      ways.share[there] += weight;
      for (int k = 0; k < along; ++k)
      {
        const double s = (k + 0.5) / along;
        const int met = material_at(case_file, x + s * dx, y + s * dy);
        if (met < 0) continue;
        ways.x[met] += weight / along * dx;
        ways.y[met] += weight / along * dy;
      }
    }
  return ways;
}
} // namespace

Kink kink_at(const Case& case_file, double x, double y)
{
  if (case_file.grid.interfaces == Interfaces::sharp) return {};
  const Ways ways = ways_around(case_file, x, y);
  // Of a modulus' compliance c: mean over the hat, and d of (c - mean), so that a surface has no part in it.
  struct Compliance
  {
    double mean = 0, x = 0, y = 0;
  };
  const auto sum = [&](const auto& compliance)
  {
    Compliance c;
    for (std::size_t m = 0; m < case_file.materials.size(); ++m)
      c.mean += ways.share[m] / ways.points * compliance(case_file.materials[m].elastic());
    for (std::size_t m = 0; m < case_file.materials.size(); ++m)
    {
      const double more = compliance(case_file.materials[m].elastic()) - c.mean;
      c.x += ways.x[m] / ways.points * more;
      c.y += ways.y[m] / ways.points * more;
    }
    return c;
  };
  if (std::count_if(ways.share.begin(), ways.share.end(), [](double share) { return share > 0; }) < 2)
    return {};
  const Compliance shear = sum([](const Elastic& e) { return 1 / e.shear_modulus(); });
  const Compliance pressure = sum([](const Elastic& e) { return 1 / e.p_modulus(); });
  const Compliance coupling = sum([](const Elastic& e) { return 1 - 2 * e.shear_modulus() / e.p_modulus(); });
  const double d = std::hypot(shear.x, shear.y);
  if (d == 0) return {};
  Kink kink;
  kink.normal_x = shear.x / d;
  kink.normal_y = shear.y / d;
  const auto across = [&](const Compliance& c) { return c.x * kink.normal_x + c.y * kink.normal_y; };
  const double G = 1 / shear.mean, M = 1 / pressure.mean;
  kink.shear = G * d;
  kink.normal = M * across(pressure);
  kink.lateral = (M - 2 * G) * across(pressure) - across(coupling);
  return kink;
}

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

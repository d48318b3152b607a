#include "solver/mpm/flow.hpp"

#include <cmath>

namespace mpm
{
namespace
{
constexpr int look_every = 20; ///< steps
}

Flow::Flow(const Domain& domain) : domain_(domain), flow_(domain.particles.size(), 0.0)
{
  std::vector<char> flows(domain.blocks.occupied.size(), 0);
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
    if (const auto* strain = domain.materials[m].field("plastic_strain"))
      for (std::size_t k = 0; k < strain->size(); ++k)
      {
        const std::size_t p = domain.material_begin[m] + k;
        flow_[p] = (*strain)[k] - domain.particles.noted_flow[p];
      }
  for (std::size_t b = 0; b < flows.size(); ++b)
    for (const ParticleRange& range : domain.blocks.occupied[b].ranges)
      for (int p = range.begin; p < range.end; ++p)
      {
        flows[b] |= flow_[p] >= slow;
        any_ |= flow_[p] >= least;
      }
  act_ = beside(flows);
  near_ = beside(beside(act_));
}

std::vector<char> Flow::beside(const std::vector<char>& some) const
{
  std::vector<char> all(some.size(), 0);
  for (std::size_t b = 0; b < some.size(); ++b)
  {
    if (!some[b]) continue;
    for (const int block : domain_.blocks.occupied[b].around)
      if (block >= 0 && domain_.blocks.occupied_in[block] >= 0) all[domain_.blocks.occupied_in[block]] = 1;
  }
  return all;
}

void note_flow(Domain& domain)
{
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
    if (const auto* strain = domain.materials[m].field("plastic_strain"))
      std::copy(strain->begin(), strain->end(),
                domain.particles.noted_flow.begin() + domain.material_begin[m]);
}

void follow_flow(Domain& domain, double dt)
{
  const StepSettings& settings = domain.settings;
  const bool wanted = settings.average_flow || settings.filter.strain > 0;
  if (!wanted || std::llround(domain.time / dt) % look_every != 0) return;
  const Flow flow(domain);
  if (!flow.any()) return;
  if (settings.filter.strain > 0) filter_stresses(domain, flow);
  if (settings.average_flow) average_flow(domain, flow);
  note_flow(domain);
}
} // namespace mpm

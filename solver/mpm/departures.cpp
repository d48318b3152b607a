#include "solver/mpm/departures.hpp"

#include "solver/mpm/domain.hpp"

namespace mpm
{
namespace
{
/// Drops the values of the particles that leave; `from` is the index of the particle that the first belongs
/// to.
template <class T>
void drop(std::vector<T>& values, std::span<const Leaving> leaving, int from)
{
  auto next = leaving.begin();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    const int index = from + static_cast<int>(k);
    while (next != leaving.end() && next->index < index) ++next;
    if (next == leaving.end() || next->index != index) values[kept++] = values[k];
  }
  values.resize(kept);
}

int material_of(const Domain& domain, int index)
{
  const auto next = std::upper_bound(domain.material_begin.begin(), domain.material_begin.end(), index);
  return static_cast<int>(next - domain.material_begin.begin()) - 1;
}

void note(Domain& domain, std::span<const Leaving> leaving)
{
  const Particles& p = domain.particles;
  for (const Leaving& one : leaving)
    domain.departed.push_back({p.id[one.index], material_of(domain, one.index), one.edge, domain.time,
                               p.mass[one.index], p.reference_x[one.index], p.reference_y[one.index]});
}

void drop_particles(Domain& domain, std::span<const Leaving> leaving)
{
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
    for (auto& state : domain.materials[m].state) drop(state, leaving, domain.material_begin[m]);
  Particles& p = domain.particles;
  for_each_array(p, [&](std::vector<double>& values) { drop(values, leaving, 0); });
  drop(p.id, leaving, 0);
  for (int& begin : domain.material_begin)
    begin -= static_cast<int>(
        std::count_if(leaving.begin(), leaving.end(), [&](const Leaving& l) { return l.index < begin; }));
}
} // namespace

void remove_particles(Domain& domain, std::span<const Leaving> leaving)
{
  if (leaving.empty()) return;
  note(domain, leaving);
  book_departure(domain, [&] { drop_particles(domain, leaving); });
  domain.particles.index_ids(domain.planted());
  for (const auto& boundary : domain.boundaries) boundary->release(domain.particles);
  sort_particles(domain);
}

void visit_departed(StateVisitor& visitor, std::vector<Departed>& departed)
{
  RecordVisitor<Departed> list(visitor, "", departed);
  list.each_integer(
      "particle", [](Departed & one) -> auto& { return one.particle; });
  list.each_integer(
      "material", [](Departed & one) -> auto& { return one.material; });
  list.each_integer(
      "edge", [](Departed & one) -> auto& { return one.edge; });
  list.member("time", "s", &Departed::time);
  list.member("mass", "kg/m", &Departed::mass);
  list.member("reference_x", "m", &Departed::reference_x);
  list.member("reference_y", "m", &Departed::reference_y);
}
} // namespace mpm

#include "io/results/domain_state.hpp"

#include "io/results/checkpoint_layout.hpp"
#include "solver/mpm/state_problem.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mpm
{
namespace
{
class Saver final : public StateVisitor
{
public:
  explicit Saver(h5::Group group) : group_(std::move(group)) {}
  void doubles(std::string_view name, std::string_view unit, std::vector<double>& values) override
  {
    group_.write(std::string(name), std::span<const double>(values), {values.size()}, unit);
  }
  void integers(std::string_view name, std::vector<std::int64_t>& values) override
  {
    group_.write(std::string(name), std::span<const std::int64_t>(values), {values.size()}, "1");
  }

private:
  h5::Group group_;
};

[[noreturn]] void refuse(const h5::Group& group, const std::string& name, const std::string& what)
{
  throw Error(exit_code::bad_input,
              fmt::format("{}: {}; no run leaves such a state, use another file", group.where(name), what));
}

class Loader final : public StateVisitor
{
public:
  explicit Loader(h5::Group group, bool may_be_none = false)
      : group_(std::move(group)), may_be_none_(may_be_none)
  {
  }
  void doubles(std::string_view name, std::string_view, std::vector<double>& values) override
  {
    values = group_.read_doubles(std::string(name));
    for (const double value : values)
      if (std::isnan(value) && !may_be_none_) refuse(group_, std::string(name), "is not a number somewhere");
  }
  void integers(std::string_view name, std::vector<std::int64_t>& values) override
  {
    values = group_.read_ints(std::string(name));
  }

private:
  h5::Group group_;
  bool may_be_none_; ///< whether NaN stands for no value
};

/// Where a boundary keeps what it remembers.
std::string boundary_group(const Boundary& boundary)
{
  return fmt::format("{}/{}", checkpoint::boundary, boundary.name());
}

/// Ids and the names of components are the axes, by which readers of netCDF-4 know the dimensions.
void name_axes(h5::Group& group)
{
  group.write_strings("component", {"x", "y"});
  group.write_strings("stress_component", {"xx", "yy", "zz", "xy"});
  group.write_strings("affine_component", {"xx", "xy", "yx", "yy"});
  for (const ParticleField& field : particle_fields)
  {
    const std::string name(field.name);
    group.attach_scale(name, "id", 0);
    if (field.components == 2) group.attach_scale(name, "component", 1);
    if (field.components == 4) group.attach_scale(name, name + "_component", 1);
  }
}

void save_particles(h5::Group group, const Particles& p)
{
  const std::size_t count = p.size();
  for (const ParticleField& field : particle_fields)
  {
    const std::size_t components = field.components;
    std::vector<double> values(count * components);
    for (std::size_t c = 0; c < components; ++c)
      for (std::size_t k = 0; k < count; ++k) values[k * components + c] = (p.*field.data[c])[k];
    std::vector<hsize_t> shape{count};
    if (components > 1) shape.push_back(components);
    group.write(std::string(field.name), std::span<const double>(values), shape, field.unit);
  }
  group.write("id", std::span<const std::int64_t>(p.id), {count}, "1");
  name_axes(group);
}

void save_materials(h5::Group group, const Domain& domain)
{
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Material& material = domain.materials[m];
    h5::Group own = group.create_group(material.name);
    own.attribute("model", material.model());
    own.attribute("material", material.origin < 0 ? material.name : domain.materials[material.origin].name);
    own.attribute("begin", std::int64_t(domain.material_begin[m]));
    own.attribute("end", std::int64_t(domain.material_begin[m + 1]));
    for (std::size_t k = 0; k < material.state.size(); ++k)
      own.write(std::string(material.state_fields()[k].name), std::span<const double>(material.state[k]),
                {material.state[k].size()}, material.state_fields()[k].unit);
  }
}

/// Which particles belong to which block: (block x, block y, material, begin, end) a line.
void save_blocks(h5::Group group, const Domain& domain)
{
  std::vector<std::int64_t> table;
  for (const OccupiedBlock& occupied : domain.blocks.occupied)
    for (const ParticleRange& r : occupied.ranges)
      table.insert(table.end(), {occupied.block.x, occupied.block.y, r.material, r.begin, r.end});
  group.attribute("spacing", domain.grid.spacing);
  group.attribute("origin", std::vector<double>{domain.grid.origin_x, domain.grid.origin_y});
  group.attribute("drift", domain.blocks.drift);
  group.write("occupied_blocks", std::span<const std::int64_t>(table), {table.size() / 5, 5}, "1");
}

void load_blocks(const h5::Group& group, Domain& domain)
{
  domain.blocks.occupied.clear();
  const std::vector<std::int64_t> table = group.read_ints("occupied_blocks");
  if (table.size() % 5 != 0) refuse(group, "occupied_blocks", "has no five columns");
  for (const std::int64_t value : table)
    if (value != static_cast<int>(value)) refuse(group, "occupied_blocks", fmt::format("holds {}", value));
  const std::vector<double> origin{domain.grid.origin_x, domain.grid.origin_y};
  if (group.attribute_double("spacing") != domain.grid.spacing || group.attribute_doubles("origin") != origin)
    refuse(group, "", "is another grid than the case's");
  for (std::size_t k = 0; k < table.size(); k += 5)
  {
    const BlockIndex block{static_cast<int>(table[k]), static_cast<int>(table[k + 1])};
    if (domain.blocks.occupied.empty() || domain.blocks.occupied.back().block != block)
      domain.blocks.occupied.push_back({block, {}, {}});
    domain.blocks.occupied.back().ranges.push_back(
        {static_cast<int>(table[k + 2]), static_cast<int>(table[k + 3]), static_cast<int>(table[k + 4])});
  }
  domain.blocks.drift = group.attribute_double("drift");
}

/// History variables, and which particles are of which material: all that the case makes, less those that
/// have left.
void load_materials(const h5::Group& group, Domain& domain)
{
  std::vector<int> begin = domain.material_begin;
  for (const Departed& one : domain.departed)
    for (std::size_t m = one.material + 1; m < begin.size(); ++m) --begin[m];
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    Material& material = domain.materials[m];
    const h5::Group own = group.open_group(fmt::format("{}/{}", checkpoint::materials, material.name));
    if (own.attribute_string("model") != material.model() || own.attribute_int("begin") != begin[m] ||
        own.attribute_int("end") != begin[m + 1])
      throw Error(exit_code::bad_input, own.where() +
                                            ": is another material than the case's; use the case that the "
                                            "checkpoint was made with");
    for (std::size_t k = 0; k < material.state.size(); ++k)
      material.state[k] = own.read_doubles(std::string(material.state_fields()[k].name));
  }
  domain.material_begin = std::move(begin);
}

struct KinkField
{
  std::string_view name, unit;
  double Kink::*member;
};
constexpr std::array gauge_kink_fields{
    KinkField{"kink_normal_x", "1", &Kink::normal_x}, KinkField{"kink_normal_y", "1", &Kink::normal_y},
    KinkField{"kink_normal", "m", &Kink::normal},     KinkField{"kink_lateral", "m", &Kink::lateral},
    KinkField{"kink_shear", "m", &Kink::shear},       KinkField{"kink_stretch", "1", &Kink::stretch},
    KinkField{"kink_slip", "1", &Kink::slip}};

void visit_gauges(StateVisitor& visitor, std::vector<Gauge>& gauges)
{
  RecordVisitor<Gauge> list(visitor, "", gauges);
  list.member("x", "m", &Gauge::x);
  list.member("y", "m", &Gauge::y);
  list.member("reference_x", "m", &Gauge::reference_x);
  list.member("reference_y", "m", &Gauge::reference_y);
  list.member("velocity_x", "m/s", &Gauge::velocity_x);
  list.member("velocity_y", "m/s", &Gauge::velocity_y);
  for (const auto& [name, unit, member] : gauge_kink_fields)
    list.each(name, unit, [m = member](Gauge& gauge) -> double& { return gauge.kink.*m; });
}
} // namespace

void save_domain(h5::Group& group, Domain& domain)
{
  save_particles(group.create_group(checkpoint::particles), domain.particles);
  save_materials(group.create_group(checkpoint::materials), domain);
  save_blocks(group.create_group(checkpoint::grid), domain);
  for (const auto& boundary : domain.boundaries)
  {
    if (boundary->name().empty()) continue;
    Saver saver(group.create_group(boundary_group(*boundary)));
    boundary->visit_state(saver);
  }
  Saver saver(group.create_group(checkpoint::gauges));
  visit_gauges(saver, domain.gauges);
  Saver departed(group.create_group(checkpoint::departed));
  visit_departed(departed, domain.departed);
  Saver energy(group.create_group(checkpoint::energy));
  visit_energy_balance(energy, domain.energy);
  Saver rest(group.create_group(checkpoint::rest));
  visit_rest(rest, domain);
}

namespace
{
/// All that the case makes, less those that have left.
void read_particles(const h5::Group& particles, Domain& domain)
{
  Particles& p = domain.particles;
  if (domain.departed.size() > std::size_t(p.size())) refuse(particles, "", "more have left than there were");
  const std::size_t count = p.size() - domain.departed.size();
  std::vector<std::int64_t> ids = particles.read_ints("id");
  if (ids.size() != count)
    throw Error(
        exit_code::bad_input,
        fmt::format("{}: holds {} particles where the case makes {}; use the case that it was made with",
                    particles.where("id"), ids.size(), count));
  p.resize(static_cast<int>(count));
  p.id = std::move(ids);
  for (const ParticleField& field : particle_fields)
  {
    const std::vector<double> values = particles.read_doubles(std::string(field.name));
    if (values.size() != count * field.components)
      throw Error(exit_code::bad_input, particles.where(std::string(field.name)) + ": has the wrong size");
    for (int c = 0; c < field.components; ++c)
      for (std::size_t k = 0; k < count; ++k) (p.*field.data[c])[k] = values[k * field.components + c];
  }
}

void read_boundaries(const h5::Group& group, Domain& domain)
{
  for (const auto& boundary : domain.boundaries)
  {
    if (boundary->name().empty()) continue;
    Loader loader(group.open_group(boundary_group(*boundary)));
    boundary->visit_state(loader);
  }
  Loader gauges(group.open_group(checkpoint::gauges), true); // of a gauge whose ground has left
  visit_gauges(gauges, domain.gauges);
  Loader departed(group.open_group(checkpoint::departed));
  visit_departed(departed, domain.departed);
  Loader energy(group.open_group(checkpoint::energy));
  visit_energy_balance(energy, domain.energy);
}

std::vector<double> masses_by_id(const Particles& p)
{
  std::vector<double> masses(p.size());
  for (int k = 0; k < p.size(); ++k) masses[p.id[k]] = p.mass[k];
  return masses;
}

/// Reads, checks, and only then builds what goes by what was read.
void load(const h5::Group& group, Domain& domain, bool with_boundaries)
{
  const std::vector<double> masses = masses_by_id(domain.particles);
  try
  {
    if (with_boundaries) read_boundaries(group, domain);
    read_particles(group.open_group(checkpoint::particles), domain);
    load_materials(group, domain);
    load_blocks(group.open_group(checkpoint::grid), domain);
    if (with_boundaries)
    {
      Loader rest(group.open_group(checkpoint::rest));
      visit_rest(rest, domain);
    }
  }
  catch (const Error&)
  {
    throw;
  }
  catch (const std::runtime_error& problem)
  {
    refuse(group, "", problem.what());
  }
  if (const std::string problem = state_problem(domain, masses); !problem.empty()) refuse(group, "", problem);
  rebuild(domain);
}
} // namespace

void load_particles(const h5::Group& group, Domain& domain)
{
  load(group, domain, false);
}

void load_domain(const h5::Group& group, Domain& domain)
{
  load(group, domain, true);
}
} // namespace mpm

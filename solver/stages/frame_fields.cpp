#include "solver/stages/frame_fields.hpp"

#include <algorithm>

namespace mpm
{
std::array<double, 2> displacement_of(const Domain& domain, int k)
{
  const Particles& p = domain.particles;
  return {p.x[k] - p.reference_x[k], p.y[k] - p.reference_y[k]};
}

std::array<double, 2> velocity_of(const Domain& domain, int k)
{
  return {domain.particles.velocity_x[k], domain.particles.velocity_y[k]};
}

namespace
{
/// A field of a frame by its name, for all particles in their order: displacement, velocity, what each
/// particle has (particle_fields), or a history variable of a law, 0 where the particle's law has none.
/// Vectors have three components, as VTK wants them.
Frame::Field frame_field(const Domain& domain, const std::string& name)
{
  const Particles& p = domain.particles;
  const int count = p.size();
  const auto vector = [&](const auto& of)
  {
    std::vector<double> values;
    for (int k = 0; k < count; ++k)
    {
      const auto [x, y] = of(domain, k);
      values.insert(values.end(), {x, y, 0});
    }
    return values;
  };
  if (name == "displacement") return {name, "m", 3, vector(displacement_of)};
  if (name == "velocity") return {name, "m/s", 3, vector(velocity_of)};
  for (const ParticleField& field : particle_fields)
  {
    if (field.name != name) continue;
    Frame::Field result{name, std::string(field.unit), field.components, {}};
    for (int k = 0; k < count; ++k)
      for (int c = 0; c < field.components; ++c) result.values.push_back((p.*field.data[c])[k]);
    if (name == "stress") result.component_names = {"xx", "yy", "zz", "xy"};
    return result;
  }
  // A history variable: each material keeps those of its own particles.
  Frame::Field result{name, "1", 1, std::vector<double>(count, 0.0)};
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Material& material = domain.materials[m];
    for (std::size_t f = 0; f < material.state.size(); ++f)
    {
      if (material.state_fields()[f].name != name) continue;
      result.unit = material.state_fields()[f].unit;
      std::copy(material.state[f].begin(), material.state[f].end(),
                result.values.begin() + domain.material_begin[m]);
    }
  }
  return result;
}

/// p = -tr(sigma) / 3 and q = sqrt(3 J2) out of the stresses of a frame.
std::vector<Frame::Field> invariants_of(const Frame::Field& stress)
{
  Frame::Field p{"p", "Pa", 1, {}}, q{"q", "Pa", 1, {}};
  for (std::size_t k = 0; k < stress.values.size(); k += 4)
  {
    const double* s = &stress.values[k];
    const Deviator deviator(s[0], s[1], s[2], s[3]);
    p.values.push_back(-deviator.mean);
    q.values.push_back(deviator.mises());
  }
  return {p, q};
}
} // namespace

Frame frame_of(const Domain& main, const Case& case_file, const Clock& clock)
{
  Frame frame;
  frame.time = clock.time();
  frame.step = clock.step;
  for (int k = 0; k < main.particles.size(); ++k)
    frame.points.insert(frame.points.end(), {main.particles.x[k], main.particles.y[k], 0});
  std::vector<std::string> fields = case_file.output.frames.fields;
  if (std::find(fields.begin(), fields.end(), "volume") == fields.end()) fields.push_back("volume");
  for (const std::string& name : fields) frame.fields.push_back(frame_field(main, name));
  if (const auto stress = std::find(fields.begin(), fields.end(), "stress"); stress != fields.end())
    for (Frame::Field& field : invariants_of(frame.fields[stress - fields.begin()]))
      frame.fields.push_back(std::move(field));
  frame.ids = main.particles.id;
  frame.materials.resize(main.particles.size());
  for (std::size_t m = 0; m < main.materials.size(); ++m)
    std::fill(frame.materials.begin() + main.material_begin[m],
              frame.materials.begin() + main.material_begin[m + 1],
              main.materials[m].origin < 0 ? m : main.materials[m].origin); // a mixture is its owner's
  for (const Material& material : case_file.materials) frame.material_names.push_back(material.name);
  return frame;
}
} // namespace mpm

#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace mpm
{
/// Material points as a structure of arrays, sorted by material, then grid block, then cell. Tension
/// positive.
struct Particles
{
  std::vector<double> x, y;                                       ///< position, m
  std::vector<double> reference_x, reference_y;                   ///< position in the undeformed ground, m
  std::vector<double> velocity_x, velocity_y;                     ///< m/s
  std::vector<double> affine_xx, affine_xy, affine_yx, affine_yy; ///< C = D^-1 B, 1/s
  std::vector<double> stress_xx, stress_yy, stress_zz, stress_xy; ///< Cauchy stress, Pa
  std::vector<double> mass;                                       ///< kg per m out of plane
  std::vector<double> volume;                                     ///< current, m3 per m out of plane
  std::vector<double> noted_flow; ///< plastic strain when the flow was looked at last, see follow_flow
  std::vector<std::int64_t> id;   ///< stable name of the particle
  std::vector<int> index_of;      ///< index in these arrays by id; -1: the particle has left

  int size() const { return static_cast<int>(x.size()); }
  void resize(int count);
  /// Fills index_of after particles have moved in the arrays; ids are below `ids`.
  void index_ids(std::size_t ids);
};

/// The fields of a particle, named once for sorting, checkpoints and checks: a scalar, a vector (x, y), a
/// tensor (xx, xy, yx, yy) or a stress (xx, yy, zz, xy).
struct ParticleField
{
  std::string_view name;
  std::string_view unit;
  int components;
  std::array<std::vector<double> Particles::*, 4> data;
};

inline constexpr std::array particle_fields{
    ParticleField{"position", "m", 2, {&Particles::x, &Particles::y}},
    ParticleField{"reference", "m", 2, {&Particles::reference_x, &Particles::reference_y}},
    ParticleField{"velocity", "m/s", 2, {&Particles::velocity_x, &Particles::velocity_y}},
    ParticleField{
        "affine",
        "1/s",
        4,
        {&Particles::affine_xx, &Particles::affine_xy, &Particles::affine_yx, &Particles::affine_yy}},
    ParticleField{
        "stress",
        "Pa",
        4,
        {&Particles::stress_xx, &Particles::stress_yy, &Particles::stress_zz, &Particles::stress_xy}},
    ParticleField{"mass", "kg/m", 1, {&Particles::mass}},
    ParticleField{"volume", "m3/m", 1, {&Particles::volume}},
    ParticleField{"noted_flow", "1", 1, {&Particles::noted_flow}},
};

/// Calls f(values) for every array of doubles that a particle has.
template <class Function>
void for_each_array(Particles& particles, const Function& f)
{
  for (const ParticleField& field : particle_fields)
    for (int c = 0; c < field.components; ++c) f(particles.*field.data[c]);
}

inline void Particles::resize(int count)
{
  for_each_array(*this, [count](std::vector<double>& values) { values.resize(count, 0.0); });
  id.resize(count, 0);
}

inline void Particles::index_ids(std::size_t ids)
{
  index_of.assign(ids, -1);
  for (int k = 0; k < size(); ++k) index_of[id[k]] = k;
}
} // namespace mpm

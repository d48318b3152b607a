#pragma once
// Ground that flows, and what follows its flow every now and then: the softening of a band by its slip, and
// the filter of stresses that the grid cannot carry.

#include "solver/mpm/domain.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace mpm
{
/// One number of each particle.
using Values = std::vector<double>;

/// Plastic strain since the last time. Blocks in which it is `slow` at some particle, and those beside them,
/// act on their stresses; what is beside these lends its values (near).
class Flow
{
public:
  static constexpr double least = 0.003; ///< somewhere, for all of it to be looked at
  static constexpr double slow = 1e-4;

  explicit Flow(const Domain& domain);
  bool any() const { return any_; }
  double operator[](int particle) const { return flow_[particle]; }

  /// Adds up over the particles near by, colour by colour: f(occupied block).
  template <class Function>
  void add(const Function& f) const
  {
    parallel::for_each_in_turn(domain_.blocks.colours,
                               [&](int b) { near_[b] ? f(domain_.blocks.occupied[b]) : void(); });
  }
  template <class Function>
  void for_each_near(const Function& f) const
  {
    parallel::for_each(domain_.blocks.awake,
                       [&](int b) { near_[b] ? f(domain_.blocks.occupied[b]) : void(); });
  }
  template <class Function>
  void for_each_acting(const Function& f) const
  {
    parallel::for_each(domain_.blocks.awake,
                       [&](int b) { act_[b] ? f(domain_.blocks.occupied[b]) : void(); });
  }

private:
  /// The blocks in `some` and those around.
  std::vector<char> beside(const std::vector<char>& some) const;

  const Domain& domain_;
  bool any_ = false;
  Values flow_;                  ///< plastic strain since the last time
  std::vector<char> act_, near_; ///< by occupied block
};

/// The particles of one material and of mixtures at interfaces that have its law (Material::law_of), as one
/// ground.
class Ground
{
public:
  Ground(const Domain& domain, int material) : domain_(domain), is_(domain.materials.size())
  {
    for (std::size_t m = 0; m < is_.size(); ++m)
    {
      const int of = domain.materials[m].law_of;
      is_[m] = (of < 0 ? static_cast<int>(m) : of) == material;
    }
  }
  bool holds(int material) const { return is_[material]; }
  /// Calls f(particle), or f(particle, material), for those of a block that are not torn apart.
  template <class Function>
  void for_each(const OccupiedBlock& occupied, const Function& f) const
  {
    for (const ParticleRange& range : occupied.ranges)
    {
      if (!is_[range.material]) continue;
      const std::vector<double>* opening = domain_.materials[range.material].field("opening");
      const int first = domain_.material_begin[range.material];
      for (int p = range.begin; p < range.end; ++p)
      {
        if (opening != nullptr && (*opening)[p - first] > 0) continue;
        if constexpr (std::is_invocable_v<Function, int, int>)
          f(p, range.material);
        else
          f(p);
      }
    }
  }

private:
  const Domain& domain_;
  std::vector<char> is_;
};

/// Every 20th step, when ground has flowed somewhere since the last time: average_flow and filter_stresses,
/// as the settings ask for. All flow is then taken for looked at, so that none counts twice.
void follow_flow(Domain& domain, double dt);

/// Spreads the plastic strain since the last time over the width l of a band (Elastic::averaging_length of
/// the law): each particle gets the mean over the disc of diameter l around its cell, of the particles of its
/// own ground. A band then softens by its slip, slip / (sqrt(3) l), wherever and in however few cells it
/// runs: what it dissipates is within 7 % of what the displacement of softening means, 14 % along a row of
/// nodes (cases/verification/shear_band; nonlocal softening: Bazant & Jirasek, J. Eng. Mech. 128 (2002)
/// 1119). What has been dissipated stays.
void average_flow(Domain& domain, const Flow& flow);

/// Takes (1 - exp(-e/strain)) (1 - A)^2 sigma from the particles' stresses, e being the plastic strain since
/// the last time averaged over the nodes; A fits an affine field to the stresses of one ground around each
/// node and reads these fits at the particles. Ground beside what flows takes part, since it is strained by
/// the same nodes; what flows nowhere near stays as it is, to the last bit. Volumes go with the mean stress
/// as they do in elastic ground, dV / V = d sigma_m / K: with the pressure alone taken away nothing would
/// hold them, and in a slide they would drift apart by fifths, some to nothing. Ground that is torn apart
/// takes no part, and none is put under tension by it. The elastic energy that it takes is booked as the
/// transfers'.
void filter_stresses(Domain& domain, const Flow& flow);

/// Begins a stage: what has flowed until now is not looked at any more.
void note_flow(Domain& domain);
} // namespace mpm

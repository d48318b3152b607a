#pragma once

#include "materials/elastic.hpp"
#include "materials/mohr_coulomb.hpp"
#include "materials/slip_weakening.hpp"
#include "materials/von_mises.hpp"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mpm
{
/// Every constitutive law there is. A new one is a struct with the members of Elastic, in a header of its
/// own, and its name here; case reader, checkpoints and frames go by its tables of parameters and state.
using Law = std::variant<Elastic, VonMises, MohrCoulomb, SlipWeakening>;

/// No law remembers more history variables than this.
inline constexpr int most_state_fields = 8;

/// A named material of a case: its law, and the law's history variables over the material's particles
/// (state[field][k], k counted from the material's first particle).
struct Material
{
  std::string name;
  Law law;
  std::vector<std::vector<double>> state;
  /// Inertial over gravitational mass: 1, but where a static stage scales masses to settle in fewer steps.
  double mass_scale = 1;
  int origin = -1; ///< of a mixture at an interface: index of the material that it belongs to; -1: it is none
  int law_of = -1; ///< of a mixture: index of the material whose law it has, its own or what it borders on

  const Elastic& elastic() const
  {
    return std::visit([](const auto& l) -> const Elastic& { return l; }, law);
  }
  std::string_view model() const
  {
    return std::visit([](const auto& l) { return l.model; }, law);
  }
  std::span<const StateField> state_fields() const
  {
    return std::visit(
        [](const auto& l) -> std::span<const StateField>
        {
          static constexpr auto fields = std::decay_t<decltype(l)>::state_fields();
          return {fields.data(), fields.size()};
        },
        law);
  }
  /// A history variable over the material's particles; null where the law has none of that name.
  const std::vector<double>* field(std::string_view name) const
  {
    const auto fields = state_fields();
    for (std::size_t f = 0; f < state.size(); ++f)
      if (fields[f].name == name) return &state[f];
    return nullptr;
  }
  std::vector<double>* field(std::string_view name)
  {
    return const_cast<std::vector<double>*>(std::as_const(*this).field(name));
  }
  /// Width in m over which a band softens by its slip, see average_flow; 0: it does not.
  double averaging_length() const
  {
    return std::visit([](const auto& l) { return l.averaging_length(); }, law);
  }
  /// Energy in J per m3 of undeformed volume that plastic flow has dissipated at the material's k-th
  /// particle.
  double dissipated(int k) const
  {
    std::array<const double*, most_state_fields> fields{};
    for (std::size_t f = 0; f < state.size(); ++f) fields[f] = state[f].data();
    return std::visit([&](const auto& l) { return l.dissipated(fields.data(), k); }, law);
  }
};
} // namespace mpm

#pragma once
// What the datasets of history.h5 and of frames are called in full, which readers of netCDF-4 put on axes.

#include <array>
#include <string_view>
#include <utility>

namespace mpm
{
inline constexpr auto long_names = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"time", "time since the start of the stage"},
    {"displacement", "displacement since the start of the shaking"},
    {"velocity", "velocity"},
    {"acceleration", "acceleration, mean since the last sample"},
    {"gauge_x", "x of the gauge at the start of the shaking"},
    {"gauge_y", "height of the gauge at the start of the shaking"},
    {"surface_displacement", "displacement of the free field's surface"},
    {"surface_velocity", "velocity of the free field's surface"},
    {"base_displacement", "displacement of the free field's base"},
    {"base_velocity", "velocity of the free field's base"},
    {"height", "height"},
    {"middle_height", "height between two rows"},
    {"greatest_acceleration", "greatest horizontal acceleration"},
    {"greatest_shear_strain", "greatest shear strain"},
    {"greatest_shear_stress", "greatest shear stress"},
    {"upgoing_velocity", "velocity of the upgoing wave at the base"},
    {"upgoing_acceleration", "acceleration of the upgoing wave at the base"},
    {"moved_area", "area of the ground that has moved"},
    {"moved_mass", "mass of the ground that has moved"},
    {"centre_of_mass_displacement", "displacement of the moved ground's centre of mass"},
    {"centre_of_mass_velocity", "velocity of the moved ground's centre of mass"},
    {"toe", "x of the slide's toe"},
    {"toe_advance", "advance of the slide's toe"},
    {"peak_velocity", "99th percentile of the moved particles' speed"},
    {"point_velocity", "greatest speed of a moved particle"},
    {"point", "place of the fastest moved particle"},
    {"left_area", "area of the ground that has left the model"},
    {"left_mass", "mass of the ground that has left the model"},
    {"x", "x"},
    {"start", "height of the free surface at the start"},
    {"end", "height of the free surface at the end"},
    {"corner_displacement", "displacement of the base's ends relative to the free field"},
    {"greatest_displacement", "greatest displacement of the base relative to the free field"},
    {"rotation", "rotation of the base"},
    {"kinetic", "kinetic energy"},
    {"elastic", "elastic energy"},
    {"gravitational", "potential energy"},
    {"plastic", "energy dissipated by plastic flow"},
    {"damping", "energy taken by local damping"},
    {"transfer", "energy dissipated by the transfers between particles and grid"},
    {"radiated_base", "energy radiated through the base"},
    {"radiated_sides", "energy radiated through the sides"},
    {"departed", "energy of ground that has left the model"},
    {"incoming", "energy of the upgoing wave"},
    {"static_reaction", "work of the static reaction"},
    {"free_field", "work of the free field at the sides"},
    {"residual", "residual of the energy balance"},
    {"position", "position"},
    {"Points", "position"},
    {"reference", "position at the start of the stage"},
    {"id", "id of the particle"},
    {"material", "index of the material"},
    {"mass", "mass"},
    {"volume", "volume as deformed"},
    {"stress", "stress, tension positive"},
    {"p", "mean pressure -(xx + yy + zz) / 3, compression positive"},
    {"q", "Mises stress sqrt(3 J2)"},
    {"plastic_strain", "accumulated plastic strain"},
    {"dissipation", "energy dissipated by plastic flow"},
    {"opening", "volume strain of opening"},
    {"affine", "affine velocity matrix"},
    {"stress_xx", "stress xx, tension positive"},
    {"stress_yy", "stress yy, tension positive"},
    {"stress_zz", "stress zz, tension positive"},
    {"stress_xy", "stress xy"},
    {"opening_xx", "strain xx of the cracks"},
    {"opening_yy", "strain yy of the cracks"},
    {"opening_xy", "strain xy of the cracks"},
    {"noted_flow", "plastic strain when the flow was looked at last"},
});

/// Of a dataset by the last part of its path; empty: none.
constexpr std::string_view long_name_of(std::string_view path)
{
  const std::string_view name = path.substr(path.rfind('/') + 1);
  for (const auto& [known, words] : long_names)
    if (known == name) return words;
  return {};
}
} // namespace mpm

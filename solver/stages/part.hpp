#pragma once

#include "solver/mpm/boundary.hpp"

#include <array>
#include <string>
#include <string_view>

namespace mpm
{
/// The parts of a model, each a domain of its own.
enum class Part
{
  ground,       ///< what the case draws, between the two sides
  left_column,  ///< the free field beyond the left side
  right_column, ///< the free field beyond the right side
};

/// The edges that may have a free-field column.
inline constexpr std::array both_sides{Edge::left, Edge::right};

constexpr bool is_column(Part part)
{
  return part != Part::ground;
}

/// "left", "right": a column's group in HDF5 files, and the name of its side in messages.
constexpr std::string_view side_name(Part column)
{
  return column == Part::left_column ? "left" : "right";
}
constexpr std::string_view side_name(Edge side)
{
  return side == Edge::left ? "left" : "right";
}

/// Group of a part below `parent` in HDF5 files: the ground's is `parent` itself, "energy", a column's one
/// further down, "energy/left".
inline std::string group_in(std::string_view parent, Part part)
{
  std::string group(parent);
  return is_column(part) ? group.append("/").append(side_name(part)) : group;
}
} // namespace mpm

#include "solver/stages/slide_report.hpp"

#include "solver/stages/slide.hpp"

#include <cmath>

namespace mpm
{
namespace
{
std::string no_slide(const nlohmann::json& greatest, double moved)
{
  const double area = greatest["value"];
  if (!(area > 0)) return fmt::format("no slide: no ground has moved more than {} m", moved);
  return fmt::format("no slide: no ground is more than {} m from where it was ({:.1f} m2 were at t = {:.2f} "
                     "s, and came back)",
                     moved, area, greatest["time"].get<double>());
}
} // namespace

std::string slide_text(const nlohmann::json& slide, double moved)
{
  const double area = slide["moved_area"];
  if (!(area > 0)) return no_slide(slide["greatest_moved_area"], moved);
  const auto [right, up] = slide["centre_of_mass_displacement"].get<std::array<double, 2>>();
  std::string text = fmt::format("slide: {:.1f} m2 have moved more than {} m, their centre of mass {:.2f} m "
                                 "({:.2f} m to the {} and {:.2f} "
                                 "m {}); toe at x = {:.1f} m, advanced by {:.2f} m",
                                 area, moved, std::hypot(right, up), std::fabs(right),
                                 right < 0 ? "left" : "right", std::fabs(up), up < 0 ? "down" : "up",
                                 slide["toe"].get<double>(), slide["toe_advance"].get<double>());
  if (const auto& trigger = slide["trigger_time"]; trigger.is_number())
    text += fmt::format("; triggered at t = {:.2f} s", trigger.get<double>());
  return text;
}
} // namespace mpm

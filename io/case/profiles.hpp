#pragma once
// The profiles that every case understands without defining them: quick, standard, fine and paper.

#include "io/case/case.hpp"

#include <array>
#include <string_view>

namespace mpm
{
/// How finely a profile resolves a case, as cells across a length.
struct StandardProfile
{
  std::string_view name;
  double cells_per_wave;  ///< of S waves of `grid.frequency` in the softest ground
  double cells_per_layer; ///< across the thinnest layer that can yield
  double cells_per_slide; ///< across what can slide, see Scales::slide
  bool papers_method;
  std::string_view meaning;
};

/// From the coarsest to the finest. Where the numbers are from: README.md.
inline constexpr std::array standard_profiles{
    StandardProfile{"quick", 6, 3, 8, false, "to try a motion"},
    StandardProfile{"standard", 10, 4, 16, false, "the usual one"},
    StandardProfile{"fine", 16, 6, 24, false, "to see whether the answer stays"},
    StandardProfile{"paper", 36, 4, 40, true, "the paper's cells and method"},
};

/// The lengths of a case that cells have to be small beside. They do not depend on the cells.
struct Scales
{
  /// A length, what it is of, and whether there is one.
  struct Length
  {
    double value = std::numeric_limits<double>::infinity(); ///< m
    std::string of;

    bool known() const { return std::isfinite(value); }
  };
  double softest = std::numeric_limits<double>::infinity(); ///< least shear-wave speed of any ground, m/s
  std::string softest_name;
  Length layer; ///< least mean thickness of a material that can yield
  /// The thickest stretch of ground that can yield, no more than the ground rises and no less than half of
  /// itself; none where the ground is level or nothing yields.
  Length slide;
  Length band;         ///< least width of a softening band that the case gives in m
  bool level = true;   ///< whether all surfaces are, but for a tenth of what can yield or of the ground
  double yielding = 0; ///< share of the ground's area that can yield
};

/// Looks at no more than a thousand strips of the ground.
Scales scales_of(const Case& case_file);

/// Greatest cell size of at most `target` m of which a whole number lies in `width` m; if it can be had for a
/// tenth less, a number with few digits.
double fitting_spacing(double width, double target);

/// What a profile sets in a case, as key paths with their values, and why.
struct ProfileChoice
{
  std::vector<std::pair<std::string, std::string>> values;
  std::vector<std::string> reasons; ///< a line each
};

/// What a standard profile sets in this case; depends on the case's ground, its `grid.frequency` and whether
/// it is shaken, so that both stages come to the same.
ProfileChoice choose(const StandardProfile& profile, const Case& case_file);

/// The profile of that name; null: there is none.
const StandardProfile* standard_profile(std::string_view name);
} // namespace mpm

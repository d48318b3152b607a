#pragma once

#include "boundaries/free_field.hpp"
#include "io/results/hdf5.hpp"

namespace mpm
{
/// The greatest values that a free-field column has had so far at each depth: the profiles of a site response
/// analysis. Rows of particles from the bottom up; strains and stresses are those between two rows. The
/// stress is what accelerates the rows above, since that of particles near the base and the surface is rough.
class ColumnEnvelope
{
public:
  /// The column is as wide as a particle, `width` (m).
  ColumnEnvelope(const FreeFieldColumn& column, double width) : column_(&column), width_(width) {}
  /// Looks at the state of `time` (s). Accelerations and stresses are means since the last look.
  void sample(double time);
  /// Adds heights and greatest values to `group`, a side's of history.h5.
  void write(h5::Group& group) const;

  void save(h5::Group& group) const;
  /// What was saved after a last look at `time` (s). `Error` bad_input when no run of this column left it.
  void load(const h5::Group& group, double time);

private:
  std::vector<double> heights() const; ///< of the rows, undeformed, m
  const FreeFieldColumn* column_;
  double width_;
  double time_ = 0;                  ///< of the last look, s
  std::vector<double> velocity_;     ///< of the rows at the last look, m/s
  std::vector<double> acceleration_; ///< greatest |a_x|, m/s2
  std::vector<double> strain_;       ///< greatest |du_x/dy|, one entry fewer
  std::vector<double> stress_;       ///< greatest shear stress, Pa, one entry fewer
};
} // namespace mpm

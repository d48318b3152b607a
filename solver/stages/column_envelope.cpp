#include "solver/stages/column_envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
struct Quantity
{
  const char *name, *unit;
};
constexpr Quantity acceleration{"greatest_acceleration", "m/s2"}, strain{"greatest_shear_strain", "1"},
    stress{"greatest_shear_stress", "Pa"};

void raise(double& greatest, double value)
{
  greatest = std::max(greatest, std::fabs(value));
}
} // namespace

std::vector<double> ColumnEnvelope::heights() const
{
  const Particles& p = column_->domain->particles;
  std::vector<double> y;
  for (int row = 0; row < column_->rows(); ++row) y.push_back(p.reference_y[column_->particle_of_row(row)]);
  return y;
}

void ColumnEnvelope::sample(double time)
{
  const Particles& p = column_->domain->particles;
  const int rows = column_->rows();
  const double interval = velocity_.empty() ? 0 : time - time_;
  velocity_.resize(rows, 0);
  acceleration_.resize(rows, 0);
  strain_.resize(rows - 1, 0);
  stress_.resize(rows - 1, 0);
  double force = 0; // on what lies above, N/m
  for (int row = rows - 1; row >= 0; --row)
  {
    const int k = column_->particle_of_row(row);
    const double acceleration = interval > 0 ? (p.velocity_x[k] - velocity_[row]) / interval : 0;
    velocity_[row] = p.velocity_x[k];
    raise(acceleration_[row], acceleration);
    force += p.mass[k] * acceleration;
    if (row == 0) break;
    const int below = column_->particle_of_row(row - 1);
    const double slid = p.x[k] - p.reference_x[k] - (p.x[below] - p.reference_x[below]);
    raise(strain_[row - 1], slid / (p.reference_y[k] - p.reference_y[below]));
    raise(stress_[row - 1], force / width_);
  }
  time_ = time;
}

// Heights are the axes: of the rows, and of the middles between them.
void ColumnEnvelope::write(h5::Group& group) const
{
  const std::vector<double> y = heights();
  std::vector<double> middle;
  for (std::size_t row = 0; row + 1 < y.size(); ++row) middle.push_back(0.5 * (y[row] + y[row + 1]));
  group.write("height", y, {}, "m");
  group.write("middle_height", middle, {}, "m");
  for (const auto& [values, quantity, axis] :
       {std::tuple{&acceleration_, acceleration, "height"}, std::tuple{&strain_, strain, "middle_height"},
        std::tuple{&stress_, stress, "middle_height"}})
  {
    group.write(quantity.name, *values, {}, quantity.unit);
    group.attach_scale(quantity.name, axis, 0);
  }
}

void ColumnEnvelope::save(h5::Group& group) const
{
  group.write("row_velocity", velocity_, {}, "m/s");
  group.write(acceleration.name, acceleration_, {}, acceleration.unit);
  group.write(strain.name, strain_, {}, strain.unit);
  group.write(stress.name, stress_, {}, stress.unit);
}

void ColumnEnvelope::load(const h5::Group& group, double time)
{
  const std::size_t rows = column_->rows();
  const auto read = [&](const std::string& name, std::size_t size, bool signless)
  {
    std::vector<double> values = group.read_doubles(name);
    const bool sound =
        std::all_of(values.begin(), values.end(),
                    [=](double value) { return std::isfinite(value) && (!signless || value >= 0); });
    if (values.size() != size || !sound)
      throw Error(exit_code::bad_input,
                  fmt::format("{}: no run of this column leaves that; use another file", group.where(name)));
    return values;
  };
  velocity_ = read("row_velocity", rows, false);
  acceleration_ = read(acceleration.name, rows, true);
  strain_ = read(strain.name, rows - 1, true);
  stress_ = read(stress.name, rows - 1, true);
  time_ = time;
}
} // namespace mpm

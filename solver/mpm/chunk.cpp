#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
/// Cell and fraction of it in which each of `count` positions stands.
void locate(const double* __restrict position, double from, double inverse, int count,
            double* __restrict cell, double* __restrict fraction)
{
  for (int k = 0; k < count; ++k)
  {
    const double local = (position[k] - from) * inverse;
    cell[k] = std::floor(local);
    fraction[k] = local - cell[k];
  }
}
} // namespace

void ChunkStencils::find(const TileStencils& tile, const double* __restrict x, const double* __restrict y,
                         int count)
{
  const double h = tile.spacing(), inverse = 1 / h;
  alignas(64) double column[chunk_size], row[chunk_size], fx[chunk_size], fy[chunk_size];
  locate(x, tile.from_x(), inverse, count, column, fx);
  locate(y, tile.from_y(), inverse, count, row, fy);
  for (int k = 0; k < count; ++k)
    node[k] = TileStencils::place(static_cast<int>(column[k]) - 1, static_cast<int>(row[k]) - 1);
  for (int k = 0; k < count; ++k)
  {
    const CubicWeights w = cubic_weights(fx[k]);
    for (int i = 0; i < 4; ++i)
    {
      x_weight[k][i] = w.weight[i];
      x_slope[k][i] = inverse * w.slope[i];
      x_moment[k][i] = w.weight[i] * (h * (i - 1 - fx[k]));
    }
  }
  for (int k = 0; k < count; ++k)
  {
    const CubicWeights w = cubic_weights(fy[k]);
    for (int j = 0; j < 4; ++j)
    {
      y_weight[j][k] = w.weight[j];
      y_slope[j][k] = inverse * w.slope[j];
      y_moment[j][k] = w.weight[j] * (h * (j - 1 - fy[k]));
    }
  }
}
} // namespace mpm

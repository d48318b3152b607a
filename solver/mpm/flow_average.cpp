#include "solver/mpm/chunk.hpp"
#include "solver/mpm/flow.hpp"

namespace mpm
{
namespace
{
constexpr double most_cells = 7; ///< radius of a disc: what a block beside reaches

/// Cells around one, and how much of each is in the disc.
struct Cell
{
  int x, y;
  double share;
};

std::vector<Cell> disc(double radius)
{
  std::vector<Cell> cells;
  const int reach = static_cast<int>(std::ceil(radius + 0.5));
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      if (const double share = std::clamp(radius + 0.5 - std::hypot(x, y), 0.0, 1.0); share > 0)
        cells.push_back({x, y, share});
  return cells;
}

/// Sums over one ground's particles in each cell, held at the cell's lower left node.
struct CellSums
{
  NodeField volume, flow; ///< V and V e
};

CellSums sum_cells(const Domain& domain, const Flow& flow, const Ground& ground)
{
  const Grid& grid = domain.grid;
  const Particles& p = domain.particles;
  CellSums sums{NodeField(grid.nodes(), 0.0), NodeField(grid.nodes(), 0.0)};
  parallel::for_each_in_turn(domain.blocks.colours,
                             [&](int block)
                             {
                               const OccupiedBlock& occupied = domain.blocks.occupied[block];
                               PairTile tile;
                               tile.value.fill(0);
                               const TileStencils at(grid, occupied.block);
                               ground.for_each(occupied,
                                               [&](int k)
                                               {
                                                 const int cell = tile_index(at.x(p.x[k]).first + 1,
                                                                             at.y(p.y[k]).first + 1);
                                                 tile.value[2 * cell] += p.volume[k];
                                                 tile.value[2 * cell + 1] += p.volume[k] * flow[k];
                                               });
                               add_tile(grid, occupied.around, tile, sums.volume, sums.flow);
                             });
  return sums;
}
} // namespace

void average_flow(Domain& domain, const Flow& flow)
{
  const Grid& grid = domain.grid;
  const Particles& p = domain.particles;
  const double before = dissipated_energy(domain);
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const double length = domain.materials[m].averaging_length();
    if (domain.materials[m].origin >= 0 || length <= 0) continue;
    const Ground ground(domain, static_cast<int>(m));
    const CellSums sums = sum_cells(domain, flow, ground);
    const std::vector<Cell> cells = disc(std::min(0.5 * length * grid.inverse_spacing(), most_cells));
    parallel::for_each(
        domain.blocks.awake,
        [&](int block)
        {
          const OccupiedBlock& occupied = domain.blocks.occupied[block];
          NodeFinder find(grid);
          // Particles may have drifted out of their block by a cell; a place that is no number, or out of
          // reach, must not lead further, and the end of the step finds it.
          const auto cell_of = [&](int k)
          {
            const auto cell = [&](double from_origin, int of_block)
            {
              const double first = block_cells * of_block;
              return static_cast<int>(
                  std::min(first + block_cells,
                           std::max(first - drift_cells, std::floor(from_origin * grid.inverse_spacing()))));
            };
            return std::pair{cell(p.x[k] - grid.origin_x, occupied.block.x),
                             cell(p.y[k] - grid.origin_y, occupied.block.y)};
          };
          const auto tile_of = [&](int k)
          {
            const auto [i, j] = cell_of(k);
            return tile_index(i - block_cells * occupied.block.x, j - block_cells * occupied.block.y);
          };
          // Of the block's cell by cell.
          Tile mean;
          mean.value.fill(-1);
          ground.for_each(occupied,
                          [&](int k)
                          {
                            double& of = mean.value[tile_of(k)];
                            if (of >= 0) return;
                            const auto [i, j] = cell_of(k);
                            double volume = 0, sum = 0;
                            find.move_to(i, j);
                            for (const Cell& cell : cells)
                            {
                              const int node = find(grid.wrapped ? 0 : i + cell.x, j + cell.y);
                              if (node < 0) continue;
                              volume += cell.share * sums.volume[node];
                              sum += cell.share * sums.flow[node];
                            }
                            of = sum / volume;
                          });
          for (const ParticleRange& range : occupied.ranges)
          {
            if (!ground.holds(range.material)) continue;
            std::vector<double>& strain = *domain.materials[range.material].field("plastic_strain");
            const int first = domain.material_begin[range.material];
            for (int k = range.begin; k < range.end; ++k)
            {
              const double of = mean.value[tile_of(k)];
              if (of >= 0) strain[k - first] = p.noted_flow[k] + of;
            }
          }
        });
  }
  domain.energy.plastic += dissipated_energy(domain) - before; // laws without a ledger take it for flow
}
} // namespace mpm

#pragma once

#include "solver/stages/fill.hpp"

namespace mpm
{
/// Gives particles near an interface elastic moduli averaged over their surroundings, in compliance (1/G and
/// 1/M, as of layers under one traction; Backus, JGR 67 (1962)): smooth splines cannot follow the jump of
/// strain at a jump of stiffness, and answer too stiffly there, an error of order 1 in the cell size. The
/// weight is a hat of half a cell to each side in both directions, over the ground that there is. Density,
/// strength and history stay the material's own. `materials` grows by one for each mixture, in steps of a
/// sixteenth; its Material::origin tells whose it is. A law that would not admit the mixture's moduli keeps
/// its own.
void average_interfaces(const Case& case_file, std::vector<Seed>& seeds, std::vector<Material>& materials);
} // namespace mpm

#pragma once

#include "solver/mpm/domain.hpp"
#include "solver/stages/fill.hpp"

namespace mpm
{
/// Gives particles near an interface elastic moduli averaged over their surroundings, in compliance (1/G and
/// 1/M, as of layers under one traction; Backus, JGR 67 (1962)): smooth splines cannot follow the jump of
/// strain at a jump of stiffness, and answer too stiffly there, an error of order 1 in the cell size. The
/// weight is a hat of 3/4 of a cell to each side in both directions, over the ground that there is. Density
/// stays the material's own, and so does the law, but where ground that cannot yield borders on ground that
/// can: as of layers under one traction the mixture is as strong as the weaker, and has its law. Without this
/// the rock's nodes hold the lowest cell of a slide on it, which has to flow within its own cells then.
/// `materials` grows by one for each mixture, in steps of 1/32; its Material::origin tells whose it is,
/// and Material::law_of whose law it has. A law that would not admit the mixture's moduli is left for its
/// own.
void average_interfaces(const Case& case_file, std::vector<Seed>& seeds, std::vector<Material>& materials);

/// The kink of the ground's motion at a point (m) of the undeformed ground, which averaged interfaces and the
/// splines smooth. Along a line, the ground under one traction stands at its integral of 1/G (or 1/M), and
/// the field at the mean of that over a hat Y; they differ by traction times
///
///   d = E_Y int_0^1 1/G(x + s Y) Y ds,
///
/// which points across the interface. The hat reaches 0.85 cells to each side, a tenth more than that of
/// average_interfaces, for what the splines smooth themselves (chosen after measuring columns with interfaces
/// anywhere in a cell). No kink where one material alone is within reach, and with sharp interfaces.
Kink kink_at(const Case& case_file, double x, double y);
} // namespace mpm

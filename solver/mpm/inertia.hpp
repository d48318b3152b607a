#pragma once

namespace mpm
{
struct Grid;

/// Gives back most of what the lumped mass takes from the inertia of the splines. Lumping leaves out
/// h^2/3 div(rho grad a), so that waves are slow by (kh)^2/6; with the accelerations a of the lumped equation
/// of motion,
///
///   m_i a_i' = m_i a_i + 1/3 sum_j m_ij (a_i - a_j),   m_ij = min(m_i, m_j) x (0 .. 1)
///
/// over the four direct neighbours j is second-order consistent with the splines' own mass matrix: one term
/// of the series of its inverse (of which Hammerquist & Nairn, Comput. Methods Appl. Mech. Eng. 318 (2017)
/// 724, keep more, with sums over the particles). Pairs exchange momentum, so that it is kept; a common
/// acceleration is not touched.
///
/// The last factor of m_ij fades from 1 to 0 where the masses along a line of three nodes differ by a factor
/// of 1.33 to 2.5, so that nothing changes at free surfaces and loose particles, which limit the step; in
/// bulk the stable Courant number falls from 1.77 to 1.19, still above stable_courant_number. Nodes that
/// follow a dashpot rather than their own mass (dt c / m > 4) take no part.
///
/// To be called after the equation of motion, which leaves the accelerations in Grid::change_x and change_y
/// and m_i, or 0 for nodes that take no part, in Grid::linked_mass; boundaries mirror the corrected
/// velocities afterwards.
void correct_inertia(Grid& grid);
} // namespace mpm

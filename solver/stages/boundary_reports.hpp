#pragma once
// What the engineer must know of the boundaries, before the shaking and after it.

#include "solver/stages/model.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// Tells where the model's side and its column do not agree before the shaking.
void warn_of_unlike_columns(Session& session, const Model& model);

/// How far the sides stand from their columns now; warns where that is too far, which is also what makes runs
/// diverge.
void report_sides(Session& session, const Model& model);

/// Where base and sides stand at the end, against free field and columns, and which columns yield; warns
/// where that is too far.
void report_boundaries(Session& session, const Model& model);
} // namespace mpm

#pragma once

#include "io/run_folder/log.hpp"

#include <nlohmann/json.hpp>

namespace mpm
{
/// What a slide has come to, in one line: how much ground, how far, when. Takes `Slide::summary()` and the
/// distance beyond which ground counts as slid (m).
std::string slide_text(const nlohmann::json& slide, double moved);
} // namespace mpm

#pragma once
// Whether a motion can be what its user means.

#include "boundaries/ground_motion/ground_motion.hpp"

namespace mpm
{
/// A number for messages, four digits.
std::string number(double value);

/// Throws std::runtime_error where a measure is beyond the numbers of the machine, with what may be the
/// cause.
void refuse_overflow(const Record& record, const MotionProcessing& processing,
                     const MotionMeasures& measures);

/// What a user should look at, by name and with its value: step, length and measures out of the range of
/// ground motions, all as scaled; a unit that the scale hides; a correction that changed more than it should;
/// a base that does not come to rest, or ends elsewhere.
std::vector<std::string> motion_warnings(const Record& record, const MotionProcessing& processing,
                                         const MotionReport& report);
} // namespace mpm

#pragma once

#include "boundaries/ground_motion/incoming_wave.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// The wave that enters at the base, and what tells it from another one.
struct Motion
{
  std::shared_ptr<IncomingWave> wave;
  RunFolder::Identity identity; ///< digests of the records in SI units, and what is made of them
  std::string title;            ///< for pictures
  nlohmann::json facts;         ///< of each component: record and correction

  /// Facts, and measures of what a run that ends at `until` s applied, for summary.json.
  nlohmann::json summary(double until) const;
};

/// Reads and processes the records that the case or the command line names, logs their measures as the run
/// is going to apply them, and warns of what it leaves out. Finds out the length of a run that goes on for
/// some time after its record. A fixed base takes no motion.
Motion load_motion(Session& session);

/// Logs the measures of what was applied until `until` s, the end of the motion included.
void report_what_was_applied(Session& session, const Motion& motion, double until);

/// The fade that the case itself asks for.
Fade planned_fade(const MotionSettings& settings);

/// Measures of a motion as applied until `until` s; of the kind of its record, as those of MotionReport.
MotionMeasures measures_applied(const GroundMotion& motion, const Fade& fade, double until);

/// Writes `/motion` of the history: what the wave brings from 0 to `until` s, evenly sampled so finely that
/// no sample of a record is left out; `step` s without a record.
void write_motion(h5::File& file, const IncomingWave& wave, double step, double until);
} // namespace mpm

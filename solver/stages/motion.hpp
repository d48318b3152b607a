#pragma once

#include "solver/stages/session.hpp"

namespace mpm
{
/// The wave that enters at the base, and what tells it from another one.
struct Motion
{
  std::shared_ptr<IncomingWave> wave;
  RunFolder::Identity identity; ///< digests of the records
  std::string title;            ///< for pictures
};

/// Reads and processes the records that the case or the command line names, and logs their measures.
Motion load_motion(Session& session);
} // namespace mpm

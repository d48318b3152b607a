#pragma once
// The output folder of a run: one run at a time, and one case, motion and setting for good.

#include "io/digest.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mpm
{
/// "checkpoint-000062500.h5"
std::string checkpoint_name(std::int64_t step);

/// Holds the folder until it is destroyed; a crash frees it too.
class RunFolder
{
public:
  /// What makes a run this run and no other, in the order in which differences are told: flattened keys of
  /// the case, digests of motion and static state.
  using Identity = std::vector<std::pair<std::string, std::string>>;

  /// Creates the folder, or goes on in it. `Error` folder_taken when another live run holds it or it has
  /// results of another identity. `fresh` removes this program's results first, and nothing else.
  RunFolder(std::filesystem::path, const Identity&, bool fresh = false);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// False on a file system without locks: then nothing keeps a second run out.
  bool locked() const { return locked_; }
  /// True when the folder already belonged to this run.
  bool resumed() const { return resumed_; }

  /// Paths of the checkpoints, newest first by their step.
  std::vector<std::filesystem::path> checkpoints() const;
  /// Removes all but the newest `keep` checkpoints.
  void prune(std::size_t keep) const;

private:
  void lock();
  void check_identity(const Identity&);

  std::filesystem::path path_;
  int lock_ = -1;
  bool locked_ = false;
  bool resumed_ = false;
};
} // namespace mpm

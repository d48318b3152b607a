#pragma once
// The output folder of a run: one run at a time, and one case, motion and setting for good.

#include "io/common/digest.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mpm
{
/// The case of a run with every default written out, for people; a file of its folder.
inline constexpr const char* resolved_name = "case-resolved.yaml";

/// The last state of a finished stage.
inline constexpr const char* final_name = "final.h5";

/// "checkpoint-000062500.h5"
std::string checkpoint_name(std::int64_t step);

/// The first difference of two lists of settings, in words; empty: there is none.
std::string difference(const std::vector<std::string>& theirs, const std::vector<std::string>& ours);

/// Holds the folder until it is destroyed; a crash frees it too.
class RunFolder
{
public:
  /// What makes a run this run and no other, in the order in which differences are told: flattened keys of
  /// the case, digests of motion and static state.
  using Identity = std::vector<std::pair<std::string, std::string>>;

  /// Creates the folder, or goes on in it. `Error` folder_taken when another live run holds it or it has
  /// results of another identity. `fresh` removes this program's results first, and nothing else; should that
  /// be cut short, what is left is no finished run.
  RunFolder(std::filesystem::path, const Identity&, bool fresh = false);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// False on a file system without locks: then nothing keeps a second run out.
  bool locked() const { return locked_; }

  /// The identity as sorted lines `key = value`.
  std::vector<std::string> identity_lines() const;

  /// Paths of the states to go on from, best first: the final one, if there is one, then the checkpoints.
  std::vector<std::filesystem::path> states() const;
  /// Gives a state that cannot be gone on from a name that is none: what is pruned are not the good ones.
  void set_aside(const std::filesystem::path& state) const;
  /// Paths of the checkpoints, newest first by their step.
  std::vector<std::filesystem::path> checkpoints() const;
  /// Removes all but the newest `keep` checkpoints.
  void prune(std::size_t keep) const;

private:
  void lock();                 ///< `Error` folder_taken while a live run holds the folder
  void check_identity();       ///< compares with identity.json, or writes it
  void remove_results() const; ///< of --fresh

  std::filesystem::path path_;
  Identity identity_;
  int lock_ = -1; ///< descriptor of .lock, which stays open as long as the folder is held
  bool locked_ = false;
};
} // namespace mpm

#include "io/run_folder/run_folder.hpp"

#include "io/common/input_file.hpp"
#include "io/results/files.hpp"
#include "io/run_folder/finish_mark.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <optional>
#include <sys/file.h>
#include <unistd.h>

namespace mpm
{
namespace fs = std::filesystem;
namespace
{
/// PREFIX, digits, SUFFIX: the number; nothing for another name.
std::optional<std::int64_t> number_in(std::string_view name, std::string_view prefix, std::string_view suffix)
{
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return {};
  if (name.size() <= prefix.size() + suffix.size()) return {};
  const std::string_view digits = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
  if (digits.size() > 18 || digits.find_first_not_of("0123456789") != digits.npos) return {};
  return std::stoll(std::string(digits));
}

/// The step in a checkpoint's name, by which the newest is found: the times of files change when they are
/// copied.
std::optional<std::int64_t> checkpoint_step(const std::string& name)
{
  return number_in(name, "checkpoint-", ".h5");
}

/// What the name of a state that cannot be gone on from ends with. It is kept, for whoever wants to know why.
constexpr std::string_view aside = ".unusable";

/// How an identity is put together; in every identity.json, under this key.
constexpr const char* format_key = "identity";
constexpr std::string_view format = "seismpm-identity/2";

bool is_state(const std::string& name)
{
  return name == final_name || checkpoint_step(name);
}

/// Is this a name under which our programs write?
bool is_output(const std::string& name)
{
  static constexpr std::array fixed = {"history.h5",    "frames.hdf.series", "log.txt",    "summary.json",
                                       "identity.json", finish_mark,         resolved_name};
  return std::ranges::find(fixed, name) != fixed.end() || is_state(name) ||
         number_in(name, "frame-", ".hdf") ||
         (name.ends_with(aside) && is_state(name.substr(0, name.size() - aside.size())));
}

/// Half-written: what a killed write leaves.
bool is_debris(const std::string& name)
{
  return name.ends_with(".tmp") && is_output(fs::path(name).stem());
}

std::vector<fs::path> files_in(const fs::path& folder, const std::function<bool(const std::string&)>& wanted)
{
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (wanted(entry.path().filename())) found.push_back(entry.path());
  return found;
}

[[noreturn]] void taken(const fs::path& folder, const std::string& what)
{
  throw Error(exit_code::folder_taken, fmt::format("{}: {}", folder.string(), what));
}

[[noreturn]] void cannot_write(const fs::path& path, const std::string& reason)
{
  throw Error(exit_code::write_failed,
              fmt::format("{}: cannot write: {}; choose another --out", path.string(), reason));
}

/// The lock and the log are the two files that are not replaced but written to: a link would lead into
/// another file, a pipe into none.
void refuse_link(const fs::path& file)
{
  const fs::file_status status = fs::symlink_status(file);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status) || fs::hard_link_count(file) > 1)
    taken(file.parent_path(),
          file.filename().string() + " is no plain file of its own; remove it or choose another --out");
}

/// All else that stands under our names is a file: a link may lead out of the folder, and a pipe is waited
/// for.
void refuse_other_than_files(const fs::path& folder)
{
  for (const auto& file : files_in(folder, is_output))
    if (!fs::is_regular_file(fs::symlink_status(file)))
      taken(folder, file.filename().string() + " is no plain file; remove it or choose another --out");
}

RunFolder::Identity read_identity(const fs::path& path)
{
  try
  {
    RunFolder::Identity identity;
    const auto stored = nlohmann::ordered_json::parse(read_input(path, most_of_case).text);
    if (const std::string found = stored.value(format_key, "none"); found != format)
      taken(path.parent_path(),
            fmt::format(
                "it holds a run of another version of this program, which told runs apart in another "
                "way (identity.json: {} is {}, where this version has {}); finish it with that version, "
                "start anew with --fresh or choose another --out",
                format_key, found, format));
    for (const auto& [key, value] : stored.items())
      if (key != format_key) identity.emplace_back(key, value.get<std::string>());
    return identity;
  }
  catch (const nlohmann::json::exception&)
  {
    taken(path.parent_path(),
          "its identity.json cannot be read; start anew with --fresh or choose another --out");
  }
}

void write_identity(const fs::path& path, const RunFolder::Identity& identity)
{
  nlohmann::ordered_json stored{{format_key, format}};
  for (const auto& [key, value] : identity) stored[key] = value;
  write_text_atomically(path, stored.dump(1) + "\n");
}

/// Null: it is not set.
const std::string* value_of(const RunFolder::Identity& identity, const std::string& key)
{
  for (const auto& [name, value] : identity)
    if (name == key) return &value;
  return nullptr;
}

/// The first difference in words; empty when there is none.
std::string difference(const RunFolder::Identity& here, const RunFolder::Identity& wanted)
{
  for (const auto& [key, value] : wanted)
  {
    const std::string* old = value_of(here, key);
    if (!old) return fmt::format("{} is {}, and not set in the run it holds", key, value);
    if (*old != value) return fmt::format("{} is {}, but {} in the run it holds", key, value, *old);
  }
  for (const auto& [key, value] : here)
    if (!value_of(wanted, key)) return fmt::format("{} is not set, but {} in the run it holds", key, value);
  return {};
}
} // namespace

std::string checkpoint_name(std::int64_t step)
{
  return fmt::format("checkpoint-{:09}.h5", step);
}

std::string difference(const std::vector<std::string>& theirs, const std::vector<std::string>& ours)
{
  for (std::size_t k = 0; k < std::max(theirs.size(), ours.size()); ++k)
  {
    const std::string a = k < theirs.size() ? theirs[k] : "nothing",
                      b = k < ours.size() ? ours[k] : "nothing";
    if (a != b) return fmt::format("was made with '{}' where there is '{}' now", a, b);
  }
  return {};
}

RunFolder::RunFolder(fs::path path, const Identity& identity, bool fresh)
    : path_(std::move(path)), identity_(identity)
{
  std::error_code error;
  fs::create_directories(path_, error);
  if (error || !fs::is_directory(path_)) cannot_write(path_, error ? error.message() : "it is not a folder");
  try
  {
    lock();
    refuse_link(path_ / "log.txt");
    if (fresh) remove_results();
    refuse_other_than_files(path_);
    check_identity();
    // Half-written files of a run that was killed: only now is it certain that they are nobody else's.
    for (const auto& file : files_in(path_, is_debris)) fs::remove(file);
  }
  catch (const fs::filesystem_error& failure)
  {
    ::close(lock_);
    cannot_write(path_, failure.code().message());
  }
  catch (...)
  {
    ::close(lock_);
    throw;
  }
}

RunFolder::~RunFolder()
{
  ::close(lock_);
}

void RunFolder::lock()
{
  const fs::path file = path_ / ".lock";
  refuse_link(file);
  lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (lock_ < 0) cannot_write(file, std::strerror(errno));
  // Of the open file, not of the process: it goes with a crash, and does not survive in a lock file left
  // behind.
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0)
  {
    if (errno != EWOULDBLOCK) return; // a file system without locks
    std::string holder;
    std::getline(std::ifstream(file), holder);
    taken(path_, fmt::format("another run holds it ({}); wait for it or choose another --out", holder));
  }
  locked_ = true;
  const std::string holder = fmt::format("host {}, pid {}, since {}\n", host_name(), ::getpid(), utc_now());
  if (::ftruncate(lock_, 0) != 0 || ::write(lock_, holder.data(), holder.size()) != ssize_t(holder.size()))
    cannot_write(file, std::strerror(errno));
}

/// The mark goes first, the identity last: whatever is left in between is an unfinished run of that identity.
void RunFolder::remove_results() const
{
  remove_finish_mark(path_);
  const auto identity = [](const std::string& name) { return name == "identity.json"; };
  for (const auto& file : files_in(path_, [&](const std::string& name) { return is_state(name); }))
    fs::remove(file);
  for (const auto& file :
       files_in(path_, [&](const std::string& name) { return is_output(name) && !identity(name); }))
    fs::remove(file);
  for (const auto& file : files_in(path_, identity)) fs::remove(file);
}

void RunFolder::check_identity()
{
  const fs::path file = path_ / "identity.json";
  if (fs::exists(file))
  {
    const std::string what = difference(read_identity(file), identity_);
    if (!what.empty()) taken(path_, what + "; start anew with --fresh or choose another --out");
    return;
  }
  // Results without an identity may be another program's: they are not written over.
  const auto strangers = files_in(path_, is_output);
  if (!strangers.empty())
    taken(path_, fmt::format("it holds {} of an unknown run; start anew with --fresh or choose another --out",
                             strangers.front().filename().string()));
  write_identity(file, identity_);
}

std::vector<std::string> RunFolder::identity_lines() const
{
  std::vector<std::string> lines;
  for (const auto& [key, value] : identity_) lines.push_back(key + " = " + value);
  // Sorted, so that the order in which settings are read may change.
  std::ranges::sort(lines);
  return lines;
}

// The final state first: it is later than every checkpoint.
std::vector<fs::path> RunFolder::states() const
{
  std::vector<fs::path> found = checkpoints();
  const fs::path final = path_ / final_name;
  if (fs::exists(fs::symlink_status(final))) found.insert(found.begin(), final);
  return found;
}

void RunFolder::set_aside(const fs::path& state) const
{
  fs::path other = state;
  other += aside;
  std::error_code error;
  fs::rename(state, other, error);
  if (error) cannot_write(state, error.message());
}

std::vector<fs::path> RunFolder::checkpoints() const
{
  auto found = files_in(path_, [](const std::string& name) { return checkpoint_step(name).has_value(); });
  std::ranges::sort(found, std::greater{},
                    [](const fs::path& path) { return *checkpoint_step(path.filename()); });
  return found;
}

void RunFolder::prune(std::size_t keep) const
{
  const auto all = checkpoints();
  std::error_code ignored; // one checkpoint too many harms nobody
  for (std::size_t i = keep; i < all.size(); ++i) fs::remove(all[i], ignored);
}
} // namespace mpm

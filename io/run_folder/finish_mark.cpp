// That final.h5 exists does not mean that the run is finished: history and summary come after it, and a file
// may have been damaged since. The mark holds all of them by digest, and is written when they are on the
// disk.

#include "io/run_folder/finish_mark.hpp"

#include "io/common/input_file.hpp"
#include "io/results/files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mpm
{
namespace fs = std::filesystem;
namespace
{
constexpr std::string_view schema = "seismpm-finished/1";

/// Whether the file holds its own digest, see write_file_atomically.
bool is_sealed(const fs::path& file)
{
  return file.extension() == ".h5" || file.extension() == ".hdf";
}

/// How a file differs from its entry; empty: not.
std::string difference(const fs::path& file, const nlohmann::json& entry)
{
  const std::string name = file.filename();
  if (!fs::is_regular_file(fs::symlink_status(file))) return name + " is missing";
  if (fs::file_size(file) != entry.at("bytes").get<std::uintmax_t>() ||
      sha256_file(file) != entry.at("sha256").get<std::string>())
    return name + " is not as it was when the run finished";
  return {};
}
} // namespace

void write_finish_mark(const fs::path& folder, const std::vector<std::string>& names)
{
  auto files = nlohmann::ordered_json::object();
  for (const std::string& name : names)
  {
    const fs::path file = folder / name;
    try
    {
      // A file that somebody has changed while the run went on must not get a mark that says it is whole.
      if (is_sealed(file)) open_complete(file);
      files[name] = {{"bytes", fs::file_size(file)}, {"sha256", sha256_file(file)}};
    }
    catch (const std::exception& lost)
    {
      throw Error(
          exit_code::write_failed,
          fmt::format("{}: was removed or damaged while the run went on ({}); the run is not finished",
                      file.string(), lost.what()));
    }
  }
  const nlohmann::ordered_json mark{{"schema", schema}, {"files", files}};
  write_text_atomically(folder / finish_mark, mark.dump(1) + "\n");
}

bool has_finish_mark(const fs::path& folder)
{
  return fs::exists(fs::symlink_status(folder / finish_mark));
}

std::string broken_mark(const fs::path& folder)
{
  try
  {
    const nlohmann::json mark = nlohmann::json::parse(read_input(folder / finish_mark, most_of_case).text);
    if (mark.at("schema") != schema || mark.at("files").empty()) return "finished.json is another program's";
    for (const auto& [name, entry] : mark.at("files").items())
      if (name.find('/') != name.npos)
        return "finished.json names a file of another folder, " + name;
      else if (const std::string what = difference(folder / name, entry); !what.empty())
        return what;
    return {};
  }
  catch (const nlohmann::json::exception&)
  {
    return "finished.json cannot be read";
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

void remove_finish_mark(const fs::path& folder)
{
  std::error_code error;
  fs::remove(folder / finish_mark, error);
  if (error)
    throw Error(exit_code::write_failed,
                fmt::format("{}: cannot be removed: {}", (folder / finish_mark).string(), error.message()));
  // A mark that came back after a crash would stand for files that are being replaced.
  sync_folder(folder);
}
} // namespace mpm

#include "solver/stages/resume.hpp"

#include "io/run_folder/finish_mark.hpp"
#include "solver/stages/checkpoint.hpp"
#include "solver/stages/resolved_case.hpp"

#include <utility>

namespace mpm
{
bool finished_already(Session& session)
{
  const RunFolder& folder = *session.folder;
  if (!has_finish_mark(folder.path())) return false;
  const std::string what = broken_mark(folder.path());
  if (what.empty())
  {
    folder.prune(0); // what a kill after the mark has left
    session.log.info("{}: is finished already; --fresh starts anew", folder.path().string());
    return true;
  }
  session.log.warn("{}: {}: the run is not finished any more", folder.path().string(), what);
  remove_finish_mark(folder.path());
  return false;
}

Start resume(Session& session, const std::function<void()>& begin_anew,
             const std::function<void(const h5::File&)>& load)
{
  const RunFolder& folder = *session.folder;
  write_text_atomically(folder / resolved_name, resolved_case(session.case_file, session.options));
  std::vector<std::filesystem::path> unusable;
  std::string lost; // a result file that a state needs beside it, or the version that can read it
  std::optional<Start> found;
  bool spoiled = false;
  for (const auto& path : folder.states())
  {
    try
    {
      const h5::File file = open_state(session, path);
      if (std::exchange(spoiled, true)) begin_anew();
      load(file);
      found = is_last(file) ? Start::at_end : Start::midway;
      session.log.recall(file.read_strings(checkpoint::warnings));
      session.log.info("goes on from {}", path.string());
      break;
    }
    catch (const std::runtime_error& error)
    {
      // A result file that is lost makes every state useless that wrote it, and no older one may hide that;
      // a state of another version is not thrown away for a new start.
      const auto* ours = dynamic_cast<const Error*>(&error);
      if (ours && ours->code == exit_code::folder_taken && lost.empty()) lost = error.what();
      session.log.warn("{}; trying an older one", error.what());
      unusable.push_back(path);
      found.reset();
    }
  }
  if (!found && !lost.empty()) throw Error(exit_code::folder_taken, lost);
  if (!found && !unusable.empty())
    session.log.warn("{}: no state in it is whole: the run starts from the beginning",
                     folder.path().string());
  for (const auto& path : unusable) folder.set_aside(path);
  if (!found && spoiled) begin_anew();
  return found.value_or(Start::afresh);
}
} // namespace mpm

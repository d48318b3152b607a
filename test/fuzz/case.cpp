// A case that is accepted is accepted again as it is written out, from another folder, and is the same then:
// the text, and what tells the runs of both stages apart. A small one also gets its motion and the ground of
// both stages.

#include "io/case/size.hpp"
#include "solver/mpm/domain.hpp"
#include "solver/stages/filling_report.hpp"
#include "solver/stages/identity.hpp"
#include "solver/stages/motion.hpp"
#include "solver/stages/relaxation.hpp"
#include "solver/stages/resolved_case.hpp"
#include "solver/stages/time_step.hpp"
#include "test/fuzz/targets.hpp"
#include "test/temporary_folder.hpp"

#include <set>

namespace mpm::fuzz
{
namespace
{
constexpr double most_particles = 2000, most_columns = 1000; // of ground that is made

/// The files of an input in a folder, and the options beside them.
class Input
{
public:
  explicit Input(std::string_view bytes)
  {
    std::string name = "case.yaml", text;
    while (!bytes.empty())
    {
      const std::string_view line =
          bytes.substr(0, bytes.find('\n') + 1 ? bytes.find('\n') + 1 : bytes.size());
      bytes.remove_prefix(line.size());
      if (!line.starts_with("%%% "))
      {
        text += line;
        continue;
      }
      add(name, text);
      name = line.substr(4, line.find('\n') - 4);
      text.clear();
    }
    add(name, text);
  }
  Options options(const char* program) const
  {
    Options o;
    o.program = program;
    o.case_file = folder_ / "case.yaml";
    o.verbosity = Verbosity::silent;
    o.profile = profile_;
    o.overrides = overrides_;
    return o;
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

private:
  void add(const std::string& name, const std::string& text)
  {
    if (name.starts_with("--set "))
      overrides_.push_back(name.substr(6));
    else if (name.starts_with("--profile "))
      profile_ = name.substr(10);
    else if (!name.empty() && name.size() < 32 && name[0] != '.' &&
             name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._") ==
                 name.npos)
      test::put(folder_ / name, text);
  }
  test::TemporaryFolder folder_;
  std::string profile_;
  std::vector<std::string> overrides_;
};

void same(const std::string& a, const std::string& b, const char* what)
{
  hold(a == b, std::string(what) + " differ:\n" + a + "---\n" + b);
}

/// The settings of a run, in no order of theirs.
std::string text_of(const RunFolder::Identity& identity)
{
  const std::set<std::pair<std::string, std::string>> sorted(identity.begin(), identity.end());
  std::string text;
  for (const auto& [key, value] : sorted) text += key + " = " + value + "\n";
  return text;
}

void read_again(const Input& input, const Session& session)
{
  const std::string text = resolved_case(session.case_file, session.options);
  std::filesystem::create_directory(input / "run");
  test::put(input / "run/case.yaml", text);
  Options options = input.options("mpm-seismic");
  options.case_file = input / "run/case.yaml";
  options.profile.clear();
  options.overrides.clear();
  std::optional<Session> again;
  try
  {
    again.emplace(options);
  }
  catch (const Error& error)
  {
    throw Broken(std::string("refused as it is written out: ") + error.what() + "\n" + text);
  }
  const Case &a = session.case_file, &b = again->case_file;
  const auto without_comments = [](std::string all)
  {
    while (all.starts_with('#')) all.erase(0, all.find('\n') + 1);
    return all;
  };
  same(without_comments(text), without_comments(resolved_case(b, options)), "cases written out");
  same(text_of(static_settings(a)), text_of(static_settings(b)), "static settings");
  same(text_of(seismic_settings(a)), text_of(seismic_settings(b)), "seismic settings");
}

/// The ground and the motion of both stages, without a step.
void make_ground(Session& session)
{
  const Case& case_file = session.case_file;
  const CaseSize size = expected_size(case_file);
  if (!(size.particles < most_particles && size.columns < most_columns)) return;
  Clock clock;
  Model model = make_static_model(case_file, clock);
  report_filling(session.log, case_file, model.filling);
  hold(clock.dt > 0 && std::isfinite(clock.dt), "a static stage without a step");
  if (case_file.seismic.duration == 0) return;
  const Motion motion = load_motion(session);
  model = make_model(case_file);
  const double dt = step_dividing(case_file.output.gauges.every, case_file.courant_number, *model.main);
  hold(dt > 0, "a seismic stage without a step");
  add_seismic_boundaries(model, case_file, motion.wave, false);
}
} // namespace

void try_case(std::string_view bytes)
try
{
  const Input input(bytes);
  Session session(input.options("mpm-seismic"));
  read_again(input, session);
  make_ground(session);
}
catch (const Error& error)
{
  hold(error.code == exit_code::bad_input || error.code == exit_code::input_missing,
       std::string("exit code ") + std::to_string(error.code) + ": " + error.what());
}
} // namespace mpm::fuzz

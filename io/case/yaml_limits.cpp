// yaml-cpp tells of a text event by event before it builds anything, but reads ahead over all marks of a
// line: those are counted first.

#include "io/case/yaml_limits.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>
#include <string_view>

namespace mpm
{
namespace
{
constexpr std::ptrdiff_t most_marks = 4 * most_yaml_nodes;

/// Where a text has more than is read.
struct TooLarge
{
  YAML::Mark where;
};

/// Counts what comes, and throws where it is too much.
class Counter final : public YAML::EventHandler
{
public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override
  {
    count(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override
  {
    open(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override
  {
    open(mark);
  }
  void OnMapEnd() override { --depth_; }

private:
  void count(const YAML::Mark& mark)
  {
    // The key of a map counts here too.
    if (++nodes_ > 2 * most_yaml_nodes) throw TooLarge{mark};
  }
  void open(const YAML::Mark& mark)
  {
    count(mark);
    if (++depth_ > deepest_yaml + 1) throw TooLarge{mark};
  }

  int nodes_ = 0, depth_ = 0;
};
} // namespace

std::optional<YAML::Mark> end_of_what_is_read(const std::string& text)
try
{
  const auto is_mark = [](char c) { return std::string_view("[]{},:").find(c) != std::string_view::npos; };
  if (std::ranges::count_if(text, is_mark) > most_marks) return YAML::Mark();
  std::istringstream stream(text);
  Counter counter;
  for (YAML::Parser parser(stream); parser.HandleNextDocument(counter);)
  {
  }
  return {};
}
catch (const TooLarge& end)
{
  return end.where;
}
} // namespace mpm

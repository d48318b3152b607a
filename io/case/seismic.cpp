// `seismic`: how long, between which boundaries, shaken by what. Several keys are a word or a time, which
// only the code can tell apart: their descriptions say it in words.

#include "io/case/sections.hpp"
#include "io/common/suggestion.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
/// A path of the case, which is relative to the case file and not to where the program runs.
std::string beside(const std::filesystem::path& folder, const std::string& file)
{
  return file.empty() ? file : (folder / file).lexically_normal().string();
}

/// The record of one direction: `built_in` or a map.
MotionSource read_source(const YamlNode& node, const std::filesystem::path& folder, Problems& problems)
{
  MotionSource source;
  if (node.kind == YamlNode::Kind::scalar)
  {
    if (node.text != "built_in")
      problems.add(node.location, node.path,
                   "is '" + node.text + "'; must be built_in, or a map as {file: " +
                       (node.text.empty() ? "records/a.AT2" : node.text) + "}");
    return source;
  }
  Section section(&node, problems);
  source.record.file = beside(folder, section.text({"file", "record of the motion, see io/records",
                                                    "path, relative to the case file"}));
  if (section.given() && !source.record.file.empty())
    // What a run depends on is the record's samples; the path is kept in full so that the written case can be
    // run.
    section.resolve("file", std::filesystem::absolute(source.record.file).string());
  const std::vector<std::string> formats = record_formats();
  source.record.format =
      formats[section.choice_or(0, {"format", "format of the file, where it does not show it"}, formats)];
  source.record.dt = section.number_or(
      NAN, {"dt", "time step of the record, where the file does not tell it", "", "from the file"},
      Dimension::time, Interval::positive());
  source.record.unit = section.text_or("", {"unit", "unit of the record, where the file does not tell it",
                                            "as g, gal, m/s2, cm/s or m", "from the file"});
  if (!source.record.unit.empty() && !is_record_unit(source.record.unit))
    section.error("unit",
                  "is '" + source.record.unit + "'; must be a unit of records, as g, gal, m/s2, cm/s or m");
  const std::vector<std::string> quantities{"acceleration", "velocity", "displacement"};
  const std::string either_quantity = either(quantities);
  if (const YamlNode* quantity =
          section.find({"quantity", "what the record is of, where neither file nor unit tells it",
                        either_quantity, "from the file, or from the unit"}))
    source.record.quantity = static_cast<Quantity>(std::max(0, read_choice(*quantity, quantities, problems)));
  source.record.origin =
      section.text_or("", {"origin", "where the file can be had, told when it is missing", "", "none"});
  source.record.component = section.text_or(
      "", {"component", "which one of a file that holds several, as the file names it: N, E-W, S16W, 340 deg",
           "", "its only one"});
  source.scale = section.number_or(1, {"scale", "factor on the record"}, Dimension::none);
  return source;
}

/// None: nothing moves the base in this direction.
std::optional<MotionSource> read_direction(Section& motion, std::string_view key, std::string_view otherwise,
                                           const std::filesystem::path& folder, Problems& problems)
{
  const YamlNode* node =
      motion.find({key, "the record of this direction; built_in is a synthetic motion of the program's own",
                   "built_in, or a map of the keys below", otherwise});
  if (!node) return std::nullopt;
  return read_source(*node, folder, problems);
}

/// `outcrop` or `upgoing`; required, because a factor of two hangs on it.
RecordedAs read_recorded_as(Section& motion, Problems& problems)
{
  const YamlNode* node = motion.require(
      {"recorded_as",
       "outcrop: recorded on rock at the surface, twice the upgoing wave; upgoing: that wave itself",
       "outcrop or upgoing"});
  if (!node) return RecordedAs::outcrop;
  // People have such records and will try: the reason is worth more than a list of the two words.
  if (node->kind == YamlNode::Kind::scalar && node->text == "within")
  {
    problems.add(node->location, node->path, "'within' is not possible: " + std::string(why_not_within));
    return RecordedAs::outcrop;
  }
  return read_choice(*node, {"outcrop", "upgoing"}, problems) == 1 ? RecordedAs::upgoing
                                                                   : RecordedAs::outcrop;
}

/// `never`, `self_driven` or a time.
void read_end(Section& motion, MotionSettings& settings, Problems& problems)
{
  const YamlNode* node = motion.find(
      {"end",
       "when the motion fades, within half a second: before this time, or after the slide goes on by itself",
       "never, self_driven or a time", "never"});
  if (!node) motion.resolve("end", "never");
  if (!node || node->text == "never") return;
  if (node->text == "self_driven")
  {
    settings.end = MotionEnd::self_driven;
    return;
  }
  if (node->kind == YamlNode::Kind::scalar && parse_quantity(node->text, Dimension::time).problem.empty())
  {
    settings.end = MotionEnd::time;
    settings.end_time = read_number(*node, Dimension::time, Interval::positive(), problems);
    return;
  }
  problems.add(node->location, node->path,
               "must be never, self_driven or a time as '12.5 s'" +
                   suggestion(node->text, {"never", "self_driven"}));
}

/// `none`, `auto` or a time.
SpringTime read_spring(Section& base, BaseKind kind, Problems& problems)
{
  const YamlNode* node = base.find(
      {"spring",
       "time T of the compliant base's spring, which lets it carry lasting loads; auto: the longest period "
       "of level ground in the domain",
       "auto, none or a time", "auto"});
  if (!node) base.resolve("spring", "auto"); // of a compliant base: see load_case
  if (!node || node->text == "auto") return {};
  if (node->text == "none") return 0;
  if (node->kind == YamlNode::Kind::scalar && parse_quantity(node->text, Dimension::time).problem.empty())
  {
    // A spring that has no effect is a misunderstanding, not a harmless extra.
    if (kind == BaseKind::fixed) base.error("spring", "a fixed base has no spring; leave it out");
    return read_number(*node, Dimension::time, Interval::positive(), problems);
  }
  problems.add(node->location, node->path,
               "must be none, auto or a time as '1 s'" + suggestion(node->text, {"none", "auto"}));
  return {};
}

FilterSettings read_filter(Section filter, Transfer transfer)
{
  FilterSettings settings;
  if (transfer == Transfer::apic) settings = {0, 0}; // it filters velocities in every step
  settings.time = filter.number_or(
      settings.time,
      {"time", "in which velocities that the grid does not carry fade; 0: they are kept; with apic 0"},
      Dimension::time, Interval::not_negative());
  settings.strain = filter.number_or(settings.strain,
                                     {"strain", "plastic strain over which stresses and volumes that the "
                                                "grid does not carry fade; 0: they are kept; with apic 0"},
                                     Dimension::none, Interval::not_negative());
  return settings;
}

constexpr std::string_view with_record = "record";

/// What follows the record in `record` or `record + TIME`, s; NaN: the text is neither.
double after_record(std::string_view text)
{
  // "record", "record + 10 s", "record+10s": blanks do not count.
  text.remove_prefix(with_record.size());
  const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(' '), text.size())); };
  skip_blanks();
  if (text.empty()) return 0;
  if (!text.starts_with('+')) return NAN;
  text.remove_prefix(1);
  skip_blanks();
  const Quantified time = parse_quantity(text, Dimension::time);
  return time.problem.empty() && time.value >= 0 ? time.value : NAN;
}

/// A time, or `record` with what follows it.
void read_duration(Section& section, SeismicSettings& settings, Problems& problems)
{
  const YamlNode* node =
      section.require({"duration", "of shaking and run-out; record: to the end of the longer record",
                       "a time, record, or record + a time"});
  if (!node) return;
  if (node->kind != YamlNode::Kind::scalar || !node->text.starts_with(with_record))
  {
    settings.duration = read_number(*node, Dimension::time, Interval::positive(), problems);
    return;
  }
  settings.duration = NAN;
  settings.after_record = after_record(node->text);
  if (std::isnan(settings.after_record))
    problems.add(node->location, node->path,
                 "is '" + node->text +
                     "'; must be record, record + a time as 'record + 10 s', or a time as '24 s'");
}

/// `seismic.motion`; the built-in motion where the case has none.
MotionSettings read_motion(Section motion, const std::filesystem::path& folder, Problems& problems)
{
  MotionSettings settings;
  settings.given = motion.given();
  if (motion.given())
  {
    settings.processing.recorded_as = read_recorded_as(motion, problems);
    settings.horizontal =
        read_direction(motion, "horizontal", "built_in without seismic.motion, else none", folder, problems);
    settings.vertical = read_direction(motion, "vertical", "none", folder, problems);
  }
  else
  {
    // Without a motion the built-in one shakes the base, which is an outcrop motion.
    motion.resolve("recorded_as", "outcrop");
    motion.resolve("horizontal", "built_in");
  }
  // A motion that moves nothing is a section that was left half done.
  if (!settings.horizontal && !settings.vertical)
    motion.error("", "has no record; give horizontal, vertical or both (built_in is the program's own)");
  const std::vector<std::string> baselines{"none", "linear", "quadratic", "cubic"};
  MotionProcessing& processing = settings.processing;
  processing.baseline = static_cast<Baseline>(
      motion.choice_or(static_cast<int>(processing.baseline),
                       {"baseline", "polynomial taken from the velocity so that it ends at 0"}, baselines));
  processing.taper = motion.number_or(
      processing.taper,
      {"taper", "cosine taper of the velocity at both ends", "", "0.5 s; 0 s without any other correction"},
      Dimension::time, Interval::not_negative());
  processing.high_pass = motion.number_or(
      processing.high_pass, {"high_pass", "corner of a Butterworth filter run forth and back; 0 Hz: off"},
      Dimension::frequency, Interval::not_negative());
  read_end(motion, settings, problems);
  return settings;
}
} // namespace

SeismicSettings read_seismic(Section& root, const std::filesystem::path& folder, Problems& problems)
{
  SeismicSettings settings;
  Section section = root.optional_section("seismic");
  if (!section.given()) return settings;
  read_duration(section, settings, problems);
  {
    Section base = section.optional_section("base");
    settings.base = static_cast<BaseKind>(
        base.choice_or(0, {"kind", "compliant: lets waves out, the motion comes in; fixed: takes no motion"},
                       {"compliant", "fixed"}));
    // A fixed base has no record from which the length could count.
    if (settings.base == BaseKind::fixed && !std::isnan(settings.after_record))
      section.error("duration", "counts from a record, and a fixed base takes none; give a time as '24 s'");
    settings.spring = read_spring(base, settings.base, problems);
    Section sides = section.optional_section("sides");
    settings.sides =
        static_cast<SideKind>(sides.choice_or(0,
                                              {"kind", "free_field: columns of level ground beside the "
                                                       "domain; quiet: dashpots; roller: no sideways motion"},
                                              {"free_field", "quiet", "roller"}));
  }
  settings.transfer = static_cast<Transfer>(section.choice_or(
      0,
      {"transfer",
       "how particles take over the nodes' velocities; apic: the paper's method, which brakes slides"},
      {"flip", "apic"}));
  settings.filter = read_filter(section.optional_section("filter"), settings.transfer);
  settings.inertia = static_cast<Inertia>(
      section.choice_or(1, {"inertia", "consistent: waves travel at their speed down to ten cells a wave"},
                        {"lumped", "consistent"}));
  settings.leaving = static_cast<GroundLeaving>(section.choice_or(
      0, {"leaving", "what becomes of ground that passes a side or the base; stop: the run ends then"},
      {"remove", "stop"}));
  settings.rest_below =
      section.number_or(0,
                        {"rest_below", "once the motion is over, ground slower than this for a second is "
                                       "skipped until something moves beside it; 0: none is"},
                        Dimension::velocity, Interval::not_negative());
  settings.motion = read_motion(section.optional_section("motion"), folder, problems);
  return settings;
}
} // namespace mpm

// The table of formats, and what their readers have in common. A reader says what the file says of a
// component (Channel); that it is in SI, agrees with the case and reaches its stated peak is seen to here.

#include "io/records/archives.hpp"

#include <algorithm>
#include <array>

namespace mpm::records
{
namespace
{
/// In the order in which they are tried. Each recognises itself by marks that no other has.
constexpr std::array table{
    Archive{"knet", "K-NET or KiK-net", is_knet, read_knet},
    Archive{"cosmos", "COSMOS", is_cosmos, read_cosmos},
    Archive{"csmip", "CSMIP", is_csmip, read_csmip},
    Archive{"esm", "ESM or ITACA (DYNA)", is_esm, read_esm},
    Archive{"smc", "SMC", is_smc, read_smc},
    Archive{"cwb", "CWB", is_cwb, read_cwb},
    Archive{"geonet", "GeoNet", is_geonet, read_geonet},
    Archive{"bhrc", "BHRC", is_bhrc, read_bhrc},
};

/// A format that is not read, told by two marks (lower case) near the start of the file.
struct Foreign
{
  std::string_view name, mark, second_mark;
};
constexpr std::array foreign{
    Foreign{"USC (Caltech volume II)", "accelerogram", "data of volume i"},
    Foreign{"AFAD (Turkiye)", "strong ground motion records", "sampling interval"},
    Foreign{"ISESD (European Strong-Motion Database)", "sampling period:", "number of samples:"},
    Foreign{"SIMBAD", "simbad", ""},
    Foreign{"an option file of SHAKE", "shake", "option"},
    Foreign{"RENADIC (Chile)", "renadic", ""},
    Foreign{"UNAM (Mexico)", "unam", "intervalo de muestreo"},
    Foreign{"an HTML page", "<html", ""},
};

/// "N-S" and "north" are one component, as are "E" and "E-W", "Z" and "Up".
std::string canonical(std::string_view component)
{
  std::string name = lower(component);
  std::erase_if(name, [](char c) { return c == '-' || c == ' ' || c == '.' || c == '_'; });
  for (const auto& [full, others] : {std::pair<std::string_view, std::string_view>{"ns", " n north ns "},
                                     {"ew", " e east ew "},
                                     {"ud", " u up ud z v vertical "}})
    if (others.find(" " + name + " ") != others.npos) return std::string(full);
  return name;
}
} // namespace

std::span<const Archive> archives()
{
  return table;
}

const Archive* archive_of(std::string_view text, Lines lines)
{
  // 4 KB hold every header's first lines, and a record may be of any length.
  const std::string head = lower(text.substr(0, 4096));
  const auto found =
      std::ranges::find_if(table, [&](const Archive& archive) { return archive.recognise(head, lines); });
  return found == table.end() ? nullptr : &*found;
}

void refuse_foreign(const RecordSource& source, std::string_view text, Lines)
{
  const auto refuse_as = [&](std::string_view name)
  {
    refuse(source, "looks like " + std::string(name) +
                       ", which is not read; convert it to two columns, time in s and acceleration");
  };
  // Binary files are told by a zero byte, which no text has.
  if (text.substr(0, 4096).find('\0') != std::string_view::npos) refuse_as("a binary file");
  const std::string head = lower(text.substr(0, 4096));
  for (const Foreign& format : foreign)
    if (head.find(format.mark) != std::string::npos && head.find(format.second_mark) != std::string::npos)
      refuse_as(format.name);
}

std::size_t chosen_component(const RecordSource& source, const std::vector<std::string>& components)
{
  std::string all;
  for (const std::string& component : components) all += (all.empty() ? "" : ", ") + component;
  if (source.component.empty())
  {
    if (components.size() == 1) return 0;
    refuse(source, "holds the components " + all + "; give one of them as component");
  }
  const auto matches = [&](auto&& is_same)
  {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < components.size(); ++i)
      if (is_same(components[i])) found.push_back(i);
    return found;
  };
  // By its name as a whole; where no component is called so, by a word in its name.
  const std::string asked = canonical(source.component);
  std::vector<std::size_t> found = matches([&](const std::string& name) { return canonical(name) == asked; });
  if (found.empty())
    found = matches([&](const std::string& name)
                    { return find_word(lower(name), lower(source.component)) != std::string::npos; });
  if (found.size() != 1)
    refuse(source, "its components are " + all + ", and '" + source.component + "' is " +
                       (found.empty() ? "not" : "not just") + " one of them");
  return found.front();
}

Record record_of(const RecordSource& source, Lines lines, std::string_view format, Channel channel)
{
  const Line& line = lines[channel.line];
  // The peak that archives print is the best check there is: it was computed from the values before they were
  // sent.
  double peak = 0;
  for (double value : channel.values) peak = std::max(peak, std::abs(value));
  if (channel.peak && std::abs(peak - std::abs(*channel.peak)) > channel.peak_tolerance)
    refuse(source, line,
           "states a peak of " + number(std::abs(*channel.peak)) + " " + channel.unit.name +
               " for component " + channel.component + ", and its values reach " + number(peak) +
               "; fetch it again");
  const double dt = agreed_dt(source, line, channel.dt, 1e-6);
  const RecordUnit unit = agreed_unit(source, Said{channel.unit, {}, {}, line}, {});
  Record record = finished(source, std::string(format), unit, dt, std::move(channel.values));
  record.component = channel.component;
  return record;
}

std::string_view text_behind(std::string_view line, std::string_view key)
{
  const std::size_t at = lower(line).find(lower(key));
  return at == std::string::npos ? std::string_view{} : line.substr(at + key.size());
}

std::optional<double> number_behind(std::string_view line, std::string_view key)
{
  std::string_view rest = text_behind(line, key);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t=:"), rest.size()));
  const std::size_t end = std::min(rest.find_first_not_of("+-.0123456789"), rest.size());
  std::string_view token = rest.substr(0, end);
  const auto value = take_number(token);
  // "49.920~s" and "0.01," end a number, "1.2.3" and "5a" do not.
  const bool ends =
      end == rest.size() || is_blank(rest[end]) || std::string_view(",;~").find(rest[end]) != rest.npos;
  return token.empty() && ends ? value : std::nullopt;
}

std::optional<double> quantity_behind(std::string_view line, std::string_view key)
{
  const auto value = number_behind(line, key);
  std::string_view rest = text_behind(line, key);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t=:+-.0123456789"), rest.size()));
  const auto unit = parse_unit(rest.substr(0, rest.find_first_of(" \t,;")));
  return value && unit ? std::optional(*value * unit->si) : std::nullopt;
}

void check_end(const RecordSource& source, Lines lines, std::size_t at)
{
  while (at < lines.size() && bare(lines[at].text).empty()) ++at;
  if (at < lines.size() && numbers_in(bare(lines[at].text)))
    refuse(source, lines[at], "goes on behind the values that the header counts; fetch it again");
}

std::size_t count_behind(const RecordSource& source, const Line& line, std::string_view key)
{
  const auto count = number_behind(line.text, key);
  if (!count || *count < 2 || *count > 1e9 || *count != std::floor(*count))
    refuse(source, line, "has to give a number of values behind '" + std::string(key) + "'; fetch it again");
  return std::size_t(*count);
}

std::vector<double> fixed_numbers(const RecordSource& source, Lines lines, std::size_t& at, std::size_t count,
                                  std::size_t width, std::size_t per_line)
{
  std::vector<double> values;
  for (; values.size() < count && at < lines.size(); ++at)
  {
    // Fixed columns, not blanks, part the numbers: "-12345.678-23456.789" are two.
    const std::size_t here = std::min(per_line, count - values.size());
    std::string_view text = lines[at].text;
    for (std::size_t field = 0; field < here; ++field)
    {
      const auto number = numbers_in(bare(text.substr(0, width)));
      if (!number || number->size() != 1 || text.size() < width)
        refuse(source, lines[at],
               "expected " + std::to_string(here) + " numbers of " + std::to_string(width) +
                   " characters, and found " + shown(text) + "; fetch it again");
      values.push_back(number->front());
      text.remove_prefix(std::min(width, text.size()));
    }
    if (!bare(text).empty())
      refuse(source, lines[at], "goes on behind its numbers with " + shown(text) + "; fetch it again");
  }
  if (values.size() < count)
    refuse(source, lines.back(),
           "ends after " + std::to_string(values.size()) + " of " + std::to_string(count) +
               " values; fetch it again, it is cut off");
  return values;
}

std::optional<FortranFormat> fortran_format(std::string_view text)
{
  const std::string all = lower(text);
  for (std::size_t open = 0; (open = all.find('(', open)) != all.npos; ++open)
  {
    std::size_t at = open + 1;
    const auto whole = [&]
    {
      std::size_t value = 0;
      for (; at < all.size() && is_digit(all[at]) && value < 1000; ++at)
        value = 10 * value + std::size_t(all[at] - '0');
      return value;
    };
    const std::size_t per_line = whole();
    if (per_line == 0 || at >= all.size() || (all[at] != 'f' && all[at] != 'e')) continue;
    ++at;
    if (const std::size_t width = whole(); width > 0 && at < all.size() && all[at] == '.')
      return FortranFormat{per_line, width};
  }
  return {};
}
} // namespace mpm::records

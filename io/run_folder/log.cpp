// Two ways to show progress: on a terminal one line that is redrawn in place twice a second, elsewhere plain
// lines every ten seconds, so that the output of a batch job stays short. Messages erase the line and it
// comes back below them. The file gets the plain lines in either case.

#include "io/run_folder/log.hpp"
#include "io/common/error.hpp"
#include "io/common/printable.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace mpm
{
namespace
{
using namespace std::chrono_literals;

constexpr auto redraw_every = 500ms;
constexpr auto print_every = 10s;
// Back to the first column, and erase to the end of the line (ECMA-48).
constexpr const char* erase_line = "\r\033[K";
constexpr std::size_t usual_columns = 80;
constexpr std::size_t whole = std::numeric_limits<std::size_t>::max();

/// Whether stderr is a terminal that can erase a line.
bool can_redraw()
{
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && term && *term && std::string_view(term) != "dumb";
}

/// Of the terminal now: people change it while a run goes on.
std::size_t columns()
{
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual_columns;
}

/// A logger that writes each message out at once: the last one before a crash is the one that is needed.
std::shared_ptr<spdlog::logger> plain_logger(spdlog::sink_ptr sink, const std::string& pattern)
{
  auto logger = std::make_shared<spdlog::logger>("", std::move(sink));
  logger->set_pattern(pattern, spdlog::pattern_time_type::utc);
  logger->flush_on(spdlog::level::info);
  return logger;
}

double seconds(std::chrono::steady_clock::duration span)
{
  return std::chrono::duration<double>(span).count();
}

/// 3.1e4
std::string short_number(double value)
{
  if (value == 0) return "0";
  // Without the zeros of "e+04": the line is short.
  std::string text = fmt::format("{:.1e}", value);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  return text.substr(0, exponent + 1) + std::to_string(std::stoi(text.substr(exponent + 1)));
}
} // namespace

Log::Log(Verbosity verbosity, Screen screen)
    : verbosity_(verbosity),
      live_(verbosity > Verbosity::quiet && screen == Screen::messages && can_redraw()),
      screen_(plain_logger(std::make_shared<spdlog::sinks::stderr_sink_mt>(), "%v")), answer_(screen_)
{
  if (screen == Screen::answer)
    answer_ = plain_logger(std::make_shared<spdlog::sinks::stdout_sink_mt>(), "%v");
}

Log::~Log()
{
  keep_line();
}

void Log::open(const std::filesystem::path& file)
{
  try
  {
    file_ = plain_logger(std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string()),
                         "%Y-%m-%dT%H:%M:%SZ  %v");
  }
  catch (const spdlog::spdlog_ex& failure)
  {
    throw Error(exit_code::write_failed,
                fmt::format("{}: {}; choose another --out", file.string(), failure.what()));
  }
  // A full disk must not end the run here: the next checkpoint will tell.
  file_->set_error_handler([](const std::string&) {});
  for (const auto& [when, text] : kept_) file_->log(when, {}, spdlog::level::info, text);
  kept_.clear();
}

void Log::say(Level level, const std::string& said)
{
  const std::string text = printable(said);
  const char* prefix = level == Level::warning ? "warning: " : level == Level::error ? "error: " : "";
  const bool known = std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end();
  if (level == Level::warning && !known) warnings_.push_back(text);
  const Level least = verbosity_ == Verbosity::verbose  ? Level::detail
                      : verbosity_ == Verbosity::normal ? Level::info
                                                        : Level::warning;
  // The file takes every level, whatever the screen shows.
  if (verbosity_ != Verbosity::silent && level >= least) to_screen(prefix + text, level);
  to_file(prefix + text);
}

void Log::recall(const std::vector<std::string>& earlier)
{
  std::vector<std::string> all = earlier;
  for (const std::string& warning : warnings_)
    if (std::find(earlier.begin(), earlier.end(), warning) == earlier.end()) all.push_back(warning);
  warnings_ = std::move(all);
}

void Log::to_screen(const std::string& text, Level level)
{
  if (line_shown_) std::fputs(erase_line, stderr);
  line_shown_ = false;
  (level < Level::warning ? answer_ : screen_)->info(spdlog::string_view_t(text));
}

// Before the folder is known there is no file; what is said until then keeps its time of day.
void Log::to_file(const std::string& text)
{
  if (file_)
    file_->info(spdlog::string_view_t(text));
  else
    kept_.push_back({std::chrono::system_clock::now(), text});
}

void Log::redraw(const std::vector<std::string>& parts)
{
  if (!live_) return;
  // The last column stays free: some terminals go on to the next line when it is filled.
  std::fprintf(stderr, "%s%s", erase_line, line_of(parts, columns() - 1).c_str());
  std::fflush(stderr);
  line_shown_ = true;
}

void Log::keep_line()
{
  if (line_shown_) std::fputs("\n", stderr);
  line_shown_ = false;
}

void Log::progress(const std::string& line)
{
  if (!live_ && verbosity_ > Verbosity::quiet) to_screen(line);
  to_file(line);
}

Progress::Progress(Log& log, StageFacts stage)
    : log_(log), stage_(std::move(stage)), start_(Clock::now()), drawn_(start_), printed_(start_),
      last_step_(stage_.first_step)
{
}

bool Progress::due() const
{
  const auto now = Clock::now();
  return now - printed_ >= print_every || (log_.live() && now - drawn_ >= redraw_every);
}

std::vector<std::string> Progress::parts(const Moment& moment, Clock::time_point now)
{
  // Speed since the last line; what is left by the mean speed of this process, which a resumed run has not
  // begun at zero.
  const double rate = double(moment.step - last_step_) / seconds(now - drawn_);
  const double done = moment.fraction - stage_.first_fraction;
  const double left =
      done > 0 && moment.fraction < 1 ? seconds(now - start_) * (1 - moment.fraction) / done : NAN;
  drawn_ = now;
  last_step_ = moment.step;
  return progress_parts(stage_, moment, rate, left);
}

void Progress::update(const Moment& moment)
{
  const auto now = Clock::now();
  const std::vector<std::string> all = parts(moment, now);
  log_.redraw(all);
  if (now - printed_ < print_every) return;
  printed_ = now;
  log_.progress(line_of(all, whole));
}

void Progress::finish(const Moment& moment)
{
  const auto now = Clock::now();
  drawn_ = start_; // the last line tells the mean speed
  last_step_ = stage_.first_step;
  const std::vector<std::string> all = parts(moment, now);
  printed_ = now;
  log_.redraw(all);
  log_.keep_line();
  log_.progress(line_of(all, whole));
}

std::string duration_text(double seconds)
{
  const auto total = std::llround(seconds);
  if (total >= 86400) return fmt::format("{} d {} h", total / 86400, total % 86400 / 3600);
  if (total >= 3600) return fmt::format("{} h {} min", total / 3600, total % 3600 / 60);
  if (total >= 60) return fmt::format("{} min {} s", total / 60, total % 60);
  return fmt::format("{} s", total);
}

std::vector<std::string> progress_parts(const StageFacts& stage, const Moment& moment,
                                        double steps_per_second, double seconds_left)
{
  std::vector<std::string> parts;
  const auto add = [&parts]<class... Args>(fmt::format_string<Args...> format, Args&&... args)
  { parts.push_back(fmt::format(format, std::forward<Args>(args)...)); };

  // What matters most comes first: a narrow terminal shows the beginning only.
  if (std::isnan(moment.fraction))
    add("{}", stage.name);
  else
    add("{} {:.0f} %", stage.name, std::floor(100 * moment.fraction));
  if (std::isfinite(seconds_left)) add("left {}", duration_text(seconds_left));
  add("t {:.4g} s", moment.time);
  add("max v {:.2g} m/s", moment.speed);
  add("step {}", moment.step);
  if (std::isfinite(steps_per_second) && steps_per_second > 0)
  {
    add("{} steps/s", steps_per_second < 100 ? fmt::format("{:.2g}", steps_per_second)
                                             : fmt::format("{:.0f}", steps_per_second));
    if (stage.particles > 0)
      add("{:.3g} ns/particle-step", 1e9 * stage.threads / (steps_per_second * double(stage.particles)));
  }
  add("KE {} J", short_number(moment.kinetic));
  return parts;
}

std::string line_of(const std::vector<std::string>& parts, std::size_t width)
{
  std::string line = parts.empty() ? "" : parts.front().substr(0, width);
  for (std::size_t k = 1; k < parts.size() && line.size() + 2 + parts[k].size() <= width; ++k)
    line += "  " + parts[k];
  return line;
}
} // namespace mpm

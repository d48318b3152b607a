#pragma once
// Messages to stderr and DIR/log.txt, and the line that tells how far a run is.

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spdlog
{
class logger;
}

namespace mpm
{
enum class Verbosity
{
  silent,  ///< nothing: of what is only tried
  quiet,   ///< warnings and errors
  normal,  ///< messages and progress too
  verbose, ///< details too
};

/// Where messages go on the screen; warnings and errors go to stderr always.
enum class Screen
{
  messages, ///< all to stderr
  answer,   ///< messages are what was asked for: to stdout, and no live line
};

/// Plain text on the screen, as much as the verbosity lets through; everything in the log file. What is said
/// before the file is open is kept for it.
class Log
{
public:
  explicit Log(Verbosity = Verbosity::normal, Screen = Screen::messages);
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  ~Log();

  /// Appends to the file from here on, so that it tells all runs of a folder.
  void open(const std::filesystem::path& file);

  // Formats as fmt does: log.info("{} particles", count).

  template <class... Args>
  void detail(fmt::format_string<Args...> format, Args&&... args)
  {
    say(Level::detail, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void info(fmt::format_string<Args...> format, Args&&... args)
  {
    say(Level::info, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void warn(fmt::format_string<Args...> format, Args&&... args)
  {
    say(Level::warning, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  void error(fmt::format_string<Args...> format, Args&&... args)
  {
    say(Level::error, fmt::format(format, std::forward<Args>(args)...));
  }
  /// All warnings so far, each once, for the summary.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Puts the warnings of the run's earlier part, which the log file has already, before this part's.
  void recall(const std::vector<std::string>& earlier);

  /// True when stderr is a terminal on which one line may be redrawn.
  bool live() const { return live_; }
  /// Shows as many of the parts, from the first on, as the terminal has room for in one line.
  void redraw(const std::vector<std::string>& parts);
  /// Leaves the live line where it is, and goes on below.
  void keep_line();
  /// To the file, and to stderr unless a live line shows it there.
  void progress(const std::string& line);

private:
  enum class Level
  {
    detail,
    info,
    warning,
    error,
  };
  /// What was said before there was a file, with its time of day.
  struct Kept
  {
    std::chrono::system_clock::time_point when;
    std::string text;
  };
  /// A message to screen, file and, if it is one, the list of warnings.
  void say(Level, const std::string& text);
  void to_screen(const std::string& text, Level level = Level::info);
  void to_file(const std::string& text);

  Verbosity verbosity_;
  bool live_;
  bool line_shown_ = false;                         ///< a live line has to be erased before a message
  std::shared_ptr<spdlog::logger> screen_, answer_; ///< warnings and errors, and the rest
  std::shared_ptr<spdlog::logger> file_;            ///< null until open()
  std::vector<Kept> kept_;
  std::vector<std::string> warnings_;
};

/// What does not change while a stage runs.
struct StageFacts
{
  std::string name; ///< "static", "seismic"
  std::int64_t particles = 0;
  int threads = 1;
  std::int64_t first_step = 0; ///< where this process begins: not 0 after a resume
  double first_fraction = 0;
};

/// How far a run is.
struct Moment
{
  double time = 0;     ///< simulated, s
  double fraction = 0; ///< of the stage done; NaN when it cannot be known
  std::int64_t step = 0;
  double kinetic = 0; ///< J
  double speed = 0;   ///< largest of any particle, m/s
};

/// One live line on a terminal; plain lines now and then otherwise and in the log file.
class Progress
{
public:
  Progress(Log&, StageFacts);
  /// Ask before gathering a `Moment`: true twice a second on a terminal, every 10 s otherwise.
  bool due() const;
  void update(const Moment&);
  /// The last line, whatever the time.
  void finish(const Moment&);

private:
  using Clock = std::chrono::steady_clock;
  std::vector<std::string> parts(const Moment&, Clock::time_point now);

  Log& log_;
  StageFacts stage_;
  Clock::time_point start_, drawn_, printed_; ///< of this process, of the live line, of the plain one
  std::int64_t last_step_;                    ///< when the line was drawn last, for the speed
};

/// "1 h 12 min"
std::string duration_text(double seconds);
/// The parts of a progress line, what matters most first; NaN for what is not known.
std::vector<std::string> progress_parts(const StageFacts&, const Moment&, double steps_per_second,
                                        double seconds_left);
/// As many of the parts, from the first on, as fit into `width` columns (no more than the first is cut for).
std::string line_of(const std::vector<std::string>& parts, std::size_t width);
} // namespace mpm

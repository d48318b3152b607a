// What the screen shows: the live line on a terminal of some width, plain lines elsewhere, answers on stdout.

#include "io/run_folder/log.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
const StageFacts stage{"seismic", 123456, 2, 0, 0};
const Moment moment{12.3456, 0.4249, 123456, 3.14e9, 12.34};

/// What a process writes to a terminal of so many columns.
std::string on_terminal(int columns, const char* term, const std::function<void()>& work)
{
  const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
  int terminal = -1;
  std::fflush(nullptr);
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  REQUIRE(child >= 0);
  if (child == 0)
  {
    setenv("TERM", term, 1);
    work();
    _exit(0);
  }
  std::string text;
  char buffer[4096];
  for (ssize_t n; (n = read(terminal, buffer, sizeof buffer)) > 0;) text.append(buffer, n);
  close(terminal);
  waitpid(child, nullptr, 0);
  return text;
}

void show_progress()
{
  Log log;
  Progress progress(log, stage);
  for (int k = 0; k < 5; ++k) progress.update(moment);
  log.warn("something");
  progress.finish(moment);
}

/// Lines as a terminal leaves them: longest, and how many end with a line feed.
std::pair<std::size_t, int> shape(const std::string& shown)
{
  std::size_t longest = 0, begin = 0;
  int rows = 0;
  for (std::size_t k = 0; k < shown.size(); ++k)
  {
    if (shown[k] != '\r' && shown[k] != '\n') continue;
    const std::string line = shown.substr(begin, k - begin);
    longest = std::max(longest, line.size() - (line.starts_with("\033[K") ? 3 : 0));
    rows += shown[k] == '\n';
    begin = k + 1;
  }
  return {longest, rows};
}
} // namespace

TEST_CASE("the progress line fits the terminal, whatever its width", "[io]")
{
  for (const int columns : {5, 20, 40, 80, 100, 200})
  {
    const std::string shown = on_terminal(columns, "xterm", show_progress);
    INFO(columns << ": " << shown);
    const auto [longest, rows] = shape(shown);
    CHECK(longest < static_cast<std::size_t>(std::max(columns, 19))); // "warning: something" is not cut
    CHECK(rows == 2);                                                 // the warning and the line that is kept
  }
  CHECK_THAT(on_terminal(40, "xterm", show_progress), Contains("seismic 42 %  left "));
  CHECK_THAT(on_terminal(200, "xterm", show_progress), Contains("KE 3.1e9 J"));
  CHECK_THAT(on_terminal(0, "xterm", show_progress), Contains("max v 12 m/s")); // width unknown: 80
}

TEST_CASE("a terminal that cannot erase a line gets plain ones, and few", "[io]")
{
  for (const char* term : {"dumb", ""})
  {
    const std::string shown = on_terminal(80, term, show_progress);
    INFO(shown);
    CHECK_THAT(shown, !Contains("\033"));
    CHECK(shape(shown).second == 2);
  }
}

TEST_CASE("parts of a progress line are left out from the last", "[io]")
{
  const auto parts = progress_parts(stage, moment, 250, 3723);
  const std::string all = line_of(parts, 1000);
  CHECK(all == "seismic 42 %  left 1 h 2 min  t 12.35 s  max v 12 m/s  step 123456  250 steps/s  "
               "64.8 ns/particle-step  KE 3.1e9 J");
  CHECK(line_of(parts, all.size()) == all);
  CHECK(line_of(parts, all.size() - 1) == all.substr(0, all.size() - 12));
  CHECK(line_of(parts, 27) == "seismic 42 %");
  CHECK(line_of(parts, 4) == "seis");
  CHECK(line_of({}, 4).empty());
  CHECK(line_of(progress_parts(stage, {1, NAN, 2, 0, 0}, NAN, NAN), 1000) ==
        "seismic  t 1 s  max v 0 m/s  step 2  KE 0 J");
}

TEST_CASE("an answer goes to stdout, warnings and errors to stderr", "[io]")
{
  const TemporaryFolder folder;
  const auto written = [&](Screen screen)
  {
    std::fflush(nullptr); // the child shall have nothing of what is still to be written
    const pid_t child = fork();
    if (child == 0)
    {
      dup2(open((folder.path() / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDOUT_FILENO);
      dup2(open((folder.path() / "err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
      Log log(Verbosity::normal, screen);
      log.info("told");
      log.warn("careful");
      log.error("wrong");
      _exit(0);
    }
    waitpid(child, nullptr, 0);
    return std::pair{contents(folder.path() / "out"), contents(folder.path() / "err")};
  };
  CHECK(written(Screen::answer) ==
        std::pair<std::string, std::string>{"told\n", "warning: careful\nerror: wrong\n"});
  CHECK(written(Screen::messages) ==
        std::pair<std::string, std::string>{"", "told\nwarning: careful\nerror: wrong\n"});
}

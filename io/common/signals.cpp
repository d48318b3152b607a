// In a handler only few calls are safe (signal-safety(7)): setting a flag, write() and _exit() are.

#include "io/common/signals.hpp"

#include "io/common/error.hpp"

#include <csignal>
#include <initializer_list>
#include <string_view>
#include <unistd.h>

namespace mpm
{
namespace
{
// A signal handler can reach nothing else.
volatile std::sig_atomic_t requested = 0;
volatile std::sig_atomic_t running = 0;

extern "C" void request_interruption(int)
{
  requested = 1;
  if (running) return;
  constexpr std::string_view text = "interrupted before the first step; run the same command again\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(exit_code::interrupted);
}

void handle(int signal, void (*handler)(int))
{
  struct sigaction action = {};
  action.sa_handler = handler;
  // A write that a signal interrupts goes on by itself.
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal)
{
  struct sigaction action = {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}
} // namespace

void install_signal_handlers()
{
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2, SIGXCPU}) handle(signal, request_interruption);
  // nohup sets it to be ignored: a run that was started so outlives its terminal.
  if (!is_ignored(SIGHUP)) handle(SIGHUP, request_interruption);
  for (const int signal : {SIGPIPE, SIGXFSZ}) handle(signal, SIG_IGN);
}

void stop_at_a_step()
{
  running = 1;
}

bool interruption_requested()
{
  return requested != 0;
}
} // namespace mpm

#include "io/signals.hpp"

#include <csignal>
#include <initializer_list>

namespace mpm
{
namespace
{
volatile std::sig_atomic_t requested = 0; // a signal handler can reach nothing else

extern "C" void request_interruption(int)
{
  requested = 1;
}
} // namespace

void install_signal_handlers()
{
  struct sigaction action = {};
  action.sa_handler = request_interruption;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGTERM, SIGUSR1, SIGINT}) sigaction(signal, &action, nullptr);
}

bool interruption_requested()
{
  return requested != 0;
}
} // namespace mpm

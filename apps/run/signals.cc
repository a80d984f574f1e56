#include "apps/run/signals.h"

#include <array>
#include <csignal>
#include <cstddef>

#include <unistd.h>

namespace mergel::apps {

namespace {

volatile std::sig_atomic_t stop_signal = 0, has_int = 0, has_usr1 = 0;

constexpr std::array<int, 5> stopping{SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGUSR2};

void handle(int number, void (*handler)(int))
{
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART; // a write in progress is completed
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

void (*handler_of(int number))(int)
{
  struct sigaction action = {};
  sigaction(number, nullptr, &action);
  return action.sa_handler;
}

extern "C" void remember_checkpoint(int)
{
  has_usr1 = 1;
}

extern "C" void remember_stop(int number)
{
  if (number == SIGINT) {
    if (has_int) { // the user does not want to wait
      std::signal(SIGINT, SIG_DFL);
      std::raise(SIGINT); // as soon as this handler returns
      return;
    }
    has_int = 1;
    constexpr char text[] =
        "\nstopping behind a checkpoint; a second Ctrl-C ends the run at once\n";
    [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, text, sizeof text - 1);
  }
  stop_signal = number;
}

/// Handlers before Signals, in the order of `stopping`.
std::array<void (*)(int), stopping.size()> before{};

/// Whether a signal that was ignored stays so: a shell's background jobs, and nohup. All others are
/// sent by a queue, which means them.
bool may_be_ignored(int number)
{
  return number == SIGINT || number == SIGHUP;
}

/// Of the program at its start.
bool are_interrupts_ignored = false, are_hangups_ignored = false;

void remember_ignored()
{
  if (handler_of(SIGINT) == SIG_IGN) are_interrupts_ignored = true;
  if (handler_of(SIGHUP) == SIG_IGN) are_hangups_ignored = true;
}

/// Libraries take signals as soon as they are loaded: UCX, below Open MPI 5, takes the SIGHUP that
/// nohup had ignored. What stands in this section is called before any of them is initialised.
[[gnu::section(".preinit_array"),
  gnu::used]] void (*const before_libraries)() = remember_ignored;

} // namespace

Signals::Signals()
{
  stop_signal = 0;
  has_int = 0;
  has_usr1 = 0;
  for (std::size_t k = 0; k < stopping.size(); ++k) {
    before[k] = handler_of(stopping[k]);
    if (before[k] != SIG_IGN || !may_be_ignored(stopping[k]))
      handle(stopping[k], remember_stop);
  }
  handle(SIGUSR1, remember_checkpoint);
}

Signals::~Signals()
{
  for (std::size_t k = 0; k < stopping.size(); ++k) handle(stopping[k], before[k]);
  handle(SIGUSR1, SIG_IGN);
}

int Signals::stop() const
{
  return stop_signal;
}
bool Signals::wants_checkpoint() const
{
  return has_usr1 != 0;
}
void Signals::checkpointed()
{
  has_usr1 = 0;
}

std::string name_of_signal(int number)
{
  switch (number) {
  case SIGTERM:
    return "SIGTERM";
  case SIGINT:
    return "SIGINT";
  case SIGHUP:
    return "SIGHUP";
  case SIGXCPU:
    return "SIGXCPU";
  case SIGUSR2:
    return "SIGUSR2";
  default:
    return "signal " + std::to_string(number);
  }
}

void ignore_signals()
{
  remember_ignored();
  ignore_signals_again();
}

void ignore_signals_again()
{
  for (const int number : {SIGUSR1, SIGXFSZ, SIGPIPE}) handle(number, SIG_IGN);
  handle(SIGUSR2, SIG_DFL); // a library may have taken it for an error
  if (are_interrupts_ignored) handle(SIGINT, SIG_IGN);
  if (are_hangups_ignored) handle(SIGHUP, SIG_IGN);
}

} // namespace mergel::apps

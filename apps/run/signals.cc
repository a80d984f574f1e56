#include "apps/run/signals.h"

#include <csignal>

namespace mergel::apps {

namespace {

volatile std::sig_atomic_t has_term = 0, has_usr1 = 0;

extern "C" void remember_signal(int number)
{
  (number == SIGTERM ? has_term : has_usr1) = 1;
}

void handle(int number, void (*handler)(int))
{
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART; // a write in progress is completed
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

} // namespace

Signals::Signals()
{
  has_term = 0;
  has_usr1 = 0;
  handle(SIGTERM, remember_signal);
  handle(SIGUSR1, remember_signal);
}

Signals::~Signals()
{
  handle(SIGTERM, SIG_DFL);
  handle(SIGUSR1, SIG_IGN); // one that comes later has no effect
}

bool Signals::wants_stop() const
{
  return has_term != 0;
}
bool Signals::wants_checkpoint() const
{
  return has_usr1 != 0;
}
void Signals::checkpointed()
{
  has_usr1 = 0;
}

void ignore_signals()
{
  handle(SIGUSR1, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
}

} // namespace mergel::apps

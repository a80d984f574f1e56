/// The signals by which people and queues end runs, recorded until the run checks them.
#pragma once

#include <string>

namespace mergel::apps {

/// While it lives, SIGTERM, SIGINT (Ctrl-C), SIGHUP (the terminal was closed), SIGXCPU (a limit of
/// processor time is reached), SIGUSR2 (sent by queues before their limit) and SIGUSR1 are
/// recorded and do not end the program. A second SIGINT ends it at once. SIGINT and SIGHUP
/// stay ignored where they were (a shell's background job, nohup). The destructor restores
/// what was before; a later SIGUSR1 has no effect.
class Signals {
public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Number of the signal that asks for the end of the run; 0: none was received.
  int stop() const;
  bool wants_checkpoint() const; ///< SIGUSR1 was received since checkpointed()
  void checkpointed();           ///< a checkpoint was written
};

/// "SIGTERM" and so on. @param number as of Signals::stop()
std::string name_of_signal(int number);

/// Call it at the start of a program: a write beyond a file-size limit or into a pipe that
/// nobody reads then fails and does not end the program, and SIGUSR1 has no effect until a
/// Signals object exists.
void ignore_signals();

/// Call it after MPI is initialised: a library below it may have reset what ignore_signals() did,
/// and what nohup did. @pre ignore_signals() was called
void ignore_signals_again();

} // namespace mergel::apps

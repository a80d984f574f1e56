/// SIGTERM and SIGUSR1, recorded until the run checks them.
#pragma once

namespace mergel::apps {

/// While it lives, the two signals are recorded and do not end the program.
class Signals {
public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  bool wants_stop() const;       ///< SIGTERM was received
  bool wants_checkpoint() const; ///< SIGUSR1 was received since checkpointed()
  void checkpointed();           ///< a checkpoint was written
};

/// Call it at the start of a program: a write beyond a file-size limit then fails and does
/// not end the program, and SIGUSR1 has no effect until a Signals object exists.
void ignore_signals();

} // namespace mergel::apps

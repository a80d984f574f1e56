/// SIGTERM and SIGUSR1, remembered until a run looks.
#pragma once

namespace mergel::apps {

/// While it lives the two signals are remembered instead of ending the program.
class Signals {
public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  bool wants_stop() const;       ///< SIGTERM came
  bool wants_checkpoint() const; ///< SIGUSR1 came since the last call of checkpointed()
  void checkpointed();
};

/// For the start of a program: a write beyond a file-size limit fails instead of ending it,
/// and SIGUSR1 does nothing until there is something to write.
void ignore_signals();

} // namespace mergel::apps

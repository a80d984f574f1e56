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

/// A write beyond a file-size limit fails instead of ending the program.
void ignore_file_size_signal();

} // namespace mergel::apps

/// Failures that end a run on all ranks together.
#pragma once

#include "dem/error.h"

#include <string>

namespace mergel {

/// Thrown on every rank with the same message: the first rank prints it, and all ranks end
/// without MPI_Abort (apps/run/run_guard.h).
struct CollectiveFailure : NumericalError {
  using NumericalError::NumericalError;
};

/// A failure of the computed state, such as a number out of the range in which a step is
/// valid. A run from the same state would fail again.
struct Unstable : CollectiveFailure {
  using CollectiveFailure::CollectiveFailure;
};

/// Message of a NumericalError that one of several ranks found. The rank cannot stop alone,
/// because the others would wait for its next message. The message is kept until the next
/// Communicator::agree_on().
class Fault {
public:
  /// Run `task`, unless a message is kept already, and keep the message of a
  /// NumericalError.
  template <class Task>
  void run(Task&& task)
  {
    if (is_set()) return;
    try {
      task();
    } catch (const NumericalError& error) {
      message_ = *error.what() ? error.what() : "unknown failure";
    }
  }
  bool is_set() const { return !message_.empty(); }
  const std::string& message() const { return message_; }

private:
  std::string message_;
};

} // namespace mergel

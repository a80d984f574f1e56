/// A failure that all ranks meet together.
#pragma once

#include "dem/error.h"

#include <string>

namespace mergel {

/// Every rank throws it alike: the first may speak for all, and all can leave in order.
struct CollectiveFailure : NumericalError {
  using NumericalError::NumericalError;
};

/// The run is no longer one of physics: some number has left the range in which its step is
/// sound. From the same state it would fail again.
struct Unstable : CollectiveFailure {
  using CollectiveFailure::CollectiveFailure;
};

/// What one of several ranks meets where it cannot stop alone: the others would wait for it
/// in their next message. It is kept until the ranks speak anyway (Communicator::agree_on).
class Fault {
public:
  /// Run `body`, unless something is wrong already, and keep the words of a NumericalError.
  template <class Body>
  void watch(Body&& body)
  {
    if (is_met()) return;
    try {
      body();
    } catch (const NumericalError& error) {
      words_ = *error.what() ? error.what() : "unknown failure";
    }
  }
  bool is_met() const { return !words_.empty(); }
  const std::string& words() const { return words_; }

private:
  std::string words_;
};

} // namespace mergel

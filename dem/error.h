/// The two errors of a run: of its input, which the user can correct, and of the run.
/// The exit codes (apps/run/run_guard.h) are 1 for InputError, 2 for NumericalError, and 3
/// for anything else (a bug).
#pragma once

#include <stdexcept>
#include <string>

namespace mergel {

/// The user's input is refused. The message says what, value, allowed range, remedy, place.
struct InputError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The run cannot go on: numerical instability, or the system failed (disk full).
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Call f; the id of the particle is put before the message of a NumericalError from it.
template <class F>
decltype(auto) with_particle_id(unsigned long long id, F&& f)
{
  try {
    return f();
  } catch (const NumericalError& e) {
    throw NumericalError("particle " + std::to_string(id) + ": " + e.what());
  }
}

/// Throw InputError with this message unless the condition holds.
inline void require(bool holds, const std::string& message)
{
  if (!holds) throw InputError(message);
}

} // namespace mergel

/// The two faults that a run can meet, by who can mend them. apps/run/run_guard.h turns them
/// into exit codes: InputError 1, NumericalError 2, anything else 3 (a bug).
#pragma once

#include <stdexcept>
#include <string>

namespace mergel {

/// The user's input cannot be used: what, value, allowed, remedy, and where.
struct InputError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The run cannot go on: numerical instability, or the system failed (disk full).
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Call f; a NumericalError from it gets the particle's id in front.
template <class F>
decltype(auto) naming_particle(unsigned long long id, F&& f)
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

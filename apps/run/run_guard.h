/// The outermost catch of a program: prints one message and gives the exit code of a
/// failure.
///
///   0 done   1 bad input   2 numerical or system failure   3 bug
///
/// InputError and std::invalid_argument are 1, NumericalError, std::runtime_error, lack of
/// memory and deal.II's errors are 2, all else is 3.
#pragma once

#include "apps/case/words.h"
#include "dem/collective_failure.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

namespace mergel::apps {

enum ExitCode : int { exit_done = 0, exit_input = 1, exit_failure = 2, exit_bug = 3 };

/// A message for a terminal: printable, and a number of more than 40 digits by its first ones. What
/// goes unstable, and what is mistyped, has hundreds.
inline std::string for_people(const std::string& message)
{
  constexpr std::size_t most = 40, kept = 10;
  std::string text;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t digit = message.find_first_of("0123456789", at);
    text += message.substr(at, digit - at);
    if (digit == std::string::npos) break;
    at = std::min(message.find_first_not_of("0123456789", digit), message.size());
    const std::size_t n = at - digit;
    text += n <= most
                ? message.substr(digit, n)
                : message.substr(digit, kept) + "...(" + std::to_string(n) + " digits)";
  }
  return printable(text);
}

/// What to print, and how the program ends.
struct Verdict {
  int code;
  std::string message;        ///< one line
  bool is_collective = false; ///< the same on all ranks
};

/// Judge the exception that is being handled. @pre called from a catch block
inline Verdict judge_current_exception()
{
  try {
    throw;
  } catch (const std::invalid_argument& error) {
    return {exit_input, in_one_line(error.what()), true};
  } catch (const CollectiveFailure& error) {
    return {exit_failure, in_one_line(error.what()), true};
  } catch (const std::runtime_error& error) {
    return {exit_failure, in_one_line(error.what())};
  } catch (const std::bad_alloc&) {
    return {exit_failure,
            "out of memory. Use fewer particles (a larger S) or a coarser mesh, "
            "or a machine with more memory"};
  } catch (const std::exception& error) {
    const std::string text = in_one_line(error.what());
    // dealii::ExceptionBase is recognised by its text, because this header does not include
    // deal.II. In Release it is thrown by checks of a run, not of the program.
    if (text.find("An error occurred in line <") != std::string::npos &&
        text.find("ExcInternalError") == std::string::npos)
      return {exit_failure, text};
    return {exit_bug, "mergel: internal error: " + text + (text.ends_with('.') ? "" : ".") +
                          " Please report this with the case file and the command line."};
  } catch (...) {
    return {exit_bug, "mergel: internal error: an exception of unknown type. Please report "
                      "this with the case file and the command line."};
  }
}

/// The rank that the launcher gave this process, known before MPI_Init; -1 without a
/// launcher.
inline int launched_rank()
{
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return -1;
}

/// Exit of a program on several ranks: tells whether all ranks leave.
class Exit {
public:
  /// Collective where MPI is initialised.
  Exit()
  {
    int is_up = 0, is_down = 0;
    MPI_Initialized(&is_up);
    MPI_Finalized(&is_down);
    if (!is_up || is_down) return;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &n_ranks_);
    if (n_ranks_ > 1) MPI_Comm_dup(MPI_COMM_WORLD, &waiting_);
  }
  ~Exit()
  {
    if (waiting_ != MPI_COMM_NULL) MPI_Comm_free(&waiting_);
  }
  Exit(const Exit&) = delete;
  Exit& operator=(const Exit&) = delete;

  int rank() const { return rank_; }
  bool is_alone() const { return n_ranks_ == 1; }

  /// Wait for the other ranks. False when one of them has not arrived after `patience`: it
  /// is waiting for a message from this rank.
  bool all_arrive(std::chrono::milliseconds timeout) const
  {
    if (is_alone()) return true;
    MPI_Request all;
    MPI_Ibarrier(waiting_, &all);
    const auto end = std::chrono::steady_clock::now() + timeout;
    for (int have_come = 0;;) {
      MPI_Test(&all, &have_come, MPI_STATUS_IGNORE);
      if (have_come) return true;
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

private:
  MPI_Comm waiting_ = MPI_COMM_NULL; ///< used for nothing else
  int rank_ = 0, n_ranks_ = 1;
};

/// Run `task` and return its exit code, or print the message of its exception on std::cerr
/// and return the exit code of that.
///
/// Call it while MPI is initialised if the task uses MPI: an exception must not unwind past
/// MPI_Finalize. Bad input and a CollectiveFailure are the same on all ranks: rank 0 prints
/// the message and all return. Any other exception, or one that the other ranks do not
/// share within `patience`, would leave them waiting: the rank prints its number and calls
/// MPI_Abort.
template <class Task>
int run_guarded(const Task& task,
                std::chrono::milliseconds timeout = std::chrono::seconds(20))
{
  const Exit exit;
  try {
    return task();
  } catch (...) {
    const Verdict verdict = judge_current_exception();

    int is_up = 0;
    MPI_Initialized(&is_up);
    if (!is_up && launched_rank() >= 0) {
      // The launcher ends the job at the first exit: rank 0 must have printed by then.
      MPI_Init(nullptr, nullptr);
      if (launched_rank() == 0) std::cerr << for_people(verdict.message) << std::endl;
      MPI_Finalize();
      return verdict.code;
    }
    if (exit.is_alone() || (verdict.is_collective && exit.all_arrive(timeout))) {
      if (exit.rank() == 0) std::cerr << for_people(verdict.message) << std::endl;
      return verdict.code;
    }
    std::cerr << "rank " << exit.rank() << ": " << for_people(verdict.message) << std::endl;
    MPI_Abort(MPI_COMM_WORLD, verdict.code);
    return verdict.code;
  }
}

} // namespace mergel::apps

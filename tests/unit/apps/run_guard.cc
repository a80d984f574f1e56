#include "tests/support/catch.h"

#include "apps/run/run_guard.h"

#include "apps/case/words.h"
#include "dem/error.h"

#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

using namespace mergel;
using namespace mergel::apps;

namespace {

/// What run_guarded() returns and prints for a task.
struct Outcome {
  int code;
  std::string printed;
};

template <class Task>
Outcome outcome(const Task& task)
{
  std::ostringstream caught;
  std::streambuf* const before = std::cerr.rdbuf(caught.rdbuf());
  const int code = run_guarded(task);
  std::cerr.rdbuf(before);
  return {code, caught.str()};
}

template <class Error>
Outcome thrown(const Error& error)
{
  return outcome([&]() -> int { throw error; });
}

/// Stands for dealii::ExceptionBase: a std::exception of many lines.
struct ManyLines : std::exception {
  explicit ManyLines(const std::string& name)
      : text(
            "\n----------------------------------------\nAn error occurred in line <9> of "
            "file <a.cc> in function\n    f()\nThe name and call sequence of the exception "
            "was:\n    " +
            name +
            "\nAdditional information: \n    Bad - luck.\n\nStacktrace:\n---\n#0 f()\n")
  {
  }
  const char* what() const noexcept override { return text.c_str(); }
  std::string text;
};

} // namespace

TEST_CASE("The exit code distinguishes bad input, failure and bug", "[unit][apps]")
{
  CHECK(outcome([] { return 0; }).code == 0);
  CHECK(outcome([] { return 0; }).printed.empty());
  CHECK(outcome([] { return 2; }).code == 2);

  CHECK(thrown(InputError("pile.prm:1: bad")).code == 1);
  CHECK(thrown(InputError("pile.prm:1: bad")).printed == "pile.prm:1: bad\n");
  CHECK(thrown(std::invalid_argument("bad")).code == 1);
  CHECK(thrown(NumericalError("a NaN")).code == 2);
  CHECK(thrown(NumericalError("a NaN")).printed == "a NaN\n");
  CHECK(thrown(std::filesystem::filesystem_error("full", std::error_code())).code == 2);
  CHECK(thrown(std::bad_alloc()).code == 2);
  CHECK(thrown(std::out_of_range("at 7")).code == 3);
  CHECK(
      thrown(std::out_of_range("at 7")).printed ==
      "mergel: internal error: at 7. Please report this with the case file and the command "
      "line.\n");
  CHECK(thrown(42).code == 3);
}

TEST_CASE("A library's long message becomes one line without its stack trace",
          "[unit][apps]")
{
  const std::string cause =
      "An error occurred in line <9> of file <a.cc> in function f() The name and call "
      "sequence of the exception was: ExcInternalError() Additional information: Bad - "
      "luck.";
  const auto [code, printed] = thrown(ManyLines("ExcInternalError()"));
  CHECK(code == 3);
  CHECK(printed == "mergel: internal error: " + cause +
                       " Please report this with the case file and the command line.\n");
  CHECK(thrown(ManyLines("SolverControl::NoConvergence(9, 1.)")).code == 2);
  CHECK(thrown(ManyLines("ExcFileNotOpen(name)")).code == 2);
  CHECK(thrown(ManyLines("ExcPETScError(55)")).code == 2);
  CHECK(thrown(InputError("a\nb")).printed == "a b\n");
  CHECK(thrown(InputError("")).printed == "no message\n");
}

TEST_CASE("nearest() finds the word that differs in few letters, or none", "[unit][apps]")
{
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("Pile", "pile") == 0);
  const std::vector<std::string> words = {"pile", "sample", "cone angle"};
  CHECK(nearest("pille", words) == "pile");
  CHECK(nearest("Sampel", words) == "sample");
  CHECK(nearest("cone_angel", words) == "cone angle");
  CHECK(nearest("velocity", words).empty());
  CHECK(nearest("", words).empty());
  CHECK(nearest("xy", {"ab"}).empty()); // two wrong letters of two
}

TEST_CASE("A message has no number of hundreds of digits, and no control characters",
          "[unit][apps]")
{
  CHECK(for_people("overlap 12345678901234567890, at most 1e5") ==
        "overlap 12345678901234567890, at most 1e5");
  CHECK(for_people("term " + std::string(300, '7') + ".5 N") ==
        "term 7777777777...(300 digits).5 N");
  CHECK(for_people("0." + std::string(41, '1')) == "0.1111111111...(41 digits)");
  CHECK(for_people("a\x1b[0m") == "a\\x1b[0m");
  const Outcome end =
      outcome([]() -> int { throw InputError("key \x1b[31m = " + std::string(99, '1')); });
  CHECK(end.printed == "key \\x1b[31m = 1111111111...(99 digits)\n");
}

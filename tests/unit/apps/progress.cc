#include "tests/support/catch.h"

#include "apps/run/progress.h"

#include <algorithm>
#include <iostream>
#include <sstream>
#include <string>

#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

using namespace mergel::apps;
using mergel::match::Contains;
using mergel::match::EndsWith;

namespace {

/// A progress output into a string, with a clock that the test sets.
struct Screen {
  explicit Screen(bool is_terminal) : is_terminal_(is_terminal) {}

  ProgressOutput output()
  {
    return {&text, is_terminal_, 79, [this] { return now; }};
  }
  /// What was written since the last call.
  std::string taken_text()
  {
    const std::string taken = text.str();
    text.str("");
    return taken;
  }

  std::ostringstream text;
  double now = 100.0;

private:
  bool is_terminal_;
};

} // namespace

TEST_CASE("Durations are written in their two largest units", "[unit][apps]")
{
  CHECK(duration_text(-1.0) == "0 s");
  CHECK(duration_text(0.4) == "0 s");
  CHECK(duration_text(59.4) == "59 s");
  CHECK(duration_text(59.6) == "1 min");
  CHECK(duration_text(80.0) == "1 min 20 s");
  CHECK(duration_text(3600.0) == "1 h");
  CHECK(duration_text(2 * 3600.0 + 5 * 60.0 + 7.0) == "2 h 5 min");
  CHECK(duration_text(86400.0 * 3 + 4 * 3600.0) == "3 d 4 h");
}

TEST_CASE("On a terminal one line is rewritten at most five times a second", "[unit][apps]")
{
  Screen screen(true);
  Progress progress("driving", screen.output());
  int n_details = 0;
  const auto detail = [&] {
    ++n_details;
    return std::string("depth 1.15 mm (0.82 D_p)  q_c 12.3 MPa");
  };
  for (int step = 1; step <= 1000; ++step) { // 1 s in steps of 1 ms
    screen.now = 100.0 + 0.001 * step;
    progress.update(1e-5 * step, detail);
  }
  CHECK(n_details >= 4); // 5 but for rounding of the clock
  CHECK(n_details <= 5);
  CHECK(screen.taken_text().find('\n') == std::string::npos);

  screen.now = 120.0;
  progress.update(0.2, detail);
  const std::string line =
      "\rdriving   20.0 %  depth 1.15 mm (0.82 D_p)  q_c 12.3 MPa  1 min 20 s left";
  CHECK(screen.taken_text() == line);

  screen.now = 130.0;
  progress.done("q_c 12.4 MPa"); // the old line is cleared first
  CHECK(screen.taken_text() == "\r" + std::string(line.size() - 1, ' ') +
                                   "\rdriving  done  q_c 12.4 MPa  in 30 s\n");
}

TEST_CASE("A line longer than the terminal is cut, the last one of a phase is not",
          "[unit][apps]")
{
  Screen screen(true);
  Progress progress("driving", screen.output());
  screen.now += 1.0;
  progress.update(0.5, std::string(200, 'x'));
  CHECK(screen.taken_text().size() == 1 + 79);
  progress.done(std::string(200, 'x'));
  CHECK_THAT(screen.taken_text(),
             EndsWith("\rdriving  done  " + std::string(200, 'x') + "  in 1 s\n"));
}

TEST_CASE("A share that falls is shown as the largest until then", "[unit][apps]")
{
  Screen screen(true);
  Progress progress("specimen", screen.output());
  for (const double fraction : {0.09, 0.0, 0.05}) {
    screen.now += 0.5;
    progress.update(fraction);
    CHECK(screen.taken_text() == "\rspecimen    9.0 %");
  }
  screen.now += 0.25;
  progress.update(0.2);
  CHECK(screen.taken_text() == "\rspecimen   20.0 %");
}

TEST_CASE("Without a terminal a plain line is written every ten seconds", "[unit][apps]")
{
  Screen screen(false);
  Progress progress("filling", screen.output());
  for (int step = 1; step <= 350; ++step) { // 35 s of 50 s
    screen.now = 100.0 + 0.1 * step;
    progress.update(step / 500.0, "n 0.52");
  }
  // the lines come at 10, 20 and 30 s, or one step later
  const std::string text = screen.taken_text();
  CHECK(std::count(text.begin(), text.end(), '\n') == 3);
  CHECK(text.find('\r') == std::string::npos);
  CHECK_THAT(text, Contains("filling   20.") && Contains(" %  n 0.52  40 s left\n"));
  progress.done();
  CHECK(screen.taken_text() == "filling  done  in 35 s\n");
}

TEST_CASE("The time left follows a change of the rate", "[unit][apps]")
{
  Screen screen(false);
  Progress progress("driving", screen.output());
  double fraction = 0.0;
  for (int step = 1; step <= 200; ++step) { // 1 %/s for 20 s, then a tenth of it
    screen.now += 1.0;
    fraction += step <= 20 ? 0.01 : 0.001;
    progress.update(fraction);
  }
  // 0.38 done after 200 s: the mean rate would give 326 s, the present one gives 620 s.
  // The old rate still has the weight exp(-180/20), below 1 %.
  const std::string text = screen.taken_text();
  CHECK_THAT(text, EndsWith("driving   38.0 %  10 min 20 s left\n") ||
                       EndsWith("driving   38.0 %  10 min 19 s left\n"));
}

TEST_CASE("No time left is shown in the first seconds, without progress, or at the end",
          "[unit][apps]")
{
  Screen screen(true);
  Progress progress("driving", screen.output());
  screen.now += 1.0;
  progress.update(0.1);
  CHECK(screen.taken_text() == "\rdriving   10.0 %");
  screen.now += 9.0;
  progress.update(1.0);
  CHECK(screen.taken_text() == "\rdriving  100.0 %");

  Progress stuck("driving", screen.output());
  screen.now += 5.0;
  stuck.update(0.0);
  CHECK(screen.taken_text() == "\rdriving    0.0 %");

  // Near an equilibrium a rate that fades would say ever more hours.
  Progress faded("hold", screen.output());
  screen.now += 5.0;
  faded.update(0.9);
  CHECK_THAT(screen.taken_text(), EndsWith("left"));
  screen.now += 9.0;
  faded.update(0.9);
  CHECK_THAT(screen.taken_text(), EndsWith("left"));
  screen.now += 1.0;
  faded.update(0.9);
  CHECK(screen.taken_text().find("left") == std::string::npos);
  screen.now += 1.0;
  faded.update(0.95);
  CHECK_THAT(screen.taken_text(), EndsWith("left"));
}

TEST_CASE("An open line is ended when a phase ends early", "[unit][apps]")
{
  Screen screen(true);
  {
    Progress progress("driving", screen.output());
    screen.now += 1.0;
    progress.update(0.1);
  }
  CHECK(screen.taken_text() == "\rdriving   10.0 %\n");
  { // nothing shown, nothing to end
    Progress progress("driving", screen.output());
  }
  CHECK(screen.taken_text().empty());
}

namespace {

/// What ProgressOutput::standard() finds where standard output is a terminal this wide.
ProgressOutput output_on_terminal(unsigned short columns)
{
  std::cout.flush();
  int ours = -1, theirs = -1;
  winsize window{};
  window.ws_row = 24;
  window.ws_col = columns;
  REQUIRE(openpty(&ours, &theirs, nullptr, nullptr, &window) == 0);
  const int before = dup(STDOUT_FILENO);
  dup2(theirs, STDOUT_FILENO);
  const ProgressOutput found = ProgressOutput::standard();
  dup2(before, STDOUT_FILENO);
  for (const int number : {before, ours, theirs}) close(number);
  return found;
}

} // namespace

TEST_CASE("A terminal without a width, as mpirun gives its ranks, counts as a file",
          "[unit][apps]")
{
  CHECK(output_on_terminal(120).is_terminal);
  CHECK(output_on_terminal(120).columns == 119);
  CHECK_FALSE(output_on_terminal(0).is_terminal);
}

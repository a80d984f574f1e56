#include "apps/help/pager.h"

#include "apps/run/run_guard.h"
#include "dem/io/standard_output.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mergel::apps {

namespace {

/// Lines of the terminal; 0 where standard output is none.
std::size_t lines_of_terminal()
{
  winsize size{};
  if (!::isatty(STDOUT_FILENO) || ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_row;
}

std::string chosen_pager()
{
  const char* const pager = std::getenv("PAGER");
  return pager ? pager : "less";
}

/// Whether the pager could be started.
bool show_by(const std::string& pager, const std::string& text)
{
  // less would clear a short text away, and shows control characters of its own.
  ::setenv("LESS", "FRX", 0);
  std::FILE* const to = ::popen(pager.c_str(), "w");
  if (!to) return false;
  std::fwrite(text.data(), 1, text.size(), to); // one who has read enough closes the pager
  const int status = ::pclose(to);
  constexpr int not_found = 127; // by the shell
  return !(WIFEXITED(status) && WEXITSTATUS(status) == not_found);
}

} // namespace

void show(const std::string& text)
{
  const std::size_t rows = lines_of_terminal();
  const auto n = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  const std::string pager = chosen_pager();
  if (rows > 0 && n >= rows && !pager.empty() && pager != "cat" && show_by(pager, text))
    return;
  std::cout << text;
  if (launched_rank() <= 0) dem::require_printed();
}

} // namespace mergel::apps

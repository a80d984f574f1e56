#include "dem/io/history.h"

#include "dem/error.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <functional>

using namespace mergel;
using namespace mergel::dem;

TEST_CASE("a history file that cannot be created is refused with the system's reason",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const auto refusal = [](const std::filesystem::path& file) -> std::string {
    try {
      History(file, {"time [s]"});
    } catch (const NumericalError& e) {
      return e.what();
    }
    return "created";
  };
  CHECK(refusal(folder.path / "none" / "history.csv")
            .find("history.csv: cannot be written: No such file or directory") !=
        std::string::npos);
  CHECK(refusal(folder.path).find(": cannot be written: Is a directory") !=
        std::string::npos);
  CHECK(refusal(folder.path / "history.csv") == "created");
}

TEST_CASE("a history that another program touches is noticed at the next line, at a mark "
          "and when asked",
          "[unit][dem]")
{
  namespace fs = std::filesystem;
  using Touch = std::function<void(const fs::path&)>;
  using Notice = std::function<void(History&)>;
  const auto copied = [](const fs::path& file) {
    fs::copy_file(file, file.string() + "~");
    fs::rename(file.string() + "~", file); // as an editor saves
  };
  const std::vector<std::pair<const char*, Touch>> touches{
      {": was removed, renamed or moved", [](const fs::path& file) { fs::remove(file); }},
      {": was removed, renamed or moved",
       [](const fs::path& file) { fs::rename(file, file.string() + "~"); }},
      {": was replaced by another file", copied},
      {" another program has changed it",
       [](const fs::path& file) { std::ofstream(file, std::ios::app) << "3\n"; }},
      {" another program has changed it",
       [](const fs::path& file) { std::ofstream out(file); }}};
  const std::vector<Notice> notices{[](History& h) { h.add({2.0}); },
                                    [](History& h) { h.mark(); },
                                    [](History& h) { h.require_in_place(); }};
  for (const auto& [message, touch] : touches)
    for (const Notice& notice : notices) {
      const TemporaryFolder folder;
      const fs::path file = folder.path / "history.csv";
      History history(file, {"time [s]"});
      history.add({1.0});
      for (const Notice& before : notices) before(history); // nothing to notice yet
      touch(file);
      CHECK_THROWS_WITH(notice(history), mergel::match::Contains(file.string()) &&
                                             mergel::match::Contains(message));
    }
}

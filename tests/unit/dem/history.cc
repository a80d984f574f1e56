#include "dem/io/history.h"

#include "dem/error.h"
#include "tests/support/temporary_folder.h"

#include <catch2/catch.hpp>

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

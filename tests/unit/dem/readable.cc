#include "dem/io/readable.h"

#include "dem/error.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

using namespace mergel;
using namespace mergel::dem;
using mergel::match::Contains;
namespace fs = std::filesystem;

TEST_CASE("a file that cannot be read is reported with the system's reason", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "a", link = folder.path / "link",
                 pipe = folder.path / "pipe";
  std::ofstream(file) << "x";
  fs::create_symlink("nowhere", link);
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_FALSE(reading_error(file));
  CHECK(reading_error(folder.path / "none") == std::errc::no_such_file_or_directory);
  CHECK(reading_error(link) == std::errc::no_such_file_or_directory);
  CHECK(reading_error(file / "b") == std::errc::not_a_directory);
  CHECK(reading_error(folder.path) == std::errc::is_a_directory);
  CHECK(reading_error(pipe) == std::errc::invalid_seek); // it is not waited for
  CHECK(reading_error(folder.path / std::string(300, 'x')) == std::errc::filename_too_long);

  CHECK(is_readable(file));
  CHECK_FALSE(is_readable(folder.path / "none"));
  CHECK_THROWS_WITH(is_readable(file / "b"),
                    Contains("a/b: cannot be read: Not a directory. Check the name."));
  CHECK_NOTHROW(require_readable(file));
  CHECK_THROWS_WITH(
      require_readable(folder.path / "none"),
      Contains("none: cannot be read: No such file or directory. Check the name."));
}

TEST_CASE("a folder that cannot be listed is no empty folder", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "a", closed = folder.path / "closed";
  std::ofstream(file) << "x";
  CHECK_FALSE(listing_error(folder.path));
  CHECK_NOTHROW(require_folder(folder.path));
  CHECK_THROWS_WITH(require_folder(folder.path / "none"), Contains("none: is no folder."));
  CHECK_THROWS_WITH(require_folder(file), Contains("a: is no folder."));
  CHECK_THROWS_WITH(require_folder(file / "b"), Contains("b: is no folder."));
  if (::geteuid() != 0) { // root may read everything
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::none);
    CHECK(reading_error(closed / "b") == std::errc::permission_denied);
    CHECK_THROWS_WITH(require_folder(closed),
                      Contains("closed: cannot be read: Permission denied. Check its "
                               "permissions and those of its folders."));
    CHECK_THROWS_WITH(is_readable(closed / "b"), Contains("Permission denied"));
    fs::permissions(closed, fs::perms::owner_all);
  }
}

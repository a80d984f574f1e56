#include "dem/io/shared_file.h"

#include "dem/error.h"
#include "dem/io/seal.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <fstream>

using namespace mergel;
using namespace mergel::dem;
using mergel::match::Contains;
namespace fs = std::filesystem;

namespace {

Writer writer(int rank, const std::string& host)
{
  Writer w;
  w.rank = rank;
  host.copy(w.host, sizeof w.host - 1);
  return w;
}

Piece piece(std::string_view all, std::uint64_t at, std::uint64_t size, int rank)
{
  return {at, size, sum_of_words(all.substr(at, size)), writer(rank, "node12")};
}

} // namespace

TEST_CASE("a file of another run is detected by its mark, a missing one by the system",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path shared = folder.path / "a.partial", stale = folder.path / "old.partial";
  const Writer first = writer(0, "node11"), second = writer(1, "node12");
  std::ofstream(shared) << "rows";
  const FileMark mark = SharedFile(shared, "a", SharedFile::Way::find).mark(first);
  CHECK_NOTHROW(require_mark(shared, "a", mark, second, 0.0));

  fs::copy_file(shared, stale);
  SharedFile(stale, "a", SharedFile::Way::find).remove_mark(mark);
  SharedFile(stale, "a", SharedFile::Way::find).mark(first); // another number
  CHECK_THROWS_WITH(require_mark(stale, "a", mark, second, 0.0),
                    Contains("a: rank 1 on node12 does not see the file that rank 0 on "
                             "node11 has made (it finds another file)") &&
                        Contains("a folder with --output that all nodes share"));
  CHECK_THROWS_WITH(require_mark(folder.path / "none", "a", mark, second, 0.0),
                    Contains("No such file or directory"));
  CHECK_THROWS_AS(SharedFile(folder.path / "none", "a", SharedFile::Way::find),
                  NumericalError);
  CHECK_FALSE(fs::exists(folder.path / "none"));

  SharedFile(shared, "a", SharedFile::Way::find).remove_mark(mark);
  CHECK(bytes_of(shared) == "rows");
}

TEST_CASE("bytes of a rank that did not reach the file are reported with rank and node",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "a.partial";
  const std::string written = "described; rows of the first rank, rows of the second one";
  const std::vector<Piece> pieces{piece(written, 11, 22, 0), piece(written, 35, 19, 1)};
  std::ofstream(file) << written;
  CHECK(read_back(file, "a", pieces) == written);

  std::string lost = written;
  lost.replace(40, 8, 8, '\0'); // a hole
  std::ofstream(file) << lost;
  CHECK_THROWS_WITH(
      read_back(file, "a", pieces),
      Contains("a: what rank 1 on node12 wrote did not arrive (bytes 35 to 54"));
  std::ofstream(file) << written.substr(0, 50);
  CHECK_THROWS_WITH(read_back(file, "a", pieces), Contains("rank 1 on node12"));
  lost = written;
  lost[3] = 'X'; // in no rank's piece
  CHECK(first_wrong(lost, pieces) == nullptr);
  lost[12] = 'X';
  CHECK(first_wrong(lost, pieces) == &pieces[0]);
}

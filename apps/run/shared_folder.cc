#include "apps/run/shared_folder.h"

#include "apps/run/ranks.h"
#include "dem/io/atomic_file.h"
#include "dem/io/shared_file.h"

#include <vector>

namespace mergel::apps {

namespace {

constexpr double timeout = 5.0; ///< longest wait for a slow network file system [s]

} // namespace

void require_shared(const std::filesystem::path& folder)
{
  const dem::Communicator all(MPI_COMM_WORLD);
  if (all.is_alone()) return;
  // The temporary file of resolved.prm: the next run removes one that a killed run left.
  const auto path = dem::temporary_name(folder / "resolved.prm");
  const dem::Writer me = dem::this_writer(all);
  std::vector<dem::FileMark> mark;
  on_first_rank([&] {
    std::filesystem::remove(path);
    mark.push_back(dem::SharedFile(path, folder, dem::SharedFile::Way::make).mark(me));
  });
  mark = all.gather(mark);
  const auto remove = [&] {
    std::error_code ignored;
    if (is_first_rank()) std::filesystem::remove(path, ignored);
  };
  try {
    on_every_rank([&] {
      try {
        dem::require_mark(path, folder, mark.front(), me, timeout);
      } catch (const NumericalError& e) {
        throw InputError(std::string("output folder ") + e.what());
      }
    });
  } catch (...) {
    remove();
    throw;
  }
  remove();
}

} // namespace mergel::apps

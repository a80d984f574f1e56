#include "apps/run/same_input.h"

#include "apps/case/words.h"
#include "apps/run/ranks.h"

#include <algorithm>

namespace mergel::apps {

namespace {

const char* const remedy =
    "Put it into a folder that all nodes share, and do not change it "
    "while the run starts.";

} // namespace

void require_same_case(const CaseFile& file)
{
  const std::string mine = file.resolved_text();
  std::string first = mine;
  share(first);
  on_every_rank([&] {
    if (first == mine) return;
    const auto changes = file.changes_since(first);
    const auto wrong = std::find_if(changes.begin(), changes.end(), [](const auto& c) {
      return !c.was.starts_with('/') || !c.is.starts_with('/');
    });
    if (wrong == changes.end()) return;
    throw InputError(wrong->section + "/" + wrong->key + " is " + shown(wrong->is) +
                     " here and " + shown(wrong->was) +
                     " on the first rank: the case, or a file that it names, is not the "
                     "same for all ranks. " +
                     remedy);
  });
}

void require_same_bytes(std::uint64_t sum, const std::string& name)
{
  std::uint64_t first = sum;
  MPI_Bcast(&first, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  on_every_rank([&] {
    if (first != sum)
      throw InputError(name + ": its content differs from that on the first rank. " +
                       remedy);
  });
}

} // namespace mergel::apps

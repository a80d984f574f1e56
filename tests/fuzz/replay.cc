// Gives every reader its corpus and some thousand mutations of it, the same ones every
// time.
//
//   fuzz_replay CORPUS [MUTATIONS_PER_FILE]
//   fuzz_replay --checkpoint FILE       write a good one, for a corpus
//
// Files good_* must be accepted, all others refused. A mutation may be accepted, or refused
// by an InputError; a sealed file must not be accepted once a byte of it has changed.
#include "tests/fuzz/crafted_checkpoint.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/reader.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include <unistd.h>

using namespace mergel::fuzz;
namespace fs = std::filesystem;

namespace {

struct Entry {
  std::string name, bytes;
};

std::vector<Entry> corpus(const fs::path& folder)
{
  std::vector<Entry> entries;
  for (const fs::directory_entry& e : fs::directory_iterator(folder)) {
    std::ifstream in(e.path(), std::ios::binary);
    entries.push_back({e.path().filename().string(),
                       std::string((std::istreambuf_iterator<char>(in)), {})});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.name < b.name; });
  return entries;
}

/// Gives a reader its files and counts accepted, refused and failed ones.
class Replay {
public:
  Replay(const Reader& reader, const fs::path& corpus_folder, const fs::path& scratch)
      : reader_(reader), entries_(corpus(corpus_folder / reader.name)),
        file_(scratch / reader.name)
  {
    if (entries_.empty()) fail("the corpus", "is empty", "");
  }

  void feed_corpus()
  {
    for (const Entry& e : entries_)
      if (accepts(e.bytes, e.name) != e.name.starts_with("good_"))
        fail(e.name, e.name.starts_with("good_") ? "is refused" : "is accepted", e.bytes);
  }

  void feed_mutations(std::uint64_t n)
  {
    for (std::uint64_t f = 0; f < entries_.size(); ++f)
      for (std::uint64_t k = 0; k < n; ++k) {
        const std::string& other = entries_[(f + k) % entries_.size()].bytes;
        const std::string bytes = mutated(entries_[f].bytes, other, {f, k});
        const std::string name = entries_[f].name + ", mutation " + std::to_string(k);
        if (accepts(bytes, name) && reader_.is_sealed && !is_in_corpus(bytes))
          fail(name, "was changed and is accepted", bytes);
      }
  }

  bool report() const
  {
    std::cout << reader_.name << ": " << entries_.size() << " files, " << n_accepted_
              << " of " << n_fed_ << " accepted, " << n_failed_ << " failed\n";
    return n_failed_ == 0;
  }

private:
  bool accepts(const std::string& bytes, const std::string& name)
  {
    ++n_fed_;
    try {
      const bool is_accepted = reader_.accepts(bytes, file_);
      n_accepted_ += is_accepted;
      return is_accepted;
    } catch (const std::exception& e) {
      fail(name, e.what(), bytes);
    }
    return false;
  }
  bool is_in_corpus(const std::string& bytes) const
  {
    return std::any_of(entries_.begin(), entries_.end(),
                       [&](const Entry& e) { return e.bytes == bytes; });
  }
  void fail(const std::string& name, const std::string& what, const std::string& bytes)
  {
    std::cout << "FAILED  " << reader_.name << ": " << name << ": " << what << '\n';
    const fs::path kept = "fuzz_failed_" + std::string(reader_.name);
    if (n_failed_++ == 0) {
      write_bytes(kept, bytes);
      std::cout << "        its bytes are in " << fs::absolute(kept).string() << '\n';
    }
  }

  const Reader& reader_;
  std::vector<Entry> entries_;
  fs::path file_;
  std::size_t n_fed_ = 0, n_accepted_ = 0, n_failed_ = 0;
};

/// A temporary folder, in memory if possible, removed at the end.
struct Scratch {
  fs::path path;
  Scratch()
  {
    const fs::path memory = "/dev/shm";
    path = (::access(memory.c_str(), W_OK) == 0 ? memory : fs::temp_directory_path()) /
           ("mergel_fuzz_" + std::to_string(::getpid()));
    fs::create_directories(path);
  }
  ~Scratch() { fs::remove_all(path); }
};

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2) {
    std::cerr << "usage: fuzz_replay CORPUS [MUTATIONS_PER_FILE]\n"
                 "       fuzz_replay --checkpoint FILE\n";
    return 1;
  }
  if (argv[1] == std::string("--checkpoint") && argc > 2) {
    write_good_checkpoint(argv[2]);
    return 0;
  }
  const std::uint64_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 500;
  const Scratch scratch;
  bool is_good = true;
  for (const Reader* reader :
       {&case_reader, &table_reader, &sample_reader, &crafted_sample_reader,
        &checkpoint_reader, &crafted_checkpoint_reader}) {
    Replay replay(*reader, argv[1], scratch.path);
    replay.feed_corpus();
    // HDF5 makes each crafted file anew, which takes a hundred times as long.
    replay.feed_mutations(reader->name.starts_with("crafted_") ? n / 10 : n);
    is_good = replay.report() && is_good;
  }
  return is_good ? 0 : 1;
}

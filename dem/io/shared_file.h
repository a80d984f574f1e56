/// A file that all ranks write into at once. The first makes it and puts a mark into it;
/// the others write only where they find that mark, so that a folder which is another one
/// on their node (a disk of its own, an old copy) is told and not filled. What a rank
/// wrote is summed and compared with what the first reads back: what was lost on the way,
/// or is shown as it was before, is told too.
#pragma once

#include "dem/parallel/communicator.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mergel::dem {

/// A rank and where it runs, to be told to others.
struct Writer {
  int rank = 0;
  char host[64] = {};
};
Writer this_writer(const Communicator& comm);
std::string name_of(const Writer& w); ///< "rank 3 on node12"

/// Number that only the file's maker knows, behind the end of the file until it is
/// complete.
struct FileMark {
  std::uint64_t at = 0;    ///< where it stands
  std::uint64_t end = 0;   ///< of the file without it
  std::uint64_t value = 0; ///< no other file has it
  Writer maker;
};

/// Bytes that a rank wrote, and their sum (sum_of_words() of dem/io/seal.h).
struct Piece {
  std::uint64_t at = 0, size = 0, sum = 0;
  Writer writer;
};

/// The open file; closed on every way out. Errors are NumericalErrors with the name that it
/// will bear, and the system's reason.
class SharedFile {
public:
  enum class Way {
    make, ///< there is none of this name
    find  ///< it is there
  };
  SharedFile(const std::filesystem::path& path, const std::filesystem::path& final_name,
             Way way);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Take room on the disk. What there is no room for is refused at once: then nothing need
  /// be written. A file that grows by it is held against the limit on its size too.
  enum class Size { grows, stays };
  void require_room(std::size_t bytes, Size size);

  /// Put a mark behind its end.
  FileMark mark(const Writer& maker);
  /// Take the mark off: the file has its own length again.
  void take_off(const FileMark& mark);

  void write(std::string_view bytes, std::uint64_t at);
  void flush();

private:
  const std::filesystem::path final_name_;
  int number_;
};

/// Refuse a file that does not bear the mark.
/// @param patience how long a slow network file system is waited for [s]
/// @throws NumericalError naming both writers and the remedy
void require_mark(const std::filesystem::path& path,
                  const std::filesystem::path& final_name, const FileMark& mark,
                  const Writer& me, double patience);

/// The first piece that these bytes do not hold; null when all are there.
const Piece* first_wrong(std::string_view bytes, const std::vector<Piece>& pieces);

/// All bytes of the file, which are those that were written; what the system remembers of
/// them is dropped once when they are not.
/// @throws NumericalError naming the writer of what is wrong, and the remedy
std::string read_back(const std::filesystem::path& path,
                      const std::filesystem::path& final_name,
                      const std::vector<Piece>& pieces);

} // namespace mergel::dem

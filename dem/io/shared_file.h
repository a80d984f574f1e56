/// A file that all ranks write at the same time. Rank 0 creates it and writes a mark into
/// it. The other ranks write only if they find that mark: this detects a folder that is a
/// different one on their node (a local disk, an old copy). Rank 0 reads the file back and
/// compares the checksum of what each rank wrote: this detects data that were lost, or are
/// still the old ones.
#pragma once

#include "dem/parallel/communicator.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mergel::dem {

/// A rank and its host, for messages.
struct Writer {
  int rank = 0;
  char host[64] = {};
};
Writer this_writer(const Communicator& comm);
std::string name_of(const Writer& w); ///< "rank 3 on node12"

/// A random number behind the end of the file, until the file is complete.
struct FileMark {
  std::uint64_t at = 0;    ///< its position in the file
  std::uint64_t end = 0;   ///< length of the file without it
  std::uint64_t value = 0; ///< unique to the file
  Writer maker;
};

/// Position and size of the bytes that a rank wrote, and their checksum (sum_of_words() of
/// dem/io/seal.h).
struct Piece {
  std::uint64_t at = 0, size = 0, sum = 0;
  Writer writer;
};

/// The open file, closed by the destructor. Errors are NumericalErrors with its final name
/// and the system's reason.
class SharedFile {
public:
  enum class Way {
    make, ///< create it; it must not exist
    find  ///< open it; it must exist
  };
  SharedFile(const std::filesystem::path& path, const std::filesystem::path& final_name,
             Way way);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Reserve room on the disk, so that a full disk is detected before anything is written.
  /// With Size::grows the limit on the file size is checked too.
  enum class Size { grows, stays };
  void require_room(std::size_t bytes, Size size);

  /// Write a mark behind the end of the file.
  FileMark mark(const Writer& maker);
  /// Remove the mark: the file has its own length again.
  void remove_mark(const FileMark& mark);

  void write(std::string_view bytes, std::uint64_t at);
  void flush();

private:
  const std::filesystem::path final_name_;
  int number_;
};

/// Check that this rank sees the mark in the file.
/// @param patience time to wait for a slow network file system [s]
/// @throws NumericalError naming both writers and the remedy
void require_mark(const std::filesystem::path& path,
                  const std::filesystem::path& final_name, const FileMark& mark,
                  const Writer& me, double timeout);

/// The first piece that differs in these bytes; null if none does.
const Piece* first_wrong(std::string_view bytes, const std::vector<Piece>& pieces);

/// All bytes of the file, after a check that they are those that were written. If they
/// differ, the system's cache of the file is dropped once and they are read again.
/// @throws NumericalError naming the writer of the wrong piece, and the remedy
std::string read_back(const std::filesystem::path& path,
                      const std::filesystem::path& final_name,
                      const std::vector<Piece>& pieces);

} // namespace mergel::dem

#include "dem/io/state/state_file.h"

#include "dem/io/atomic_file.h"
#include "dem/io/hdf5/hdf5.h"
#include "dem/io/hdf5/open_bytes.h"
#include "dem/io/seal.h"
#include "dem/io/shared_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mergel::dem {

namespace fs = std::filesystem;

namespace {

template <class T>
hid_t type_of()
{
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int16_t>) return H5T_NATIVE_INT16;
  if constexpr (std::is_same_v<T, char>) return H5T_NATIVE_CHAR;
}

Seal seal_of(const std::string& kind)
{
  return {kind, "64-bit sum", "take an older one", sum_of_words};
}

/// Collective: each rank gives its failure, "" for none; all ranks throw the first one.
void agree(const Communicator& comm, const std::string& wrong)
{
  const std::vector<char> all = comm.gather(std::vector<char>(
      wrong.c_str(), wrong.c_str() + wrong.size() + (wrong.empty() ? 0 : 1)));
  if (!all.empty()) throw CollectiveFailure(all.data());
}

/// Call f on this rank; all ranks throw when it failed on one.
template <class F>
void all_or_none(const Communicator& comm, F&& f)
{
  std::string wrong;
  try {
    f();
  } catch (const std::exception& e) {
    wrong = e.what();
    if (wrong.empty()) wrong = "unknown failure";
  }
  agree(comm, wrong);
}

constexpr std::size_t room_for_descriptions = 65536;
constexpr double timeout = 5.0; ///< with a slow network file system [s]

/// Create the file with its arrays of `rows` rows each; returns the offset of each array
/// from the start of the file, behind the room of the seal.
std::vector<std::uint64_t> lay_out(const fs::path& path, const std::string& kind,
                                   int version, const State& state,
                                   const std::vector<std::uint64_t>& rows)
{
  using namespace hdf5;
  const Quiet quiet;
  const Handle creation = user_block(seal_room);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT), H5Fclose,
              "create " + path.string());
  write_text_attribute(file, "format", "mergel " + kind);
  write_attribute(file, "version", H5T_NATIVE_INT, &version);
  const Handle early(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "choose a layout");
  H5Pset_layout(early, H5D_CONTIGUOUS);
  H5Pset_alloc_time(early, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(early, H5D_FILL_TIME_NEVER);

  std::vector<std::uint64_t> begin;
  for (const auto& [name, array] : state.arrays()) {
    const hid_t type = std::visit(
        [](const auto& v) {
          return type_of<typename std::decay_t<decltype(v)>::value_type>();
        },
        array.values);
    Handle set = create_array(file, name, type, {rows[begin.size()], array.columns}, early);
    const haddr_t offset = H5Dget_offset(set);
    if (offset == HADDR_UNDEF && rows[begin.size()] > 0)
      throw NumericalError("HDF5 cannot give the offset of " + name);
    begin.push_back(offset == HADDR_UNDEF ? 0 : offset);
    set.finish("write " + name);
  }
  file.finish("write " + path.string());
  return begin;
}

bool is_finite(const std::vector<double>& values)
{
  return std::all_of(values.begin(), values.end(),
                     [](double a) { return std::isfinite(a); });
}

template <class T>
StateArray read_one(hid_t array, const std::string& name)
{
  const hdf5::Shape shape = hdf5::shape_of(array, name, sizeof(T));
  std::vector<T> values(shape.rows * shape.columns);
  if (!values.empty()) hdf5::read_into(array, name, type_of<T>(), values.data());
  if constexpr (std::is_same_v<T, double>)
    if (!is_finite(values)) throw NumericalError(name + " has a number that is not finite");
  return {std::move(values), shape.columns};
}

StateArray read_any(hid_t file, const std::string& name)
{
  using namespace hdf5;
  require_own(file, name);
  const Handle array(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "open " + name);
  require_in_one_piece(array, name);
  const Handle type(H5Dget_type(array), H5Tclose, "read the type of " + name);
  const auto is = [&](hid_t native) { return H5Tequal(type, native) > 0; };
  if (is(H5T_NATIVE_DOUBLE)) return read_one<double>(array, name);
  if (is(H5T_NATIVE_UINT64)) return read_one<std::uint64_t>(array, name);
  if (is(H5T_NATIVE_UINT32)) return read_one<std::uint32_t>(array, name);
  if (is(H5T_NATIVE_INT32)) return read_one<std::int32_t>(array, name);
  if (is(H5T_NATIVE_INT16)) return read_one<std::int16_t>(array, name);
  if (is(H5T_NATIVE_CHAR)) return read_one<char>(array, name);
  throw NumericalError("wrong type of " + name);
}

herr_t add_name(hid_t, const char* name, const H5L_info_t*, void* names)
{
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::string read_format(hid_t file)
{
  using namespace hdf5;
  const Handle a(H5Aopen(file, "format", H5P_DEFAULT), H5Aclose, "find its format");
  require_single(a, "format");
  const Handle type(H5Aget_type(a), H5Tclose, "read its format");
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || size == 0 ||
      size > 1000)
    throw NumericalError("its format is not a text");
  std::string text(size, '\0');
  if (H5Aread(a, type, text.data()) < 0)
    throw NumericalError("HDF5 cannot read its format");
  return text.c_str();
}

} // namespace

void State::refuse(const std::string& name, const std::string& why)
{
  throw InputError("does not fit this program or case: its array " + name + " " + why);
}

const StateArray& State::find(const std::string& name) const
{
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) refuse(name, "is missing");
  return found->second;
}

void write_state(const fs::path& file, const std::string& kind, int version,
                 const State& mine, const Communicator& comm)
{
  all_or_none(comm, [&] {
    for (const auto& [name, array] : mine.arrays())
      if (const auto* values = std::get_if<std::vector<double>>(&array.values);
          values && !is_finite(*values))
        throw NumericalError("the state has a number that is not finite (" + name +
                             "): the run is unstable, and " + file.string() +
                             " was not written");
  });
  const std::size_t n = mine.arrays().size();
  std::vector<std::uint64_t> my_rows;
  for (const auto& [name, array] : mine.arrays()) my_rows.push_back(array.rows());
  const std::vector<std::uint64_t> rows_by_rank = comm.gather(my_rows);
  std::vector<std::uint64_t> rows(n, 0), before(n, 0);
  std::size_t bytes = room_for_descriptions;
  for (std::size_t k = 0; k < rows_by_rank.size(); ++k) {
    rows[k % n] += rows_by_rank[k];
    if (k / n < static_cast<std::size_t>(comm.rank())) before[k % n] += rows_by_rank[k];
  }
  std::size_t place = 0;
  for (const auto& [name, array] : mine.arrays())
    bytes += rows[place++] * array.columns *
             std::visit([](const auto& v) { return sizeof(v[0]); }, array.values);

  const Writer me = this_writer(comm);
  const auto write = [&](const fs::path& path) {
    std::vector<std::uint64_t> begin;
    std::vector<FileMark> mark;
    all_or_none(comm, [&] {
      if (comm.rank() != 0) return;
      fs::remove(path); // left by a run that was killed
      SharedFile(path, file, SharedFile::Way::make)
          .require_room(bytes, SharedFile::Size::grows);
      begin = lay_out(path, kind, version, mine, rows);
      // HDF5 truncates the file and frees the reserved room: reserve it again for the rows.
      SharedFile made(path, file, SharedFile::Way::find);
      made.require_room(bytes, SharedFile::Size::stays);
      if (!comm.is_alone()) mark.push_back(made.mark(me));
    });
    begin = comm.gather(begin);
    mark = comm.gather(mark);
    std::vector<Piece> pieces;
    all_or_none(comm, [&] {
      if (comm.rank() != 0) require_mark(path, file, mark.front(), me, timeout);
      SharedFile out(path, file, SharedFile::Way::find);
      std::size_t k = 0;
      for (const auto& [name, array] : mine.arrays()) {
        const std::uint64_t first = before[k] * array.columns; // first number of this rank
        std::visit(
            [&](const auto& v) {
              const std::size_t size = sizeof(v[0]);
              const std::string_view part{reinterpret_cast<const char*>(v.data()),
                                          size * v.size()};
              const std::uint64_t at = begin[k] + first * size;
              out.write(part, at);
              if (!part.empty() && !comm.is_alone())
                pieces.push_back({at, part.size(), sum_of_words(part), me});
            },
            array.values);
        ++k;
      }
      if (!comm.is_alone()) out.flush();
    });
    pieces = comm.gather(pieces);
    all_or_none(comm, [&] {
      if (comm.rank() != 0) return;
      if (!mark.empty())
        SharedFile(path, file, SharedFile::Way::find).remove_mark(mark.front());
      const std::string block = seal_block(read_back(path, file, pieces), seal_of(kind));
      SharedFile(path, file, SharedFile::Way::find).write(block, 0);
    });
  };
  if (comm.rank() != 0) {
    write(temporary_name(file));
    agree(comm, "");
    return;
  }
  std::string wrong;
  try {
    replace_file(file, write);
  } catch (const CollectiveFailure&) {
    throw; // thrown on all ranks
  } catch (const std::exception& e) {
    wrong = e.what();
  }
  agree(comm, wrong);
}

State read_state(const fs::path& path, const std::string& kind, int version,
                 std::uint64_t* sum)
{
  using namespace hdf5;
  const Quiet quiet;
  const Seal seal = seal_of(kind);
  std::string bytes = unsealed(path, seal, sum);
  State state;
  try {
    const OpenBytes memory(bytes, path); // the bytes of which the checksum was computed
    const hid_t file = memory.file();
    if (const std::string format = read_format(file); format != "mergel " + kind)
      throw InputError("is a " + format + ", not a mergel " + kind);
    int found = 0;
    read_attribute(file, "version", H5T_NATIVE_INT, &found);
    if (found != version)
      throw OtherVersion(
          "has " + kind + " format " + std::to_string(found) +
          (found > version ? ", newer than the " : ", older than the ") +
          std::to_string(version) + " that this program reads: a" +
          (found > version ? " later" : "n earlier") +
          " version of mergel has written it. Finish the run with that version, or begin "
          "it anew");
    std::vector<std::string> names;
    if (H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name, &names) < 0)
      throw NumericalError("HDF5 cannot list its arrays");
    for (const std::string& name : names) {
      StateArray array = read_any(file, name);
      std::visit([&](auto& v) { state.add(name, std::move(v), array.columns); },
                 array.values);
    }
  } catch (const NumericalError& e) {
    throw DamagedFile(std::string("is damaged (") + e.what() + "); " + seal.remedy);
  }
  return state;
}

} // namespace mergel::dem

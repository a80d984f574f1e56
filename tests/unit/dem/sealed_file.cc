#include "dem/io/seal.h"

#include "dem/io/sample_file.h"
#include "dem/io/state/checkpoint.h"
#include "dem/io/state/state_file.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <hdf5.h>

#include <fstream>
#include <utility>

using namespace mergel;
using namespace mergel::dem;
namespace fs = std::filesystem;

namespace {

void write_sample_to(const fs::path& file)
{
  Sample s;
  ParticleState b;
  b.R = 0.04;
  b.S = 3.0;
  b.m = sphere_mass(b.R, 2556.0);
  s.packing.particles.add(b);
  s.recipe = {{"porosity", "0.52"}};
  write_sample(file, s);
}

void write_checkpoint_to(const fs::path& file)
{
  State state(0);
  state.add<double>("numbers", {1.0, 2.0, 3.0});
  write_checkpoint(file, {"0.1.0", "pile", "driving", "set a = 1\n", 7, 0.5},
                   std::move(state), Communicator());
}

std::string refusal_of_sample(const fs::path& file)
{
  try {
    read_sample(file);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

std::string refusal_of_checkpoint(const fs::path& file)
{
  try {
    read_checkpoint(file);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

void write_bytes(const fs::path& file, const std::string& bytes)
{
  std::ofstream(file, std::ios::binary) << bytes;
}

/// As h5py.File(name, "r+") does.
void open_for_writing_and_close(const fs::path& file)
{
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(opened >= 0);
  REQUIRE(H5Fclose(opened) >= 0);
}

const Seal of_sample{"sample", "FNV-1a", "make it again",
                     [](std::string_view bytes) { return fnv_1a(bytes); }};
const Seal of_checkpoint{"checkpoint", "64-bit sum", "take an older one", sum_of_words};

/// The file as earlier versions sealed it: mark and checksum behind the data.
std::string sealed_at_the_end(const std::string& bytes, const Seal& seal)
{
  const std::string data = bytes.substr(seal_room);
  return data + "mergel " + seal.kind + ", " + seal.sum + " " + hexadecimal(seal.of(data));
}

} // namespace

TEST_CASE(
    "a program that opens a sample or a checkpoint for writing and closes it leaves it "
    "as it was",
    "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path sample = folder.path / "s.h5", checkpoint = folder.path / "c.h5";
  write_sample_to(sample);
  write_checkpoint_to(checkpoint);
  for (const fs::path& file : {sample, checkpoint}) {
    const std::string before = bytes_of(file);
    open_for_writing_and_close(file);
    CHECK(bytes_of(file) == before);
  }
  CHECK(refusal_of_sample(sample) == "read");
  CHECK(refusal_of_checkpoint(checkpoint) == "read");
}

TEST_CASE("a sample that another program has changed is refused", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "s.h5";
  write_sample_to(file);
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t R = H5Dopen2(opened, "R", H5P_DEFAULT);
  const double larger = 0.05;
  REQUIRE(H5Dwrite(R, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &larger) >= 0);
  H5Dclose(R);
  H5Fclose(opened);
  CHECK(refusal_of_sample(file).find("is damaged (its checksum does not match)") == 0);
}

TEST_CASE("the seal says in words what the file is", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "s.h5";
  write_sample_to(file);
  const std::string bytes = bytes_of(file);
  const std::string block = bytes.substr(0, seal_room), data = bytes.substr(seal_room);
  const std::string words = "mergel sample, FNV-1a " + hexadecimal(fnv_1a(data)) + ", " +
                            std::to_string(data.size()) + " bytes behind these 512\n";
  CHECK(block == words + std::string(seal_room - words.size(), '\0'));
  CHECK(begins_as_sealed(file, "sample"));
  CHECK_FALSE(begins_as_sealed(file, "checkpoint"));
  CHECK_FALSE(begins_as_sealed(folder.path / "none.h5", "sample"));
}

TEST_CASE("files with the seal at their end, of earlier versions, are read and are guarded "
          "as before",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "a.h5";
  write_sample_to(file);
  const std::string sample = sealed_at_the_end(bytes_of(file), of_sample);
  write_checkpoint_to(file);
  const std::string checkpoint = sealed_at_the_end(bytes_of(file), of_checkpoint);

  write_bytes(file, sample);
  CHECK(refusal_of_sample(file) == "read");
  CHECK(refusal_of_checkpoint(file).find("is no checkpoint, or is truncated") == 0);
  write_bytes(file, checkpoint);
  CHECK(refusal_of_checkpoint(file) == "read");
  CHECK(begins_as_sealed(file, "checkpoint"));
  for (std::string changed : {sample, checkpoint}) {
    changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 0x10);
    write_bytes(file, changed);
    CHECK(refusal_of_sample(file) != "read");
    CHECK(refusal_of_checkpoint(file) != "read");
  }
  // What such a program cut off is missed.
  write_bytes(file, sample);
  open_for_writing_and_close(file);
  CHECK(refusal_of_sample(file).find("is no sample, or is truncated") == 0);
}

TEST_CASE("bytes lost or added at the end of a sealed file, or a seal alone, are refused",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "s.h5";
  write_sample_to(file);
  const std::string good = bytes_of(file);
  for (const std::size_t n : {good.size() - 1, good.size() / 2, seal_room + 1, seal_room,
                              seal_room - 1, std::size_t{100}}) {
    write_bytes(file, good.substr(0, n));
    CHECK(refusal_of_sample(file).find("is no sample, or is truncated") == 0);
  }
  write_bytes(file, good + '\0');
  CHECK(refusal_of_sample(file).find("is damaged (its checksum does not match)") == 0);
  write_bytes(file, "");
  CHECK(refusal_of_sample(file).find("is no sample: it is not an HDF5 file") == 0);
}

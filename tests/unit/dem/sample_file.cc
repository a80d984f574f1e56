#include "dem/io/sample_file.h"

#include "dem/io/seal.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <fstream>

using namespace mergel;
using namespace mergel::dem;
namespace fs = std::filesystem;

namespace {

Sample three_particles()
{
  Sample s;
  for (int k = 0; k < 3; ++k) {
    ParticleState b;
    b.x = Vec3(0.1 * k, 1.0 / 3.0, -0.7);
    b.R = 0.04 + 0.001 * k;
    b.S = 3.0 + k;
    b.m = sphere_mass(b.R, 2556.0);
    s.packing.particles.add(b);
  }
  s.packing.porosity = 0.52;
  s.packing.whole_porosity = 0.54;
  s.packing.overlap = 1e-4;
  s.packing.pressure = 5.1e3;
  s.packing.friction = 0.025;
  s.packing.cell.size = {0.3, 1.0, 2.0 / 3.0};
  s.bonding = {{{0, 1, {}}, {1, 2, {-1, 0, 2}}}, 1.5e-5};
  s.recipe = {{"porosity", "0.52"}, {"seed", "1"}};
  return s;
}

std::string refusal(const fs::path& file)
{
  try {
    read_sample(file);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

void overwrite_byte(const fs::path& file, std::streamoff at, char value)
{
  std::fstream f(file, std::ios::in | std::ios::out | std::ios::binary);
  f.seekp(at);
  f.put(value);
}

} // namespace

TEST_CASE("a sample is read back bit for bit", "[unit][dem]")
{
  const TemporaryFolder folder;
  const Sample s = three_particles();
  write_sample(folder.path / "s.h5", s);
  const Sample r = read_sample(folder.path / "s.h5");
  REQUIRE(r.packing.particles.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const ParticleState &a = s.packing.particles.state[i],
                        &b = r.packing.particles.state[i];
    CHECK(a.x == b.x);
    CHECK(a.R == b.R);
    CHECK(a.S == b.S);
    CHECK(a.m == b.m);
    CHECK(r.packing.particles.id[i] == i);
  }
  CHECK(r.bonding.pairs == s.bonding.pairs);
  CHECK(r.bonding.limit == s.bonding.limit);
  CHECK(r.packing.porosity == s.packing.porosity);
  CHECK(r.packing.pressure == s.packing.pressure);
  CHECK(r.packing.friction == s.packing.friction);
  CHECK(r.packing.cell.size == s.packing.cell.size);
  CHECK(r.recipe == s.recipe);
  CHECK(difference(r, s.recipe).empty());
}

TEST_CASE("a sample of another recipe is reported with its first difference", "[unit][dem]")
{
  const Sample s = three_particles();
  CHECK(difference(s, {{"porosity", "0.5"}, {"seed", "2"}}) ==
        "was made with porosity = 0.52, the case asks for 0.5");
  CHECK(difference(s, {{"porosity", "0.52"}}) ==
        "was made by another version of the program");
}

TEST_CASE("a file that is not a sample is refused with the reason", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "s.h5";
  CHECK(refusal(file) == "there is no such file");
  CHECK(refusal(folder.path) == "is not a file");
  CHECK(refusal(folder.path / std::string(300, 'x')) ==
        "cannot be read: File name too long. Give a shorter name");

  std::ofstream(file) << "time [s],depth [m]\n";
  CHECK(refusal(file).find("is no sample: it is not an HDF5 file") == 0);

  write_sample(file, three_particles());
  fs::resize_file(file, fs::file_size(file) / 2);
  CHECK(refusal(file).find("is no sample, or is truncated") == 0);
}

// HDF5 reads beyond its own memory on some of these files: they must never reach it.
TEST_CASE("a sample with one changed byte is refused, wherever the byte is", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "s.h5";
  write_sample(file, three_particles());
  std::ifstream in(file, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  in.close();

  std::size_t n_tried = 0, n_refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    overwrite_byte(file, static_cast<std::streamoff>(at),
                   static_cast<char>(good[at] ^ 0x41));
    ++n_tried;
    n_refused += refusal(file) != "read";
    overwrite_byte(file, static_cast<std::streamoff>(at), good[at]);
  }
  CHECK(n_tried > 5000);
  CHECK(n_refused == n_tried);
  CHECK(refusal(file) == "read");
}

TEST_CASE("an HDF5 file without the seal is refused", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "s.h5";
  write_sample(file, three_particles());
  const std::string good = bytes_of(file);
  const std::string data = good.substr(seal_room); // HDF5 opens it in both places
  for (const std::string& bytes : {data, std::string(seal_room, '\0') + data}) {
    std::ofstream(file, std::ios::binary) << bytes;
    CHECK(refusal(file).find("is no sample, or is truncated") == 0);
  }
}

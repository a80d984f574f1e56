#include "dem/io/state/checkpoint.h"
#include "dem/assembly/distribute.h"
#include "dem/assembly/timestep.h"
#include "dem/io/sample_file.h"
#include "dem/io/seal.h"
#include "dem/io/state/assembly_state.h"
#include "tests/support/assembly_with_everything.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <cstring>
#include <fstream>
#include <limits>

using namespace mergel;
using namespace mergel::dem;
using mergel::dem::test::assembly_with_everything;
namespace fs = std::filesystem;

namespace {

void step(Assembly& assembly)
{
  test::step_with_everything(assembly, 1e-6);
}

State kept(const Assembly& assembly)
{
  State state(0);
  save(state, assembly);
  return state;
}

/// Name of the first array that differs in its bytes; empty if none does.
std::string first_difference(const State& a, const State& b)
{
  for (const auto& [name, array] : a.arrays()) {
    const auto other = b.arrays().find(name);
    if (other == b.arrays().end() || other->second.columns != array.columns) return name;
    const bool same = std::visit(
        [&](const auto& v) {
          const auto* w = std::get_if<std::decay_t<decltype(v)>>(&other->second.values);
          return w && w->size() == v.size() &&
                 (v.empty() ||
                  std::memcmp(v.data(), w->data(), v.size() * sizeof(v[0])) == 0);
        },
        array.values);
    if (!same) return name;
  }
  return a.arrays().size() == b.arrays().size() ? "" : "number of arrays";
}

CheckpointLabel label()
{
  return {"0.1.0", "pile", "driving", "subsection A\n  set b = 1\nend\n", 123456, 0.25};
}

void write(const fs::path& file)
{
  write_checkpoint(file, label(), kept(assembly_with_everything()), Communicator());
}

std::string refusal(const fs::path& file)
{
  try {
    read_checkpoint(file);
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

TEST_CASE("an assembly continues from a checkpoint with the same bits", "[unit][dem]")
{
  const TemporaryFolder folder;
  Assembly assembly = assembly_with_everything();
  for (int k = 0; k < 100; ++k) step(assembly);
  const fs::path file = folder.path / checkpoint_name(100);
  write_checkpoint(file, label(), kept(assembly), Communicator());
  for (int k = 0; k < 100; ++k) step(assembly);

  Checkpoint c = read_checkpoint(file);
  CHECK(c.label.job == "pile");
  CHECK(c.label.phase == "driving");
  CHECK(c.label.case_text == label().case_text);
  CHECK(c.label.step == 123456);
  CHECK(c.label.time == 0.25);
  // Into an assembly of the same case in its initial state.
  Assembly other = assembly_with_everything();
  load(c.state, other);
  rebuild_lists(other);
  for (int k = 0; k < 100; ++k) step(other);
  CHECK(first_difference(kept(assembly), kept(other)).empty());

  // Every kind of history took part.
  CHECK(assembly.rigid_walls.front().contacts.front().f_s.norm() > 0.0);
  CHECK(assembly.walls.front().contacts.size() == 1);
  CHECK(assembly.walls.front().bonds.front().V.norm() > 0.0);
  CHECK(assembly.rigid_walls.back().force[Revolution::tip].z.value() > 0.0);
  CHECK(assembly.contacts.shear.size() > 0);
  CHECK(contact_shear_of(assembly.bonds, 0).norm() > 0.0);
  CHECK(stored_energy(assembly.mirrors.front(), assembly.material, assembly.particles)
            .value() > 0.0);
}

TEST_CASE("a Hertz contact continues with the same bits and the same stable step",
          "[unit][dem]")
{
  // Its stiffness depends on the overlaps, which follow from the positions.
  const HertzMaterial grains{2e9, 0.2, 0.3};
  Assembly assembly = assembly_with_everything(grains);
  for (int k = 0; k < 100; ++k) step(assembly);
  for (const RigidWall& w : assembly.rigid_walls) CHECK(w.contacts.front().overlap > 0.0);
  CHECK(assembly.walls.front().contacts.front().overlap > 0.0);
  State state = kept(assembly);
  Assembly other = assembly_with_everything(grains);
  load(state, other);
  rebuild_lists(other);
  CHECK(stable_time_step(other, {}) == stable_time_step(assembly, {}));
  Assembly deeper = other;
  for (RigidWall& w : deeper.rigid_walls) w.x.z() += 3.0 * w.contacts.front().overlap;
  CHECK(stable_time_step(deeper, {}) < stable_time_step(other, {}));
  for (int k = 0; k < 100; ++k) step(assembly);
  for (int k = 0; k < 100; ++k) step(other);
  CHECK(first_difference(kept(assembly), kept(other)).empty());
}

TEST_CASE("a file that is not a checkpoint is refused with the reason", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "c.h5";
  CHECK(refusal(file) == "there is no such file");
  CHECK(refusal(folder.path) == "is not a file");
  std::ofstream(file) << "time [s],depth [m]\n";
  CHECK(refusal(file).find("is no checkpoint: it is not an HDF5 file") == 0);
  write(file);
  CHECK(refusal(file) == "read");
  fs::resize_file(file, fs::file_size(file) - 1);
  CHECK(refusal(file).find("is no checkpoint, or is truncated") == 0);
  write_sample(file, Sample{});
  CHECK(refusal(file).find("is no checkpoint, or is truncated") == 0);
  write_state(file, "checkpoint", 5, State(0), Communicator());
  CHECK(
      refusal(file) ==
      "has checkpoint format 5, newer than the 4 that this program reads: a later version "
      "of mergel has written it. Finish the run with that version, or begin it anew");
  write_state(file, "checkpoint", 3, State(0), Communicator());
  CHECK(refusal(file) ==
        "has checkpoint format 3, older than the 4 that this program reads: an earlier "
        "version of mergel has written it. Finish the run with that version, or begin it "
        "anew");
  write_state(file, "checkpoint", 4, State(0), Communicator());
  CHECK(refusal(file).find("does not fit this program or case: its array label_") == 0);
}

TEST_CASE("a sealed checkpoint with a NaN counts as damaged, not as another program's",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / checkpoint_name(1);
  CheckpointLabel rare = label();
  rare.time = 0.12345678; // occurs once in the file
  write_checkpoint(file, rare, kept(assembly_with_everything()), Communicator());
  const Seal seal{"checkpoint", "64-bit sum", "", sum_of_words};
  std::string bytes = unsealed(file, seal);
  const auto in_bytes = [](double value) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    return text;
  };
  const auto at = bytes.rfind(in_bytes(rare.time));
  REQUIRE(at != std::string::npos);
  bytes.replace(at, sizeof(double), in_bytes(std::numeric_limits<double>::quiet_NaN()));
  std::ofstream(file, std::ios::binary) << sealed(bytes, seal);
  CHECK(refusal(file).find("is damaged (label_time has a number that is not finite)") == 0);
  CHECK(newest_checkpoint(folder.path).refused.front().is_damaged);
}

TEST_CASE("a checkpoint with one changed byte is refused, wherever the byte is",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "c.h5";
  write(file);
  std::ifstream in(file, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  in.close();
  std::size_t n_tried = 0, n_refused = 0;
  for (std::size_t at = 0; at < good.size(); at += 31) {
    overwrite_byte(file, static_cast<std::streamoff>(at),
                   static_cast<char>(good[at] ^ 0x80));
    ++n_tried;
    n_refused += refusal(file) != "read";
    overwrite_byte(file, static_cast<std::streamoff>(at), good[at]);
  }
  CHECK(n_tried > 300);
  CHECK(n_refused == n_tried);
  CHECK(refusal(file) == "read");
}

TEST_CASE("the sum of words detects two flipped signs and zeros at the end", "[unit][dem]")
{
  std::string bytes(64, '\0');
  const auto sum = [&] { return sum_of_words(bytes); };
  const std::uint64_t plain = sum();
  bytes[7] = bytes[15] = static_cast<char>(0x80); // both top bits: FNV-1a of words stays
  CHECK(sum() != plain);
  bytes.assign(65, '\0');
  CHECK(sum() != plain);
}

TEST_CASE("arrays that do not fit each other are refused by name", "[unit][dem]")
{
  const Assembly assembly = assembly_with_everything();
  const auto refusal_with = [&](const auto& change) {
    State state = kept(assembly);
    change(state);
    Assembly other = assembly_with_everything();
    try {
      load(state, other);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("loaded");
  };
  using mergel::match::Contains;
  CHECK(refusal_with([](State&) {}) == "loaded");
  CHECK_THAT(refusal_with([](State& s) {
               s.add<std::uint32_t>("bond_pairs", {0, 1, 1, 2, 2, 6}, 2);
             }),
             Contains("bond_pairs names particles that cannot be a pair"));
  CHECK_THAT(refusal_with([](State& s) {
               s.add<std::uint32_t>("bond_pairs", {0, 1, 1, 2, 1, 2}, 2);
             }),
             Contains("bond_pairs has an entry twice"));
  CHECK_THAT(refusal_with([](State& s) {
               s.add<std::uint32_t>("grains", {0, 1, 2, 3, 4, 7});
             }),
             Contains("grains is not complete"));
  CHECK_THAT(refusal_with([](State& s) {
               s.add<std::int32_t>("grain_bonds", {1, 1});
             }),
             Contains("grain_bonds has 2 rows, not 6"));
  CHECK_THAT(
      refusal_with([](State& s) { s.add_common<std::uint64_t>("rigid_walls", {3}); }),
      Contains("rigid_walls counts 3, the case has 2"));
  CHECK_THAT(
      refusal_with([](State& s) { s.add<std::int32_t>("wall0_bond_triangles", {1}); }),
      Contains("names a triangle that does not exist"));
}

TEST_CASE("a state with a NaN is never written", "[unit][dem]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "c.h5";
  write(file);
  Assembly assembly = assembly_with_everything();
  assembly.particles.state[2].v.x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(write_checkpoint(file, label(), kept(assembly), Communicator()),
                  CollectiveFailure);
  CHECK(refusal(file) == "read"); // the one before
}

TEST_CASE("the newest checkpoint that can be read is found, and the newer ones are named",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  CHECK(newest_checkpoint(folder.path / "none").file.empty());
  for (const std::uint64_t step : {900u, 1000u, 20000u})
    write(folder.path / checkpoint_name(step));
  fs::resize_file(folder.path / checkpoint_name(20000), 5000);
  const FoundCheckpoint found = newest_checkpoint(folder.path);
  CHECK(found.file == folder.path / checkpoint_name(1000));
  REQUIRE(found.refused.size() == 1);
  CHECK(found.refused.front().file == folder.path / checkpoint_name(20000));
  CHECK(found.refused.front().reason.find("is no checkpoint, or is") == 0);
  CHECK(found.refused.front().is_damaged);
  // A complete file of another format is distinguished from a damaged one.
  write_state(folder.path / checkpoint_name(20000), "checkpoint", 2, State(0),
              Communicator());
  const RefusedCheckpoint other = newest_checkpoint(folder.path).refused.front();
  CHECK_FALSE(other.is_damaged);
  CHECK(other.is_of_other_version);
}

TEST_CASE("the checkpoint just written is kept beside left-over files of later steps",
          "[unit][dem]")
{
  const TemporaryFolder folder;
  for (const std::uint64_t step : {100u, 200u, 300u, 20000u, 30000u})
    std::ofstream(folder.path / checkpoint_name(step)) << "x";
  keep_newest(folder.path / checkpoint_name(300), 2);
  std::vector<fs::path> kept;
  for (const std::uint64_t step : {30000u, 20000u, 300u, 200u})
    kept.push_back(folder.path / checkpoint_name(step));
  CHECK(checkpoints_in(folder.path) == kept);
}

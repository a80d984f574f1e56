// Checkpoints as bytes, and HDF5 files with a correct checksum and arbitrary contents. Each
// is loaded into an assembly, which then runs a step.
#include "tests/fuzz/reader.h"

#include "dem/error.h"
#include "dem/io/state/assembly_state.h"
#include "dem/io/state/checkpoint.h"
#include "tests/fuzz/crafted_checkpoint.h"
#include "tests/support/assembly_with_everything.h"

#include <cmath>

namespace mergel::fuzz {

namespace {

void check(const dem::Assembly& assembly)
{
  const std::size_t n = assembly.particles.size();
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  for (const dem::ParticleState& b : assembly.particles.state)
    promise(b.x.allFinite() && b.v.allFinite() && is_positive(b.R) && is_positive(b.m) &&
                is_positive(b.S),
            "a particle with impossible values");
  const auto check_pairs = [n](const std::vector<dem::Pair>& pairs) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      promise(pairs[k].i < pairs[k].j && pairs[k].j < n,
              "a pair without its two particles");
      promise(k == 0 || pairs[k - 1] < pairs[k], "pairs out of order, or twice");
    }
  };
  check_pairs(assembly.bonds.pairs);
  check_pairs(assembly.contacts.pairs);
  promise(assembly.contacts.shear.size() == assembly.contacts.pairs.size(),
          "a contact without its shear");
  for (const dem::Wall& wall : assembly.walls)
    for (const dem::WallBond& b : wall.bonds)
      promise(b.particle < n && b.anchor.triangle >= 0 &&
                  static_cast<std::size_t>(b.anchor.triangle) <
                      wall.topology.triangles.size(),
              "a bond without its particle or triangle");
}

/// Numbers that are each possible but do not fit together may stop the run with an error.
void go_on(dem::Assembly& assembly)
{
  try {
    dem::rebuild_lists(assembly);
    dem::test::step_with_everything(assembly, 1e-6);
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
}

/// Whether the state can be loaded into this assembly. @throws BrokenPromise
bool is_loaded(dem::State state)
{
  static const dem::Assembly whole = dem::test::assembly_with_everything();
  dem::Assembly assembly = whole;
  try {
    dem::load(state, assembly);
  } catch (const InputError&) {
    return false;
  }
  check(assembly);
  go_on(assembly);
  return true;
}

} // namespace

/// A file of an older program may not fit the assembly; it is still accepted as a
/// checkpoint.
const Reader checkpoint_reader{
    "checkpoint", true, [](const std::string& bytes, const std::filesystem::path& file) {
      write_bytes(file, bytes);
      try {
        is_loaded(dem::read_checkpoint(file).state);
      } catch (const InputError&) {
        return false;
      }
      return true;
    }};

const Reader crafted_checkpoint_reader{
    "crafted_checkpoint", false,
    [](const std::string& bytes, const std::filesystem::path& file) {
      craft_checkpoint(file, bytes);
      try {
        return is_loaded(dem::read_checkpoint(file).state);
      } catch (const InputError&) {
        return false;
      }
    }};

} // namespace mergel::fuzz

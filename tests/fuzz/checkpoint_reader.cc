// Checkpoints as they are, and with a right sum over whatever HDF5 can hold; each is taken into
// a rock, and what is taken goes on.
#include "tests/fuzz/reader.h"

#include "dem/error.h"
#include "dem/io/state/assembly_state.h"
#include "dem/io/state/checkpoint.h"
#include "tests/fuzz/crafted_checkpoint.h"
#include "tests/support/rock_with_everything.h"

#include <cmath>

namespace mergel::fuzz {

namespace {

void check(const dem::Rock& rock)
{
  const std::size_t n = rock.particles.size();
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  for (const dem::Body& b : rock.particles.body)
    promise(b.x.allFinite() && b.v.allFinite() && is_positive(b.R) && is_positive(b.m) &&
                is_positive(b.S),
            "a grain that cannot be");
  const auto check_pairs = [n](const std::vector<dem::Pair>& pairs) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      promise(pairs[k].i < pairs[k].j && pairs[k].j < n, "a pair without its two grains");
      promise(k == 0 || pairs[k - 1] < pairs[k], "pairs out of order, or twice");
    }
  };
  check_pairs(rock.bonds.pairs);
  check_pairs(rock.contacts.pairs);
  promise(rock.contacts.shear.size() == rock.contacts.pairs.size(),
          "a contact without its shear");
  for (const dem::Wall& wall : rock.walls)
    for (const dem::WallBond& b : wall.bonds)
      promise(b.particle < n && b.anchor.triangle >= 0 &&
                  static_cast<std::size_t>(b.anchor.triangle) <
                      wall.topology.triangles.size(),
              "a bond without its grain or triangle");
}

/// Numbers that are possible each and impossible together may stop the run, by an Error.
void go_on(dem::Rock& rock)
{
  try {
    dem::rebuild_lists(rock);
    dem::test::step_with_everything(rock, 1e-6);
  } catch (const InputError&) {
  } catch (const NumericalError&) {
  }
}

/// Whether the state is one of this rock. @throws BrokenPromise
bool is_taken(dem::State state)
{
  static const dem::Rock whole = dem::test::rock_with_everything();
  dem::Rock rock = whole;
  try {
    dem::take(state, rock);
  } catch (const InputError&) {
    return false;
  }
  check(rock);
  go_on(rock);
  return true;
}

} // namespace

/// A file of an older program may not fit the rock, and is a checkpoint all the same.
const Reader checkpoint_reader{
    "checkpoint", true, [](const std::string& bytes, const std::filesystem::path& file) {
      write_bytes(file, bytes);
      try {
        is_taken(dem::read_checkpoint(file).state);
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
        return is_taken(dem::read_checkpoint(file).state);
      } catch (const InputError&) {
        return false;
      }
    }};

} // namespace mergel::fuzz

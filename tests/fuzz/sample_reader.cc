// Samples as bytes, and HDF5 files with a correct checksum and arbitrary contents.
#include "tests/fuzz/reader.h"

#include "dem/error.h"
#include "dem/io/sample_file.h"
#include "tests/fuzz/crafted_sample.h"

#include <cmath>

namespace mergel::fuzz {

namespace {

void check(const dem::Sample& s)
{
  const auto& particles = s.packing.particles.state;
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  for (const dem::ParticleState& b : particles)
    promise(b.x.allFinite() && is_positive(b.R) && is_positive(b.m) && is_positive(b.S),
            "a particle with impossible values");
  for (std::size_t k = 0; k < s.bonding.pairs.size(); ++k) {
    const dem::Pair& q = s.bonding.pairs[k];
    promise(q.i < q.j && q.j < particles.size(), "a bond without its two particles");
    promise(k == 0 || s.bonding.pairs[k - 1] < q, "bonds out of order, or twice");
  }
}

bool is_accepted(const std::filesystem::path& file)
{
  try {
    check(dem::read_sample(file));
  } catch (const InputError&) {
    return false;
  }
  return true;
}

} // namespace

const Reader sample_reader{"sample", true,
                           [](const std::string& bytes, const std::filesystem::path& file) {
                             write_bytes(file, bytes);
                             return is_accepted(file);
                           }};

const Reader crafted_sample_reader{
    "crafted_sample", false,
    [](const std::string& bytes, const std::filesystem::path& file) {
      craft_sample(file, bytes);
      return is_accepted(file);
    }};

} // namespace mergel::fuzz

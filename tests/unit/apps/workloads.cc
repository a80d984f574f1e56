#include "tests/support/catch.h"

#include "apps/bench/workloads.h"

#include "dem/assembly/energy_balance.h"
#include "dem/error.h"
#include "dem/pairs/pair_sums.h"

#include <algorithm>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

WorkloadSpec small(Workload workload, std::size_t n, std::uint64_t seed = 1)
{
  WorkloadSpec spec;
  spec.workload = workload;
  spec.n_particles = n;
  spec.seed = seed;
  return spec;
}

double per_particle(std::size_t n, const dem::Assembly& assembly)
{
  return static_cast<double>(n) / static_cast<double>(assembly.particles.size());
}

void run(WorkingAssembly& working, int steps)
{
  for (int k = 0; k < steps; ++k) working.step();
}

double stored(const dem::Assembly& assembly)
{
  const dem::PairSums e =
      dem::sum_pairs(assembly.material, assembly.cell, assembly.particles, assembly.bonds,
                     assembly.contacts);
  return e.bonds.value() + e.contacts.value();
}

} // namespace

TEST_CASE("A workload has the same bits from the same seed, before and after 50 steps",
          "[unit][apps]")
{
  for (const Workload w : {Workload::bonded_block, Workload::frictional_packing}) {
    WorkingAssembly first = make_workload(small(w, 300)),
                    second = make_workload(small(w, 300)),
                    other = make_workload(small(w, 300, 2));
    CHECK(checksum(first.assembly.particles) == checksum(second.assembly.particles));
    CHECK(checksum(first.assembly.particles) != checksum(other.assembly.particles));
    const std::uint64_t before = checksum(first.assembly.particles);
    run(first, 50);
    run(second, 50);
    CHECK(checksum(first.assembly.particles) == checksum(second.assembly.particles));
    CHECK(checksum(first.assembly.particles) != before);
  }
}

TEST_CASE("The checksum depends on each bit of a particle, not on the order of storage",
          "[unit][apps]")
{
  dem::Particles p;
  for (int k = 0; k < 3; ++k) {
    dem::ParticleState b;
    b.x = {1.0 * k, 2.0, 3.0};
    p.add(b);
  }
  const std::uint64_t sum = checksum(p);
  dem::Particles rotated_with_contact = p;
  std::reverse(rotated_with_contact.state.begin(), rotated_with_contact.state.end());
  CHECK(checksum(rotated_with_contact) != sum);
  std::reverse(rotated_with_contact.id.begin(), rotated_with_contact.id.end());
  CHECK(checksum(rotated_with_contact) == sum);
  p.state[1].omega.z() = -0.0; // differs from 0 in its sign bit only
  CHECK(checksum(p) != sum);
}

TEST_CASE("W1 has 2.45 bonds per particle and breaks none in 200 steps of compression",
          "[unit][apps]")
{
  WorkingAssembly working = make_workload(small(Workload::bonded_block, 500));
  const dem::Assembly& assembly = working.assembly;
  CHECK(per_particle(assembly.bonds.size(), assembly) == bonds_per_particle);
  CHECK_FALSE(assembly.cell.is_periodic());
  for (const dem::ParticleState& b : assembly.particles.state)
    REQUIRE((b.R >= 0.4e-4 && b.R <= 0.6e-4)); // a unit is 0.1 mm

  const double before = stored(assembly);
  run(working, 200);
  CHECK(assembly.losses.broken == 0);
  CHECK(assembly.losses.yielded == 0);
  CHECK(stored(assembly) > before); // it is compressed
}

TEST_CASE("The lists of both workloads go stale every 200 to 260 steps", "[unit][apps]")
{
  // 250 from the common velocity, which the ends of W1 have too; agitation and compression
  // add to it.
  for (const Workload w : {Workload::bonded_block, Workload::frictional_packing}) {
    WorkingAssembly working = make_workload(small(w, 300));
    const std::size_t before = working.assembly.list.n_builds();
    run(working, 1040);
    const std::size_t rebuilds = working.assembly.list.n_builds() - before;
    CAPTURE(static_cast<int>(w), rebuilds);
    CHECK(rebuilds >= 4);
    CHECK(rebuilds <= 5);
  }
}

TEST_CASE("W2 has and keeps 3.4 contacts per particle, of which some slip", "[unit][apps]")
{
  WorkingAssembly working = make_workload(small(Workload::frictional_packing, 1000));
  dem::Assembly& assembly = working.assembly;
  CHECK(assembly.bonds.size() == 0);
  // Measured 3.37 to 3.41 for 400 to 50,000 particles: settling with friction loses a few.
  CHECK(per_particle(count_contacts(assembly), assembly) ==
        Approx(contacts_per_particle).margin(0.2));

  const double slip = assembly.losses.slip.value(), energy = stored(assembly);
  run(working, 200);
  CHECK(per_particle(count_contacts(assembly), assembly) ==
        Approx(contacts_per_particle).margin(0.2));
  CHECK(assembly.losses.slip.value() > slip);
  CHECK(assembly.losses.slip.value() - slip < 0.1 * energy); // slightly agitated, no flow
}

TEST_CASE("W1 with a yielding share of 0.1 has 0.07 to 0.15 of its bonds yielding",
          "[unit][apps]")
{
  WorkloadSpec spec = small(Workload::bonded_block, 500);
  spec.yielding = 0.1;
  WorkingAssembly working = make_workload(spec);
  const dem::Assembly& assembly = working.assembly;
  const std::size_t before = assembly.losses.yielded;
  const int steps = 200;
  run(working, steps);
  const double share = static_cast<double>(assembly.losses.yielded - before) /
                       static_cast<double>(assembly.bonds.size() * steps);
  CAPTURE(share);
  CHECK(share > 0.07);
  CHECK(share < 0.15);
  CHECK(assembly.losses.broken == 0);
  double intact = 1.0;
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b)
    intact = std::min(intact, assembly.bonds.intact(b));
  CHECK(intact > 0.999); // it never softens
}

TEST_CASE("A workload that cannot be made is refused with the reason", "[unit][apps]")
{
  CHECK_THROWS_WITH(make_workload(small(Workload::bonded_block, 10)),
                    Contains("--particles = 10: must lie in 200 to 2e7"));
  WorkloadSpec spec = small(Workload::frictional_packing, 500);
  spec.yielding = 0.1;
  CHECK_THROWS_AS(make_workload(spec), InputError);
}

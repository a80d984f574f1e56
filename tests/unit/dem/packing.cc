#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

#include "dem/pairs/neighbours.h"
#include "dem/specimen/bonding.h"
#include "dem/specimen/porosity.h"

#include <algorithm>

using namespace mergel::dem;
using namespace mergel::dem::test;
using mergel::match::Contains;

namespace {

constexpr double d00 = 0.066e-3; // [m]

/// A small half cylinder of the paper's size distribution; S grows with the radius.
SpecimenSpec small_specimen()
{
  SpecimenSpec s;
  s.region = HalfCylinder{1.6e-3, 2.0e-3, 16};
  s.scale = {1.5, 2.0, 0.4e-3, 1.2e-3};
  s.sizes = Grading(UniformSizes{d00, 0.1337e-3});
  s.rho = 2556.0;
  s.porosity = 0.52;
  s.contact = LinearMaterial{.g_a = 0.15 * d00};
  s.g_b = 0.4 * d00;
  s.coordination = 5.8;
  return s;
}

const Packing& packed()
{
  static const Packing packing = pack(small_specimen(), [](double) {});
  return packing;
}

} // namespace

TEST_CASE("A packing has its porosity, its ids in order and no overlap", "[unit][dem]")
{
  const SpecimenSpec s = small_specimen();
  const Packing& packing = packed();
  const Particles& p = packing.particles;
  CAPTURE(p.size(), packing.porosity, packing.whole_porosity, packing.overlap);
  CHECK(p.size() > 1000);
  CHECK(packing.porosity ==
        Approx(0.52).margin(0.01)); // 0.004, and what the last sweeps change
  CHECK(core_porosity(s.region, p) == packing.porosity);
  CHECK(packing.whole_porosity > packing.porosity); // the walls leave voids

  bool in_order = true, in_size = true, inside = true;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const ParticleState& b = p.state[i];
    in_order = in_order && p.id[i] == i;
    in_size = in_size && 2.0 * b.R >= b.S * s.sizes.smallest() &&
              2.0 * b.R <= b.S * s.sizes.largest() && b.S >= 1.5 && b.S <= 2.0 &&
              b.m == sphere_mass(b.R, s.rho);
    inside = inside && depth(s.region, b.x) > 0.9 * b.R;
  }
  CHECK(in_order);
  CHECK(in_size);
  CHECK(inside);

  // No two particles with their far-field shells overlap by more than the overlap reported;
  // without the shells they do not touch.
  double worst = 0.0;
  for (const Pair& q : find_pairs(p, {}, activation_gap(s.contact))) {
    const ParticleState &i = p.state[q.i], &j = p.state[q.j];
    const double reach = i.R + j.R + activation_gap(s.contact) * 0.5 * (i.S + j.S);
    worst = std::max(worst, (reach - (j.x - i.x).norm()) / reach);
  }
  CHECK(worst <= packing.overlap * 1.5 + 1e-12); // reported before the last move
  CHECK(packing.overlap < 2e-3);
}

TEST_CASE("Equal particles have the size curve that was wanted", "[unit][dem]")
{
  Particles p;
  for (const double S : {1.0, 1.7, 2.3, 3.1}) { // R/S is d00/2 up to round-off
    ParticleState b;
    b.S = S;
    b.R = 0.5 * S * d00;
    p.add(b);
  }
  const SizeReport r = describe_sizes(Grading(UniformSizes{d00, d00}), p);
  CHECK(r.distance_by_mass == 0.0);
  CHECK(r.distance_by_number == 0.0);
  CHECK(r.d_50 == Approx(d00));
  // Of another size they are as far off as can be.
  CHECK(describe_sizes(Grading(UniformSizes{2 * d00, 2 * d00}), p).distance_by_mass == 1.0);
}

TEST_CASE("The distance of the size curves is that of the step of the made one",
          "[unit][dem]")
{
  // One particle in the middle of a uniform grading: 0.5 on both sides of the step.
  Particles p;
  ParticleState b;
  b.S = 1.0;
  b.R = 0.75 * d00;
  p.add(b);
  const SizeReport r = describe_sizes(Grading(UniformSizes{d00, 2.0 * d00}), p);
  // Compared at 1e-9 of the diameter beside it, where the slope is 1/d00.
  CHECK(r.distance_by_number == Approx(0.5).margin(1e-8));
}

TEST_CASE("A porosity that leaves room for fewer than two particles is refused",
          "[unit][dem]")
{
  SpecimenSpec s = small_specimen();
  for (const double porosity : {0.99999, 0.9999999}) {
    s.porosity = porosity; // of 8 mm3: 1e-4 or 1e-6 mm3, a particle has 5e-4 at least
    CHECK_THROWS_WITH(pack(s, [](double) {}),
                      Contains("leaves room for fewer than two particles, for 0"));
  }
}

TEST_CASE("The number of particles per volume falls with the cube of S", "[unit][dem]")
{
  const SpecimenSpec s = small_specimen();
  double n_inner = 0.0, n_outer = 0.0;
  for (const ParticleState& b : packed().particles.state) {
    n_inner += b.S == 1.5;
    n_outer += b.S == 2.0;
  }
  // n S^3 is the same per volume; the area of the prism beyond r_outer is its area less the
  // half disc.
  const double outer_area = volume(s.region) / 2.0e-3 - 0.5 * pi * 1.2e-3 * 1.2e-3;
  const double inner_area = 0.5 * pi * 0.4e-3 * 0.4e-3;
  const double expected = inner_area / outer_area * std::pow(2.0 / 1.5, 3);
  // some 100 particles inside: 2.5 standard deviations of 10 %
  CHECK(n_inner / n_outer == Approx(expected).epsilon(0.25));
}

TEST_CASE("The same seed gives the same bits, another seed another packing", "[unit][dem]")
{
  SpecimenSpec s = small_specimen();
  s.region = HalfCylinder{1.2e-3, 1.3e-3, 8};
  const auto first = [&](std::uint64_t seed) {
    s.seed = seed;
    s.porosity = 0.6; // loose: few sweeps
    return pack(s, [](double) {}).particles.state.front().x;
  };
  CHECK(first(4) == first(4));
  CHECK(first(4) != first(5));
}

TEST_CASE("Bonds are the closest pairs, up to the coordination or the bond gap",
          "[unit][dem]")
{
  SpecimenSpec s = small_specimen();
  const Particles& p = packed().particles;
  const auto gap_of = [&](const Pair& q) {
    const ParticleState &i = p.state[q.i], &j = p.state[q.j];
    return ((j.x - i.x).norm() - i.R - j.R) / (0.5 * (i.S + j.S));
  };
  const Bonding bonding = choose_bonds(s, p, {});
  const auto n = static_cast<double>(p.size());
  CHECK(2.0 * static_cast<double>(bonding.pairs.size()) / n ==
        Approx(5.8).margin(1.0 / n + 1e-12));
  CHECK(std::is_sorted(bonding.pairs.begin(), bonding.pairs.end()));
  CHECK(bonding.limit <= s.g_b);
  double widest = 0.0;
  for (const Pair& q : bonding.pairs) widest = std::max(widest, gap_of(q));
  CHECK(widest == bonding.limit);
  for (const Pair& q : find_pairs(p, {}, s.g_b))
    if (!std::binary_search(bonding.pairs.begin(), bonding.pairs.end(), q))
      REQUIRE(gap_of(q) >= bonding.limit);

  s.coordination = 20.0; // more than the gap allows
  const Bonding all = choose_bonds(s, p, {});
  CHECK(all.pairs == find_pairs(p, {}, s.g_b));
}

TEST_CASE("A porosity that cannot be reached is refused with the range that can",
          "[unit][dem]")
{
  SpecimenSpec s = small_specimen();
  CHECK_NOTHROW(s.check());
  CHECK(effective_solid_fraction(s) == Approx(0.626).margin(0.002)); // dem/README.md, 17.

  s.porosity = 0.2;
  std::string text;
  try {
    s.check();
  } catch (const mergel::InputError& error) {
    text = error.what();
  }
  const std::string before = "must be at least ";
  REQUIRE_THAT(text, Contains(before));
  const double lowest = std::stod(text.substr(text.find(before) + before.size()));
  s.porosity = lowest + 0.001;
  CHECK_NOTHROW(s.check());
  s.porosity = lowest - 0.001;
  CHECK_THROWS_WITH(s.check(), Contains(" and below 1: "));

  s.compaction = Compaction::confined;
  s.pressure = 5e3;
  s.contact = contact(0.63e9, 2.4, 0.3, 0.15 * d00);
  // The shells fill 0.626 at 0.52: 1 - 0.48 * 0.52/0.626 = 0.60.
  CHECK_THROWS_WITH(s.check(), Contains(" and at most about 0.60"));
}

TEST_CASE("Specimen parameters out of range are refused", "[unit][dem]")
{
  const auto refused = [](auto&& change) {
    SpecimenSpec s = small_specimen();
    change(s);
    CHECK_THROWS_AS(s.check(), mergel::InputError);
  };
  refused([](SpecimenSpec& s) { std::get<HalfCylinder>(s.region).radius = 0.0; });
  refused([](SpecimenSpec& s) { std::get<HalfCylinder>(s.region).segments = 1; });
  refused([](SpecimenSpec& s) { s.scale.S_inner = 0.0; });
  refused([](SpecimenSpec& s) { s.compaction = Compaction::confined; }); // no pressure
  refused([](SpecimenSpec& s) { s.friction = -0.1; });
  refused([](SpecimenSpec& s) { s.porosity = 1.0; });
  refused([](SpecimenSpec& s) { s.porosity = std::nan(""); });
  refused(
      [](SpecimenSpec& s) { s.scale.S_outer = 20.0; }); // particles as large as the region
  // Twice the largest diameter, 2 x 0.2674 mm, and the gaps that are searched, 0.0594 mm.
  const auto box = [](double edge) {
    return [edge](SpecimenSpec& s) {
      s.region = PeriodicBox{Vec3::Constant(edge)};
      s.scale = {2.0, 2.0, 0.0, 0.0};
    };
  };
  refused(box(0.65e-3));
  SpecimenSpec fits = small_specimen();
  box(0.66e-3)(fits);
  CHECK_NOTHROW(fits.check());
}

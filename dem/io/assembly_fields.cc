#include "dem/io/assembly_fields.h"

#include "dem/parallel/merge_runs.h"
#include "dem/parallel/rows.h"

#include <cmath>

namespace mergel::dem {

namespace {

Field scalar(const std::string& name, std::vector<double> values)
{
  return {name, 1, std::move(values)};
}

Field vector(const std::string& name, std::size_t n)
{
  return {name, 3, std::vector<double>(3 * n)};
}

void set_vector(Field& f, std::size_t k, const Vec3& a)
{
  for (std::size_t c = 0; c < 3; ++c) f.values[3 * k + c] = a[static_cast<Eigen::Index>(c)];
}

} // namespace

std::vector<double> particle_damage(const Assembly& assembly)
{
  const Particles& p = assembly.particles;
  const std::vector<Index> rows = owned_rows(p);
  std::vector<double> sum(p.n_owned(), 0.0), count(p.n_owned(), 0.0);
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b)
    for (const Index i : {assembly.bonds.pairs[b].i, assembly.bonds.pairs[b].j}) {
      if (!p.owns(i)) continue;
      sum[rows[i]] += 1.0 - assembly.bonds.intact(b);
      count[rows[i]] += 1.0;
    }
  for (std::size_t k = 0; k < sum.size(); ++k)
    if (count[k] > 0.0) sum[k] /= count[k];
  return sum;
}

std::vector<Field> particle_fields(const Assembly& assembly, const std::vector<Vec3>& x_0)
{
  const Particles& p = assembly.particles;
  const std::size_t n = p.n_owned();
  Field radius = scalar("radius", std::vector<double>(n)),
        S = scalar("S", std::vector<double>(n)), id = scalar("id", std::vector<double>(n)),
        strength = scalar("strength", {});
  Field velocity = vector("velocity", n), force = vector("force", n),
        displacement = vector("displacement", n);
  std::size_t k = 0;
  p.for_owned([&](Index i) {
    const ParticleState& b = p.state[i];
    radius.values[k] = b.R;
    S.values[k] = b.S;
    id.values[k] = static_cast<double>(p.id[i]);
    set_vector(velocity, k, b.v);
    set_vector(force, k, p.load[i].f);
    set_vector(displacement, k, b.x - x_0[i]);
    if (!p.strength.empty()) strength.values.push_back(p.strength[i]);
    ++k;
  });
  std::vector<Field> fields{std::move(radius),
                            std::move(velocity),
                            scalar("damage", particle_damage(assembly)),
                            std::move(force),
                            std::move(S),
                            std::move(id),
                            std::move(displacement)};
  if (!p.strength.empty()) fields.push_back(std::move(strength));
  return fields;
}

std::vector<Field> strain_fields(const std::vector<DeformationFit>& fits)
{
  Field volumetric = scalar("volumetric strain [-]", {}),
        shear = scalar("shear strain [-]", {}), D2_min = scalar("D2_min [-]", {});
  for (const DeformationFit& fit : fits) {
    volumetric.values.push_back(volumetric_strain(fit.F));
    shear.values.push_back(shear_strain(fit.F));
    D2_min.values.push_back(fit.D2_min);
  }
  return {volumetric, shear, D2_min};
}

std::vector<BondLine> gather_bonds(const Assembly& assembly, int to)
{
  const Particles& p = assembly.particles;
  std::vector<BondLine> mine;
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b)
    if (p.owns(assembly.bonds.pairs[b].i))
      mine.push_back(
          {assembly.bonds.pairs[b],
           read_bond(assembly.bonds, b, p, assembly.cell, assembly.material.bond)});
  std::vector<BondLine> all = assembly.comm.gather_on(to, mine);
  merge_runs(all, [](const BondLine& a, const BondLine& b) { return a.pair < b.pair; });
  return all;
}

void write_bonds(const std::filesystem::path& file, const Particles& p,
                 const PeriodicCell& cell, const std::vector<BondLine>& bonds)
{
  const std::size_t n = bonds.size();
  std::vector<Vec3> x;
  for (const ParticleState& b : p.state) x.push_back(b.x);
  std::vector<std::array<Index, 2>> lines;
  Field N = scalar("N", std::vector<double>(n)), D = scalar("D", std::vector<double>(n));
  Field V = vector("V", n), M = vector("M", n), T = scalar("T", std::vector<double>(n));
  for (std::size_t b = 0; b < n; ++b) {
    const Pair& q = bonds[b].pair;
    Index end = q.j;
    if (q.shift != Shift{}) { // the line ends at the image instead of crossing the cell
      end = static_cast<Index>(x.size());
      x.push_back(p.state[q.j].x + cell.offset(q.shift));
    }
    lines.push_back({q.i, end});
    const BondReading& r = bonds[b].bond;
    N.values[b] = r.N;
    D.values[b] = r.D;
    set_vector(V, b, r.V);
    set_vector(M, b, r.M);
    T.values[b] = r.T;
  }
  write_lines(file, x, lines, {N, V, M, T, D});
}

namespace {

/// Points and triangles of the part of a body of revolution between the angles 0 and n_around
/// facets.
struct RevolutionSurface {
  std::vector<Vec3>
      points; ///< the tip, n of each meridian from the tip up, the centre of the top
  std::vector<std::array<Index, 3>> triangles;
  Index n = 0; ///< points of a meridian

  Index at(Index meridian, Index ring) const { return 1 + n * meridian + ring; }
};

constexpr Index n_facets = 48; // over the half circle, of 3.75 degrees

RevolutionSurface revolution_surface(const Revolution& shape, const Vec3& x,
                                     const Eigen::Quaterniond& rotation, double z_top,
                                     Index n_around)
{
  const auto placed = [&, Q = rotation.toRotationMatrix()](double x_, double y, double z) {
    return Vec3(x + Q * Vec3(x_, y, z));
  };
  RevolutionSurface s;
  std::vector<Revolution::Corner> rings(shape.profile.begin() + 1, shape.profile.end());
  rings.push_back({shape.R(), std::max(z_top - x.z(), shape.tip_height())});
  s.n = static_cast<Index>(rings.size());
  s.points.push_back(x);
  for (Index k = 0; k <= n_around; ++k) {
    const double phi = pi * k / n_facets;
    for (const auto& ring : rings)
      s.points.push_back(placed(ring.r * std::cos(phi), ring.r * std::sin(phi), ring.z));
  }
  const auto top = static_cast<Index>(s.points.size());
  s.points.push_back(placed(0.0, 0.0, rings.back().z));

  for (Index k = 0; k < n_around; ++k) {
    s.triangles.push_back({0, s.at(k, 0), s.at(k + 1, 0)});
    for (Index j = 0; j + 1 < s.n; ++j) {
      s.triangles.push_back({s.at(k, j), s.at(k + 1, j + 1), s.at(k + 1, j)});
      s.triangles.push_back({s.at(k, j), s.at(k, j + 1), s.at(k + 1, j + 1)});
    }
    s.triangles.push_back({s.at(k, s.n - 1), top, s.at(k + 1, s.n - 1)});
  }
  return s;
}

} // namespace

void write_half_revolution(const std::filesystem::path& file, const Revolution& shape,
                           const Vec3& x, const Eigen::Quaterniond& rotation, double z_top)
{
  RevolutionSurface s = revolution_surface(shape, x, rotation, z_top, n_facets);
  // The cut face.
  s.triangles.push_back({0, s.at(n_facets, 0), s.at(0, 0)});
  for (Index j = 0; j + 1 < s.n; ++j) {
    s.triangles.push_back({s.at(0, j), s.at(n_facets, j), s.at(n_facets, j + 1)});
    s.triangles.push_back({s.at(0, j), s.at(n_facets, j + 1), s.at(0, j + 1)});
  }
  write_surface(file, s.points, s.triangles, {});
}

void write_revolution(const std::filesystem::path& file, const Revolution& shape,
                      const Vec3& x, const Eigen::Quaterniond& rotation, double z_top)
{
  const RevolutionSurface s = revolution_surface(shape, x, rotation, z_top, 2 * n_facets);
  write_surface(file, s.points, s.triangles, {});
}

} // namespace mergel::dem

#include "dem/io/assembly_fields.h"

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
  std::vector<double> sum(assembly.particles.size(), 0.0),
      count(assembly.particles.size(), 0.0);
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b)
    for (const Index p : {assembly.bonds.pairs[b].i, assembly.bonds.pairs[b].j}) {
      sum[p] += 1.0 - assembly.bonds.intact(b);
      count[p] += 1.0;
    }
  for (std::size_t p = 0; p < sum.size(); ++p)
    if (count[p] > 0.0) sum[p] /= count[p];
  return sum;
}

void write_particles(const std::filesystem::path& file, const Assembly& assembly,
                     const std::vector<Vec3>& x_0, const std::vector<Field>& more)
{
  const Particles& p = assembly.particles;
  const std::size_t n = p.n_owned();
  std::vector<Vec3> x;
  Field radius = scalar("radius", std::vector<double>(n)),
        S = scalar("S", std::vector<double>(n)), id = scalar("id", std::vector<double>(n));
  Field velocity = vector("velocity", n), force = vector("force", n),
        displacement = vector("displacement", n);
  for (std::size_t k = 0; k < n; ++k) {
    const ParticleState& b = p.state[k];
    x.push_back(b.x);
    radius.values[k] = b.R;
    S.values[k] = b.S;
    id.values[k] = static_cast<double>(p.id[k]);
    set_vector(velocity, k, b.v);
    set_vector(force, k, p.load[k].f);
    set_vector(displacement, k, b.x - x_0[k]);
  }
  std::vector<Field> fields{
      radius, velocity,    scalar("damage", particle_damage(assembly)), force, S,
      id,     displacement};
  if (!p.strength.empty()) fields.push_back(scalar("strength", p.strength));
  fields.insert(fields.end(), more.begin(), more.end());
  write_points(file, x, fields);
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

void write_bonds(const std::filesystem::path& file, const Assembly& assembly)
{
  const std::size_t n = assembly.bonds.size();
  std::vector<Vec3> x;
  for (const ParticleState& b : assembly.particles.state) x.push_back(b.x);
  std::vector<std::array<Index, 2>> lines;
  Field N = scalar("N", std::vector<double>(n)), D = scalar("D", std::vector<double>(n));
  Field V = vector("V", n), M = vector("M", n), T = scalar("T", std::vector<double>(n));
  for (std::size_t b = 0; b < n; ++b) {
    const Pair& q = assembly.bonds.pairs[b];
    Index end = q.j;
    if (q.shift != Shift{}) { // the line ends at the image instead of crossing the cell
      end = static_cast<Index>(x.size());
      x.push_back(assembly.particles.state[q.j].x + assembly.cell.offset(q.shift));
    }
    lines.push_back({q.i, end});
    const BondReading r = read_bond(assembly.bonds, b, assembly.particles, assembly.cell,
                                    assembly.material.bond);
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

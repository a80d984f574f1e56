#include "dem/assembly/averages.h"

#include "dem/assembly/branches.h"

#include <algorithm>
#include <cmath>

namespace mergel::dem {

namespace {

using TensorSum = std::array<ExactVector<EnergySum>, 3>; ///< by rows

void add(TensorSum& sum, const Mat3& a)
{
  for (int k = 0; k < 3; ++k) sum[static_cast<std::size_t>(k)].add(a.row(k));
}

Mat3 value(const TensorSum& sum)
{
  Mat3 a;
  for (int k = 0; k < 3; ++k) a.row(k) = sum[static_cast<std::size_t>(k)].value();
  return a;
}

void list(ExactReduction& sums, TensorSum& sum)
{
  for (auto& row : sum) sums.add(row);
}

/// Along each axis, the number of cells between a particle and its image in the cell at the
/// origin.
Vec3 cells_away(const Assembly& assembly, Index i)
{
  return assembly.particles.state[i].x.cwiseQuotient(assembly.cell.size).array().floor();
}

struct Sums {
  TensorSum virial, bond_fabric, contact_fabric;
  ExactVector<EnergySum> across; ///< force times edges of the cell [J]
  EnergySum solid;               ///< sphere volume over the volume of the cell [-]
  std::size_t n_bonds = 0, n_contacts = 0;

  void add_force(const Assembly& assembly, const Pair& q, const Vec3& F, const Vec3& r)
  {
    add(virial, F * r.transpose());
    Vec3 cells = cells_away(assembly, q.j) - cells_away(assembly, q.i);
    for (int a = 0; a < 3; ++a) cells[a] += q.shift[static_cast<std::size_t>(a)];
    across.add(F.cwiseProduct(cells).cwiseProduct(assembly.cell.size));
  }
  void add_contact(const Assembly& assembly, const Pair& q, const Vec3& f_s)
  {
    const double f_n =
        read_contact(q, f_s, assembly.particles, assembly.cell, assembly.material.contact)
            .f_n;
    if (f_n == 0.0) return;
    const Branch b(assembly, q);
    ++n_contacts;
    add(contact_fabric, b.n() * b.n().transpose());
    add_force(assembly, q, f_s - f_n * b.n(), b.r);
  }
};

double over(std::size_t part, std::size_t whole)
{
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

} // namespace

CellAverages cell_averages(const Assembly& assembly)
{
  const Particles& p = assembly.particles;
  Sums s;
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b) {
    const Pair& q = assembly.bonds.pairs[b];
    if (!p.owns(q.i)) continue;
    if (assembly.bonds.intact(b) > 0.0) {
      const Branch branch(assembly, q);
      const BondReading bond =
          read_bond(assembly.bonds, b, p, assembly.cell, assembly.material.bond);
      ++s.n_bonds;
      add(s.bond_fabric, branch.n() * branch.n().transpose());
      s.add_force(assembly, q, bond.N * branch.n() + bond.V, branch.r);
    }
    s.add_contact(assembly, q, contact_shear_of(assembly.bonds, b));
  }
  for (std::size_t c = 0; c < assembly.contacts.pairs.size(); ++c)
    if (p.owns(assembly.contacts.pairs[c].i))
      s.add_contact(assembly, assembly.contacts.pairs[c], assembly.contacts.shear[c].f_s);
  // Over the volume of the cell: a volume in m^3 is too small for the quantum of the sum.
  const double V = assembly.cell.volume();
  p.for_owned([&](Index i) { s.solid.add(sphere_mass(p.state[i].R, 1.0) / V); });

  ExactReduction sums;
  list(sums, s.virial);
  list(sums, s.bond_fabric);
  list(sums, s.contact_fabric);
  sums.add(s.across);
  sums.add(s.solid);
  sums.run(assembly.comm);
  s.n_bonds = assembly.comm.global_sum(s.n_bonds);
  s.n_contacts = assembly.comm.global_sum(s.n_contacts);

  CellAverages a;
  const Mat3 sigma = value(s.virial) / V;
  a.stress = 0.5 * (sigma + sigma.transpose());
  const double norm = a.stress.norm();
  a.antisymmetric = norm > 0.0 ? (sigma - a.stress).norm() / norm : 0.0;
  a.traction = s.across.value() / V;
  if (s.n_bonds > 0) a.bond_fabric = value(s.bond_fabric) / static_cast<double>(s.n_bonds);
  if (s.n_contacts > 0)
    a.contact_fabric = value(s.contact_fabric) / static_cast<double>(s.n_contacts);
  a.bond_coordination = 2.0 * over(s.n_bonds, p.size());
  a.contact_coordination = 2.0 * over(s.n_contacts, p.size());
  const double solid = s.solid.value();
  a.porosity = 1.0 - solid;
  a.void_ratio = solid > 0.0 ? (1.0 - solid) / solid : 0.0;
  return a;
}

namespace {

/// Share of a branch between two heights.
double share_between(double z_from, double z_to, double z_low, double z_high)
{
  const auto [low, high] = std::minmax(z_from, z_to);
  const double inside = std::min(high, z_high) - std::max(low, z_low);
  if (high - low > 0.0) return std::clamp(inside / (high - low), 0.0, 1.0);
  return inside >= 0.0 ? 1.0 : 0.0;
}

/// Share of the branch x + s r, s in [0, 1], inside a box with edges along the axes.
double share_inside(const Vec3& x, const Vec3& r, const Vec3& low, const Vec3& high)
{
  double from = 0.0, to = 1.0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (r[k] == 0.0) {
      if (x[k] < low[k] || x[k] > high[k]) return 0.0;
      continue;
    }
    const double at_low = (low[k] - x[k]) / r[k], at_high = (high[k] - x[k]) / r[k];
    const auto [enters, leaves] = std::minmax(at_low, at_high);
    from = std::max(from, enters);
    to = std::min(to, leaves);
  }
  return std::max(0.0, to - from);
}

/// Sum of all ranks over the volume, symmetric part.
Mat3 stress_of(TensorSum& virial, double volume, const Communicator& comm)
{
  ExactReduction sums;
  list(sums, virial);
  sums.run(comm);
  const Mat3 sigma = value(virial) / volume;
  return 0.5 * (sigma + sigma.transpose());
}

} // namespace

Mat3 slab_stress(const Assembly& assembly, double z_low, double z_high, double area)
{
  TensorSum virial;
  const auto add_force = [&](const Vec3& from, const Vec3& r, const Vec3& F) {
    const double share = share_between(from.z(), from.z() + r.z(), z_low, z_high);
    if (share > 0.0) add(virial, share * F * r.transpose());
  };
  visit_branches(assembly, [&](const Pair& q, const Branch& b, const Vec3& F) {
    add_force(assembly.particles.state[q.i].x, b.r, F);
  });
  for (const Wall& wall : assembly.walls)
    for (const WallContactForce& c : wall.contact_forces) {
      const Vec3& x = assembly.particles.state[c.particle].x;
      add_force(x, c.point - x, c.f);
    }
  return stress_of(virial, area * (z_high - z_low), assembly.comm);
}

Mat3 box_stress(const Assembly& assembly, const Vec3& low, const Vec3& high, double volume)
{
  TensorSum virial;
  visit_branches(assembly, [&](const Pair& q, const Branch& b, const Vec3& F) {
    const double share = share_inside(assembly.particles.state[q.i].x, b.r, low, high);
    if (share > 0.0) add(virial, share * F * b.r.transpose());
  });
  return stress_of(virial, volume, assembly.comm);
}

Vec3 affine_stiffness(const Assembly& assembly)
{
  return affine_stiffness(assembly, assembly.cell.volume());
}

Vec3 affine_stiffness(const Assembly& assembly, double V)
{
  ExactVector<EnergySum> sum;
  const auto add_spring = [&](const Branch& b, double k_n, double k_s) {
    const Vec3 n2 = b.n().cwiseAbs2();
    const double r2 = b.r.squaredNorm();
    sum.add(r2 * (k_n * n2.cwiseAbs2() + k_s * n2.cwiseProduct(Vec3::Ones() - n2)));
  };
  const auto add_contact = [&](const Pair& q) {
    const Branch b(assembly, q);
    const ContactLaw& law = assembly.material.contact;
    const double overlap = activation_gap(law) * b.S - (b.r.norm() - b.L);
    if (overlap <= 0.0) return;
    const ParticleState &i = assembly.particles.state[q.i],
                        &j = assembly.particles.state[q.j];
    const auto k = contact_stiffness(law, sides_of_pair(i.R, j.R, 1.0 / b.L), overlap);
    add_spring(b, k.k_n, k.k_s);
  };
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b) {
    const Pair& q = assembly.bonds.pairs[b];
    if (!assembly.particles.owns(q.i)) continue;
    const Branch branch(assembly, q);
    const auto k =
        bond_shape(section(assembly.material.bond), branch.radius, 1.0 / branch.L);
    const double intact = assembly.bonds.intact(b);
    if (intact > 0.0) add_spring(branch, intact * k.k_n, intact * k.k_s);
    add_contact(q);
  }
  for (const Pair& q : assembly.contacts.pairs)
    if (assembly.particles.owns(q.i)) add_contact(q);
  ExactReduction sums;
  sums.add(sum);
  sums.run(assembly.comm);
  return sum.value() / V;
}

double inertial_number(double rate, double d, double rho, double p)
{
  return p > 0.0 ? std::abs(rate) * d * std::sqrt(rho / p) : 0.0;
}

} // namespace mergel::dem

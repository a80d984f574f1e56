#include "dem/assembly/averages.h"

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

/// One pair as it stands.
struct Branch {
  Vec3 r; ///< from i to j [m]
  double L, radius, S;

  Branch(const Rock& rock, const Pair& q)
  {
    const Body &i = rock.particles.body[q.i], &j = rock.particles.body[q.j];
    r = j.x + rock.cell.offset(q.shift) - i.x;
    L = i.R + j.R;
    radius = std::min(i.R, j.R);
    S = 0.5 * (i.S + j.S);
  }
  Vec3 n() const { return r.normalized(); }
};

/// Cells between a grain and the image that lies in the cell at the origin.
Vec3 cells_away(const Rock& rock, Index i)
{
  return rock.particles.body[i].x.cwiseQuotient(rock.cell.size).array().floor();
}

struct Sums {
  TensorSum virial, bond_fabric, contact_fabric;
  ExactVector<EnergySum> across; ///< force times edges of the cell [J]
  EnergySum solid;               ///< [m^3]
  std::size_t n_bonds = 0, n_contacts = 0;

  void add_force(const Rock& rock, const Pair& q, const Vec3& F, const Vec3& r)
  {
    add(virial, F * r.transpose());
    Vec3 cells = cells_away(rock, q.j) - cells_away(rock, q.i);
    for (int a = 0; a < 3; ++a) cells[a] += q.shift[static_cast<std::size_t>(a)];
    across.add(F.cwiseProduct(cells).cwiseProduct(rock.cell.size));
  }
  void add_contact(const Rock& rock, const Pair& q, const Vec3& f_s)
  {
    const double f_n =
        read_contact(q, f_s, rock.particles, rock.cell, rock.material.contact).f_n;
    if (f_n == 0.0) return;
    const Branch b(rock, q);
    ++n_contacts;
    add(contact_fabric, b.n() * b.n().transpose());
    add_force(rock, q, f_s - f_n * b.n(), b.r);
  }
};

double over(std::size_t part, std::size_t whole)
{
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

} // namespace

CellAverages cell_averages(const Rock& rock)
{
  const Particles& p = rock.particles;
  Sums s;
  for (std::size_t b = 0; b < rock.bonds.size(); ++b) {
    const Pair& q = rock.bonds.pairs[b];
    if (!p.owns(q.i)) continue;
    if (rock.bonds.intact(b) > 0.0) {
      const Branch branch(rock, q);
      const BondReading bond = read_bond(rock.bonds, b, p, rock.cell, rock.material.bond);
      ++s.n_bonds;
      add(s.bond_fabric, branch.n() * branch.n().transpose());
      s.add_force(rock, q, bond.N * branch.n() + bond.V, branch.r);
    }
    s.add_contact(rock, q, shear_beside(rock.bonds, b));
  }
  for (std::size_t c = 0; c < rock.contacts.pairs.size(); ++c)
    if (p.owns(rock.contacts.pairs[c].i))
      s.add_contact(rock, rock.contacts.pairs[c], rock.contacts.shear[c].f_s);
  // in units of the cell, for the sake of the quantum
  const double V = rock.cell.volume();
  p.for_owned([&](Index i) { s.solid.add(sphere_mass(p.body[i].R, 1.0) / V); });

  ExactReduction sums;
  list(sums, s.virial);
  list(sums, s.bond_fabric);
  list(sums, s.contact_fabric);
  sums.add(s.across);
  sums.add(s.solid);
  sums.run(rock.comm);
  s.n_bonds = rock.comm.global_sum(s.n_bonds);
  s.n_contacts = rock.comm.global_sum(s.n_contacts);

  CellAverages a;
  const Mat3 sigma = value(s.virial) / V;
  a.stress = 0.5 * (sigma + sigma.transpose());
  const double norm = a.stress.norm();
  a.skew = norm > 0.0 ? (sigma - a.stress).norm() / norm : 0.0;
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

std::vector<Mat3> grain_stresses(const Rock& rock)
{
  const Particles& p = rock.particles;
  std::vector<Mat3> sum(p.size(), Mat3::Zero()); // [J]
  const auto add_force = [&](const Pair& q, const Branch& b, const Vec3& F) {
    const double half_gap = 0.5 * (b.r.norm() - b.L);
    const Mat3 moment = F * b.n().transpose();
    sum[q.i] += (p.body[q.i].R + half_gap) * moment;
    sum[q.j] += (p.body[q.j].R + half_gap) * moment;
  };
  const auto add_contact = [&](const Pair& q, const Vec3& f_s) {
    const double f_n = read_contact(q, f_s, p, rock.cell, rock.material.contact).f_n;
    if (f_n == 0.0) return;
    const Branch b(rock, q);
    add_force(q, b, f_s - f_n * b.n());
  };
  for (std::size_t k = 0; k < rock.bonds.size(); ++k) {
    const Pair& q = rock.bonds.pairs[k];
    if (rock.bonds.intact(k) > 0.0) {
      const Branch b(rock, q);
      const BondReading bond = read_bond(rock.bonds, k, p, rock.cell, rock.material.bond);
      add_force(q, b, bond.N * b.n() + bond.V);
    }
    add_contact(q, shear_beside(rock.bonds, k));
  }
  for (std::size_t c = 0; c < rock.contacts.pairs.size(); ++c)
    add_contact(rock.contacts.pairs[c], rock.contacts.shear[c].f_s);

  double solid = 0.0; // [m^3]
  for (const Body& b : p.body) solid += sphere_mass(b.R, 1.0);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double share = sphere_mass(p.body[i].R, 1.0) / solid * rock.cell.volume();
    sum[i] = (0.5 / share * (sum[i] + sum[i].transpose())).eval();
  }
  return sum;
}

Vec3 affine_stiffness(const Rock& rock)
{
  ExactVector<EnergySum> sum;
  const auto add_spring = [&](const Branch& b, double k_n, double k_s) {
    const Vec3 n2 = b.n().cwiseAbs2();
    const double r2 = b.r.squaredNorm();
    sum.add(r2 * (k_n * n2.cwiseAbs2() + k_s * n2.cwiseProduct(Vec3::Ones() - n2)));
  };
  const auto add_contact = [&](const Pair& q) {
    const Branch b(rock, q);
    if (b.r.norm() - b.L >= rock.material.contact.g_a * b.S) return;
    const auto k = linear_stiffness(rock.material.contact, b.radius, 1.0 / b.L);
    add_spring(b, k.k_n, k.k_s);
  };
  for (std::size_t b = 0; b < rock.bonds.size(); ++b) {
    const Pair& q = rock.bonds.pairs[b];
    if (!rock.particles.owns(q.i)) continue;
    const Branch branch(rock, q);
    const auto k = bond_shape(section(rock.material.bond), branch.radius, 1.0 / branch.L);
    const double intact = rock.bonds.intact(b);
    if (intact > 0.0) add_spring(branch, intact * k.k_n, intact * k.k_s);
    add_contact(q);
  }
  for (const Pair& q : rock.contacts.pairs)
    if (rock.particles.owns(q.i)) add_contact(q);
  ExactReduction sums;
  sums.add(sum);
  sums.run(rock.comm);
  return sum.value() / rock.cell.volume();
}

double inertial_number(double rate, double d, double rho, double p)
{
  return p > 0.0 ? std::abs(rate) * d * std::sqrt(rho / p) : 0.0;
}

} // namespace mergel::dem

#include "dem/continuum/particle_stress.h"

#include "dem/assembly/neighbourhood.h"
#include "dem/continuum/section_sums.h"
#include "dem/parallel/rows.h"

#include <algorithm>

namespace mergel::dem {

namespace {

/// What a particle adds to the stress around it and its neighbours.
struct Share {
  Mat3 moment = Mat3::Zero(); ///< sum of F (x) (x_c - x_i) [J]
  double volume = 0.0;        ///< [m^3]

  Share& operator+=(const Share& b)
  {
    moment += b.moment;
    volume += b.volume;
    return *this;
  }
  Mat3 stress() const { return 0.5 / volume * (moment + moment.transpose()); }
};

/// Of the owned particles.
std::vector<Share> shares_of(const Particles& p, const std::vector<LoadedBranch>& branches,
                             const std::vector<double>& porosity,
                             const std::vector<Index>& rows)
{
  std::vector<Share> shares(p.n_owned());
  p.for_owned([&](Index i) {
    const Index k = rows[i];
    shares[k].volume = sphere_mass(p.state[i].R, 1.0) / (1.0 - porosity[k]);
  });
  for (const LoadedBranch& b : branches) {
    const Mat3 whole = b.F * b.r.transpose();
    if (b.end != BranchEnd::particle) {
      shares[rows[b.i]].moment += whole;
      continue;
    }
    const double length = b.r.norm(), R_i = p.state[b.i].R, R_j = p.state[b.j].R;
    const double arm_i = R_i + 0.5 * (length - R_i - R_j);
    // length > 0: centres do not meet
    if (p.owns(b.i)) shares[rows[b.i]].moment += arm_i / length * whole;
    if (p.owns(b.j)) shares[rows[b.j]].moment += (length - arm_i) / length * whole;
  }
  return shares;
}

} // namespace

std::vector<Mat3> neighbourhood_stresses(const Assembly& assembly,
                                         const std::vector<LoadedBranch>& branches,
                                         const std::vector<double>& porosity,
                                         const std::vector<Pair>& pairs)
{
  const Particles& p = assembly.particles;
  const bool is_narrow = !holds_neighbourhoods(assembly.cell, p);
  std::vector<char> is_wanted(p.size(), is_narrow);
  for (const Pair& q : pairs) is_wanted[q.i] = is_wanted[q.j] = 1;
  std::vector<Index> remote;
  for (Index i = 0; i < p.size(); ++i)
    if (is_wanted[i] && !p.owns(i)) remote.push_back(i);

  // Rows of the owned particles, then of the others.
  std::vector<Index> rows = owned_rows(p);
  std::vector<Share> shares = shares_of(p, branches, porosity, rows);
  const std::vector<Share> fetched =
      fetch_rows(assembly.comm, assembly.partition, rows, shares, remote);
  for (std::size_t k = 0; k < remote.size(); ++k)
    rows[remote[k]] = static_cast<Index>(shares.size() + k);
  shares.insert(shares.end(), fetched.begin(), fetched.end());

  std::vector<Mat3> stress;
  if (is_narrow) {
    Share all;
    for (Index i = 0; i < p.size(); ++i) all += shares[rows[i]];
    stress.assign(p.n_owned(), all.stress()); // particles: volume > 0
    return stress;
  }
  std::vector<Share> sums(shares.begin(),
                          shares.begin() + static_cast<std::ptrdiff_t>(p.n_owned()));
  for (const Pair& q : pairs) {
    if (p.owns(q.i)) sums[rows[q.i]] += shares[rows[q.j]];
    if (p.owns(q.j)) sums[rows[q.j]] += shares[rows[q.i]];
  }
  for (const Share& sum : sums) stress.push_back(sum.stress());
  return stress;
}

std::vector<double> even_porosity(const Particles& p, double volume)
{
  double solid = 0.0; // [m^3]
  for (const ParticleState& b : p.state) solid += sphere_mass(b.R, 1.0);
  return std::vector<double>(p.n_owned(), 1.0 - solid / volume);
}

std::vector<double> strained_porosity(double n_0, const std::vector<DeformationFit>& fits)
{
  std::vector<double> n;
  for (const DeformationFit& fit : fits) {
    const double J = fit.F.determinant(); // of debris it may be anything
    n.push_back(J > 0.0 ? std::clamp(1.0 - (1.0 - n_0) / J, 0.0, 1.0 - smallest_solid)
                        : n_0);
  }
  return n;
}

} // namespace mergel::dem

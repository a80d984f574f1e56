#include "dem/assembly/distribute.h"

#include "dem/pairs/bond_record.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace mergel::dem {

namespace {

struct BondRecord {
  Pair pair;
  BondHistory history;
};

Bonds bonds_of(const std::vector<BondRecord>& records)
{
  Bonds bonds;
  bonds.pairs.reserve(records.size());
  for (const BondRecord& r : records) append(bonds, r.pair, r.history);
  return bonds;
}

struct ContactRecord {
  Pair pair;
  std::array<double, 3> history; ///< f_s
};

std::vector<BondRecord> bond_records(const Bonds& bonds)
{
  std::vector<BondRecord> records;
  for (std::size_t b = 0; b < bonds.size(); ++b)
    records.push_back({bonds.pairs[b], history_of(bonds, b)});
  return records;
}

std::vector<ContactRecord> contact_records(const Contacts& contacts)
{
  std::vector<ContactRecord> records;
  for (std::size_t c = 0; c < contacts.pairs.size(); ++c) {
    const Vec3& f = contacts.shear[c].f_s;
    records.push_back({contacts.pairs[c], {f.x(), f.y(), f.z()}});
  }
  return records;
}

/// Records of pairs from all ranks, each once, ascending. A pair is told by the owner of its
/// first grain; the owner of its second, if another, is compared with it on request.
template <class Record>
std::vector<Record> gathered(const Rock& rock, std::vector<Record> records, bool compare)
{
  const Particles& p = rock.particles;
  std::vector<Record> first, second;
  for (const Record& r : records) {
    if (p.owns(r.pair.i))
      first.push_back(r);
    else if (p.owns(r.pair.j))
      second.push_back(r);
  }
  std::vector<Record> all = rock.comm.gather(first);
  const auto ascending = [](const Record& a, const Record& b) { return a.pair < b.pair; };
  std::sort(all.begin(), all.end(), ascending);
  if (compare)
    for (const Record& r : rock.comm.gather(second)) {
      const auto at = std::lower_bound(all.begin(), all.end(), r, ascending);
      if (at == all.end() || !(at->pair == r.pair) ||
          std::memcmp(at->history.data(), r.history.data(), sizeof r.history) != 0)
        throw std::logic_error(
            "two ranks hold different histories of the pair of particles " +
            std::to_string(p.id[r.pair.i]) + " and " + std::to_string(p.id[r.pair.j]));
    }
  return all;
}

/// Records of single grains from all ranks, in the order of `key`.
template <class Record, class Key>
std::vector<Record> gathered_by(const Communicator& comm, const std::vector<Record>& mine,
                                Key&& key)
{
  std::vector<Record> all = comm.gather(mine);
  std::stable_sort(all.begin(), all.end(),
                   [&](const Record& a, const Record& b) { return key(a) < key(b); });
  return all;
}

std::pair<Index, int> key_of(const WallContact& c)
{
  return {c.particle, c.wall};
}

/// What the owner of a grain knows of it, its motion apart.
struct GrainRecord {
  Index particle;
  int n_bonds;
  std::array<double, 6> load; ///< f, t
};

/// Drop what touches no owned grain.
void keep_own(Rock& rock)
{
  const Particles& p = rock.particles;
  std::vector<BondRecord> bonds;
  for (const BondRecord& r : bond_records(rock.bonds))
    if (p.owns(r.pair.i) || p.owns(r.pair.j)) bonds.push_back(r);
  rock.bonds = bonds_of(bonds);

  Contacts contacts;
  for (std::size_t c = 0; c < rock.contacts.pairs.size(); ++c) {
    const Pair& q = rock.contacts.pairs[c];
    if (!p.owns(q.i) && !p.owns(q.j)) continue;
    contacts.pairs.push_back(q);
    contacts.shear.push_back(rock.contacts.shear[c]);
  }
  rock.contacts = std::move(contacts);

  const auto foreign = [&p](const auto& r) { return !p.owns(r.particle); };
  for (Mirror& m : rock.mirrors) std::erase_if(m.pairs, foreign);
  for (PlaneWall& w : rock.planes) std::erase_if(w.contacts.contacts(), foreign);
  for (PileWall& w : rock.piles) std::erase_if(w.contacts.contacts(), foreign);
  for (Wall& w : rock.walls) {
    std::erase_if(w.contacts, foreign);
    w.listed.resize(w.contacts.size()); // made anew with the list
    std::erase_if(w.bonds, foreign);
  }
  rock.list.invalidate();
}

/// Losses and works of the whole stay on rank 0, so that their sum over ranks is theirs.
void keep_sums_once(Rock& rock)
{
  if (rock.comm.rank() == 0) return;
  rock.losses = {};
  rock.work = {};
  for (Mirror& m : rock.mirrors) {
    m.energy.clear();
    m.force.clear();
  }
}

} // namespace

void share_out(Rock& rock, MPI_Comm comm)
{
  rock.comm = Communicator(comm);
  if (rock.comm.is_alone()) return;
  // A first share by number, so that each grain has one owner to give it away.
  const auto n = rock.particles.size(),
             n_ranks = static_cast<std::size_t>(rock.comm.n_ranks()),
             rank = static_cast<std::size_t>(rock.comm.rank());
  std::vector<char> is_owned(n, 0);
  for (std::size_t i = rank * n / n_ranks; i < (rank + 1) * n / n_ranks; ++i)
    is_owned[i] = 1;
  rock.particles.set_ownership(std::move(is_owned), std::vector<char>(n, 0));
  rock.partition.assign(rock.particles, {}, rock.comm);
  rock.ghosts.clear();
  keep_own(rock);
  keep_sums_once(rock);
}

Rock whole(Rock& rock, bool compare)
{
  if (rock.comm.is_alone()) return rock;
  rock.partition.gather_motion(rock.particles, rock.comm);
  Rock all = rock;
  all.comm = Communicator();
  all.partition = Partition();
  all.ghosts = Ghosts();

  Particles& p = all.particles;
  std::vector<GrainRecord> grains;
  rock.particles.for_owned([&](Index i) {
    const Vec3 &f = p.load[i].f, &t = p.load[i].t;
    grains.push_back({i, p.n_bonds[i], {f.x(), f.y(), f.z(), t.x(), t.y(), t.z()}});
  });
  for (const GrainRecord& g : rock.comm.gather(grains)) {
    p.n_bonds[g.particle] = g.n_bonds;
    p.load[g.particle].f = {g.load[0], g.load[1], g.load[2]};
    p.load[g.particle].t = {g.load[3], g.load[4], g.load[5]};
  }

  all.bonds = bonds_of(gathered(rock, bond_records(rock.bonds), compare));
  all.contacts = {};
  for (const ContactRecord& r : gathered(rock, contact_records(rock.contacts), compare)) {
    all.contacts.pairs.push_back(r.pair);
    all.contacts.shear.emplace_back().f_s = Vec3(r.history[0], r.history[1], r.history[2]);
  }

  ExactReduction sums;
  const auto by_particle = [](const auto& r) { return r.particle; };
  for (std::size_t k = 0; k < rock.mirrors.size(); ++k) {
    all.mirrors[k].pairs = gathered_by(rock.comm, rock.mirrors[k].pairs, by_particle);
    sums.add(all.mirrors[k].energy);
    sums.add(all.mirrors[k].force);
  }
  for (std::size_t k = 0; k < rock.planes.size(); ++k)
    all.planes[k].contacts.contacts() =
        gathered_by(rock.comm, rock.planes[k].contacts.contacts(), key_of);
  for (std::size_t k = 0; k < rock.piles.size(); ++k)
    all.piles[k].contacts.contacts() =
        gathered_by(rock.comm, rock.piles[k].contacts.contacts(), key_of);
  for (std::size_t k = 0; k < rock.walls.size(); ++k) {
    Wall& w = all.walls[k];
    w.contacts = gathered_by(rock.comm, rock.walls[k].contacts, key_of);
    w.listed.assign(w.contacts.size(), {});
    w.bonds = gathered_by(rock.comm, rock.walls[k].bonds, by_particle);
  }
  for (EnergySum* s : {&all.losses.slip, &all.losses.plastic, &all.losses.residue,
                       &all.work.gravity, &all.work.damping, &all.work.lock})
    sums.add(*s);
  sums.run(rock.comm);
  all.losses.broken = rock.comm.global_sum(rock.losses.broken);
  all.losses.yielded = rock.comm.global_sum(rock.losses.yielded);
  for (std::size_t k = 0; k < n_break_modes; ++k)
    all.losses.broken_by[k] = rock.comm.global_sum(rock.losses.broken_by[k]);
  all.losses.virial = rock.virial;
  all.losses.breakages = gathered_by(rock.comm, rock.losses.breakages,
                                     [](const Breakage& b) { return b.pair; });

  const std::size_t n = p.size();
  p.set_ownership(std::vector<char>(n, 1), std::vector<char>(n, 0));
  all.list.invalidate();
  return all;
}

void rebalance(Rock& rock, double seconds, bool compare)
{
  if (rock.comm.is_alone()) return;
  Particles& p = rock.particles;
  // A grain's share of the time goes with the pairs that it has a part in.
  std::vector<double> pairs(p.size(), 1.0);
  for (const auto* list : {&rock.bonds.pairs, &rock.contacts.pairs})
    for (const Pair& q : *list) {
      pairs[q.i] += 1.0;
      pairs[q.j] += 1.0;
    }
  double all_pairs = 0.0;
  p.for_owned([&](Index i) { all_pairs += pairs[i]; });
  std::vector<double> weight;
  p.for_owned([&](Index i) { weight.push_back(seconds * pairs[i] / all_pairs); });

  Rock all = whole(rock, compare);
  rock.partition.assign(p, weight, rock.comm);
  rock.ghosts.clear();
  // Only what migrates is replaced: others hold references to walls and piles.
  std::vector<char> is_owned(p.size(), 0);
  p.for_owned([&](Index i) { is_owned[i] = 1; });
  all.particles.set_ownership(std::move(is_owned), std::vector<char>(p.size(), 0));
  p = std::move(all.particles);
  rock.bonds = std::move(all.bonds);
  rock.contacts = std::move(all.contacts);
  for (std::size_t k = 0; k < rock.mirrors.size(); ++k)
    rock.mirrors[k].pairs = std::move(all.mirrors[k].pairs);
  for (std::size_t k = 0; k < rock.planes.size(); ++k)
    rock.planes[k].contacts = std::move(all.planes[k].contacts);
  for (std::size_t k = 0; k < rock.piles.size(); ++k)
    rock.piles[k].contacts = std::move(all.piles[k].contacts);
  for (std::size_t k = 0; k < rock.walls.size(); ++k) {
    rock.walls[k].contacts = std::move(all.walls[k].contacts);
    rock.walls[k].bonds = std::move(all.walls[k].bonds);
  }
  keep_own(rock);
}

} // namespace mergel::dem

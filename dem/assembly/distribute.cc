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

Contacts contacts_of(const std::vector<ContactRecord>& records)
{
  Contacts contacts;
  for (const ContactRecord& r : records) {
    contacts.pairs.push_back(r.pair);
    contacts.shear.emplace_back().f_s = Vec3(r.history[0], r.history[1], r.history[2]);
  }
  return contacts;
}

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

/// @param all of the owners of the first particles, ascending; @param others of the same
///   pairs by another rank
/// @throws std::logic_error for a pair whose histories differ
template <class Record>
void compare_with(const std::vector<Record>& all, const std::vector<Record>& others,
                  const Particles& p)
{
  for (const Record& r : others) {
    const auto at =
        std::lower_bound(all.begin(), all.end(), r,
                         [](const Record& a, const Record& b) { return a.pair < b.pair; });
    if (at == all.end() || !(at->pair == r.pair) ||
        std::memcmp(at->history.data(), r.history.data(), sizeof r.history) != 0)
      throw std::logic_error(
          "two ranks hold different histories of the pair of particles " +
          std::to_string(p.id[r.pair.i]) + " and " + std::to_string(p.id[r.pair.j]));
  }
}

/// Compare the histories that two ranks hold of the pairs across their border.
template <class Record>
void compare_over_borders(const Assembly& assembly, const std::vector<Record>& records,
                          const std::vector<int>& owner)
{
  const Particles& p = assembly.particles;
  std::vector<Record> first;
  std::vector<std::vector<Record>> to(static_cast<std::size_t>(assembly.comm.n_ranks()));
  for (const Record& r : records) {
    if (p.owns(r.pair.i))
      first.push_back(r);
    else
      to[static_cast<std::size_t>(owner[r.pair.i])].push_back(r);
  }
  compare_with(first, assembly.comm.exchange(to), p);
}

void compare_histories(const Assembly& assembly)
{
  const std::vector<int> owner = assembly.partition.owners();
  compare_over_borders(assembly, bond_records(assembly.bonds), owner);
  compare_over_borders(assembly, contact_records(assembly.contacts), owner);
}

/// Records that move with their particles from a partition to the next. Ranks exchange those
/// that they lack, no others.
class Migration {
public:
  /// @param before, after the rank that owned each particle, and that owns it now
  Migration(const Communicator& comm, const std::vector<int>& before,
            std::vector<int> after)
      : comm_(comm), before_(before), after_(std::move(after))
  {
  }

  /// Records of pairs, ascending: a rank has those of its particles.
  template <class Record>
  std::vector<Record> of_pairs(const std::vector<Record>& records) const
  {
    std::vector<std::vector<Record>> to(static_cast<std::size_t>(comm_.n_ranks()));
    std::vector<Record> mine;
    for (const Record& r : records) {
      const Index i = r.pair.i, j = r.pair.j;
      if (after_[i] == comm_.rank() || after_[j] == comm_.rank()) mine.push_back(r);
      if (before_[i] != comm_.rank()) continue; // the owner of the first particle sends
      const auto send = [&](int rank) {
        if (rank != before_[i] && rank != before_[j])
          to[static_cast<std::size_t>(rank)].push_back(r);
      };
      send(after_[i]);
      if (after_[j] != after_[i]) send(after_[j]);
    }
    append(comm_.exchange(to), mine);
    std::sort(mine.begin(), mine.end(),
              [](const Record& a, const Record& b) { return a.pair < b.pair; });
    return mine;
  }

  /// Records of single particles, which their owners have.
  template <class Record>
  std::vector<Record> of_particles(const std::vector<Record>& records) const
  {
    std::vector<std::vector<Record>> to(static_cast<std::size_t>(comm_.n_ranks()));
    std::vector<Record> mine;
    for (const Record& r : records) {
      const int rank = after_[r.particle];
      (rank == comm_.rank() ? mine : to[static_cast<std::size_t>(rank)]).push_back(r);
    }
    append(comm_.exchange(to), mine);
    return mine;
  }

private:
  template <class Record>
  static void append(const std::vector<Record>& more, std::vector<Record>& to)
  {
    to.insert(to.end(), more.begin(), more.end());
  }

  const Communicator& comm_;
  const std::vector<int>& before_;
  const std::vector<int> after_;
};

/// Order of the records of a wall. A particle in a corner has several, in a fixed order.
std::pair<Index, int> key_of(const WallContact& c)
{
  return {c.particle, c.wall};
}
template <class Record>
Index key_of(const Record& r)
{
  return r.particle;
}

/// What only the owner of a particle holds, apart from its motion.
struct ParticleRecord {
  Index particle;
  int n_bonds;
  std::array<double, 6> load; ///< f, t
};

/// Of the particles that this rank owned before.
std::vector<ParticleRecord> particle_records(const Particles& p,
                                             const std::vector<Index>& owned)
{
  std::vector<ParticleRecord> records;
  for (const Index i : owned) {
    const Vec3 &f = p.load[i].f, &t = p.load[i].t;
    records.push_back({i, p.n_bonds[i], {f.x(), f.y(), f.z(), t.x(), t.y(), t.z()}});
  }
  return records;
}

void restore(const ParticleRecord& g, Particles& p)
{
  p.n_bonds[g.particle] = g.n_bonds;
  p.load[g.particle].f = {g.load[0], g.load[1], g.load[2]};
  p.load[g.particle].t = {g.load[3], g.load[4], g.load[5]};
}

std::vector<Index> owned_particles(const Particles& p)
{
  std::vector<Index> owned;
  p.for_owned([&](Index i) { owned.push_back(i); });
  return owned;
}

/// Drop all bonds, contacts and wall contacts without an owned particle.
void keep_own(Assembly& assembly)
{
  const Particles& p = assembly.particles;
  std::vector<BondRecord> bonds;
  for (const BondRecord& r : bond_records(assembly.bonds))
    if (p.owns(r.pair.i) || p.owns(r.pair.j)) bonds.push_back(r);
  assembly.bonds = bonds_of(bonds);

  Contacts contacts;
  for (std::size_t c = 0; c < assembly.contacts.pairs.size(); ++c) {
    const Pair& q = assembly.contacts.pairs[c];
    if (!p.owns(q.i) && !p.owns(q.j)) continue;
    contacts.pairs.push_back(q);
    contacts.shear.push_back(assembly.contacts.shear[c]);
  }
  assembly.contacts = std::move(contacts);

  const auto is_remote = [&p](const auto& r) { return !p.owns(r.particle); };
  for_each_wall(assembly, [&](auto& wall) {
    std::apply([&](auto&... lists) { (std::erase_if(lists, is_remote), ...); },
               histories(wall));
  });
  assembly.list.invalidate();
}

/// Keep losses and works on rank 0 only, so that their sum over the ranks does not change.
void keep_sums_once(Assembly& assembly)
{
  if (assembly.comm.rank() == 0) return;
  assembly.losses = {};
  assembly.work = {};
  visit_sums(assembly, [](const char*, SumKind kind, auto& sum) {
    if (kind == SumKind::by_rank) visit_raw(sum, [](ExactWide& raw) { raw = 0; });
  });
}

} // namespace

void distribute(Assembly& assembly, MPI_Comm comm)
{
  assembly.comm = Communicator(comm);
  for (const Wall& wall : assembly.walls)
    if (wall.f.is_shared() && wall.f.shares().first.size() !=
                                  static_cast<std::size_t>(assembly.comm.n_ranks()) + 1)
      throw std::logic_error("the nodes of a wall are shared among other ranks");
  if (assembly.comm.is_alone()) return;
  // A preliminary partition by index: Zoltan needs one owner for each particle.
  const auto n = assembly.particles.size(),
             n_ranks = static_cast<std::size_t>(assembly.comm.n_ranks()),
             rank = static_cast<std::size_t>(assembly.comm.rank());
  std::vector<char> is_owned(n, 0);
  for (std::size_t i = rank * n / n_ranks; i < (rank + 1) * n / n_ranks; ++i)
    is_owned[i] = 1;
  assembly.particles.set_ownership(std::move(is_owned), std::vector<char>(n, 0));
  assembly.partition.assign(assembly.particles, {}, assembly.comm);
  assembly.ghosts.clear();
  keep_own(assembly);
  keep_sums_once(assembly);
}

namespace {

/// Records of single particles of all ranks, in the order of `key`.
template <class Record, class Key>
std::vector<Record> gather_by(const Communicator& comm, const std::vector<Record>& mine,
                              Key&& key)
{
  std::vector<Record> all = comm.gather(mine);
  std::stable_sort(all.begin(), all.end(),
                   [&](const Record& a, const Record& b) { return key(a) < key(b); });
  return all;
}

/// Records of pairs, each once, ascending. The owner of the first particle supplies the
/// record. If `compare` is set, it is compared with that of the owner of the second.
template <class Record>
std::vector<Record> gather_pairs(const Assembly& assembly,
                                 const std::vector<Record>& records, bool compare)
{
  const Particles& p = assembly.particles;
  std::vector<Record> first, second;
  for (const Record& r : records) {
    if (p.owns(r.pair.i))
      first.push_back(r);
    else if (p.owns(r.pair.j))
      second.push_back(r);
  }
  std::vector<Record> all = assembly.comm.gather(first);
  std::sort(all.begin(), all.end(),
            [](const Record& a, const Record& b) { return a.pair < b.pair; });
  if (compare) compare_with(all, assembly.comm.gather(second), p);
  return all;
}

void gather_wall_histories(Assembly& assembly, Assembly& all)
{
  for_each_wall(assembly, all, [&](auto& mine, auto& wall) {
    auto from = histories(mine);
    auto to = histories(wall);
    [&]<std::size_t... k>(std::index_sequence<k...>)
    {
      ((std::get<k>(to) = gather_by(assembly.comm, std::get<k>(from),
                                    [](const auto& r) { return key_of(r); })),
       ...);
    }
    (std::make_index_sequence<std::tuple_size_v<decltype(from)>>{});
  });
}

/// Sums that the ranks hold in parts.
void gather_sums(Assembly& assembly, Assembly& all)
{
  std::vector<ExactWide> parts;
  const auto is_in_parts = [](SumKind kind) {
    return kind == SumKind::by_rank || kind == SumKind::by_node;
  };
  visit_sums(assembly, [&](const char*, SumKind kind, const auto& sum) {
    if (is_in_parts(kind))
      visit_part(sum, [&](const ExactWide& raw) { parts.push_back(raw); });
  });
  ExactReduction sums;
  for (ExactWide& part : parts) sums.add(part);
  sums.run(assembly.comm);
  auto part = parts.begin();
  visit_sums(all, [&](const char*, SumKind kind, auto& sum) {
    if (is_in_parts(kind)) visit_raw(sum, [&](ExactWide& raw) { raw = *part++; });
  });
  for (Wall& wall : all.walls) wall.f.share({}); // they are complete now
}

void gather_losses(const Assembly& assembly, Assembly& all)
{
  const PairLosses& mine = assembly.losses;
  all.losses.broken = assembly.comm.global_sum(mine.broken);
  all.losses.yielded = assembly.comm.global_sum(mine.yielded);
  for (std::size_t k = 0; k < n_break_modes; ++k)
    all.losses.broken_by[k] = assembly.comm.global_sum(mine.broken_by[k]);
  all.losses.breakages =
      gather_by(assembly.comm, mine.breakages, [](const Breakage& b) { return b.pair; });
  all.losses.virial = assembly.virial;
}

} // namespace

Assembly gather(Assembly& assembly, bool compare)
{
  if (assembly.comm.is_alone()) return assembly;
  Assembly all = assembly;
  all.comm = Communicator();
  all.partition = Partition();
  all.ghosts = Ghosts();
  const Particles& p = assembly.particles;
  assembly.partition.gather_motion(all.particles, assembly.comm);
  for (const ParticleRecord& g :
       assembly.comm.gather(particle_records(p, owned_particles(p))))
    restore(g, all.particles);
  all.bonds = bonds_of(gather_pairs(assembly, bond_records(assembly.bonds), compare));
  all.contacts =
      contacts_of(gather_pairs(assembly, contact_records(assembly.contacts), compare));
  gather_wall_histories(assembly, all);
  gather_sums(assembly, all);
  gather_losses(assembly, all);
  const std::size_t n = p.size();
  all.particles.set_ownership(std::vector<char>(n, 1), std::vector<char>(n, 0));
  all.list.invalidate();
  return all;
}

void rebalance(Assembly& assembly, double seconds, bool compare)
{
  if (assembly.comm.is_alone()) return;
  Particles& p = assembly.particles;
  // A particle's share of the time is proportional to 1 + the number of its pairs.
  std::vector<double> pairs(p.size(), 1.0);
  for (const auto* list : {&assembly.bonds.pairs, &assembly.contacts.pairs})
    for (const Pair& q : *list) {
      pairs[q.i] += 1.0;
      pairs[q.j] += 1.0;
    }
  double all_pairs = 0.0;
  p.for_owned([&](Index i) { all_pairs += pairs[i]; });
  std::vector<double> weight;
  p.for_owned([&](Index i) { weight.push_back(seconds * pairs[i] / all_pairs); });

  if (compare) compare_histories(assembly);
  assembly.partition.gather_motion(p, assembly.comm);
  const std::vector<int> before = assembly.partition.owners();
  const std::vector<Index> owned = owned_particles(p);
  assembly.partition.assign(p, weight, assembly.comm);
  assembly.ghosts.clear();
  const Migration migration(assembly.comm, before, assembly.partition.owners());

  for (const ParticleRecord& g : migration.of_particles(particle_records(p, owned)))
    restore(g, p);
  assembly.bonds = bonds_of(migration.of_pairs(bond_records(assembly.bonds)));
  assembly.contacts = contacts_of(migration.of_pairs(contact_records(assembly.contacts)));
  for_each_wall(assembly, [&](auto& wall) {
    std::apply(
        [&](auto&... lists) {
          const auto migrate = [&](auto& list) {
            list = migration.of_particles(list);
            std::stable_sort(list.begin(), list.end(), [](const auto& r, const auto& s) {
              return key_of(r) < key_of(s);
            });
          };
          (migrate(lists), ...);
        },
        histories(wall));
  });
  assembly.list.invalidate();
}

} // namespace mergel::dem

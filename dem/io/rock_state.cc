#include "dem/io/rock_state.h"

#include "dem/bond_record.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace mergel::dem {

namespace {

constexpr std::size_t words = sizeof(ExactWide) / sizeof(std::uint64_t);

void append(std::vector<double>& to, const Vec3& a)
{
  to.insert(to.end(), {a.x(), a.y(), a.z()});
}

Vec3 vec_at(const std::vector<double>& from, std::size_t k)
{
  return {from[k], from[k + 1], from[k + 2]};
}

template <class Sum>
void append(std::vector<ExactWide*>& to, ExactVector<Sum>& v)
{
  to.insert(to.end(), {&v.x.raw(), &v.y.raw(), &v.z.raw()});
}

/// True for a history that is not all zero bits.
bool says_something(const Vec3& f, double energy)
{
  const std::array<double, 4> all{f.x(), f.y(), f.z(), energy}, nothing{};
  return std::memcmp(all.data(), nothing.data(), sizeof all) != 0;
}

/// Numbers of rows in the ascending order of `key`, each key once.
template <class Key>
std::vector<std::size_t> ascending(const std::string& name, std::size_t n, Key&& key)
{
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t k = 1; k < n; ++k)
    if (!(key(order[k - 1]) < key(order[k]))) State::refuse(name, "names one twice");
  return order;
}

// --- grains ------------------------------------------------------------------------------

constexpr std::size_t body_columns = 12, load_columns = 6;

void put_grains(State& state, const Particles& p)
{
  std::vector<std::uint32_t> number;
  std::vector<double> body, load;
  std::vector<std::int32_t> n_bonds;
  p.for_owned([&](Index i) {
    const Body& b = p.body[i];
    number.push_back(i);
    for (const Vec3& a : {b.x, b.v, b.omega}) append(body, a);
    body.insert(body.end(), {b.R, b.S, b.m});
    append(load, p.load[i].f);
    append(load, p.load[i].t);
    n_bonds.push_back(p.n_bonds[i]);
  });
  state.add("grains", std::move(number));
  state.add("grain_bodies", std::move(body), body_columns);
  state.add("grain_loads", std::move(load), load_columns);
  state.add("grain_bonds", std::move(n_bonds));
}

Particles take_grains(const State& state)
{
  const auto& number = state.get<std::uint32_t>("grains");
  const std::size_t n = number.size();
  const auto& body = state.get_rows<double>("grain_bodies", n, body_columns);
  const auto& load = state.get_rows<double>("grain_loads", n, load_columns);
  const auto& n_bonds = state.get_rows<std::int32_t>("grain_bonds", n);
  const auto order = ascending("grains", n, [&](std::size_t k) { return number[k]; });
  if (n > 0 && number[order.back()] != n - 1) State::refuse("grains", "leaves some out");

  Particles p;
  for (const std::size_t k : order) {
    const double* a = &body[k * body_columns];
    Body b;
    b.x = {a[0], a[1], a[2]};
    b.v = {a[3], a[4], a[5]};
    b.omega = {a[6], a[7], a[8]};
    b.R = a[9];
    b.S = a[10];
    b.m = a[11];
    if (!(b.R > 0.0 && b.S > 0.0 && b.m > 0.0))
      State::refuse("grain_bodies", "has a grain without size or mass");
    const Index i = p.add(b);
    p.load[i].f = vec_at(load, k * load_columns);
    p.load[i].t = vec_at(load, k * load_columns + 3);
    p.n_bonds[i] = n_bonds[k];
  }
  return p;
}

// --- pairs -------------------------------------------------------------------------------

/// Pairs as two arrays; the periodic shift of most rocks is all zero.
class PairColumns {
public:
  void append(const Pair& q)
  {
    grains_.insert(grains_.end(), {q.i, q.j});
    shifts_.insert(shifts_.end(), q.shift.begin(), q.shift.end());
  }
  void put(State& state, const std::string& name)
  {
    state.add(name + "_pairs", std::move(grains_), 2);
    state.add(name + "_shifts", std::move(shifts_), 3);
  }

private:
  std::vector<std::uint32_t> grains_;
  std::vector<std::int16_t> shifts_;
};

std::vector<Pair> take_pairs(const State& state, const std::string& name, std::size_t n)
{
  const auto& grains = state.get<std::uint32_t>(name + "_pairs", 2);
  const std::size_t n_pairs = grains.size() / 2;
  const auto& shifts = state.get_rows<std::int16_t>(name + "_shifts", n_pairs, 3);
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < n_pairs; ++k) {
    if (grains[2 * k] >= grains[2 * k + 1] || grains[2 * k + 1] >= n)
      State::refuse(name + "_pairs", "names grains that cannot be a pair");
    pairs.push_back({grains[2 * k],
                     grains[2 * k + 1],
                     {shifts[3 * k], shifts[3 * k + 1], shifts[3 * k + 2]}});
  }
  return pairs;
}

constexpr std::size_t bond_columns = std::tuple_size_v<BondHistory>;

void put_bonds(State& state, const Particles& p, const Bonds& bonds)
{
  PairColumns pairs;
  std::vector<double> history;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (!p.owns(bonds.pairs[b].i)) continue;
    pairs.append(bonds.pairs[b]);
    const BondHistory h = history_of(bonds, b);
    history.insert(history.end(), h.begin(), h.end());
  }
  pairs.put(state, "bond");
  state.add("bond_histories", std::move(history), bond_columns);
}

Bonds take_bonds(const State& state, std::size_t n)
{
  const std::vector<Pair> pairs = take_pairs(state, "bond", n);
  const auto& history =
      state.get_rows<double>("bond_histories", pairs.size(), bond_columns);
  Bonds bonds;
  for (const std::size_t from :
       ascending("bond_pairs", pairs.size(), [&](std::size_t k) { return pairs[k]; })) {
    BondHistory h;
    std::copy_n(&history[from * bond_columns], bond_columns, h.begin());
    append(bonds, pairs[from], h);
  }
  return bonds;
}

void put_contacts(State& state, const Particles& p, const Contacts& contacts)
{
  PairColumns pairs;
  std::vector<double> shear;
  for (std::size_t c = 0; c < contacts.pairs.size(); ++c) {
    if (!p.owns(contacts.pairs[c].i) || !says_something(contacts.shear[c].f_s, 0.0))
      continue;
    pairs.append(contacts.pairs[c]);
    append(shear, contacts.shear[c].f_s);
  }
  pairs.put(state, "contact");
  state.add("contact_shears", std::move(shear), 3);
}

Contacts take_contacts(const State& state, std::size_t n)
{
  const std::vector<Pair> pairs = take_pairs(state, "contact", n);
  const auto& shear = state.get_rows<double>("contact_shears", pairs.size(), 3);
  Contacts contacts;
  for (const std::size_t from :
       ascending("contact_pairs", pairs.size(), [&](std::size_t k) { return pairs[k]; })) {
    contacts.pairs.push_back(pairs[from]);
    contacts.shear.emplace_back().f_s = vec_at(shear, 3 * from);
  }
  return contacts;
}

void put_breakages(State& state, const PairLosses& losses)
{
  PairColumns pairs;
  std::vector<double> x;
  std::vector<std::int32_t> mode;
  for (const Breakage& b : losses.breakages) {
    pairs.append(b.pair);
    append(x, b.x);
    mode.push_back(static_cast<std::int32_t>(b.mode));
  }
  pairs.put(state, "breakage");
  state.add("breakage_modes", std::move(mode));
  state.add("breakage_places", std::move(x), 3);
}

std::vector<Breakage> take_breakages(const State& state, std::size_t n)
{
  const std::vector<Pair> pairs = take_pairs(state, "breakage", n);
  const auto& x = state.get_rows<double>("breakage_places", pairs.size(), 3);
  const auto& mode = state.get_rows<std::int32_t>("breakage_modes", pairs.size());
  std::vector<Breakage> breakages;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (mode[k] < 0 || mode[k] >= static_cast<std::int32_t>(n_break_modes))
      State::refuse("breakage_modes", "names a load that there is not");
    breakages.push_back({pairs[k], vec_at(x, 3 * k), static_cast<BreakMode>(mode[k])});
  }
  return breakages;
}

// --- walls -------------------------------------------------------------------------------

std::string numbered(const char* what, std::size_t k)
{
  return what + std::to_string(k);
}

void check_grain(const std::string& name, std::uint32_t i, std::size_t n)
{
  if (i >= n) State::refuse(name, "names a grain that is not there");
}

void put_wall_contacts(State& state, const std::string& name,
                       const std::vector<WallContact>& contacts)
{
  std::vector<std::uint32_t> grain;
  std::vector<std::int32_t> patch;
  std::vector<double> history;
  for (const WallContact& c : contacts) {
    if (!says_something(c.f_s, c.energy)) continue;
    grain.push_back(c.particle);
    patch.push_back(c.wall);
    append(history, c.f_s);
    history.push_back(c.energy);
  }
  state.add(name + "_contact_grains", std::move(grain));
  state.add(name + "_contact_patches", std::move(patch));
  state.add(name + "_contact_histories", std::move(history), 4);
}

std::vector<WallContact> take_wall_contacts(const State& state, const std::string& name,
                                            std::size_t n)
{
  const auto& grain = state.get<std::uint32_t>(name + "_contact_grains");
  const auto& patch = state.get_rows<std::int32_t>(name + "_contact_patches", grain.size());
  const auto& history =
      state.get_rows<double>(name + "_contact_histories", grain.size(), 4);
  std::vector<WallContact> contacts;
  for (const std::size_t k :
       ascending(name + "_contact_grains", grain.size(), [&](std::size_t a) {
         return std::pair{grain[a], patch[a]};
       })) {
    check_grain(name + "_contact_grains", grain[k], n);
    contacts.push_back({grain[k], patch[k], vec_at(history, 4 * k), history[4 * k + 3]});
  }
  return contacts;
}

void put_mirror(State& state, const std::string& name, const Mirror& mirror)
{
  std::vector<std::uint32_t> grain;
  std::vector<double> history;
  for (const MirrorPair& m : mirror.pairs) {
    grain.push_back(m.particle);
    history.insert(history.end(), {m.gap_0, m.bond.u_p, m.bond.intact});
  }
  state.add(name + "_grains", std::move(grain));
  state.add(name + "_histories", std::move(history), 3);
}

void take_mirror(const State& state, const std::string& name, std::size_t n, Mirror& mirror)
{
  const auto& grain = state.get<std::uint32_t>(name + "_grains");
  const auto& history = state.get_rows<double>(name + "_histories", grain.size(), 3);
  mirror.pairs.clear();
  for (const std::size_t k :
       ascending(name + "_grains", grain.size(), [&](std::size_t a) { return grain[a]; })) {
    check_grain(name + "_grains", grain[k], n);
    mirror.pairs.push_back(
        {grain[k], history[3 * k], {history[3 * k + 1], history[3 * k + 2]}});
  }
}

constexpr std::size_t wall_bond_columns = 10;

void put_wall(State& state, const std::string& name, const Wall& wall)
{
  std::vector<double> nodes;
  for (std::size_t k = 0; k < wall.x.size(); ++k) {
    append(nodes, wall.x[k]);
    append(nodes, wall.v[k]);
  }
  state.add_common(name + "_nodes", std::move(nodes), 6);
  put_wall_contacts(state, name, wall.contacts);

  std::vector<std::uint32_t> grain;
  std::vector<std::int32_t> triangle;
  std::vector<double> history;
  for (const WallBond& b : wall.bonds) {
    grain.push_back(b.particle);
    triangle.push_back(b.anchor.triangle);
    append(history, b.anchor.weight);
    history.insert(history.end(), {b.gap_0, b.state.u_p, b.state.intact});
    append(history, b.V);
    history.push_back(b.energy);
  }
  state.add(name + "_bond_grains", std::move(grain));
  state.add(name + "_bond_triangles", std::move(triangle));
  state.add(name + "_bond_histories", std::move(history), wall_bond_columns);
}

void take_wall(const State& state, const std::string& name, std::size_t n, Wall& wall)
{
  const auto& nodes = state.get_rows<double>(name + "_nodes", wall.x.size(), 6);
  for (std::size_t k = 0; k < wall.x.size(); ++k) {
    wall.x[k] = vec_at(nodes, 6 * k);
    wall.v[k] = vec_at(nodes, 6 * k + 3);
  }
  update_normals(wall);
  wall.contacts = take_wall_contacts(state, name, n);
  wall.listed.assign(wall.contacts.size(), {}); // made anew with the list
  wall.pushes.clear();
  wall.x_listed.clear();

  const auto& grain = state.get<std::uint32_t>(name + "_bond_grains");
  const auto& triangle =
      state.get_rows<std::int32_t>(name + "_bond_triangles", grain.size());
  const auto& history =
      state.get_rows<double>(name + "_bond_histories", grain.size(), wall_bond_columns);
  for (const std::int32_t t : triangle)
    if (t < 0 || static_cast<std::size_t>(t) >= wall.topology.triangles.size())
      State::refuse(name + "_bond_triangles", "names a triangle that is not there");
  // A grain in a corner has a bond to each side, in the order of the patches.
  const auto patch_of = [&](std::size_t k) {
    return wall.topology.patch[static_cast<std::size_t>(triangle[k])];
  };
  wall.bonds.clear();
  for (const std::size_t k :
       ascending(name + "_bond_grains", grain.size(), [&](std::size_t a) {
         return std::pair{grain[a], patch_of(a)};
       })) {
    check_grain(name + "_bond_grains", grain[k], n);
    const std::size_t at = k * wall_bond_columns;
    WallBond b;
    b.particle = grain[k];
    b.anchor = {triangle[k], vec_at(history, at)};
    b.gap_0 = history[at + 3];
    b.state = {history[at + 4], history[at + 5]};
    b.V = vec_at(history, at + 6);
    b.energy = history[at + 9];
    wall.bonds.push_back(b);
  }
}

/// Of one rank or of all: as ExactReduction has it, the ones that are summed.
std::vector<ExactWide*> sums_of_ranks(Rock& rock)
{
  std::vector<ExactWide*> sums;
  for (EnergySum* s : {&rock.losses.slip, &rock.losses.plastic, &rock.losses.residue,
                       &rock.work.gravity, &rock.work.damping, &rock.work.lock})
    sums.push_back(&s->raw());
  for (Mirror& m : rock.mirrors) {
    sums.push_back(&m.energy.raw());
    append(sums, m.force);
  }
  return sums;
}

/// What every rank knows in full.
std::vector<ExactWide*> sums_of_all(Rock& rock)
{
  std::vector<ExactWide*> sums{&rock.wall_work.raw(), &rock.pile_work.raw(),
                               &rock.cell_work.raw()};
  append(sums, rock.virial);
  for (PlaneWall& w : rock.planes) append(sums, w.force);
  for (Wall& w : rock.walls)
    for (VectorSum& f : w.f) append(sums, f);
  for (PileWall& w : rock.piles) {
    append(sums, w.load.cone);
    append(sums, w.load.shaft);
  }
  return sums;
}

/// A copy of what the sums of a rock need, and no more.
Rock copy_of_sums(const Rock& rock)
{
  Rock copy;
  copy.losses.slip = rock.losses.slip;
  copy.losses.plastic = rock.losses.plastic;
  copy.losses.residue = rock.losses.residue;
  copy.work = rock.work;
  copy.wall_work = rock.wall_work;
  copy.pile_work = rock.pile_work;
  copy.cell_work = rock.cell_work;
  copy.virial = rock.virial;
  for (const Mirror& m : rock.mirrors) {
    copy.mirrors.emplace_back();
    copy.mirrors.back().energy = m.energy;
    copy.mirrors.back().force = m.force;
  }
  for (const PlaneWall& w : rock.planes) copy.planes.emplace_back().force = w.force;
  for (const Wall& w : rock.walls) copy.walls.emplace_back().f = w.f;
  for (const PileWall& w : rock.piles) copy.piles.emplace_back().load = w.load;
  return copy;
}

} // namespace

void put_sums(State& state, const std::string& name, const std::vector<ExactWide*>& sums)
{
  std::vector<std::uint64_t> raw(words * sums.size());
  for (std::size_t k = 0; k < sums.size(); ++k)
    std::memcpy(&raw[words * k], sums[k], sizeof(ExactWide));
  state.add_common(name, std::move(raw), words);
}

void take_sums(const State& state, const std::string& name,
               const std::vector<ExactWide*>& sums)
{
  const auto& raw = state.get_rows<std::uint64_t>(name, sums.size(), words);
  for (std::size_t k = 0; k < sums.size(); ++k)
    std::memcpy(sums[k], &raw[words * k], sizeof(ExactWide));
}

void put(State& state, const Rock& rock)
{
  const Particles& p = rock.particles;
  put_grains(state, p);
  put_bonds(state, p, rock.bonds);
  put_contacts(state, p, rock.contacts);
  put_breakages(state, rock.losses);
  std::vector<double> cell;
  for (const Vec3& a : {rock.cell.size, rock.cell.rate}) append(cell, a);
  state.add_common("cell", std::move(cell), 6);
  state.add_common<std::uint64_t>("cell_is_driven", {rock.cell.is_driven ? 1u : 0u});
  for (std::size_t k = 0; k < rock.mirrors.size(); ++k)
    put_mirror(state, numbered("mirror", k), rock.mirrors[k]);
  for (std::size_t k = 0; k < rock.planes.size(); ++k) {
    const PlaneWall& w = rock.planes[k];
    std::vector<double> place;
    for (const Vec3& a : {w.plane.point, w.plane.normal, w.plane.v}) append(place, a);
    state.add_common(numbered("plane", k) + "_place", std::move(place), 9);
    put_wall_contacts(state, numbered("plane", k), w.contacts.contacts());
  }
  for (std::size_t k = 0; k < rock.walls.size(); ++k)
    put_wall(state, numbered("wall", k), rock.walls[k]);
  for (std::size_t k = 0; k < rock.piles.size(); ++k) {
    const Pile& a = rock.piles[k].pile;
    state.add_common<double>(numbered("pile", k) + "_place",
                             {a.R, a.cone_height, a.x_axis, a.y_axis, a.z_tip, a.v_z}, 6);
    put_wall_contacts(state, numbered("pile", k), rock.piles[k].contacts.contacts());
  }
  state.add_common<std::uint64_t>("bodies", {rock.mirrors.size(), rock.planes.size(),
                                             rock.walls.size(), rock.piles.size()});
  state.add_common<std::uint64_t>(
      "bonds_broken_and_yielded",
      {rock.domain.sum(rock.losses.broken), rock.domain.sum(rock.losses.yielded)});
  std::vector<std::uint64_t> broken_by;
  for (const std::size_t k : rock.losses.broken_by) broken_by.push_back(rock.domain.sum(k));
  state.add_common("bonds_broken_by_mode", std::move(broken_by));

  Rock copy = copy_of_sums(rock);
  ExactReduction all;
  for (EnergySum* s : {&copy.losses.slip, &copy.losses.plastic, &copy.losses.residue,
                       &copy.work.gravity, &copy.work.damping, &copy.work.lock})
    all.add(*s);
  for (Mirror& m : copy.mirrors) {
    all.add(m.energy);
    all.add(m.force);
  }
  all.run(rock.domain);
  put_sums(state, "sums_over_grains", sums_of_ranks(copy));
  put_sums(state, "sums_on_walls", sums_of_all(copy));
}

void take(State& state, Rock& rock)
{
  const std::vector<std::uint64_t> bodies{rock.mirrors.size(), rock.planes.size(),
                                          rock.walls.size(), rock.piles.size()};
  if (state.get_rows<std::uint64_t>("bodies", bodies.size()) != bodies)
    State::refuse("bodies", "counts other walls or piles");
  rock.domain = Domain();
  rock.particles = take_grains(state);
  state.forget("grain");
  const std::size_t n = rock.particles.size();
  rock.bonds = take_bonds(state, n);
  state.forget("bond_");
  rock.contacts = take_contacts(state, n);
  state.forget("contact_");
  const auto& cell = state.get_rows<double>("cell", 1, 6);
  rock.cell.size = vec_at(cell, 0);
  rock.cell.rate = vec_at(cell, 3);
  rock.cell.is_driven = state.get_rows<std::uint64_t>("cell_is_driven", 1)[0] != 0;
  for (std::size_t k = 0; k < rock.mirrors.size(); ++k)
    take_mirror(state, numbered("mirror", k), n, rock.mirrors[k]);
  for (std::size_t k = 0; k < rock.planes.size(); ++k) {
    PlaneWall& w = rock.planes[k];
    const auto& place = state.get_rows<double>(numbered("plane", k) + "_place", 1, 9);
    w.plane = {vec_at(place, 0), vec_at(place, 3), vec_at(place, 6)};
    w.contacts.contacts() = take_wall_contacts(state, numbered("plane", k), n);
  }
  for (std::size_t k = 0; k < rock.walls.size(); ++k)
    take_wall(state, numbered("wall", k), n, rock.walls[k]);
  for (std::size_t k = 0; k < rock.piles.size(); ++k) {
    const auto& a = state.get_rows<double>(numbered("pile", k) + "_place", 1, 6);
    rock.piles[k].pile = {a[0], a[1], a[2], a[3], a[4], a[5]};
    rock.piles[k].contacts.contacts() = take_wall_contacts(state, numbered("pile", k), n);
  }
  const auto& counts = state.get_rows<std::uint64_t>("bonds_broken_and_yielded", 2);
  rock.losses.broken = counts[0];
  rock.losses.yielded = counts[1];
  const auto& broken_by =
      state.get_rows<std::uint64_t>("bonds_broken_by_mode", n_break_modes);
  std::copy(broken_by.begin(), broken_by.end(), rock.losses.broken_by.begin());
  rock.losses.breakages = take_breakages(state, n);
  take_sums(state, "sums_over_grains", sums_of_ranks(rock));
  take_sums(state, "sums_on_walls", sums_of_all(rock));
  rock.list.invalidate();
}

} // namespace mergel::dem

#include "dem/io/state/wall_state.h"

#include "dem/io/state/state_rows.h"

#include <string>
#include <utility>

namespace mergel::dem {

namespace {

void check_particle(const std::string& name, std::uint32_t i, std::size_t n)
{
  if (i >= n) State::refuse(name, "names a particle that does not exist");
}

/// Columns of a contact: shear force, overlap.
constexpr std::size_t contact_columns = 4;

void save_wall_contacts(State& state, const std::string& name,
                        const std::vector<WallContact>& contacts)
{
  std::vector<std::uint32_t> particle;
  std::vector<std::int32_t> patch;
  std::vector<double> history;
  for (const WallContact& c : contacts) {
    if (!is_nonzero(c.f_s, c.overlap)) continue;
    particle.push_back(c.particle);
    patch.push_back(c.wall);
    append(history, c.f_s);
    history.push_back(c.overlap);
  }
  state.add(name + "_contact_grains", std::move(particle));
  state.add(name + "_contact_patches", std::move(patch));
  state.add(name + "_contact_histories", std::move(history), contact_columns);
}

std::vector<WallContact> load_wall_contacts(const State& state, const std::string& name,
                                            std::size_t n)
{
  const auto& particle = state.get<std::uint32_t>(name + "_contact_grains");
  const auto& patch =
      state.get_rows<std::int32_t>(name + "_contact_patches", particle.size());
  const auto& history =
      state.get_rows<double>(name + "_contact_histories", particle.size(), contact_columns);
  std::vector<WallContact> contacts;
  for (const std::size_t k :
       ascending(name + "_contact_grains", particle.size(), [&](std::size_t a) {
         return std::pair{particle[a], patch[a]};
       })) {
    check_particle(name + "_contact_grains", particle[k], n);
    const std::size_t at = contact_columns * k;
    contacts.push_back({particle[k], patch[k], vec_at(history, at), history[at + 3]});
  }
  return contacts;
}

void save_wall(State& state, const std::string& name, const Mirror& mirror)
{
  std::vector<std::uint32_t> particle;
  std::vector<double> history;
  for (const MirrorPair& m : mirror.pairs) {
    particle.push_back(m.particle);
    history.insert(history.end(), {m.gap_0, m.bond.u_p, m.bond.intact});
  }
  state.add(name + "_grains", std::move(particle));
  state.add(name + "_histories", std::move(history), 3);
}

void load_wall(const State& state, const std::string& name, std::size_t n, Mirror& mirror)
{
  const auto& particle = state.get<std::uint32_t>(name + "_grains");
  const auto& history = state.get_rows<double>(name + "_histories", particle.size(), 3);
  mirror.pairs.clear();
  for (const std::size_t k : ascending(name + "_grains", particle.size(),
                                       [&](std::size_t a) { return particle[a]; })) {
    check_particle(name + "_grains", particle[k], n);
    mirror.pairs.push_back(
        {particle[k], history[3 * k], {history[3 * k + 1], history[3 * k + 2]}});
  }
}

constexpr std::size_t wall_bond_columns = 9;

void save_wall(State& state, const std::string& name, const Wall& wall)
{
  std::vector<double> nodes;
  for (std::size_t k = 0; k < wall.x.size(); ++k) {
    append(nodes, wall.x[k]);
    append(nodes, wall.v[k]);
  }
  state.add_common(name + "_nodes", std::move(nodes), 6);
  save_wall_contacts(state, name, wall.contacts);

  std::vector<std::uint32_t> particle;
  std::vector<std::int32_t> triangle;
  std::vector<double> history;
  for (const WallBond& b : wall.bonds) {
    particle.push_back(b.particle);
    triangle.push_back(b.anchor.triangle);
    append(history, b.anchor.weight);
    history.insert(history.end(), {b.gap_0, b.state.u_p, b.state.intact});
    append(history, b.V);
  }
  state.add(name + "_bond_grains", std::move(particle));
  state.add(name + "_bond_triangles", std::move(triangle));
  state.add(name + "_bond_histories", std::move(history), wall_bond_columns);
}

void load_wall(const State& state, const std::string& name, std::size_t n, Wall& wall)
{
  const auto& nodes = state.get_rows<double>(name + "_nodes", wall.x.size(), 6);
  for (std::size_t k = 0; k < wall.x.size(); ++k) {
    wall.x[k] = vec_at(nodes, 6 * k);
    wall.v[k] = vec_at(nodes, 6 * k + 3);
  }
  wall.contacts = load_wall_contacts(state, name, n);
  wall.listed.assign(wall.contacts.size(), {}); // rebuilt with the list
  wall.contact_forces.clear();
  wall.x_listed.clear();

  const auto& particle = state.get<std::uint32_t>(name + "_bond_grains");
  const auto& triangle =
      state.get_rows<std::int32_t>(name + "_bond_triangles", particle.size());
  const auto& history =
      state.get_rows<double>(name + "_bond_histories", particle.size(), wall_bond_columns);
  for (const std::int32_t t : triangle)
    if (t < 0 || static_cast<std::size_t>(t) >= wall.topology.triangles.size())
      State::refuse(name + "_bond_triangles", "names a triangle that does not exist");
  // A particle in a corner has a bond to each side, in the order of the patches.
  const auto patch_of = [&](std::size_t k) {
    return wall.topology.patch[static_cast<std::size_t>(triangle[k])];
  };
  wall.bonds.clear();
  for (const std::size_t k :
       ascending(name + "_bond_grains", particle.size(), [&](std::size_t a) {
         return std::pair{particle[a], patch_of(a)};
       })) {
    check_particle(name + "_bond_grains", particle[k], n);
    const std::size_t at = k * wall_bond_columns;
    WallBond b;
    b.particle = particle[k];
    b.anchor = {triangle[k], vec_at(history, at)};
    b.gap_0 = history[at + 3];
    b.state = {history[at + 4], history[at + 5]};
    b.V = vec_at(history, at + 6);
    wall.bonds.push_back(b);
  }
}

void save_wall(State& state, const std::string& name, const RigidWall& wall)
{
  const auto row = [](const Vec3& a) { return std::vector<double>{a.x(), a.y(), a.z()}; };
  state.add_common(name + "_x", row(wall.x), 3);
  state.add_common(name + "_v", row(wall.v), 3);
  const auto& q = wall.rotation;
  state.add_common<double>(name + "_rotation", {q.x(), q.y(), q.z(), q.w()}, 4);
  state.add_common(name + "_omega", row(wall.omega), 3);
  save_wall_contacts(state, name, wall.contacts);
}

void load_wall(const State& state, const std::string& name, std::size_t n, RigidWall& wall)
{
  wall.x = vec_at(state.get_rows<double>(name + "_x", 1, 3), 0);
  wall.v = vec_at(state.get_rows<double>(name + "_v", 1, 3), 0);
  const auto& q = state.get_rows<double>(name + "_rotation", 1, 4);
  wall.rotation = Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
  wall.omega = vec_at(state.get_rows<double>(name + "_omega", 1, 3), 0);
  wall.contacts = load_wall_contacts(state, name, n);
}

/// Numbers of walls by their kinds, under names of their own.
template <class Visit>
void visit_counts(const Assembly& assembly, Visit&& visit)
{
  visit("mirrors", assembly.mirrors.size());
  visit("walls", assembly.walls.size());
  visit("rigid_walls", assembly.rigid_walls.size());
}

} // namespace

void save_walls(State& state, const Assembly& assembly)
{
  for_each_named_wall(assembly, [&](const std::string& name, const auto& wall) {
    save_wall(state, name, wall);
  });
  visit_counts(assembly, [&](const char* name, std::size_t n) {
    state.add_common<std::uint64_t>(name, {n});
  });
}

void check_walls(const State& state, const Assembly& assembly)
{
  visit_counts(assembly, [&](const char* name, std::size_t n) {
    const std::uint64_t found = state.get_rows<std::uint64_t>(name, 1)[0];
    if (found != n)
      State::refuse(name, "counts " + std::to_string(found) + ", the case has " +
                              std::to_string(n));
  });
}

void load_walls(const State& state, std::size_t n, Assembly& assembly)
{
  for_each_named_wall(assembly, [&](const std::string& name, auto& wall) {
    load_wall(state, name, n, wall);
  });
}

} // namespace mergel::dem

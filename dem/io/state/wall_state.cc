#include "dem/io/state/wall_state.h"

#include "dem/io/state/state_rows.h"

#include <string>
#include <utility>

namespace mergel::dem {

namespace {

std::string numbered(const char* what, std::size_t k)
{
  return what + std::to_string(k);
}

void check_particle(const std::string& name, std::uint32_t i, std::size_t n)
{
  if (i >= n) State::refuse(name, "names a particle that does not exist");
}

void save_wall_contacts(State& state, const std::string& name,
                        const std::vector<WallContact>& contacts)
{
  std::vector<std::uint32_t> particle;
  std::vector<std::int32_t> patch;
  std::vector<double> history;
  for (const WallContact& c : contacts) {
    if (!is_nonzero(c.f_s, c.energy)) continue;
    particle.push_back(c.particle);
    patch.push_back(c.wall);
    append(history, c.f_s);
    history.push_back(c.energy);
  }
  state.add(name + "_contact_grains", std::move(particle));
  state.add(name + "_contact_patches", std::move(patch));
  state.add(name + "_contact_histories", std::move(history), 4);
}

std::vector<WallContact> load_wall_contacts(const State& state, const std::string& name,
                                            std::size_t n)
{
  const auto& particle = state.get<std::uint32_t>(name + "_contact_grains");
  const auto& patch =
      state.get_rows<std::int32_t>(name + "_contact_patches", particle.size());
  const auto& history =
      state.get_rows<double>(name + "_contact_histories", particle.size(), 4);
  std::vector<WallContact> contacts;
  for (const std::size_t k :
       ascending(name + "_contact_grains", particle.size(), [&](std::size_t a) {
         return std::pair{particle[a], patch[a]};
       })) {
    check_particle(name + "_contact_grains", particle[k], n);
    contacts.push_back({particle[k], patch[k], vec_at(history, 4 * k), history[4 * k + 3]});
  }
  return contacts;
}

void save_mirror(State& state, const std::string& name, const Mirror& mirror)
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

void load_mirror(const State& state, const std::string& name, std::size_t n, Mirror& mirror)
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

constexpr std::size_t wall_bond_columns = 10;

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
    history.push_back(b.energy);
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
  update_normals(wall);
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
    b.energy = history[at + 9];
    wall.bonds.push_back(b);
  }
}

} // namespace

void save_walls(State& state, const Assembly& assembly)
{
  for (std::size_t k = 0; k < assembly.mirrors.size(); ++k)
    save_mirror(state, numbered("mirror", k), assembly.mirrors[k]);
  for (std::size_t k = 0; k < assembly.planes.size(); ++k) {
    const PlaneWall& w = assembly.planes[k];
    std::vector<double> place;
    for (const Vec3& a : {w.plane.point, w.plane.normal, w.plane.v}) append(place, a);
    state.add_common(numbered("plane", k) + "_place", std::move(place), 9);
    save_wall_contacts(state, numbered("plane", k), w.contacts.contacts());
  }
  for (std::size_t k = 0; k < assembly.walls.size(); ++k)
    save_wall(state, numbered("wall", k), assembly.walls[k]);
  for (std::size_t k = 0; k < assembly.piles.size(); ++k) {
    const Pile& a = assembly.piles[k].pile;
    state.add_common<double>(numbered("pile", k) + "_place",
                             {a.R, a.cone_height, a.x_axis, a.y_axis, a.z_tip, a.v_z}, 6);
    save_wall_contacts(state, numbered("pile", k), assembly.piles[k].contacts.contacts());
  }
  state.add_common<std::uint64_t>("bodies",
                                  {assembly.mirrors.size(), assembly.planes.size(),
                                   assembly.walls.size(), assembly.piles.size()});
}

void check_walls(const State& state, const Assembly& assembly)
{
  const std::vector<std::uint64_t> counts{assembly.mirrors.size(), assembly.planes.size(),
                                          assembly.walls.size(), assembly.piles.size()};
  if (state.get_rows<std::uint64_t>("bodies", counts.size()) != counts)
    State::refuse("bodies", "has another number of walls or piles");
}

void load_walls(const State& state, std::size_t n, Assembly& assembly)
{
  for (std::size_t k = 0; k < assembly.mirrors.size(); ++k)
    load_mirror(state, numbered("mirror", k), n, assembly.mirrors[k]);
  for (std::size_t k = 0; k < assembly.planes.size(); ++k) {
    PlaneWall& w = assembly.planes[k];
    const auto& place = state.get_rows<double>(numbered("plane", k) + "_place", 1, 9);
    w.plane = {vec_at(place, 0), vec_at(place, 3), vec_at(place, 6)};
    w.contacts.contacts() = load_wall_contacts(state, numbered("plane", k), n);
  }
  for (std::size_t k = 0; k < assembly.walls.size(); ++k)
    load_wall(state, numbered("wall", k), n, assembly.walls[k]);
  for (std::size_t k = 0; k < assembly.piles.size(); ++k) {
    const auto& a = state.get_rows<double>(numbered("pile", k) + "_place", 1, 6);
    assembly.piles[k].pile = {a[0], a[1], a[2], a[3], a[4], a[5]};
    assembly.piles[k].contacts.contacts() =
        load_wall_contacts(state, numbered("pile", k), n);
  }
}

} // namespace mergel::dem

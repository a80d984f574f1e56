#include "apps/pile/pile_output.h"

#include "apps/run/restart.h"
#include "dem/continuum/shaft_profile.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/polyhedron_surface.h"
#include "dem/version.h"

#include <cstdio>

namespace mergel::apps {

namespace {

const std::vector<std::string> columns{
    "time [s]",
    "depth [m]",
    "depth/D_p [-]",
    "tip depth [m]",
    "tip force of the full pile [N]",
    "shaft force of the full pile [N]",
    "q_c [Pa]",
    "bonds broken [-]",
    "unbalanced-force ratio [-]",
    "kinetic energy of the half model [J]",
    "interface force error [-]",
    "interface moment error [-]",
    "interface power error [-]",
    "energy error [-]",
    "time step [s]",
    "stable step [s]",
    "pile work of the half model [J]",
    "elastic energy of the half model [J]",
    "bond plasticity and damage of the half model [J]",
    "friction of the half model [J]",
    "damping of the half model [J]",
    "stage [-]",
    "head force of the full pile [N]",
    "lateral head force of the full pile [N]",
    "lateral displacement of the head [m]",
    "rotation of the head [rad]",
    "head work of the half model [J]",
    "damping of the half pile [J]",
    "largest overlap [-]",
    "pairs that overlap by more than 0.3 [-]",
    "pairs that overlap by more than 0.5 [-]",
};

/// Energies are those of what is modelled.
std::vector<std::string> columns_of(const PileCase& c)
{
  std::vector<std::string> all = columns;
  const std::string half = " of the half ";
  if (!c.assembly.is_half())
    for (std::string& name : all)
      if (const auto at = name.find(half); at != std::string::npos)
        name.replace(at, half.size(), " of the full ");
  return all;
}

const std::vector<Frames::Kind> kinds{{"particles", "vtp"}, {"bonds", "vtp"},
                                      {"pile", "vtp"},      {"far_field", "vtu"},
                                      {"fields", "vti"},    {"contacts", "vtp"}};

constexpr const char* last_positions = "output_x_last";
constexpr double height_over_surface = 0.5; // of the continuum fields, in diameters
constexpr double layer = 0.5; // thickness of the coloured layers, in diameters

void write_half(const std::filesystem::path& file, const dem::RigidWall& pile, double z_top)
{
  if (const auto* polyhedron = std::get_if<dem::Polyhedron>(&pile.shape))
    dem::write_half_polyhedron(file, *polyhedron, pile.x, pile.rotation, z_top);
  else
    dem::write_half_revolution(file, std::get<dem::Revolution>(pile.shape), pile.x,
                               pile.rotation, z_top);
}

void write_whole(const std::filesystem::path& file, const dem::RigidWall& pile,
                 double z_top)
{
  if (const auto* polyhedron = std::get_if<dem::Polyhedron>(&pile.shape))
    dem::write_polyhedron(file, *polyhedron, pile.x, pile.rotation, z_top);
  else
    dem::write_revolution(file, std::get<dem::Revolution>(pile.shape), pile.x,
                          pile.rotation, z_top);
}

dem::HistoryMark mark_in(const dem::State& state)
{
  const auto& mark = state.get_rows<std::uint64_t>("output_history", 2);
  return {mark[0], mark[1]};
}

} // namespace

PileOutput::PileOutput(const std::filesystem::path& folder, const PileCase& c)
    : case_(c), history_(folder / "history.csv", columns_of(c)), frames_(folder, kinds),
      profiles_(folder, c), shaft_(c)
{
}

PileOutput::PileOutput(const std::filesystem::path& folder, const PileCase& c,
                       const std::filesystem::path& earlier, const dem::State& state)
    : case_(c), history_(folder / "history.csv", columns_of(c), earlier / "history.csv",
                         mark_in(state)),
      frames_(folder, kinds, earlier, state), profiles_(folder, c, earlier, state),
      shaft_(c, state)
{
  if (state.has(last_positions)) { // older checkpoints do not have it
    const auto& x = state.get<double>(last_positions, 3);
    for (std::size_t k = 0; k < x.size(); k += 3)
      x_last_.emplace_back(x[k], x[k + 1], x[k + 2]);
  }
  copy_specimen(earlier, folder);
}

void PileOutput::save(dem::State& state, const PileOutput* output)
{
  const dem::HistoryMark mark = output ? output->history_.mark() : dem::HistoryMark{};
  state.add_common<std::uint64_t>("output_history", {mark.bytes, mark.sum});
  Frames::save(state, output ? &output->frames_ : nullptr);
  PileProfiles::save(state, output ? &output->profiles_ : nullptr);
  ShaftStress::save(state, output ? &output->shaft_ : nullptr);
  std::vector<double> x;
  if (output)
    for (const dem::Vec3& at : output->x_last_) x.insert(x.end(), {at.x(), at.y(), at.z()});
  state.add_common(last_positions, std::move(x), 3);
}

std::string PileOutput::check(const std::filesystem::path& folder, const dem::State& state)
{
  return report_on_history(folder / "history.csv", mark_in(state)) +
         PileProfiles::check(folder, state) + Frames::check(folder, kinds, state);
}

void PileOutput::record(const PileRecord& r, const ShaftRings& rings,
                        const std::vector<dem::RingForce>& forces)
{
  shaft_.add(r.stage, r.tip_depth, r.q_c, rings, forces);
  const dem::EnergyBalance& e = r.balance;
  history_.add({r.time,
                r.depth,
                r.depth / case_.diameter,
                r.tip_depth,
                r.F_tip,
                r.F_shaft,
                r.q_c,
                static_cast<double>(r.broken),
                r.unbalanced,
                r.kinetic,
                r.interface.force,
                r.interface.moment,
                r.interface.power,
                r.energy_error,
                r.time_step,
                r.stable_step,
                e.rigid_wall_work,
                e.bonds + e.contacts + e.walls + e.mirror,
                e.plastic + e.breakage_release,
                e.slip,
                e.damping,
                static_cast<double>(r.stage),
                r.F_head,
                r.F_lateral,
                r.displacement,
                r.rotation,
                r.head.applied_work,
                r.head.damping,
                r.overlaps.largest,
                static_cast<double>(r.overlaps.beyond_mark),
                static_cast<double>(r.overlaps.beyond_high_mark)});
}

ContinuumSpec continuum_spec(const PileCase& c, const dem::Particles& p)
{
  const double D = c.diameter;
  return {0.5 * c.assembly.diameter, c.assembly.height, height_over_surface * D,
          c.averaging_length * dem::finest_d_50(p), layer * D};
}

dem::AssemblyFiles PileOutput::files() const
{
  return {frames_.file(0), frames_.file(1), frames_.file(5)};
}

void PileOutput::write_fields(const PileContinuum& continuum,
                              const coupling::CoupledSystem& coupled) const
{
  const dem::Assembly& assembly = coupled.assembly;
  const dem::RigidWall& pile = assembly.rigid_walls.front();
  const auto write_pile = assembly.mirrors.empty() ? write_whole : write_half;
  write_pile(frames_.file(2), pile, 2.0 * case_.diameter);
  dem::replace_file(frames_.file(3), [&](const std::filesystem::path& path) {
    far_field_of(coupled).write_vtu(path, dem::program_text());
  });
  continuum.write_section(frames_.file(4));
}

void PileOutput::add_frame(double time, const PileContinuum& continuum,
                           const dem::Assembly& assembly)
{
  const double z_tip = assembly.rigid_walls.front().x.z(),
               d_50 = dem::finest_d_50(assembly.particles);
  profiles_.add(
      {time, -z_tip - case_.tip_height(), z_tip, case_.averaging_length * d_50, d_50},
      continuum.sums(), shaft_);
  frames_.add(time);
  x_last_.clear();
  for (const dem::ParticleState& b : assembly.particles.state) x_last_.push_back(b.x);
}

} // namespace mergel::apps

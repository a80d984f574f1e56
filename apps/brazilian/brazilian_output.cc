#include "apps/brazilian/brazilian_output.h"

#include "apps/run/restart.h"

namespace mergel::apps {

namespace {

const std::vector<std::string> columns{"time [s]",
                                       "approach of the plates [m]",
                                       "diametral strain [-]",
                                       "force on the upper plate [N]",
                                       "force on the lower plate [N]",
                                       "load P [N]",
                                       "2P/(pi D t) [Pa]",
                                       "contact half-angle [rad]",
                                       "half-angle of all contacts [rad]",
                                       "particles at the plates [-]",
                                       "stress across at the centre [Pa]",
                                       "stress along at the centre [Pa]",
                                       "broken bonds [-]",
                                       "broken in tension [-]",
                                       "broken in compression [-]",
                                       "broken in shear [-]",
                                       "broken in bending [-]",
                                       "broken at the centre [-]",
                                       "broken at the plates [-]",
                                       "broken elsewhere along the diameter [-]",
                                       "broken at the sides [-]",
                                       "kinetic energy [J]",
                                       "stored energy [J]",
                                       "work of the plates [J]",
                                       "plasticity and damage [J]",
                                       "slip [J]",
                                       "rotation-constraint loss [J]",
                                       "damping [J]",
                                       "energy error [-]",
                                       "unbalanced-force ratio [-]",
                                       "time step [s]",
                                       "stable step [s]"};

const std::vector<Frames::Kind> kinds{{"particles", "vtp"},
                                      {"bonds", "vtp"},
                                      {"breaks", "vtp"},
                                      {"plates", "vtp"},
                                      {"contacts", "vtp"}};

dem::HistoryMark mark_in(const dem::State& state)
{
  const auto& mark = state.get_rows<std::uint64_t>("output_history", 2);
  return {mark[0], mark[1]};
}

double count(std::size_t n)
{
  return static_cast<double>(n);
}

/// Points where bonds broke. The mode is that of the load: 0 tension, 1 compression, 2 shear,
/// 3 bending.
void write_breaks(const std::filesystem::path& file,
                  const std::vector<coupling::DiscBreak>& breaks)
{
  std::vector<dem::Vec3> x;
  dem::Field mode{"mode", 1, {}}, number{"number", 1, {}}, radius{"radius", 1, {}},
      load{"load [N]", 1, {}}, strain{"diametral strain [-]", 1, {}},
      normal{"normal", 3, {}};
  for (const coupling::DiscBreak& b : breaks) {
    mode.values.push_back(static_cast<double>(b.mode));
    number.values.push_back(count(x.size() + 1));
    radius.values.push_back(b.radius);
    load.values.push_back(b.load);
    strain.values.push_back(b.strain);
    normal.values.insert(normal.values.end(), {b.n.x(), b.n.y(), b.n.z()});
    x.push_back(b.x);
  }
  dem::write_points(file, x, {mode, number, radius, load, strain, normal});
}

/// Both plates, as wide as the disc and as long as it is thick.
void write_plates(const std::filesystem::path& file, const dem::Assembly& assembly,
                  const coupling::DiscGeometry& disc)
{
  std::vector<dem::Vec3> nodes;
  std::vector<std::array<dem::Index, 3>> triangles;
  for (const dem::RigidWall& plate : assembly.rigid_walls) {
    const auto first = static_cast<dem::Index>(nodes.size());
    for (const double y : {-0.5, 0.5})
      for (const double x : {-0.5, 0.5})
        nodes.emplace_back(x * disc.diameter, y * disc.thickness, plate.x.z());
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first + 1, first + 3, first + 2});
  }
  dem::write_surface(file, nodes, triangles, {});
}

} // namespace

BrazilianOutput::BrazilianOutput(const std::filesystem::path& folder,
                                 const coupling::DiscGeometry& disc)
    : disc_(disc), history_(folder / "history.csv", columns), frames_(folder, kinds)
{
}

BrazilianOutput::BrazilianOutput(const std::filesystem::path& folder,
                                 const coupling::DiscGeometry& disc,
                                 const std::filesystem::path& earlier,
                                 const dem::State& state)
    : disc_(disc),
      history_(folder / "history.csv", columns, earlier / "history.csv", mark_in(state)),
      frames_(folder, kinds, earlier, state)
{
  copy_specimen(earlier, folder);
}

void BrazilianOutput::save(dem::State& state, const BrazilianOutput* output)
{
  const dem::HistoryMark mark = output ? output->history_.mark() : dem::HistoryMark{};
  state.add_common<std::uint64_t>("output_history", {mark.bytes, mark.sum});
  Frames::save(state, output ? &output->frames_ : nullptr);
}

std::string BrazilianOutput::check(const std::filesystem::path& folder,
                                   const dem::State& state)
{
  return report_on_history(folder / "history.csv", mark_in(state)) +
         Frames::check(folder, kinds, state);
}

void BrazilianOutput::record(const coupling::BrazilianRecord& r)
{
  const dem::EnergyBalance& e = r.balance;
  history_.add({r.time,
                r.approach,
                r.strain,
                r.F_top,
                r.F_bottom,
                r.load,
                disc_.splitting_stress(r.load),
                r.contact.half_angle,
                r.contact.outermost,
                count(r.contact.n),
                r.centre.xx,
                r.centre.zz,
                count(r.broken),
                count(r.broken_by[0]),
                count(r.broken_by[1]),
                count(r.broken_by[2]),
                count(r.broken_by[3]),
                count(r.zones[0]),
                count(r.zones[1]),
                count(r.zones[2]),
                count(r.zones[3]),
                e.kinetic,
                e.bonds + e.contacts + e.walls,
                e.rigid_wall_work,
                e.plastic + e.breakage_release,
                e.slip,
                e.rotation_constraint,
                e.damping,
                r.energy_error,
                r.unbalanced,
                r.time_step,
                r.stable_step});
}

dem::AssemblyFiles BrazilianOutput::files() const
{
  return {frames_.file(0), frames_.file(1), frames_.file(4)};
}

void BrazilianOutput::write_fields(const dem::Assembly& assembly,
                                   const coupling::BrazilianTest& test) const
{
  write_breaks(frames_.file(2), test.breaks());
  write_plates(frames_.file(3), assembly, disc_);
}

} // namespace mergel::apps

#include "apps/triaxial/triaxial_output.h"

#include "apps/run/restart.h"
#include "apps/triaxial/band_output.h"
#include "dem/text.h"

namespace mergel::apps {

namespace {

const std::vector<std::string> columns{"time [s]",
                                       "stage [-]",
                                       "part [-]",
                                       "cycle [-]",
                                       "axial strain [-]",
                                       "axial strain of the middle third [-]",
                                       "lateral strain of the middle third [-]",
                                       "volumetric strain of the middle third [-]",
                                       "axial strain of the stage [-]",
                                       "controlled strain [-]",
                                       "axial stress [Pa]",
                                       "lateral stress [Pa]",
                                       "p [Pa]",
                                       "q [Pa]",
                                       "raw q [Pa]",
                                       "cell pressure [Pa]",
                                       "pressure on the particles [Pa]",
                                       "axial stress of the middle third [Pa]",
                                       "lateral stress of the middle third [Pa]",
                                       "force on the upper platen [N]",
                                       "force on the lower platen [N]",
                                       "tilt of the upper platen [rad]",
                                       "void ratio [-]",
                                       "enclosed volume [m3]",
                                       "volumetric strain of the enclosed volume [-]",
                                       "membrane penetration [-]",
                                       "axial stress of the membrane [Pa]",
                                       "lateral stress of the membrane [Pa]",
                                       "share of the membrane that wrinkles [-]",
                                       "largest stretch of the membrane [-]",
                                       "folds of the membrane [-]",
                                       "broken bonds [-]",
                                       "broken in tension [-]",
                                       "broken in compression [-]",
                                       "broken in shear [-]",
                                       "broken in bending [-]",
                                       "kinetic energy [J]",
                                       "stored energy [J]",
                                       "strain energy of the membrane [J]",
                                       "work of platens and pressure [J]",
                                       "plasticity and damage [J]",
                                       "slip [J]",
                                       "damping [J]",
                                       "energy error [-]",
                                       "interface force error [-]",
                                       "interface moment error [-]",
                                       "interface power error [-]",
                                       "unbalanced-force ratio [-]",
                                       "inertial number [-]",
                                       "time step [s]",
                                       "stable step [s]"};

std::vector<Frames::Kind> kinds_of(const TriaxialCase& c)
{
  std::vector<Frames::Kind> kinds{
      {"particles", "vtp"}, {"bonds", "vtp"}, {"platens", "vtp"}, {"contacts", "vtp"}};
  if (c.membrane.is_there) kinds.push_back({"membrane", "vtp"});
  return kinds;
}

constexpr const char *history_file = "history.csv", *bands_file = "localisation.csv";
constexpr const char *history_mark = "output_history", *bands_mark = "output_localisation";

dem::HistoryMark mark_in(const dem::State& state, const char* name)
{
  const auto& mark = state.get_rows<std::uint64_t>(name, 2);
  return {mark[0], mark[1]};
}

double count(std::size_t n)
{
  return static_cast<double>(n);
}

std::vector<std::array<dem::Index, 3>>
triangles_of(const std::vector<dem::Triangle>& triangles, std::size_t first = 0)
{
  std::vector<std::array<dem::Index, 3>> all;
  for (const dem::Triangle& t : triangles) {
    std::array<dem::Index, 3> to;
    for (std::size_t k = 0; k < 3; ++k)
      to[k] = static_cast<dem::Index>(first + dem::uz(t[k]));
    all.push_back(to);
  }
  return all;
}

/// At the nodes, for the writer of surfaces has no cell data: mean of the triangles around.
std::vector<dem::Field> membrane_fields(const fem::MembraneMotion& motion)
{
  const fem::MembraneFields f = motion.membrane().fields(motion.state().x);
  const auto& triangles = motion.membrane().rest().triangles;
  std::vector<double> n(motion.membrane().rest().x.size(), 0.0);
  for (const auto& t : triangles)
    for (const int k : t) n[dem::uz(k)] += 1.0;
  std::vector<dem::Field> fields;
  const auto add = [&](const char* name, const std::vector<double>& of_triangle) {
    dem::Field field{name, 1, std::vector<double>(n.size(), 0.0)};
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (const int k : triangles[t])
        field.values[dem::uz(k)] += of_triangle[t] / n[dem::uz(k)];
    fields.push_back(std::move(field));
  };
  add("larger stretch [-]", f.stretch_1);
  add("smaller stretch [-]", f.stretch_2);
  add("larger stress [Pa]", f.stress_1);
  add("smaller stress [Pa]", f.stress_2);
  add("taut 2, wrinkled 1, slack 0", f.state);
  return fields;
}

} // namespace

TriaxialOutput::TriaxialOutput(const std::filesystem::path& folder, const TriaxialCase& c)
    : history_(folder / history_file, columns),
      bands_(folder / bands_file, band_headings()), frames_(folder, kinds_of(c))
{
}

TriaxialOutput::TriaxialOutput(const std::filesystem::path& folder, const TriaxialCase& c,
                               const std::filesystem::path& earlier,
                               const dem::State& state)
    : history_(folder / history_file, columns, earlier / history_file,
               mark_in(state, history_mark)),
      bands_(folder / bands_file, band_headings(), earlier / bands_file,
             mark_in(state, bands_mark)),
      frames_(folder, kinds_of(c), earlier, state)
{
  copy_specimen(earlier, folder);
}

void TriaxialOutput::save(dem::State& state, const TriaxialOutput* output)
{
  const auto add = [&](const char* name, const dem::HistoryMark& mark) {
    state.add_common<std::uint64_t>(name, {mark.bytes, mark.sum});
  };
  add(history_mark, output ? output->history_.mark() : dem::HistoryMark{});
  add(bands_mark, output ? output->bands_.mark() : dem::HistoryMark{});
  Frames::save(state, output ? &output->frames_ : nullptr);
}

std::string TriaxialOutput::check(const std::filesystem::path& folder,
                                  const TriaxialCase& c, const dem::State& state)
{
  return report_on_history(folder / history_file, mark_in(state, history_mark)) +
         report_on_history(folder / bands_file, mark_in(state, bands_mark)) +
         Frames::check(folder, kinds_of(c), state);
}

void TriaxialOutput::record(const coupling::TriaxialRecord& r, const StageLabel& stage)
{
  const dem::EnergyBalance& e = r.balance.assembly;
  const coupling::StructureEnergies& s = r.balance.structures;
  history_.add({r.time,
                count(stage.number),
                static_cast<double>(stage.part),
                count(stage.cycle),
                r.whole.axial_strain(),
                r.middle.axial,
                r.middle.lateral,
                r.middle.volumetric,
                r.of_stage.axial_strain(),
                r.controlled_strain,
                r.whole.axial(),
                r.whole.lateral(),
                r.whole.p(),
                r.whole.q(),
                r.q_raw,
                r.cell_pressure,
                r.membrane.delivered,
                r.middle_axial,
                r.middle_lateral,
                r.F_top,
                r.F_bottom,
                r.tilt,
                r.void_ratio,
                r.membrane.volume,
                r.membrane.strain,
                r.membrane.penetration,
                r.membrane.axial,
                r.membrane.hoop,
                r.membrane.wrinkled,
                r.membrane.stretch,
                count(r.membrane.n_folds),
                count(r.broken),
                count(r.broken_by[0]),
                count(r.broken_by[1]),
                count(r.broken_by[2]),
                count(r.broken_by[3]),
                e.kinetic + s.kinetic,
                e.bonds + e.contacts + e.walls,
                s.strain,
                s.applied_work,
                e.plastic + e.breakage_release,
                e.slip,
                e.damping + s.damping,
                r.energy_error,
                r.interface.force,
                r.interface.moment,
                r.interface.power,
                r.unbalanced,
                r.inertial_number,
                r.time_step,
                r.stable_step});
}

void TriaxialOutput::record(const coupling::BandRecord& r, double d_50,
                            const StageLabel& stage)
{
  bands_.add(band_line(r, d_50, stage));
}

std::vector<dem::Field> fields_of(const coupling::LocalStrains& strains)
{
  std::vector<dem::Field> fields = dem::strain_fields(strains.total);
  for (dem::Field& field : dem::strain_fields(strains.increment)) {
    field.name.insert(field.name.find(" ["), " of the increment");
    fields.push_back(std::move(field));
  }
  return fields;
}

dem::AssemblyFiles TriaxialOutput::files() const
{
  return {frames_.file(0), frames_.file(1), frames_.file(3)};
}

void TriaxialOutput::write_fields(const coupling::CoupledSystem& system) const
{
  std::vector<dem::Vec3> nodes;
  std::vector<std::array<dem::Index, 3>> triangles;
  for (std::size_t k = 0; k < 2; ++k) {
    const dem::Wall& platen = system.assembly.walls[k]; // the same on all ranks
    const auto of_platen = triangles_of(platen.topology.triangles, nodes.size());
    triangles.insert(triangles.end(), of_platen.begin(), of_platen.end());
    nodes.insert(nodes.end(), platen.x.begin(), platen.x.end());
  }
  dem::write_surface(frames_.file(2), nodes, triangles, {});
  if (system.structures.size() > 2) {
    const auto& membrane =
        dynamic_cast<const coupling::MembraneStructure&>(*system.structures[2].structure);
    dem::write_surface(frames_.file(4), system.assembly.walls[2].x,
                       triangles_of(system.assembly.walls[2].topology.triangles),
                       membrane_fields(membrane.motion()));
  }
}

} // namespace mergel::apps

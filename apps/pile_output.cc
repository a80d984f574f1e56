#include "apps/pile_output.h"

#include "dem/io/rock_fields.h"

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
    "unbalanced ratio [-]",
    "kinetic energy of the half model [J]",
    "interface force error [-]",
    "interface moment error [-]",
    "interface power error [-]",
    "energy error [-]",
    "pile work of the half model [J]",
    "elastic energy of the half model [J]",
    "bond plasticity and damage of the half model [J]",
    "friction of the half model [J]",
    "damping of the half model [J]",
};

} // namespace

PileOutput::PileOutput(const std::filesystem::path& folder, const PileCase& c)
    : fields_(folder / "fields"), diameter_(c.diameter),
      history_(folder / "history.csv", columns), particles_(folder / "particles.pvd"),
      bonds_(folder / "bonds.pvd"), pile_(folder / "pile.pvd"),
      far_field_(folder / "far_field.pvd")
{
  std::filesystem::create_directories(fields_);
}

void PileOutput::record(const PileRecord& r)
{
  const dem::EnergyBook& e = r.book;
  history_.add({r.time, r.depth, r.depth / diameter_, r.tip_depth, r.F_tip, r.F_shaft,
                r.q_c, static_cast<double>(r.broken), r.unbalanced, r.kinetic,
                r.interface.force, r.interface.moment, r.interface.power, r.energy_error,
                e.pile_work, e.bonds + e.contacts + e.walls + e.mirror,
                e.plastic + e.residue, e.slip, e.damping});
}

void PileOutput::frame(double time, const dem::Rock& rock, const CoupledRock& coupled)
{
  const auto file = [&](const char* what, const char* extension) {
    char name[64];
    std::snprintf(name, sizeof name, "%s_%04d.%s", what, n_frames_, extension);
    return fields_ / name;
  };

  const auto particles = file("particles", "vtp");
  dem::write_particles(particles, rock, coupled.x_0);
  particles_.add(time, particles);

  const auto bonds = file("bonds", "vtp");
  dem::write_bonds(bonds, rock);
  bonds_.add(time, bonds);

  const auto pile = file("pile", "vtp");
  dem::write_pile(pile, rock.piles.front().pile, 2.0 * diameter_);
  pile_.add(time, pile);

  const auto far_field = file("far_field", "vtu");
  coupled.far_field.write_vtu(far_field);
  far_field_.add(time, far_field);
  ++n_frames_;
}

} // namespace mergel::apps

#include "apps/pile_output.h"

#include "dem/error.h"
#include "dem/io/atomic_file.h"
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

struct Kind {
  const char *name, *extension;
};
constexpr Kind kinds[] = {
    {"particles", "vtp"}, {"bonds", "vtp"}, {"pile", "vtp"}, {"far_field", "vtu"}};

/// particles_0012.vtp
std::string frame_name(const Kind& kind, std::size_t frame)
{
  char name[64];
  std::snprintf(name, sizeof name, "%s_%04zu.%s", kind.name, frame, kind.extension);
  return name;
}

/// The frames that there are of a kind.
std::vector<dem::SeriesEntry> entries(const Kind& kind, const std::vector<double>& times)
{
  std::vector<dem::SeriesEntry> found;
  for (const double time : times)
    found.push_back(
        {time, std::filesystem::path("fields") / frame_name(kind, found.size())});
  return found;
}

void copy_whole(const std::filesystem::path& from, const std::filesystem::path& to)
{
  dem::replace_file(to, [&](const std::filesystem::path& path) {
    std::filesystem::copy_file(from, path,
                               std::filesystem::copy_options::overwrite_existing);
  });
}

dem::HistoryMark mark_in(const dem::State& state)
{
  const auto& mark = state.get_rows<std::uint64_t>("output_history", 2);
  return {mark[0], mark[1]};
}

} // namespace

PileOutput::PileOutput(const std::filesystem::path& folder, double diameter,
                       dem::History history, const std::vector<double>& frame_times)
    : fields_(folder / "fields"), diameter_(diameter), history_(std::move(history)),
      frame_times_(frame_times),
      particles_(folder / "particles.pvd", entries(kinds[0], frame_times)),
      bonds_(folder / "bonds.pvd", entries(kinds[1], frame_times)),
      pile_(folder / "pile.pvd", entries(kinds[2], frame_times)),
      far_field_(folder / "far_field.pvd", entries(kinds[3], frame_times))
{
  std::filesystem::create_directories(fields_);
}

PileOutput::PileOutput(const std::filesystem::path& folder, const PileCase& c)
    : PileOutput(folder, c.diameter, dem::History(folder / "history.csv", columns), {})
{
}

PileOutput::PileOutput(const std::filesystem::path& folder, const PileCase& c,
                       const std::filesystem::path& earlier, const dem::State& state)
    : PileOutput(folder, c.diameter,
                 dem::History(folder / "history.csv", columns, earlier / "history.csv",
                              mark_in(state)),
                 state.get<double>("output_frames"))
{
  if (!std::filesystem::equivalent(folder, earlier)) {
    if (std::filesystem::exists(earlier / "sample.h5"))
      copy_whole(earlier / "sample.h5", folder / "sample.h5");
    for (const Kind& kind : kinds)
      for (std::size_t k = 0; k < frame_times_.size(); ++k)
        copy_whole(earlier / "fields" / frame_name(kind, k), fields_ / frame_name(kind, k));
  }
  for (dem::Series* series : {&particles_, &bonds_, &pile_, &far_field_}) series->write();
}

void PileOutput::put(dem::State& state, const PileOutput* output)
{
  const dem::HistoryMark mark = output ? output->history_.mark() : dem::HistoryMark{};
  state.add_common<std::uint64_t>("output_history", {mark.bytes, mark.sum});
  state.add_common("output_frames", output ? output->frame_times_ : std::vector<double>{});
}

void PileOutput::check(const std::filesystem::path& folder, const dem::State& state)
{
  dem::check_history(folder / "history.csv", mark_in(state));
  for (const Kind& kind : kinds)
    for (std::size_t k = 0; k < n_frames(state); ++k) {
      const auto file = folder / "fields" / frame_name(kind, k);
      require(std::filesystem::is_regular_file(file),
              file.string() + ": is missing, so the series cannot be continued. Put it "
                              "back.");
    }
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
  const auto file = [&](const Kind& kind) {
    return fields_ / frame_name(kind, frame_times_.size());
  };

  const auto particles = file(kinds[0]);
  dem::write_particles(particles, rock, coupled.x_0);
  particles_.add(time, particles);

  const auto bonds = file(kinds[1]);
  dem::write_bonds(bonds, rock);
  bonds_.add(time, bonds);

  const auto pile = file(kinds[2]);
  dem::write_pile(pile, rock.piles.front().pile, 2.0 * diameter_);
  pile_.add(time, pile);

  const auto far_field = file(kinds[3]);
  dem::replace_file(far_field, [&](const std::filesystem::path& path) {
    coupled.far_field.write_vtu(path);
  });
  far_field_.add(time, far_field);
  frame_times_.push_back(time);
}

} // namespace mergel::apps

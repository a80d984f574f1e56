/// mergel pile: install a cone-ended pile by jacking into bonded rock.
#include "apps/coupled_rock.h"
#include "apps/jobs.h"
#include "apps/output_folder.h"
#include "apps/pile_output.h"
#include "apps/progress.h"
#include "apps/ranks.h"
#include "dem/distribute.h"
#include "dem/io/atomic_file.h"

#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>

namespace mergel::apps {

namespace {

/// Where bonds between grains broke, seen from the pile as it stood then.
class BreakageCount {
public:
  std::size_t all = 0;
  std::size_t near = 0;  ///< within 2 D_p of the axis
  std::size_t above = 0; ///< more than D_p above the shoulder and outside the shaft

  /// Count the bonds that broke since the last call; collective.
  void update(const dem::Rock& rock)
  {
    const dem::Pile& pile = rock.piles.front().pile;
    const double D = 2.0 * pile.R;
    const auto& breakages = rock.losses.breakages;
    std::size_t n_near = 0, n_above = 0;
    for (std::size_t k = n_seen_; k < breakages.size(); ++k) {
      const dem::Vec3& x = breakages[k].x;
      const double r = std::hypot(x.x() - pile.x_axis, x.y() - pile.y_axis);
      n_near += r <= 2.0 * D;
      n_above += x.z() > pile.z_shoulder() + D && r > pile.R;
    }
    all += rock.domain.sum(breakages.size() - n_seen_);
    near += rock.domain.sum(n_near);
    above += rock.domain.sum(n_above);
    n_seen_ = breakages.size();
  }

private:
  std::size_t n_seen_ = 0;
};

/// Velocity that starts and ends with a ramp of constant acceleration over 0.05 D.
class Jack {
public:
  explicit Jack(const PileCase& c)
      : v_(c.velocity), ramp_(0.05 * c.diameter), travel_(c.travel())
  {
  }
  double velocity(double travelled) const
  {
    // v^2 = 2 a s; a floor of 1 % lets the first step begin and the last one end.
    const double s = std::min(travelled, travel_ - travelled);
    return v_ * std::clamp(std::sqrt(std::max(0.0, s) / ramp_), 0.01, 1.0);
  }
  double travel() const { return travel_; }

private:
  double v_, ramp_, travel_;
};

/// Mean pile forces between two records.
struct MeanForce {
  double cone = 0.0, shaft = 0.0;
  std::size_t n = 0;

  void add(const dem::PileLoad& load)
  {
    cone += load.cone.z.value();
    shaft += load.shaft.z.value();
    ++n;
  }
};

/// Drives the pile down and keeps the books.
class Installation {
public:
  /// @param output null on all ranks but the first
  Installation(const PileCase& c, CoupledRock& coupled, PileOutput* output)
      : case_(c), coupled_(coupled), output_(output), jack_(c), start_(coupled.books())
  {
    dem::PileWall pile;
    pile.pile.R = 0.5 * c.diameter;
    pile.pile.cone_height = c.cone_height();
    pile.material = c.contact;
    coupled.rock.piles.push_back(pile);
    coupled.rock.list.invalidate();
    dem::add_forces(coupled.rock, 0.0);
    std::size_t n = 0; // each where its first grain is owned
    for (const dem::Pair& q : coupled.rock.bonds.pairs)
      n += coupled.rock.particles.owns(q.i);
    n_between_ = coupled.rock.domain.sum(n);
    n = 0;
    for (const dem::Wall& w : coupled.rock.walls) n += w.bonds.size();
    for (const dem::Mirror& m : coupled.rock.mirrors)
      for (const dem::MirrorPair& pair : m.pairs) n += pair.bond.intact > 0.0;
    n_bonds_ = n_between_ + coupled.rock.domain.sum(n);
  }

  void run()
  {
    dem::Pile& pile = coupled_.rock.piles.front().pile;
    Progress progress("driving");
    frame();
    int n_frames = 1;
    double next_record = case_.record_every;
    while (travelled() < jack_.travel()) {
      coupled_.step([&](double dt) {
        pile.v_z = -jack_.velocity(travelled());
        pile.z_tip += dt * pile.v_z;
      });
      time_ += coupled_.dt_before;
      force_.add(coupled_.rock.piles.front().load);
      if (coupled_.n_steps % CoupledRock::steps_between_checks == 0)
        dem::check_overlaps(coupled_.rock);

      const bool is_over = travelled() >= jack_.travel();
      if (travelled() >= next_record || is_over) {
        record();
        next_record += case_.record_every;
      }
      if (travelled() >= jack_.travel() * n_frames / case_.frames || is_over) {
        frame();
        ++n_frames;
      }
      if (coupled_.n_steps % 20 == 0)
        progress.update(travelled() / jack_.travel(), [&] { return now(); });
    }
    progress.done(now());
  }

  const PileRecord& last() const { return last_; }
  double peak() const { return q_peak_; }
  double worst_energy_error() const { return worst_energy_error_; }
  const coupling::InterfaceBalance& worst_interface() const { return worst_interface_; }
  const BreakageCount& breakage() const { return breakage_; }
  std::size_t n_bonds() const { return n_bonds_; }     ///< of all kinds, when driving began
  std::size_t n_between() const { return n_between_; } ///< of these, between grains

private:
  double travelled() const { return -coupled_.rock.piles.front().pile.z_tip; }

  void frame()
  {
    const dem::Rock rock = dem::whole(coupled_.rock);
    if (output_) output_->frame(time_, rock, coupled_);
  }

  std::string now() const
  {
    std::ostringstream out;
    out.precision(3);
    out << "depth " << 1e3 * last_.depth << " mm (" << last_.depth / case_.diameter
        << " D_p)  q_c " << 1e-6 * last_.q_c << " MPa  broken " << last_.broken;
    return out.str();
  }

  void record()
  {
    const double half_to_full = 2.0;
    const double area = 0.25 * dem::pi * case_.diameter * case_.diameter;
    const CoupledRock::Books books = coupled_.books();
    PileRecord r;
    r.time = time_;
    r.tip_depth = travelled();
    r.depth = r.tip_depth - case_.cone_height();
    r.F_tip = half_to_full * force_.cone / static_cast<double>(force_.n);
    r.F_shaft = half_to_full * force_.shaft / static_cast<double>(force_.n);
    r.q_c = r.F_tip / area;
    breakage_.update(coupled_.rock);
    r.broken = coupled_.rock.domain.sum(
        coupled_.rock.losses.broken); // none while settling: equilibrate() throws
    r.unbalanced = coupled_.unbalanced();
    r.kinetic = books.rock.kinetic;
    r.interface = coupled_.balance();
    r.book = books.rock;
    r.book.pile_work -= start_.rock.pile_work;
    r.book.plastic -= start_.rock.plastic;
    r.book.residue -= start_.rock.residue;
    r.book.slip -= start_.rock.slip;
    r.book.damping -= start_.rock.damping;

    // What was stored at the start counts as put in: the tip meets the first grain after
    // some travel.
    const double input = start_.rock.stored() + std::abs(books.rock.pile_work) +
                         std::abs(books.rock.gravity - start_.rock.gravity);
    const double error = CoupledRock::unexplained(books, start_);
    r.energy_error = input > 0.0 ? error / input : 0.0;
    force_ = {};
    last_ = r;
    q_peak_ = std::max(q_peak_, r.q_c);
    if (output_) output_->record(r);

    worst_energy_error_ = std::max(worst_energy_error_, std::abs(r.energy_error));
    worst_interface_.force = std::max(worst_interface_.force, r.interface.force);
    worst_interface_.moment = std::max(worst_interface_.moment, r.interface.moment);
    worst_interface_.power = std::max(worst_interface_.power, r.interface.power);
    if (std::abs(r.energy_error) > 0.01)
      throw NumericalError("the energy book leaves " + dem::shortest(r.energy_error) +
                           " of the input unexplained (at most 0.01) at step " +
                           std::to_string(coupled_.n_steps) + ", t = " +
                           dem::shortest(time_) + " s: lower `Motion/time step safety`");
  }

  const PileCase& case_;
  CoupledRock& coupled_;
  PileOutput* output_;
  Jack jack_;
  CoupledRock::Books start_;
  BreakageCount breakage_;
  MeanForce force_;
  PileRecord last_;
  double time_ = 0.0, q_peak_ = 0.0, worst_energy_error_ = 0.0;
  coupling::InterfaceBalance worst_interface_;
  std::size_t n_bonds_ = 0, n_between_ = 0;
};

/// Grains that flew over the rim of the interface; they are followed, but nothing catches them.
std::size_t count_debris(const dem::Rock& rock, double lip)
{
  std::size_t n = 0;
  rock.particles.for_owned([&](dem::Index i) { n += rock.particles.body[i].x.z() > lip; });
  return rock.domain.sum(n);
}

struct Share {
  const char* name;
  double seconds;
};

/// Time of a step by its parts, as shares of the whole.
std::string shares(const CoupledRock& coupled, double seconds)
{
  const dem::StepTimes& t = coupled.rock.times;
  const double far = coupled.exchange.far_field_seconds,
               ex = coupled.exchange.exchange_seconds;
  const double whole = t.total() + far + ex;
  std::ostringstream out;
  out.precision(3);
  out << "time of a step: " << 1e6 * whole / static_cast<double>(coupled.n_steps)
      << " us in " << coupled.n_steps << " steps, "
      << 1e9 * whole / static_cast<double>(coupled.n_steps * coupled.rock.particles.size())
      << " ns a grain;";
  for (const Share& s : {Share{"bonds", t.bonds},
                         {"contacts", t.contacts},
                         {"walls", t.walls},
                         {"motion", t.motion},
                         {"ranks", t.exchange},
                         {"lists", t.lists},
                         {"far field", far},
                         {"coupling", ex}})
    out << ' ' << s.name << ' ' << 100.0 * s.seconds / whole << " %,";
  out << " whole run " << duration_text(seconds);
  return out.str();
}

void write_summary(const std::filesystem::path& file, const Installation& run,
                   const CoupledRock& coupled, std::size_t n_debris, double seconds)
{
  const PileRecord& r = run.last();
  const BreakageCount& broken = run.breakage();
  std::ostringstream out;
  const auto number = [&](const char* name, double value, const char* end = ",\n") {
    out << "  \"" << name << "\": " << dem::shortest(value) << end;
  };
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  out << "{\n";
  number("depth [m]", r.depth);
  number("tip depth [m]", r.tip_depth);
  number("q_c [Pa]", r.q_c);
  number("largest q_c [Pa]", run.peak());
  number("tip force of the full pile [N]", r.F_tip);
  number("shaft force of the full pile [N]", r.F_shaft);
  number("bonds [-]", count(run.n_bonds()));
  number("bonds broken [-]", count(r.broken));
  number("bonds between grains [-]", count(run.n_between()));
  number("broken between grains [-]", count(broken.all));
  number("broken within 2 D_p of the axis [-]", count(broken.near));
  number("broken more than D_p above the shoulder [-]", count(broken.above));
  number("grains above the lip [-]", count(n_debris));
  number("largest energy error [-]", run.worst_energy_error());
  number("largest interface force error [-]", run.worst_interface().force);
  number("largest interface moment error [-]", run.worst_interface().moment);
  number("largest interface power error [-]", run.worst_interface().power);
  number("particles [-]", count(coupled.rock.particles.size()));
  number("far-field cells [-]", count(coupled.far_field.n_cells()));
  number("steps [-]", count(coupled.n_steps));
  number("time step [s]", coupled.dt);
  number("wall-clock time [s]", seconds, "\n");
  out << "}\n";
  dem::replace_file(file, out.str());
}

void print_summary(const std::filesystem::path& folder, const PileCase& c,
                   const Installation& run, const CoupledRock& coupled,
                   std::size_t n_debris, double seconds)
{
  const PileRecord& r = run.last();
  const BreakageCount& broken = run.breakage();
  const auto percent = [](std::size_t part, std::size_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
  };
  std::cout.precision(4);
  std::cout << "\npile at " << 1e3 * r.depth << " mm (" << r.depth / c.diameter
            << " D_p): q_c " << 1e-6 * r.q_c << " MPa, largest " << 1e-6 * run.peak()
            << " MPa; tip " << r.F_tip << " N, shaft " << r.F_shaft << " N (full pile)\n"
            << "bonds broken: " << r.broken << " of " << run.n_bonds() << ", " << broken.all
            << " of them between grains: " << percent(broken.near, broken.all)
            << " % within 2 D_p of the axis, " << broken.above
            << " more than D_p above the shoulder when they broke; " << n_debris
            << " grains flew above the lip\n"
            << "energy book closes to " << 100.0 * run.worst_energy_error()
            << " % of the input; interface balances to " << run.worst_interface().force
            << " (force), " << run.worst_interface().moment << " (moment), "
            << run.worst_interface().power << " (power)\n"
            << shares(coupled, seconds) << "\nresults: " << folder.string()
            << " (history.csv, summary.json, *.pvd for ParaView); pictures: mergel-view "
            << folder.string() << "\n";
}

} // namespace

void help_pile(std::ostream& out)
{
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.help(out);
}

int run_pile(const JobOptions& options)
{
  const double start = dem::wall_clock();
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read(options.case_file, options.set);
  complete(file, c);
  const OutputFolder folder(options.output,
                            options.overwrite ? Earlier::overwrite : Earlier::keep);
  std::vector<std::filesystem::path> inputs{options.case_file};
  if (!c.rock.sample.empty()) inputs.push_back(c.rock.sample);
  on_first_rank([&] { folder.check(inputs); });

  fem::FarField far_field = make_far_field(c.rock);
  coupling::Interface interface =
      coupling::make_interface(far_field.interface(), c.rock.interface, c.rock.lip);
  const dem::Sample sample = obtain_sample(file, c.rock);
  std::cout << far_field.summary() << '\n' << report(c.rock, sample) << '\n';

  std::optional<PileOutput> output;
  on_first_rank([&] {
    folder.commit(inputs);
    file.write_resolved(folder.path() / "resolved.prm");
    dem::write_sample(folder.path() / "sample.h5", sample);
    output.emplace(folder.path(), c);
  });

  CoupledRock coupled(c.rock, sample, std::move(far_field), std::move(interface));
  equilibrate(coupled, c.rock.balance, 200'000);
  Installation run(c, coupled, output ? &*output : nullptr);
  run.run();

  const double seconds = dem::wall_clock() - start;
  const std::size_t n_debris = count_debris(coupled.rock, c.rock.lip);
  on_first_rank([&] {
    write_summary(folder.path() / "summary.json", run, coupled, n_debris, seconds);
  });
  print_summary(folder.path(), c, run, coupled, n_debris, seconds);
  return 0;
}

} // namespace mergel::apps

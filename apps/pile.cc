/// mergel pile: install a cone-ended pile by jacking into bonded rock.
#include "apps/coupled_rock.h"
#include "apps/jobs.h"
#include "apps/output_folder.h"
#include "apps/pile_output.h"
#include "apps/progress.h"
#include "apps/ranks.h"
#include "apps/restart.h"
#include "dem/distribute.h"
#include "dem/io/atomic_file.h"

#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>
#include <type_traits>

namespace mergel::apps {

namespace {

/// Where bonds between grains broke, seen from the pile as it stood then.
class BreakageCount {
public:
  std::size_t all = 0;
  std::size_t near = 0;  ///< within 2 D_p of the axis
  std::size_t above = 0; ///< more than D_p above the shoulder and outside the shaft

  /// Count the bonds that broke since the last call, and forget them; collective.
  void take(dem::Rock& rock)
  {
    const dem::Pile& pile = rock.piles.front().pile;
    const double D = 2.0 * pile.R;
    std::size_t n_near = 0, n_above = 0;
    for (const dem::Breakage& b : rock.losses.breakages) {
      const dem::Vec3& x = b.x;
      const double r = std::hypot(x.x() - pile.x_axis, x.y() - pile.y_axis);
      n_near += r <= 2.0 * D;
      n_above += x.z() > pile.z_shoulder() + D && r > pile.R;
    }
    all += rock.domain.sum(rock.losses.breakages.size());
    near += rock.domain.sum(n_near);
    above += rock.domain.sum(n_above);
    rock.losses.breakages.clear();
  }
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
  double slows_down_at() const { return travel_ - ramp_; } ///< travel of the tip [m]

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

/// The pile with its tip at the surface, at rest.
dem::PileWall make_pile(const PileCase& c)
{
  dem::PileWall pile;
  pile.pile.R = 0.5 * c.diameter;
  pile.pile.cone_height = c.cone_height();
  pile.material = c.contact;
  return pile;
}

/// Drives the pile down and keeps the books.
class Installation {
public:
  /// @param output null on all ranks but the first
  Installation(const PileCase& c, CoupledRock& coupled, PileOutput* output)
      : case_(c), coupled_(coupled), output_(output), jack_(c)
  {
    next_record_ = c.record_every;
  }

  /// Whether a state is that of a pile under way.
  static bool is_in(const dem::State& state) { return state.has("pile_numbers"); }
  /// Of the tip in such a state [m].
  static double travelled_in(const dem::State& state)
  {
    return -state.get_rows<double>("pile0_place", 1, 6)[4];
  }

  /// Put the pile on the rock in equilibrium.
  void begin()
  {
    CoupledRock& coupled = coupled_;
    start_ = coupled.books();
    coupled.rock.piles.push_back(make_pile(case_));
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
    frame();
    n_frames_ = 1;
  }

  void put(dem::State& state) const;
  /// Go on as put() told.
  void take(const dem::State& state);
  /// The next record, or frame, by a spacing that is not that of the run so far.
  void space_records_anew();
  void space_frames_anew();

  /// @param after_step called between two steps, for checkpoints
  void run(const std::function<void()>& after_step)
  {
    dem::Pile& pile = coupled_.rock.piles.front().pile;
    Progress progress("driving");
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
      if (travelled() >= next_record_ || is_over) {
        record();
        next_record_ += case_.record_every;
      }
      if (travelled() >= next_frame() || is_over) {
        frame();
        ++n_frames_;
      }
      if (coupled_.n_steps % 20 == 0)
        progress.update(travelled() / jack_.travel(), [&] { return now(); });
      if (!is_over) after_step();
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
  double next_frame() const
  {
    return jack_.travel() * static_cast<double>(n_frames_) / case_.frames;
  }

  /// Every number of a run, to be kept and taken; `self` may be const.
  template <class Self>
  static auto numbers_of(Self& self);
  template <class Self>
  static auto counts_of(Self& self);

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
    breakage_.take(coupled_.rock);
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
  double next_record_ = 0.0; ///< travel [m]
  std::size_t n_frames_ = 0; ///< thresholds of frames passed, the first included
  coupling::InterfaceBalance worst_interface_;
  std::size_t n_bonds_ = 0, n_between_ = 0;
};

template <class Self>
auto Installation::numbers_of(Self& self)
{
  using Number = std::conditional_t<std::is_const_v<Self>, const double, double>;
  std::vector<Number*> all{&self.time_,        &self.q_peak_,     &self.worst_energy_error_,
                           &self.next_record_, &self.force_.cone, &self.force_.shaft};
  for (auto* b : {&self.worst_interface_, &self.last_.interface})
    all.insert(all.end(), {&b->force, &b->moment, &b->power});
  auto& r = self.last_;
  all.insert(all.end(), {&r.time, &r.depth, &r.tip_depth, &r.F_tip, &r.F_shaft, &r.q_c,
                         &r.unbalanced, &r.kinetic, &r.energy_error});
  for (auto* e : {&self.start_.rock, &self.last_.book})
    all.insert(all.end(), {&e->kinetic, &e->bonds, &e->contacts, &e->walls, &e->mirror,
                           &e->gravity, &e->wall_work, &e->pile_work, &e->slip, &e->plastic,
                           &e->residue, &e->lock, &e->damping});
  auto& f = self.start_.far_field;
  all.insert(all.end(), {&f.kinetic, &f.strain, &f.interface_work, &f.gravity_work,
                         &f.initial_stress_work, &f.damping});
  return all;
}

template <class Self>
auto Installation::counts_of(Self& self)
{
  using Count = std::conditional_t<std::is_const_v<Self>, const std::size_t, std::size_t>;
  return std::vector<Count*>{
      &self.force_.n,        &self.last_.broken, &self.breakage_.all, &self.breakage_.near,
      &self.breakage_.above, &self.n_frames_,    &self.n_bonds_,      &self.n_between_};
}

void Installation::put(dem::State& state) const
{
  std::vector<double> numbers;
  for (const double* a : numbers_of(*this)) numbers.push_back(*a);
  std::vector<std::uint64_t> counts;
  for (const std::size_t* n : counts_of(*this)) counts.push_back(*n);
  state.add_common("pile_numbers", std::move(numbers));
  state.add_common("pile_counts", std::move(counts));
}

void Installation::take(const dem::State& state)
{
  const auto all = numbers_of(*this);
  const auto& numbers = state.get_rows<double>("pile_numbers", all.size());
  for (std::size_t k = 0; k < all.size(); ++k) *all[k] = numbers[k];
  const auto all_counts = counts_of(*this);
  const auto& counts = state.get_rows<std::uint64_t>("pile_counts", all_counts.size());
  for (std::size_t k = 0; k < all_counts.size(); ++k) *all_counts[k] = counts[k];
}

void Installation::space_records_anew()
{
  next_record_ = case_.record_every * (std::floor(travelled() / case_.record_every) + 1.0);
}

void Installation::space_frames_anew()
{
  n_frames_ = 1;
  while (n_frames_ < static_cast<std::size_t>(case_.frames) && next_frame() <= travelled())
    ++n_frames_;
}

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

/// Steps of this start of the program, seconds of the whole run.
struct Work {
  std::size_t n_steps;
  double seconds;
};

/// Time of a step by its parts, as shares of the whole.
std::string shares(const CoupledRock& coupled, const Work& work)
{
  const dem::StepTimes& t = coupled.rock.times;
  const double far = coupled.exchange.far_field_seconds,
               ex = coupled.exchange.exchange_seconds;
  const double whole = t.total() + far + ex;
  std::ostringstream out;
  out.precision(3);
  out << "time of a step: " << 1e6 * whole / static_cast<double>(work.n_steps) << " us in "
      << work.n_steps << " steps, "
      << 1e9 * whole / static_cast<double>(work.n_steps * coupled.rock.particles.size())
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
  out << " whole run " << duration_text(work.seconds);
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
                   std::size_t n_debris, const Work& work)
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
            << shares(coupled, work) << "\nresults: " << folder.string()
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

namespace {

/// Keys that a restart may change.
const std::vector<std::string> free_keys{"Pile/final depth", "Output/record every",
                                         "Output/frames", "Output/checkpoint every",
                                         "Specimen/file"};

/// The velocity near the end depends on where the end is: a run that slows down, or would
/// have by now, cannot get another end.
void check_new_end(const CaseFile& file, const PileCase& c, const Restart& restart)
{
  if (!Installation::is_in(restart.checkpoint.state)) return;
  CaseFile earlier_file;
  PileCase earlier;
  declare(earlier_file, earlier);
  earlier_file.read_text(restart.checkpoint.label.case_text, restart.file.string());
  if (earlier.travel() == c.travel()) return;
  const double travelled = Installation::travelled_in(restart.checkpoint.state);
  if (travelled <= std::min(Jack(earlier).slows_down_at(), Jack(c).slows_down_at())) return;
  const auto mm = [](double x) { return dem::shortest(1e3 * x) + " mm"; };
  file.refuse(
      "Pile", "final depth",
      "was " + mm(earlier.final_depth) + ", and with its tip at " + mm(travelled) +
          " the checkpoint lies beyond the place where the pile begins to slow down "
          "for one of the two: restore it, or take an older checkpoint");
}

/// Files that the run reads after the folder was looked at.
std::vector<std::filesystem::path> inputs_of(const JobOptions& options, const PileCase& c,
                                             const std::optional<Restart>& restart)
{
  std::vector<std::filesystem::path> inputs;
  if (options.restart.empty()) inputs.push_back(options.case_file);
  if (restart) inputs.push_back(restart->file);
  if (!restart && !c.rock.sample.empty()) inputs.push_back(c.rock.sample);
  return inputs;
}

/// What a run had done before this start of the program.
struct WorkBefore {
  std::size_t n_steps = 0;
  double seconds = 0.0;
};

WorkBefore take_work(const dem::Checkpoint& checkpoint)
{
  return {checkpoint.label.step, checkpoint.state.get_rows<double>("seconds", 1).front()};
}

void go_on(Installation& run, const dem::State& state,
           const std::vector<CaseFile::Change>& changed)
{
  run.take(state);
  for (const CaseFile::Change& c : changed) {
    if (c.key == "record every") run.space_records_anew();
    if (c.key == "final depth" || c.key == "frames") run.space_frames_anew();
  }
}

} // namespace

int run_pile(const JobOptions& options)
{
  const double start = dem::wall_clock();
  std::optional<Restart> restart = find_restart(options.restart, "pile");
  CaseFile file;
  PileCase c;
  declare(file, c);
  std::vector<CaseFile::Change> changed;
  on_every_rank([&] {
    read_case(file, options, restart);
    complete(file, c);
    if (!restart) return;
    changed = check_case(file, *restart, free_keys);
    check_new_end(file, c, *restart);
  });
  if (restart) std::cout << report(*restart, changed) << '\n';
  OutputFolder folder(options.output, Earlier::keep);
  const auto inputs = inputs_of(options, c, restart);
  on_first_rank([&] {
    folder = folder_of(options, restart);
    folder.check(inputs);
    if (restart) PileOutput::check(restart->folder, restart->checkpoint.state);
  });

  fem::FarField far_field = make_far_field(c.rock);
  coupling::Interface interface =
      coupling::make_interface(far_field.interface(), c.rock.interface, c.rock.lip);
  std::optional<PileOutput> output;
  std::optional<CoupledRock> coupled;
  if (restart) {
    std::cout << far_field.summary() << '\n';
    dem::State& state = restart->checkpoint.state;
    std::vector<dem::PileWall> piles;
    if (Installation::is_in(state)) piles.push_back(make_pile(c));
    coupled.emplace(c.rock, state, std::move(piles), std::move(far_field),
                    std::move(interface));
    on_first_rank([&] {
      go_on_in(folder, inputs, file, *restart);
      output.emplace(folder.path(), c, restart->folder, state);
    });
    restart->file = bring_along(restart->file, folder.path());
  } else {
    const dem::Sample sample = obtain_sample(file, c.rock);
    std::cout << far_field.summary() << '\n' << report(c.rock, sample) << '\n';
    on_first_rank([&] {
      folder.commit(inputs);
      file.write_resolved(folder.path() / "resolved.prm");
      dem::write_sample(folder.path() / "sample.h5", sample);
      output.emplace(folder.path(), c);
    });
    coupled.emplace(c.rock, sample, std::move(far_field), std::move(interface));
  }

  Installation run(c, *coupled, output ? &*output : nullptr);
  const WorkBefore before = restart ? take_work(restart->checkpoint) : WorkBefore{};
  const auto seconds = [&] { return before.seconds + dem::wall_clock() - start; };
  Keeper keeper({.folder = folder.path(),
                 .job = "pile",
                 .case_text = file.resolved_text(),
                 .every = c.checkpoints.every,
                 .end = start + options.walltime,
                 .restarted_from = restart ? restart->file : std::filesystem::path{}});
  bool is_driving = restart && Installation::is_in(restart->checkpoint.state);
  if (is_driving) go_on(run, restart->checkpoint.state, changed);
  restart.reset(); // its arrays are no longer needed
  const auto after_step = [&] {
    keeper.after_step(
        coupled->rock.domain,
        {coupled->n_steps, coupled->time, is_driving ? "driving" : "settling"},
        [&](dem::State& state) {
          coupled->put(state);
          PileOutput::put(state, output ? &*output : nullptr);
          state.add_common<double>("seconds", {seconds()});
          if (is_driving) run.put(state);
        });
  };
  try {
    equilibrate(*coupled, c.rock.balance, 200'000, after_step);
    if (!is_driving) run.begin();
    is_driving = true;
    run.run(after_step);
  } catch (...) {
    keeper.rethrow_with_remedy();
  }

  const std::size_t n_debris = count_debris(coupled->rock, c.rock.lip);
  on_first_rank([&] {
    write_summary(folder.path() / "summary.json", run, *coupled, n_debris, seconds());
  });
  print_summary(folder.path(), c, run, *coupled, n_debris,
                {coupled->n_steps - before.n_steps, seconds()});
  return 0;
}

} // namespace mergel::apps

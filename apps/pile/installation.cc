#include "apps/pile/installation.h"

#include "apps/run/progress.h"
#include "apps/run/ranks.h"
#include "apps/run/step_report.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mergel::apps {

void BreakageCount::collect(const PileCase& c, dem::Assembly& assembly)
{
  const dem::RigidWall& pile = assembly.rigid_walls.front();
  const double D = c.diameter, R = 0.5 * D, z_shoulder = pile.x.z() + c.tip_height();
  std::size_t n_near = 0, n_above = 0, n_at_tip = 0, n_away = 0;
  for (const dem::Breakage& b : assembly.losses.breakages) {
    const dem::Vec3& x = b.x;
    const double r = std::hypot(x.x() - pile.x.x(), x.y() - pile.x.y());
    n_near += r <= 2.0 * D;
    n_above += x.z() > z_shoulder + D && r > R;
    n_at_tip += x.z() < z_shoulder && (x - pile.x).norm() <= 2.0 * D;
    n_away += x.z() > z_shoulder + R && r > R + 0.5 * D && x.z() < -D;
    to_far_field =
        std::min({to_far_field, 0.5 * c.assembly.diameter - std::hypot(x.x(), x.y()),
                  c.assembly.height + x.z()});
  }
  all += assembly.comm.global_sum(assembly.losses.breakages.size());
  near += assembly.comm.global_sum(n_near);
  above += assembly.comm.global_sum(n_above);
  at_tip += assembly.comm.global_sum(n_at_tip);
  away += assembly.comm.global_sum(n_away);
  to_far_field = -assembly.comm.global_max(-to_far_field);
  assembly.losses.breakages.clear();
}

// Both kinds of pile have the same parts.
static_assert(std::size_t{dem::Revolution::tip} == dem::Polyhedron::tip &&
              std::size_t{dem::Revolution::shaft} == dem::Polyhedron::shaft);

void MeanForce::add(const dem::RigidWall& pile, const coupling::DrivenPile& head_of_pile)
{
  tip += pile.force[dem::Revolution::tip].z.value();
  shaft += pile.force[dem::Revolution::shaft].z.value();
  head += head_of_pile.head_force(pile);
  lateral += head_of_pile.lateral_force(pile);
  ++n;
}

namespace {

dem::RigidShape shape_of(const PileCase& c)
{
  if (c.surface.polyhedron) return *c.surface.polyhedron;
  const double R = 0.5 * c.diameter;
  return c.tip == PileCase::Tip::flat ? dem::flat_ended(R)
                                      : dem::cone_ended(R, c.tip_height());
}

} // namespace

dem::RigidWall make_pile(const PileCase& c)
{
  dem::RigidWall pile = dem::make_rigid_wall(shape_of(c), dem::Vec3::Zero(), c.contact);
  pile.reach = c.assembly.height; // what it touches is in the DEM region
  return pile;
}

Installation::Installation(const PileCase& c, coupling::CoupledSystem& coupled,
                           std::optional<PileOutput>& output)
    : case_(c), coupled_(coupled), output_(output), stage_run_(c, coupled),
      rings_(c, dem::finest_d_50(coupled.assembly.particles))
{
}

void Installation::begin()
{
  coupled_.assembly.rigid_walls.push_back(make_pile(case_));
  coupled_.assembly.list.invalidate();
  dem::add_forces(coupled_.assembly, 0.0);
  coupled_.find_time_step();
  coupled_.time = 0.0; // messages and checkpoints count from here, as history.csv does
  start_ = coupled_.energy_balances(); // a flat tip may press on particles where it stands
  count_bonds();
  frame();
}

void Installation::count_bonds()
{
  const dem::Assembly& assembly = coupled_.assembly;
  std::size_t n = 0; // each on the rank that owns its first particle
  for (const dem::Pair& q : assembly.bonds.pairs) n += assembly.particles.owns(q.i);
  n_between_ = assembly.comm.global_sum(n);
  n = 0;
  for (const dem::Wall& w : assembly.walls) n += w.bonds.size();
  for (const dem::Mirror& m : assembly.mirrors)
    for (const dem::MirrorPair& pair : m.pairs) n += pair.bond.intact > 0.0;
  n_bonds_ = n_between_ + assembly.comm.global_sum(n);
}

std::string Installation::phase() const
{
  if (!case_.has_stages()) return "penetration";
  const std::size_t k = position_.n_done; // behind the last stage only when it is finished
  if (k >= case_.stages.size()) return "finished";
  return "stage " + std::to_string(k + 1) + " (" + name_of(case_.stages[k]) + ")";
}

void Installation::run(const std::function<void()>& after_step)
{
  while (position_.n_done < case_.stages.size()) {
    if (!position_.is_under_way) begin_stage();
    run_stage(after_step);
    end_stage();
  }
}

void Installation::begin_stage()
{
  stage_run_.begin(position_.n_done);
  position_.is_under_way = true;
  if (stage_run_.stage().kind == PileStage::Kind::penetrate) {
    push_ = {travelled(), stage_run_.rate().travel(), travelled()};
    ++n_pushes_;
    space_frames_anew();
  }
  space_records_anew();
}

void Installation::run_stage(const std::function<void()>& after_step)
{
  const bool penetrates = stage_run_.stage().kind == PileStage::Kind::penetrate;
  Progress progress(phase());
  for (bool is_over = penetrates && push_.end <= travelled(); !is_over;) {
    stage_run_.step();
    time_ += coupled_.dt_before;
    force_.add(coupled_.assembly.rigid_walls.front(), head());
    if (coupled_.n_steps % dem::steps_between_step_checks == 0)
      progress.say(read_overlaps());

    is_over = stage_run_.is_over();
    if (stage_run_.position() >= next_record_ || is_over) {
      progress.say(record());
      next_record_ += stage_run_.record_every();
    }
    if ((penetrates && travelled() >= next_frame()) || is_over) {
      frame();
      ++n_frames_;
    }
    if (coupled_.n_steps % 20 == 0)
      progress.update(stage_run_.fraction(), [&] { return now(); });
    if (!is_over) after_step();
  }
  progress.done(case_.has_stages() ? now() + "  " + stage_run_.outcome() : now());
}

void Installation::end_stage()
{
  n_at_capacity_ += stage_run_.has_capacity();
  if (stage_run_.stage().kind == PileStage::Kind::penetrate) push_.tip = travelled();
  ++position_.n_done;
  position_.is_under_way = false;
}

std::string Installation::read_overlaps()
{
  const dem::Overlaps found = dem::check_overlaps(coupled_.assembly);
  overlaps_.add(found);
  largest_overlaps_.add(found);
  constexpr double step = 0.1; // from one line to the next [-]
  const double next = said_overlap_ > 0.0 ? said_overlap_ + step : dem::Overlaps::high_mark;
  if (!(found.largest > next)) return "";
  said_overlap_ = step * std::floor(found.largest / step);
  std::ostringstream out;
  out.precision(2);
  out << "the largest overlap has grown to " << found.largest << " of the smaller radius; "
      << found.beyond_mark << " pairs overlap by more than " << dem::Overlaps::mark << ", "
      << found.beyond_high_mark << " by more than " << dem::Overlaps::high_mark
      << "; the run stops at `Motion/largest overlap` = "
      << coupled_.assembly.motion.largest_overlap << '\n';
  return out.str();
}

void Installation::frame()
{
  dem::Assembly& assembly = coupled_.assembly;
  assembly.partition.gather_motion(assembly.particles, assembly.comm);
  const std::vector<dem::Vec3> x_last =
      assembly.comm.gather(output_ ? output_->x_last() : std::vector<dem::Vec3>{});
  const FrameInput input{assembly, coupled_.x_0, x_last.empty() ? coupled_.x_0 : x_last};
  std::optional<PileContinuum> continuum;
  on_every_rank(
      [&] { continuum.emplace(continuum_spec(case_, assembly.particles), input); });
  continuum->add_ranks();
  const dem::FrameFiles frame({assembly, coupled_.x_0, continuum->branches(),
                               continuum->porosity(), continuum->particle_fields()});
  dem::AssemblyFiles files;
  on_first_rank([&] {
    output_->require_in_place();
    files = output_->files();
  });
  write_together(frame, files, [&] { output_->write_fields(*continuum, coupled_); });
  on_first_rank([&] { output_->add_frame(time_, *continuum, assembly); });
}

std::string Installation::now() const
{
  std::ostringstream out;
  out.precision(3);
  out << "depth " << 1e3 * last_.depth << " mm (" << last_.depth / case_.diameter
      << " D_p)  q_c " << 1e-6 * last_.q_c << " MPa  broken " << last_.broken;
  if (case_.has_stages()) out << "  head " << last_.F_head << " N";
  return out.str();
}

PileRecord Installation::new_record(const coupling::EnergyBalances& energy_balances)
{
  const double to_full = 1.0 / case_.modelled_share();
  const double area = 0.25 * dem::pi * case_.diameter * case_.diameter;
  PileRecord r;
  r.time = time_;
  r.tip_depth = travelled();
  r.depth = r.tip_depth - case_.tip_height();
  r.F_tip = to_full * force_.tip / static_cast<double>(force_.n);
  r.F_shaft = to_full * force_.shaft / static_cast<double>(force_.n);
  r.q_c = r.F_tip / area;
  r.stage = position_.n_done + 1;
  r.F_head = to_full * force_.head / static_cast<double>(force_.n);
  r.F_lateral = to_full * force_.lateral / static_cast<double>(force_.n);
  r.displacement = head().displacement(coupled_.assembly.rigid_walls.front());
  r.rotation = head().rotation();
  r.head = head().energies();
  r.overlaps = overlaps_;
  breakage_.collect(case_, coupled_.assembly);
  r.broken = coupled_.assembly.comm.global_sum(
      coupled_.assembly.losses.broken); // none while settling: equilibrate() throws
  r.unbalanced = coupled_.unbalanced();
  r.kinetic = energy_balances.assembly.kinetic;
  r.interface = coupled_.balance();
  r.balance = energy_balances.assembly;
  r.balance.rigid_wall_work -= start_.assembly.rigid_wall_work;
  r.balance.plastic -= start_.assembly.plastic;
  r.balance.breakage_release -= start_.assembly.breakage_release;
  r.balance.slip -= start_.assembly.slip;
  r.balance.damping -= start_.assembly.damping;

  // The energy stored at the start counts as input: the tip touches the first particle only
  // after some travel.
  const double input = start_.assembly.stored() +
                       std::abs(energy_balances.assembly.rigid_wall_work) +
                       std::abs(energy_balances.assembly.gravity - start_.assembly.gravity);
  const double error =
      coupling::unexplained(energy_balances, start_) + head().energies().net();
  r.energy_error = input > 0.0 ? error / input : 0.0;
  r.time_step = coupled_.dt;
  r.stable_step = coupled_.stable_step.limit;
  force_ = {};
  overlaps_ = {};
  return r;
}

std::string Installation::record()
{
  const PileRecord r = new_record(coupled_.energy_balances());
  last_ = r;
  q_peak_ = std::max(q_peak_, r.q_c);
  // A NaN cannot be written; the check below reports it.
  const auto& pile = coupled_.assembly.rigid_walls.front();
  const auto forces = dem::ring_forces(coupled_.assembly, pile, rings_.height, rings_.n);
  if (std::isfinite(r.energy_error))
    on_first_rank([&] { output_->record(r, rings_, forces); });

  worst_energy_error_ = std::max(worst_energy_error_, std::abs(r.energy_error));
  worst_interface_.force = std::max(worst_interface_.force, r.interface.force);
  worst_interface_.moment = std::max(worst_interface_.moment, r.interface.moment);
  worst_interface_.power = std::max(worst_interface_.power, r.interface.power);
  const bool is_alarmed =
      energy_alarm_.add(r.energy_error, r.time, std::abs(r.balance.rigid_wall_work),
                        start_.assembly.stored());
  if (!(std::abs(r.energy_error) <= 0.01))
    throw Unstable("the energy error is " + dem::shortest(r.energy_error) +
                   " of the input (at most 0.01) at step " +
                   std::to_string(coupled_.n_steps) + ", t = " + dem::shortest(time_) +
                   " s: lower `Motion/time step safety`");
  return is_alarmed ? alarm_text(energy_alarm_) : "";
}

} // namespace mergel::apps

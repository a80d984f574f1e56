#include "apps/pile/installation.h"

#include "apps/run/progress.h"
#include "apps/run/ranks.h"
#include "dem/assembly/distribute.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mergel::apps {

void BreakageCount::take(dem::Rock& rock)
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
  all += rock.comm.global_sum(rock.losses.breakages.size());
  near += rock.comm.global_sum(n_near);
  above += rock.comm.global_sum(n_above);
  rock.losses.breakages.clear();
}

void MeanForce::add(const dem::PileLoad& load)
{
  cone += load.cone.z.value();
  shaft += load.shaft.z.value();
  ++n;
}

dem::PileWall make_pile(const PileCase& c)
{
  dem::PileWall pile;
  pile.pile.R = 0.5 * c.diameter;
  pile.pile.cone_height = c.cone_height();
  pile.material = c.contact;
  return pile;
}

Installation::Installation(const PileCase& c, CoupledRock& coupled, PileOutput* output)
    : case_(c), coupled_(coupled), output_(output), jack_(c), next_record_(c.record_every)
{
}

void Installation::begin()
{
  start_ = coupled_.books();
  coupled_.rock.piles.push_back(make_pile(case_));
  coupled_.rock.list.invalidate();
  dem::add_forces(coupled_.rock, 0.0);
  count_bonds();
  frame();
  n_frames_ = 1;
}

void Installation::count_bonds()
{
  const dem::Rock& rock = coupled_.rock;
  std::size_t n = 0; // each where its first grain is owned
  for (const dem::Pair& q : rock.bonds.pairs) n += rock.particles.owns(q.i);
  n_between_ = rock.comm.global_sum(n);
  n = 0;
  for (const dem::Wall& w : rock.walls) n += w.bonds.size();
  for (const dem::Mirror& m : rock.mirrors)
    for (const dem::MirrorPair& pair : m.pairs) n += pair.bond.intact > 0.0;
  n_bonds_ = n_between_ + rock.comm.global_sum(n);
}

void Installation::run(const std::function<void()>& after_step)
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

double Installation::travelled() const
{
  return -coupled_.rock.piles.front().pile.z_tip;
}

void Installation::frame()
{
  const dem::Rock rock = dem::whole(coupled_.rock);
  on_first_rank([&] { output_->frame(time_, rock, coupled_); });
}

std::string Installation::now() const
{
  std::ostringstream out;
  out.precision(3);
  out << "depth " << 1e3 * last_.depth << " mm (" << last_.depth / case_.diameter
      << " D_p)  q_c " << 1e-6 * last_.q_c << " MPa  broken " << last_.broken;
  return out.str();
}

PileRecord Installation::new_record(const CoupledRock::Books& books)
{
  const double half_to_full = 2.0;
  const double area = 0.25 * dem::pi * case_.diameter * case_.diameter;
  PileRecord r;
  r.time = time_;
  r.tip_depth = travelled();
  r.depth = r.tip_depth - case_.cone_height();
  r.F_tip = half_to_full * force_.cone / static_cast<double>(force_.n);
  r.F_shaft = half_to_full * force_.shaft / static_cast<double>(force_.n);
  r.q_c = r.F_tip / area;
  breakage_.take(coupled_.rock);
  r.broken = coupled_.rock.comm.global_sum(
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
  return r;
}

void Installation::record()
{
  const PileRecord r = new_record(coupled_.books());
  last_ = r;
  q_peak_ = std::max(q_peak_, r.q_c);
  // What is no number cannot be written; the book below says so.
  if (std::isfinite(r.energy_error)) on_first_rank([&] { output_->record(r); });

  worst_energy_error_ = std::max(worst_energy_error_, std::abs(r.energy_error));
  worst_interface_.force = std::max(worst_interface_.force, r.interface.force);
  worst_interface_.moment = std::max(worst_interface_.moment, r.interface.moment);
  worst_interface_.power = std::max(worst_interface_.power, r.interface.power);
  if (!(std::abs(r.energy_error) <= 0.01))
    throw Unstable("the energy book leaves " + dem::shortest(r.energy_error) +
                   " of the input unexplained (at most 0.01) at step " +
                   std::to_string(coupled_.n_steps) + ", t = " + dem::shortest(time_) +
                   " s: lower `Motion/time step safety`");
}

} // namespace mergel::apps

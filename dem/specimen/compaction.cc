#include "dem/specimen/compaction.h"

#include "dem/assembly/distribute.h"
#include "dem/specimen/growth.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace mergel::dem {

namespace {

constexpr double safety = 0.7;   // of the time step
constexpr double at_rest = 1e-3; // unbalanced-force ratio

double wall_pressure_term(const LinearMaterial& m, const Body& b, double gap)
{
  const double g_a = m.g_a * b.S;
  if (gap >= g_a) return 0.0;
  return linear_stiffness(m, b.R, 1.0 / b.R).k_n * (g_a - gap) * (b.R + gap);
}

/// The grains with everything that bounds them.
Rock make_rock(const SpecimenSpec& s, const Packing& packing, double friction)
{
  Rock rock;
  rock.particles = packing.particles;
  rock.cell = packing.cell;
  rock.material.contact = s.contact;
  rock.material.contact.mu = friction;
  rock.motion.free_rotation = s.free_rotation;
  const double d00 = s.sizes.smallest();
  rock.list = VerletList(s.contact.g_a + growth_reserve * d00, usual_skin * d00);
  for (const Face& face : solid_faces(s.region)) {
    PlaneWall wall;
    wall.plane.point = face.point;
    wall.plane.normal = face.inwards;
    wall.material = s.contact;
    wall.material.mu = 0.0;
    wall.material.g_a = 0.0;
    rock.planes.push_back(wall);
  }
  if (std::holds_alternative<HalfCylinder>(s.region)) rock.mirrors.emplace_back();
  return rock;
}

/// The stable step of the smallest grain with twelve neighbours of its size that press, which no
/// loose grain has yet [s].
double dense_time_step(const Rock& rock)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Body& b : rock.particles.body) {
    const double k_n = linear_stiffness(rock.material.contact, b.R, 0.5 / b.R).k_n; // > 0
    least = std::min(least, std::sqrt(2.0 * b.m / (12.0 * k_n)));
  }
  return safety * least / std::sqrt(1.0 + rock.motion.damping);
}

/// A loose rock whose grains can be made larger and smaller while it moves.
class Settling {
public:
  /// @param share of the sizes at the start
  Settling(const SpecimenSpec& s, const Packing& packing, double friction, double share,
           MPI_Comm comm)
      : spec_(s), full_(packing.particles.body), rock_(make_rock(s, packing, friction)),
        volume_(volume(s.region)), growth_allowed_(growth_reserve * s.sizes.smallest() /
                                                   (s.sizes.largest() + s.contact.g_a))
  {
    resize(share);
    if (comm != MPI_COMM_NULL) share_out(rock_, comm);
    add_forces(rock_, 0.0);
    dt_ = dt_before_ = std::min(dense_time_step(rock_), stable_time_step(rock_, safety));
  }

  /// One step, at the end of which all sizes are `factor` times what they were.
  void step(double factor = 1.0)
  {
    if (factor != 1.0) resize(factor * share_);
    advance(rock_, dt_before_, dt_, [](double) {});
    dt_before_ = dt_;
    if (++n_steps_ % steps_between_checks == 0)
      dt_ = std::min(dt_, stable_time_step(rock_, safety));
  }

  void set_friction(double mu) { rock_.material.contact.mu = mu; }
  double pressure() const { return mean_pressure(rock_, volume_); }
  double unbalanced() const { return unbalanced_ratio(rock_); }
  std::size_t n_steps() const { return n_steps_; }
  Rock& rock() { return rock_; }

  /// The grains at rest. A periodic box takes the change of their sizes over. Collective.
  Packing finish()
  {
    rock_.comm.agree_on(rock_.fault); // of the last step
    Packing packing;
    packing.pressure = pressure();
    packing.overlap = largest_overlap();
    Rock all = whole(rock_);
    packing.particles = std::move(all.particles);
    packing.cell = all.cell;
    clear_loads(packing.particles);
    for (std::size_t i = 0; i < full_.size(); ++i) {
      Body& b = packing.particles.body[i];
      b.v.setZero();
      b.omega.setZero();
      if (all.cell.is_periodic()) {
        b.R = full_[i].R;
        b.S = full_[i].S;
        b.x /= share_;
      }
      b.m = sphere_mass(b.R, spec_.rho);
    }
    if (all.cell.is_periodic()) packing.cell.size /= share_;
    measure_porosity(spec_, packing);
    return packing;
  }

private:
  static constexpr std::size_t steps_between_checks = 100;

  void resize(double share)
  {
    grown_ += std::abs(share / share_ - 1.0);
    share_ = share;
    for (std::size_t i = 0; i < full_.size(); ++i) {
      rock_.particles.body[i].R = share * full_[i].R;
      rock_.particles.body[i].S = share * full_[i].S; // the far-field shell with it
    }
    if (grown_ < growth_allowed_) return;
    rock_.list.invalidate();
    grown_ = 0.0;
  }

  /// Of two grains, shells included, over the distance at which they would not overlap.
  double largest_overlap() const
  {
    double most = 0.0;
    for (const Pair& q : rock_.contacts.pairs) {
      const Body &i = rock_.particles.body[q.i], &j = rock_.particles.body[q.j];
      const double reach = i.R + j.R + 0.5 * spec_.contact.g_a * (i.S + j.S);
      const double d = (j.x + rock_.cell.offset(q.shift) - i.x).norm();
      most = std::max(most, (reach - d) / reach);
    }
    return rock_.comm.global_max(most);
  }

  const SpecimenSpec& spec_;
  std::vector<Body> full_; ///< at the start, with the sizes asked for
  Rock rock_;
  double volume_, growth_allowed_;
  double share_ = 1.0, grown_ = 0.0, dt_ = 0.0, dt_before_ = 0.0;
  std::size_t n_steps_ = 0;
};

} // namespace

double mean_pressure(const Rock& rock, double volume)
{
  const Particles& p = rock.particles;
  MomentSum sum; // [N m]
  const LinearMaterial& contact = rock.material.contact;
  const auto add = [&](const Pair& q) {
    if (!p.owns(q.i)) return;
    const double f_n = read_contact(q, Vec3::Zero(), p, rock.cell, contact).f_n;
    if (f_n > 0.0)
      sum.add(f_n * (p.body[q.j].x + rock.cell.offset(q.shift) - p.body[q.i].x).norm());
  };
  for (const Pair& q : rock.contacts.pairs) add(q);
  for (const Pair& q : rock.bonds.pairs) add(q);
  for (const PlaneWall& w : rock.planes)
    for (const WallContact& c : w.contacts.contacts()) {
      const Body& b = p.body[c.particle];
      sum.add(wall_pressure_term(w.material, b, w.plane.touch(b).gap));
    }
  for (const Mirror& m : rock.mirrors)
    for (const MirrorPair& pair : m.pairs) {
      const Body& b = p.body[pair.particle];
      const double gap = 2.0 * (b.x.y() - b.R), g_a = contact.g_a * b.S;
      if (gap < g_a) // half of the pair's length is ours
        sum.add(linear_stiffness(contact, b.R, 0.5 / b.R).k_n * (g_a - gap) * b.x.y());
    }
  ExactReduction all;
  all.add(sum);
  all.run(rock.comm);
  return sum.value() / (3.0 * volume);
}

namespace {

/// Grows and shrinks the grains at the rate at which pressure is missing, halved each time the
/// pressure passes its target.
class PressureHold {
public:
  PressureHold(Settling& settling, double pressure) : settling_(settling), wanted_(pressure)
  {
  }

  /// Ten steps; returns how much is missing before them, over the target.
  double run()
  {
    const double missing = (wanted_ - settling_.pressure()) / wanted_;
    const bool is_below = missing > 0.0;
    if (is_below != was_below_) rate_ = std::max(least_rate, 0.5 * rate_);
    was_below_ = is_below;
    for (int k = 0; k < 10; ++k)
      settling_.step(1.0 + rate_ * std::clamp(missing, -1.0, 1.0));
    return missing;
  }

private:
  // Growth in one step [-]. The largest keeps the inertial number, rate 3.8 sqrt(E/p), at
  // 0.03 for E/p = 1e5; at the least some 100 steps pass from the target to a tenth beyond.
  static constexpr double largest_rate = 2e-5, least_rate = 1e-7;

  Settling& settling_;
  double wanted_;
  double rate_ = largest_rate;
  bool was_below_ = true;
};

/// Where the grains start: a little smaller than the cloud, so that none is pressed.
constexpr double start_share = 0.995;

/// Grow the grains to full size with this friction between them, then lock them with their own
/// and bring them to rest under the pressure.
Packing lock(const SpecimenSpec& s, const Packing& cloud, double friction, MPI_Comm comm,
             const std::function<void(double)>& progress)
{
  constexpr int steps_of_growth = 500, steps_of_flow = 1000;
  constexpr int looks_at_rest = 20000;
  Settling settling(s, cloud, friction, start_share, comm);
  const double factor = std::pow(start_share, -1.0 / steps_of_growth);
  for (int k = 0; k < steps_of_growth; ++k) settling.step(factor);
  for (int k = 0; k < steps_of_flow; ++k) settling.step();

  settling.set_friction(s.contact.mu);
  PressureHold hold(settling, s.pressure);
  int n_met = 0;
  for (int k = 0;; ++k) {
    progress(std::min(1.0, k / 1000.0));
    n_met = std::abs(hold.run()) < 0.25 * pressure_tolerance ? n_met + 1 : 0;
    if (n_met > 20 && settling.unbalanced() < at_rest) break;
    if (k == looks_at_rest)
      throw CollectiveFailure(
          "a specimen under " + shortest(s.pressure) + " Pa does not come to rest: after " +
          std::to_string(settling.n_steps()) + " steps its unbalanced-force ratio is " +
          shortest(settling.unbalanced()) + ", wanted " + shortest(at_rest) +
          ", its pressure " + shortest(settling.pressure()) +
          " Pa; raise `Contact/friction` or `Specimen/target pressure`");
  }
  Packing locked = settling.finish();
  locked.friction = friction;
  return locked;
}

} // namespace

void confine(const SpecimenSpec& s, Packing& packing, MPI_Comm comm,
             const std::function<void(double)>& progress)
{
  constexpr int most_tries = 6;
  constexpr double good = 0.4 * porosity_tolerance;
  const Packing cloud = packing;
  double least = std::numeric_limits<double>::infinity(), n_low = least, n_high = -least;
  int n_tries = 0;
  // How much looser than wanted the grains lock.
  const auto error_with = [&](double friction) {
    // How many tries it takes is not known: the next takes half of what is left.
    const auto part = [&](double done) {
      progress(1.0 - std::pow(0.5, n_tries) * (1.0 - 0.5 * done));
    };
    const Packing locked = lock(s, cloud, friction, comm, part);
    ++n_tries;
    const double error = locked.porosity - s.porosity;
    n_low = std::min(n_low, locked.porosity);
    n_high = std::max(n_high, locked.porosity);
    if (std::abs(error) < least) {
      least = std::abs(error);
      packing = locked;
    }
    return error;
  };

  double low = 0.0, high = s.contact.mu; // friction; porosity grows with it
  const double usual = std::min(0.025, 0.5 * high);
  const bool is_loose = error_with(usual) > 0.0;
  if (least <= good) return;
  (is_loose ? high : low) = usual;
  const bool has_range = s.contact.mu > 0.0; // else they lock in one way alone
  const bool is_within = has_range && (error_with(is_loose ? low : high) > 0.0) != is_loose;
  while (is_within && least > good && n_tries < most_tries) {
    const double middle = 0.5 * (low + high);
    (error_with(middle) > 0.0 ? high : low) = middle;
  }
  if (least <= porosity_tolerance) return;

  std::ostringstream text;
  text.precision(4);
  text << "cannot be met together with `Specimen/target pressure`: these grains lock ";
  if (has_range) {
    error_with(is_loose ? s.contact.mu : 0.0); // the other end, to say what can be had
    text << "between " << n_low << " and " << n_high
         << " under it, with a friction of 0 to " << s.contact.mu
         << " while they are packed; change the porosity or "
         << "`Contact/activation gap`";
  } else {
    text << "at " << n_low << " under it, and without friction at no other; change the "
         << "porosity, `Contact/activation gap` or `Contact/friction`";
  }
  throw InputError(text.str());
}

void expand(const SpecimenSpec& s, Packing& packing, MPI_Comm comm,
            const std::function<void(double)>& progress)
{
  constexpr int most_steps = 100000, steps_between_looks = 50;
  // Grains that are hardly jammed part for good, and then only a pair or two touch: nothing is
  // left to be balanced. Overlaps under this share of the modulus are below 1e-6 d.
  constexpr double no_pressure = 1e-6;
  Settling settling(s, packing, s.friction, 1.0, comm);
  for (int k = 0; k < most_steps; k += steps_between_looks) {
    for (int n = 0; n < steps_between_looks; ++n) settling.step();
    progress(std::min(1.0, k / 20000.0));
    if (settling.unbalanced() < at_rest ||
        settling.pressure() < no_pressure * s.contact.E) {
      check_overlaps(settling.rock());
      packing = settling.finish();
      packing.friction = s.friction;
      return;
    }
  }
  throw CollectiveFailure(
      "a specimen does not come to rest: after " + std::to_string(settling.n_steps()) +
      " steps its unbalanced-force ratio is " + shortest(settling.unbalanced()) +
      ", wanted " + shortest(at_rest) + "; raise `Specimen/generation friction`");
}

} // namespace mergel::dem

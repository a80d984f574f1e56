#include "dem/specimen/compaction.h"

#include "dem/assembly/distribute.h"
#include "dem/assembly/overlaps.h"
#include "dem/assembly/step.h"
#include "dem/assembly/timestep.h"
#include "dem/specimen/growth.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace mergel::dem {

namespace {

constexpr double at_rest = 1e-3; // unbalanced-force ratio

/// Contacts come and go while a specimen is made: the bound, which is never too large.
constexpr StepSpec step_spec{StepRule::block_bound, default_block_safety};

double wall_pressure_term(const ContactLaw& m, const ParticleState& b, double gap)
{
  const double overlap = activation_gap(m) * b.S - gap;
  return overlap > 0.0 ? normal_force(m, sides_at_wall(b.R), overlap) * (b.R + gap) : 0.0;
}

/// Assembly of the particles and their boundaries.
Assembly make_assembly(const SpecimenSpec& s, const Packing& packing, double friction)
{
  Assembly assembly;
  assembly.particles = packing.particles;
  assembly.cell = packing.cell;
  assembly.material.contact = with_friction(s.contact, friction);
  assembly.motion.free_rotation = s.free_rotation;
  assembly.motion.largest_overlap = 0.5; // a specimen is made at low pressure
  const double d00 = s.sizes.smallest();
  assembly.list =
      VerletList(activation_gap(s.contact) + growth_reserve * d00, default_skin * d00);
  for (const Face& face : solid_faces(s.region)) {
    assembly.rigid_walls.push_back(make_rigid_wall(
        Plane{face.inwards}, face.point, without_gap(with_friction(s.contact, 0.0))));
  }
  if (std::holds_alternative<HalfCylinder>(s.region)) assembly.mirrors.emplace_back();
  return assembly;
}

/// Stable step for a particle with twelve pressing neighbours of its own size, smallest
/// over all particles [s]. A loose packing does not have these contacts yet.
double dense_time_step(const Assembly& assembly)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const ParticleState& b : assembly.particles.state) {
    const double k_n = contact_stiffness(assembly.material.contact, sides_at_mirror(b.R),
                                         estimated_overlap * b.R)
                           .k_n; // > 0
    smallest = std::min(smallest, std::sqrt(2.0 * b.m / (12.0 * k_n)));
  }
  constexpr double safety = 0.7; // there may be more neighbours
  return safety * smallest / std::sqrt(1.0 + assembly.motion.damping);
}

/// An unbonded assembly whose particle sizes can change while it moves.
class Settling {
public:
  /// @param share factor of all sizes at the start [-]
  Settling(const SpecimenSpec& s, const Packing& packing, double friction, double share,
           MPI_Comm comm)
      : spec_(s), full_(packing.particles.state),
        assembly_(make_assembly(s, packing, friction)), volume_(volume(s.region)),
        growth_allowed_(growth_reserve * s.sizes.smallest() /
                        (s.sizes.largest() + activation_gap(s.contact) +
                         default_skin * s.sizes.smallest())) // the skin grows too
  {
    resize(share);
    if (comm != MPI_COMM_NULL) distribute(assembly_, comm);
    add_forces(assembly_, 0.0);
    dt_ = dt_before_ =
        std::min(dense_time_step(assembly_), stable_time_step(assembly_, step_spec));
  }

  /// One step, at the end of which all sizes are `factor` times what they were.
  void step(double factor = 1.0)
  {
    if (factor != 1.0) resize(factor * share_);
    advance(assembly_, dt_before_, dt_, [](double) {});
    dt_before_ = dt_;
    if (++n_steps_ % steps_between_step_checks == 0)
      dt_ = std::min(dt_, stable_time_step(assembly_, step_spec, dt_));
  }

  void set_friction(double mu)
  {
    assembly_.material.contact = with_friction(assembly_.material.contact, mu);
  }
  double pressure() const { return mean_pressure(assembly_, volume_); }
  double unbalanced() const { return unbalanced_ratio(assembly_); }
  std::size_t n_steps() const { return n_steps_; }
  Assembly& assembly() { return assembly_; }

  /// The packing at rest. A periodic box is scaled instead of its particles, which get
  /// their full sizes back. Collective.
  Packing finish()
  {
    assembly_.comm.agree_on(assembly_.fault); // a fault of the last step
    Packing packing;
    packing.pressure = pressure();
    packing.overlap = largest_overlap();
    Assembly all = gather(assembly_);
    packing.particles = std::move(all.particles);
    packing.cell = all.cell;
    clear_loads(packing.particles);
    for (std::size_t i = 0; i < full_.size(); ++i) {
      ParticleState& b = packing.particles.state[i];
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
  void resize(double share)
  {
    grown_ += std::abs(share / share_ - 1.0);
    share_ = share;
    for (std::size_t i = 0; i < full_.size(); ++i) {
      assembly_.particles.state[i].R = share * full_[i].R;
      assembly_.particles.state[i].S = share * full_[i].S; // scales the far-field shell
    }
    if (grown_ < growth_allowed_) return;
    assembly_.list.invalidate();
    grown_ = 0.0;
  }

  /// Largest overlap of two particles, shells included, over the distance at which they
  /// would not overlap [-].
  double largest_overlap() const
  {
    double most = 0.0;
    for (const Pair& q : assembly_.contacts.pairs) {
      const ParticleState &i = assembly_.particles.state[q.i],
                          &j = assembly_.particles.state[q.j];
      const double reach = i.R + j.R + 0.5 * activation_gap(spec_.contact) * (i.S + j.S);
      const double d = (j.x + assembly_.cell.offset(q.shift) - i.x).norm();
      most = std::max(most, (reach - d) / reach);
    }
    return assembly_.comm.global_max(most);
  }

  const SpecimenSpec& spec_;
  std::vector<ParticleState> full_; ///< at the start, with full sizes
  Assembly assembly_;
  double volume_, growth_allowed_;
  double share_ = 1.0, grown_ = 0.0, dt_ = 0.0, dt_before_ = 0.0;
  std::size_t n_steps_ = 0;
};

} // namespace

double mean_pressure(const Assembly& assembly, double volume)
{
  const Particles& p = assembly.particles;
  MomentSum sum; // [N m]
  const ContactLaw& contact = assembly.material.contact;
  const auto add = [&](const Pair& q) {
    if (!p.owns(q.i)) return;
    const double f_n = read_contact(q, Vec3::Zero(), p, assembly.cell, contact).f_n;
    if (f_n > 0.0)
      sum.add(f_n *
              (p.state[q.j].x + assembly.cell.offset(q.shift) - p.state[q.i].x).norm());
  };
  for (const Pair& q : assembly.contacts.pairs) add(q);
  for (const Pair& q : assembly.bonds.pairs) add(q);
  for (const RigidWall& w : assembly.rigid_walls)
    for (const WallContact& c : w.contacts) {
      const ParticleState& b = p.state[c.particle];
      sum.add(wall_pressure_term(w.material, b, closest_point(w, b).gap));
    }
  for (const Mirror& m : assembly.mirrors)
    for (const MirrorPair& pair : m.pairs) {
      const ParticleState& b = p.state[pair.particle];
      const double overlap = activation_gap(contact) * b.S - 2.0 * (b.x.y() - b.R);
      if (overlap > 0.0) // half of the pair's length lies in the region
        sum.add(normal_force(contact, sides_at_mirror(b.R), overlap) * b.x.y());
    }
  ExactReduction all;
  all.add(sum);
  all.run(assembly.comm);
  return sum.value() / (3.0 * volume);
}

namespace {

/// Changes the sizes of the particles at a rate proportional to target minus pressure. The
/// rate is halved each time the pressure passes its target.
class PressureHold {
public:
  PressureHold(Settling& settling, double pressure) : settling_(settling), wanted_(pressure)
  {
  }

  /// Ten steps. Returns (target - pressure)/target before them.
  double run()
  {
    const double missing = (wanted_ - settling_.pressure()) / wanted_;
    const bool is_below = missing > 0.0;
    if (is_below != was_below_) rate_ = std::max(lowest_rate, 0.5 * rate_);
    was_below_ = is_below;
    for (int k = 0; k < 10; ++k)
      settling_.step(1.0 + rate_ * std::clamp(missing, -1.0, 1.0));
    return missing;
  }

private:
  // Growth in one step [-]. The largest keeps the inertial number, rate 3.8 sqrt(E/p), at
  // 0.03 for E/p = 1e5. At the lowest rate the pressure takes about 100 steps from its
  // target to a tenth above it.
  static constexpr double largest_rate = 2e-5, lowest_rate = 1e-7;

  Settling& settling_;
  double wanted_;
  double rate_ = largest_rate;
  bool was_below_ = true;
};

/// Factor of the sizes at the start: below 1, so that no contact presses.
constexpr double start_share = 0.995;

/// Grow the particles to full size with this friction, then set the friction of the
/// specimen and bring them to rest under the target pressure.
Packing jam(const SpecimenSpec& s, const Packing& cloud, double friction, MPI_Comm comm,
            const std::function<void(double)>& progress)
{
  constexpr int steps_of_growth = 500, steps_of_flow = 1000;
  constexpr int max_checks = 20000;
  Settling settling(s, cloud, friction, start_share, comm);
  const double factor = std::pow(start_share, -1.0 / steps_of_growth);
  for (int k = 0; k < steps_of_growth; ++k) settling.step(factor);
  for (int k = 0; k < steps_of_flow; ++k) settling.step();

  settling.set_friction(dem::friction(s.contact));
  PressureHold hold(settling, s.pressure);
  int n_met = 0;
  for (int k = 0;; ++k) {
    progress(std::min(1.0, k / 1000.0));
    n_met = std::abs(hold.run()) < 0.25 * pressure_tolerance ? n_met + 1 : 0;
    if (n_met > 20 && settling.unbalanced() < at_rest) break;
    if (k == max_checks)
      throw CollectiveFailure(
          "a specimen under " + shortest(s.pressure) + " Pa does not come to rest: after " +
          std::to_string(settling.n_steps()) + " steps its unbalanced-force ratio is " +
          shortest(settling.unbalanced()) + ", wanted " + shortest(at_rest) +
          ", its pressure " + shortest(settling.pressure()) +
          " Pa; raise `Contact/friction` or `Specimen/target pressure`");
  }
  Packing jammed = settling.finish();
  jammed.friction = friction;
  return jammed;
}

} // namespace

void confine(const SpecimenSpec& s, Packing& packing, MPI_Comm comm,
             const std::function<void(double)>& progress)
{
  constexpr int max_trials = 6;
  constexpr double good = 0.4 * porosity_tolerance;
  const Packing cloud = packing;
  double smallest = std::numeric_limits<double>::infinity(), n_low = smallest,
         n_high = -smallest;
  int n_tries = 0;
  // Porosity at which the particles jam minus the target.
  const auto error_with = [&](double friction) {
    // The number of trials is not known: each counts as half of the remaining work.
    const auto part = [&](double done) {
      progress(1.0 - std::pow(0.5, n_tries) * (1.0 - 0.5 * done));
    };
    const Packing jammed = jam(s, cloud, friction, comm, part);
    ++n_tries;
    const double error = jammed.porosity - s.porosity;
    n_low = std::min(n_low, jammed.porosity);
    n_high = std::max(n_high, jammed.porosity);
    if (std::abs(error) < smallest) {
      smallest = std::abs(error);
      packing = jammed;
    }
    return error;
  };

  double low = 0.0, high = dem::friction(s.contact); // friction; porosity grows with it
  const double usual = std::min(0.025, 0.5 * high);
  const bool is_loose = error_with(usual) > 0.0;
  if (smallest <= good) return;
  (is_loose ? high : low) = usual;
  const bool has_range =
      dem::friction(s.contact) > 0.0; // else they jam at one porosity only
  const bool is_within = has_range && (error_with(is_loose ? low : high) > 0.0) != is_loose;
  while (is_within && smallest > good && n_tries < max_trials) {
    const double middle = 0.5 * (low + high);
    (error_with(middle) > 0.0 ? high : low) = middle;
  }
  if (smallest <= porosity_tolerance) return;

  std::ostringstream text;
  text.precision(4);
  text << "cannot be reached together with `Specimen/target pressure`: under this pressure "
          "these particles jam at ";
  if (has_range) {
    error_with(is_loose ? dem::friction(s.contact) : 0.0); // the other end of the range
    text << "porosities between " << n_low << " and " << n_high
         << ", with a friction of 0 to " << dem::friction(s.contact)
         << " while they are packed; change the porosity"
         << (activation_gap(s.contact) > 0.0 ? " or `Contact/activation gap`" : "");
  } else {
    text << "a porosity of " << n_low << " only, since they have no friction; change the "
         << "porosity"
         << (activation_gap(s.contact) > 0.0 ? ", `Contact/activation gap`" : "")
         << " or `Contact/friction`";
  }
  throw InputError(text.str());
}

void expand(const SpecimenSpec& s, Packing& packing, MPI_Comm comm,
            const std::function<void(double)>& progress)
{
  constexpr int max_steps = 100000, steps_between_checks = 50;
  // Barely jammed particles separate until only one or two pairs touch; then the
  // unbalanced-force ratio has no meaning. Below this pressure over the modulus, overlaps
  // are below 1e-6 d.
  constexpr double no_pressure = 1e-6;
  Settling settling(s, packing, s.friction, 1.0, comm);
  for (int k = 0; k < max_steps; k += steps_between_checks) {
    for (int n = 0; n < steps_between_checks; ++n) settling.step();
    progress(std::min(1.0, k / 20000.0));
    if (settling.unbalanced() < at_rest ||
        settling.pressure() < no_pressure * modulus(s.contact)) {
      check_overlaps(settling.assembly());
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

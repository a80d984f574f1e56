/// Rocks that break while they move, run for the bits: what this prints must not depend on
/// the number of ranks.
///
/// usage: mpi_scenes SCENE [rebuild] [rebalance] [restart FILE] [stop STEP FILE]
///   block      bonded, free faces, squeezed until bonds break
///   turning    the same block, turning and flying across the borders of the ranks
///   periodic   a periodic box of bonded and unbonded grains, stirred until bonds break
///   element    the same box, squeezed along z until bonds break while its sides hold a stress
///   varied     the same, with strengths that vary from grain to grain
///   rebuild    lists are built at every 7th step besides
///   rebalance  grains change ranks at every 50th step, by weights that make no sense;
///              doubled histories are compared
///   restart    go on from this checkpoint, on any number of ranks
///   stop       write this checkpoint behind this step, and stop
#include "apps/bench/workloads.h"
#include "dem/assembly/averages.h"
#include "dem/assembly/distribute.h"
#include "dem/assembly/energy_balance.h"
#include "dem/element/servo.h"
#include "dem/io/state/assembly_state.h"
#include "dem/io/state/checkpoint.h"
#include "dem/math/random.h"
#include "dem/pairs/strength.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

using namespace mergel;
using namespace mergel::dem;

namespace {

constexpr int n_steps = 400;

/// Strengths that the motion of a scene exceeds in places.
void weaken(Rock& rock, double strength)
{
  auto& bond = std::get<DamageBond>(rock.material.bond);
  bond.sigma_t = strength;
  bond.sigma_c = 3.0 * strength;
  bond.C = 1.2 * strength;
  bond.u_c = 1e-7;
  bond.theta_c = 1e-3;
}

/// Each grain gets a velocity and spin of its own.
void stir(Rock& rock, double speed)
{
  for (Index i = 0; i < rock.particles.size(); ++i) {
    Body& b = rock.particles.body[i];
    for (int a = 0; a < 3; ++a) {
      const auto draw = [&](std::uint64_t k) {
        return 2.0 * uniform(7, i, k + static_cast<std::uint64_t>(a)) - 1.0;
      };
      b.v[a] += speed * draw(0);
      b.omega[a] += 0.5 * speed / b.R * draw(3);
    }
  }
}

void turn(Rock& rock, double rate)
{
  Vec3 centre = Vec3::Zero();
  for (const Body& b : rock.particles.body) centre += b.x;
  centre /= static_cast<double>(rock.particles.size());
  const Vec3 spin = rate * Vec3(0.3, 0.5, 0.8).normalized();
  for (Body& b : rock.particles.body) {
    b.v += spin.cross(b.x - centre);
    b.omega += spin;
  }
}

apps::WorkingRock make(const std::string& name)
{
  apps::WorkloadSpec spec;
  spec.n_particles = 3000;
  const bool is_squeezed = name == "element" || name == "varied";
  if (name == "periodic" || is_squeezed) {
    spec.workload = apps::Workload::frictional_packing;
    apps::WorkingRock w = apps::make_workload(spec);
    // Two thirds of what touches is bonded.
    std::vector<Pair> bonded;
    for (std::size_t c = 0; c < w.rock.contacts.pairs.size(); ++c)
      if (c % 3 != 0) bonded.push_back(w.rock.contacts.pairs[c]);
    w.rock.bonds = make_bonds(w.rock.particles, w.rock.cell, bonded);
    w.rock.contacts = {};
    w.rock.list.invalidate();
    if (name == "periodic") stir(w.rock, 10.0);
    w.rock.cell.is_driven = is_squeezed;
    return w;
  }
  if (name != "block" && name != "turning") throw std::invalid_argument("no scene " + name);
  apps::WorkingRock w = apps::make_workload(spec);
  stir(w.rock, 4.0);
  if (name == "turning") turn(w.rock, 2e4);
  return w;
}

std::uint64_t checksum_of_histories(const Rock& rock)
{
  std::uint64_t sum = 1469598103934665603u;
  const auto add = [&sum](double a) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &a, sizeof a);
    sum = (sum ^ bits) * 1099511628211u;
  };
  for (std::size_t b = 0; b < rock.bonds.size(); ++b) {
    const BondBlock& k = rock.bonds.blocks[b / n_lanes];
    const auto l = static_cast<int>(b % n_lanes);
    for (const Triple<Lanes>* t : {&k.V, &k.M, &k.f_s})
      for (const double a : {t->x[l], t->y[l], t->z[l]}) add(a);
    for (const double a : {k.gap_0[l], k.u_p[l], k.T[l], k.intact[l]}) add(a);
  }
  for (const ContactShear& s : rock.contacts.shear)
    if (s.f_s != Vec3::Zero()) // candidates differ with the lists, histories do not
      for (int a = 0; a < 3; ++a) add(s.f_s[a]);
  return sum;
}

/// Sides that hold a stress while the box is squeezed.
void squeeze(apps::WorkingRock& w, Servo& servo, int step)
{
  if (step % 100 == 1) servo.stiffness = affine_stiffness(w.rock);
  servo.limit = 1e-4 / w.dt;
  const Vec3 sigma = w.rock.virial.value() / w.rock.cell.volume();
  w.rock.cell.rate = servo.rates(
      CellOrder{AxisOrder{true, -2e7, 0.0}, {true, -1e7, 0.0}, {false, 0.0, -3e-5 / w.dt}},
      sigma, w.dt);
}

void report(apps::WorkingRock& w, int step)
{
  const EnergyBook e = energy_book(w.rock, w.dt);
  const double unbalanced = unbalanced_ratio(w.rock);
  const CellAverages c = w.rock.cell.is_driven ? cell_averages(w.rock) : CellAverages{};
  const Rock all = whole(w.rock);
  if (w.rock.comm.rank() != 0) return;
  std::printf(
      "%4d %016" PRIx64 " %016" PRIx64 " broken %zu yielded %zu dt %a unbalanced %a "
      "kinetic %a bonds %a contacts %a plastic %a residue %a slip %a damping %a "
      "cell work %a stress %a %a traction %a edges %a %a\n",
      step, apps::checksum(all.particles), checksum_of_histories(all), all.losses.broken,
      all.losses.yielded, w.dt, unbalanced, e.kinetic, e.bonds, e.contacts, e.plastic,
      e.residue, e.slip, e.damping, e.cell_work, c.stress(0, 0), c.stress(1, 2),
      c.traction.z(), all.cell.size.x(), all.cell.size.z());
}

struct Options {
  bool rebuilds = false, rebalances = false;
  std::string restart, checkpoint; ///< files
  int stop = n_steps;
};

void save(const apps::WorkingRock& w, const Servo& servo, const std::string& file)
{
  State state(w.rock.comm.rank());
  put(state, w.rock);
  state.add_common<double>("steps", {w.dt, w.dt_before});
  const Vec3 &I = servo.integral, &M = servo.stiffness;
  state.add_common<double>("servo", {I.x(), I.y(), I.z(), M.x(), M.y(), M.z()}, 6);
  write_checkpoint(file, {"test", "scene", "", "", w.n_steps, 0.0}, std::move(state),
                   w.rock.comm);
}

void restore(apps::WorkingRock& w, Servo& servo, const std::string& file)
{
  Checkpoint c = read_checkpoint(file);
  take(c.state, w.rock);
  w.n_steps = c.label.step;
  w.dt = c.state.get<double>("steps")[0];
  w.dt_before = c.state.get<double>("steps")[1];
  const auto& s = c.state.get_rows<double>("servo", 1, 6);
  servo.integral = {s[0], s[1], s[2]};
  servo.stiffness = {s[3], s[4], s[5]};
}

void run(const std::string& name, const Options& o)
{
  const bool rebuilds = o.rebuilds, rebalances = o.rebalances;
  apps::WorkingRock w = make(name);
  weaken(w.rock, 1e8);
  const auto n_before = w.n_steps;
  Servo servo;
  if (!o.restart.empty()) restore(w, servo, o.restart);
  if (name == "varied")
    draw_strengths({StrengthVariability::Distribution::weibull, 0.4, 3}, w.rock.particles);
  share_out(w.rock, MPI_COMM_WORLD);
  if (o.restart.empty())
    add_forces(w.rock, 0.0);
  else
    rebuild_lists(w.rock);
  for (int step = static_cast<int>(w.n_steps - n_before) + 1; step <= o.stop; ++step) {
    if (rebuilds && step % 7 == 0) w.rock.list.invalidate();
    if (rebalances && step % 50 == 0)
      rebalance(w.rock, 1.0 + (step / 50 + w.rock.comm.rank()) % 3, true);
    if (w.rock.cell.is_driven) squeeze(w, servo, step);
    w.step();
    if (step % 40 == 0) report(w, step);
  }
  std::fflush(stdout);
  if (!o.checkpoint.empty()) {
    save(w, servo, o.checkpoint);
    return;
  }
  const std::size_t broken = w.rock.comm.global_sum(w.rock.losses.broken);
  if (broken < 20)
    throw std::runtime_error("only " + std::to_string(broken) + " bonds broke");
}

} // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  try {
    Options o;
    for (int k = 2; k < argc; ++k) {
      const std::string word = argv[k];
      o.rebuilds = o.rebuilds || word == "rebuild";
      o.rebalances = o.rebalances || word == "rebalance";
      if (word == "restart" && k + 1 < argc) o.restart = argv[++k];
      if (word == "stop" && k + 2 < argc) {
        o.stop = std::atoi(argv[++k]);
        o.checkpoint = argv[++k];
      }
    }
    run(argc > 1 ? argv[1] : "", o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "mpi_scenes: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}

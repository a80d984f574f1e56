/// Assemblies that move while their bonds break. The output must have the same bits on any
/// number of ranks.
///
/// usage: mpi_scenes SCENE [rebuild] [rebalance] [restart FILE] [stop STEP FILE]
///   block      bonded, free faces, compressed until bonds break
///   turning    the same block, rotating and moving across the borders of the ranks
///   periodic   a periodic box, two thirds of its contacts bonded, with random velocities
///              that break bonds
///   hertz      the same with Hertz-Mindlin contacts
///   element    the same box, compressed along z until bonds break; stress-controlled x, y
///   debris     the block at rest, hit by a few fragments that fly between it and a wall
///   varied     the same, with strengths that vary from particle to particle
///   sums       none of these: forces on nodes that are added over the ranks, on each or shared,
///              of ordinary size and without room in 64 bits on one rank or on all
///   rebuild    lists are also built at every 7th step
///   rebalance  particles change ranks at every 50th step, by arbitrary weights; histories
///              that two ranks hold are compared
///   restart    continue from this checkpoint, on any number of ranks
///   stop       write this checkpoint after this step, and stop
#include "apps/bench/workloads.h"
#include "dem/assembly/averages.h"
#include "dem/assembly/distribute.h"
#include "dem/assembly/energy_balance.h"
#include "dem/continuum/particle_stress.h"
#include "dem/continuum/section_sums.h"
#include "dem/element/servo.h"
#include "dem/io/assembly_frame.h"
#include "dem/io/state/assembly_state.h"
#include "dem/io/state/checkpoint.h"
#include "dem/io/state/step_numbers.h"
#include "dem/math/random.h"
#include "dem/pairs/strength.h"
#include "dem/parallel/reduction.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

using namespace mergel;
using namespace mergel::dem;

namespace {

constexpr int n_steps = 400;

/// Strengths that the motion of a scene exceeds in places.
void weaken(Assembly& assembly, double strength)
{
  auto& bond = std::get<DamageBond>(assembly.material.bond);
  bond.sigma_t = strength;
  bond.sigma_c = 3.0 * strength;
  bond.C = 1.2 * strength;
  bond.u_c = 1e-7;
  bond.theta_c = 1e-3;
}

/// Adds a random velocity and spin to each particle.
void stir(Assembly& assembly, double speed)
{
  for (Index i = 0; i < assembly.particles.size(); ++i) {
    ParticleState& b = assembly.particles.state[i];
    for (int a = 0; a < 3; ++a) {
      const auto draw = [&](std::uint64_t k) {
        return 2.0 * uniform(7, i, k + static_cast<std::uint64_t>(a)) - 1.0;
      };
      b.v[a] += speed * draw(0);
      b.omega[a] += 0.5 * speed / b.R * draw(3);
    }
  }
}

void turn(Assembly& assembly, double rate)
{
  Vec3 centre = Vec3::Zero();
  for (const ParticleState& b : assembly.particles.state) centre += b.x;
  centre /= static_cast<double>(assembly.particles.size());
  const Vec3 spin = rate * Vec3(0.3, 0.5, 0.8).normalized();
  for (ParticleState& b : assembly.particles.state) {
    b.v += spin.cross(b.x - centre);
    b.omega += spin;
  }
}

/// Fragments beside the block that fly towards it, and a rigid wall behind them.
void throw_fragments(Assembly& assembly)
{
  constexpr double speed = 40.0;
  Particles& p = assembly.particles;
  Vec3 mean = Vec3::Zero(), low = p.state.front().x, high = low;
  for (const ParticleState& b : p.state) {
    mean += b.v / static_cast<double>(p.size());
    low = low.cwiseMin(b.x);
    high = high.cwiseMax(b.x);
  }
  for (ParticleState& b : p.state) b.v -= mean;
  const double R = p.state.front().R;
  for (int k = 0; k < 5; ++k)
    for (int l = 0; l < 5; ++l) {
      ParticleState b = p.state.front();
      b.x = {high.x() + 3.0 * R, low.y() + 0.2 * (k + 0.5) * (high.y() - low.y()),
             low.z() + 0.2 * (l + 0.5) * (high.z() - low.z())};
      b.v = speed * Vec3(-1.0, 0.02 * k, -0.03 * l);
      b.omega.setZero();
      b.m = sphere_mass(R, 2556.0);
      p.add(b);
    }
  assembly.rigid_walls.push_back(make_rigid_wall(Plane{-Vec3::UnitX()},
                                                 high + 4.5 * R * Vec3::UnitX(),
                                                 without_gap(assembly.material.contact)));
  assembly.list.invalidate();
}

apps::WorkingAssembly make(const std::string& name)
{
  apps::WorkloadSpec spec;
  spec.n_particles = 3000;
  const bool is_compressed = name == "element" || name == "varied";
  if (name == "periodic" || name == "hertz" || is_compressed) {
    spec.workload = apps::Workload::frictional_packing;
    apps::WorkingAssembly w = apps::make_workload(spec);
    // Two thirds of the contacts are bonded.
    std::vector<Pair> bonded;
    for (std::size_t c = 0; c < w.assembly.contacts.pairs.size(); ++c)
      if (c % 3 != 0) bonded.push_back(w.assembly.contacts.pairs[c]);
    w.assembly.bonds = make_bonds(w.assembly.particles, w.assembly.cell, bonded);
    w.assembly.contacts = {};
    w.assembly.list.invalidate();
    if (name == "hertz") w.assembly.material.contact = HertzMaterial{1e9, 0.2, 0.4};
    if (!is_compressed) stir(w.assembly, 10.0);
    w.assembly.cell.is_strain_controlled = is_compressed;
    return w;
  }
  if (name != "block" && name != "turning" && name != "debris")
    throw std::invalid_argument("unknown scene " + name);
  apps::WorkingAssembly w = apps::make_workload(spec);
  stir(w.assembly, name == "debris" ? 0.5 : 4.0);
  if (name == "debris") throw_fragments(w.assembly);
  if (name == "turning") turn(w.assembly, 2e4);
  return w;
}

std::uint64_t checksum_of_histories(const Assembly& assembly)
{
  std::uint64_t sum = 1469598103934665603u;
  const auto add = [&sum](double a) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &a, sizeof a);
    sum = (sum ^ bits) * 1099511628211u;
  };
  for (std::size_t b = 0; b < assembly.bonds.size(); ++b) {
    const BondBlock& k = assembly.bonds.blocks[b / n_lanes];
    const auto l = static_cast<int>(b % n_lanes);
    for (const Triple<Lanes>* t : {&k.V, &k.M, &k.f_s})
      for (const double a : {t->x[l], t->y[l], t->z[l]}) add(a);
    for (const double a : {k.gap_0[l], k.u_p[l], k.T[l], k.intact[l]}) add(a);
  }
  for (const ContactShear& s : assembly.contacts.shear)
    if (s.f_s != Vec3::Zero()) // candidates differ with the lists, histories do not
      for (int a = 0; a < 3; ++a) add(s.f_s[a]);
  return sum;
}

/// Compresses the box along z; x and y are stress-controlled.
void compress(apps::WorkingAssembly& w, Servo& servo, int step)
{
  if (step % 100 == 1) servo.stiffness = affine_stiffness(w.assembly);
  servo.limit = 1e-4 / w.dt;
  const Vec3 sigma = w.assembly.virial.value() / w.assembly.cell.volume();
  w.assembly.cell.rate = servo.rates(CellControl{AxisControl{true, -2e7, 0.0},
                                                 {true, -1e7, 0.0},
                                                 {false, 0.0, -3e-5 / w.dt}},
                                     sigma, w.dt);
}

void report(apps::WorkingAssembly& w, int step)
{
  const EnergyBalance e = energy_balance(w.assembly, w.dt);
  const double unbalanced = unbalanced_ratio(w.assembly);
  const CellAverages c =
      w.assembly.cell.is_strain_controlled ? cell_averages(w.assembly) : CellAverages{};
  const Assembly all = gather(w.assembly);
  if (w.assembly.comm.rank() != 0) return;
  std::printf(
      "%4d %016" PRIx64 " %016" PRIx64 " broken %zu yielded %zu dt %a unbalanced %a "
      "kinetic %a bonds %a contacts %a plastic %a released %a slip %a damping %a "
      "cell work %a stress %a %a traction %a edges %a %a\n",
      step, apps::checksum(all.particles), checksum_of_histories(all), all.losses.broken,
      all.losses.yielded, w.dt, unbalanced, e.kinetic, e.bonds, e.contacts, e.plastic,
      e.breakage_release, e.slip, e.damping, e.cell_work, c.stress(0, 0), c.stress(1, 2),
      c.traction.z(), all.cell.size.x(), all.cell.size.z());
}

std::uint64_t fnv_1a(const std::string& bytes)
{
  std::uint64_t sum = 1469598103934665603u;
  for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return sum;
}

/// The sums over all cells of a section through the block, as text.
std::string section_of(const Assembly& assembly, const std::vector<Vec3>& x_0,
                       const std::vector<LoadedBranch>& branches,
                       const std::vector<DeformationFit>& fits)
{
  const Particles& p = assembly.particles;
  ParticleValues values;
  p.for_owned([&](Index i) {
    values.displacement.push_back(p.state[i].x - x_0[i]);
    values.increment.push_back(p.state[i].v);
  });
  for (const DeformationFit& fit : fits) {
    values.volumetric.push_back(volumetric_strain(fit.F));
    values.shear.push_back(shear_strain(fit.F));
  }
  values.damage = particle_damage(assembly);
  values.coordination = coordination(p, branches);
  const double edge = 20.0 * 2.0 * p.state.front().R;
  SectionSums sums(make_section_grid(edge, edge, edge, 0.05 * edge), p, branches, values,
                   nullptr);
  sums.add_ranks(assembly.comm);
  const SectionSum all = sums.between(0.0, edge, -edge, edge);
  if (!(all.solid > 0.0 && all.virial.norm() > 0.0))
    throw std::runtime_error("nothing is in the section");
  std::string text;
  for (int row = 0; row < sums.grid().n_z; ++row)
    for (int column = 0; column < sums.grid().n_columns(); ++column) {
      const SectionSum& s = sums.cell(column, row);
      char line[512];
      std::snprintf(line, sizeof line, "%a %a %a %a %a %a %a %a %a %a\n", s.solid,
                    s.virial(0, 0), s.virial(2, 1), s.displacement.x(), s.increment.z(),
                    s.damage, s.coordination, s.volumetric, s.shear, s.largest_R);
      text += line;
    }
  return text;
}

/// Write a frame, each rank its files, and show their checksums and that of a section.
void report_frame(Assembly& assembly, const std::vector<Vec3>& x_0,
                  const PeriodicCell& cell_0)
{
  assembly.partition.gather_motion(assembly.particles, assembly.comm);
  const auto fits = local_deformations(x_0, assembly.particles, cell_0, assembly.cell);
  const auto branches = loaded_branches(assembly);
  const std::string section = section_of(assembly, x_0, branches, fits);
  const FrameFiles frame(
      {assembly, x_0, branches, strained_porosity(0.4, fits), strain_fields(fits)});
  const AssemblyFiles files{"particles.vtp", "bonds.vtp", "contacts.vtp"};
  frame.write(files);
  MPI_Barrier(MPI_COMM_WORLD);
  if (assembly.comm.rank() != 0) return;
  std::printf("section %016" PRIx64, fnv_1a(section));
  for (const auto& file : {files.particles, files.bonds, files.contacts}) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::printf(" %s %016" PRIx64, file.c_str(), fnv_1a(bytes));
  }
  std::printf("\n");
}

struct Options {
  bool rebuilds = false, rebalances = false;
  std::string restart, checkpoint; ///< files
  int stop = n_steps;
};

template <class Working>
NumbersOf<Working> numbers_of(Working& w)
{
  NumbersOf<Working> all{{"time step [s]", &w.dt},
                         {"previous time step [s]", &w.dt_before}};
  append_stable_step(all, w.stable_step);
  return all;
}

template <class Working>
CountsOf<Working> counts_of(Working& w)
{
  CountsOf<Working> all;
  append_stable_step_counts(all, w.stable_step);
  return all;
}

void save(const apps::WorkingAssembly& w, const Servo& servo, const std::string& file)
{
  State state(w.assembly.comm.rank());
  save(state, w.assembly);
  save_numbers(state, "steps", numbers_of(w));
  save_counts(state, "step_counts", counts_of(w));
  const Vec3 &I = servo.integral, &M = servo.stiffness;
  state.add_common<double>("servo", {I.x(), I.y(), I.z(), M.x(), M.y(), M.z()}, 6);
  write_checkpoint(file, {"test", "scene", "", "", w.n_steps, 0.0}, std::move(state),
                   w.assembly.comm);
}

void restore(apps::WorkingAssembly& w, Servo& servo, const std::string& file)
{
  Checkpoint c = read_checkpoint(file);
  load(c.state, w.assembly);
  w.n_steps = c.label.step;
  load_numbers(c.state, "steps", numbers_of(w));
  load_counts(c.state, "step_counts", counts_of(w));
  const auto& s = c.state.get_rows<double>("servo", 1, 6);
  servo.integral = {s[0], s[1], s[2]};
  servo.stiffness = {s[3], s[4], s[5]};
}

/// Forces and stable step of what was bonded since the assembly was made.
void start(apps::WorkingAssembly& w)
{
  add_forces(w.assembly, 0.0);
  find_stable_step(w.stable_step, w.assembly, StepSpec{}, 0.0, w.assembly.motion.damping);
  w.dt = w.dt_before = default_safety * w.stable_step.limit;
}

/// Forces on five nodes, each term from one rank, of up to 10^`decade` N. With `shared` each rank
/// gets those of its nodes.
void add_up(double decade, bool shared, const Communicator& comm)
{
  NodalSums sums(5), of_others(2);
  if (shared) {
    NodeShares shares{{}, static_cast<std::size_t>(comm.rank())};
    const auto n = static_cast<std::size_t>(comm.n_ranks());
    for (std::size_t r = 0; r <= n; ++r) shares.first.push_back(5 * r / n);
    sums.share(std::move(shares));
  }
  ForceSum beside;
  for (std::uint64_t k = 0; k < 20000; ++k) {
    const auto draw = [&](std::uint64_t c) {
      return std::pow(10.0, decade) * (2.0 * uniform(5, k, c) - 1.0);
    };
    const Row force{draw(0), draw(1), draw(2), 0.0};
    if (static_cast<int>(k % 7) % comm.n_ranks() != comm.rank()) continue;
    sums.add(k % 5, force);
    of_others.add(k % 2, force);
    beside.add(draw(3));
  }
  ExactReduction all;
  all.add(of_others);
  all.add(sums);
  all.add(beside);
  all.run(comm);
  std::vector<Vec3> f;
  const auto [first, end] = sums.own();
  for (std::size_t k = first; k < end; ++k) f.push_back(sums.value(k));
  if (sums.is_shared()) f = comm.gather(f);
  if (comm.rank() != 0) return;
  for (std::size_t k = 0; k < f.size(); ++k)
    std::printf("%g %zu %a %a %a %a %a\n", decade, k, f[k].x(), f[k].y(), f[k].z(),
                of_others.value(k % 2).x(), beside.value());
}

void run(const std::string& name, const Options& o)
{
  const bool rebuilds = o.rebuilds, rebalances = o.rebalances;
  apps::WorkingAssembly w = make(name);
  weaken(w.assembly, 1e8);
  std::vector<Vec3> x_0;
  for (const ParticleState& b : w.assembly.particles.state) x_0.push_back(b.x);
  const PeriodicCell cell_0 = w.assembly.cell;
  // The largest frequency is computed again in the middle of the run, after the first stop.
  const auto n_before = w.n_steps = steps_between_evaluations - n_steps / 2;
  Servo servo;
  if (!o.restart.empty()) restore(w, servo, o.restart);
  if (name == "varied")
    draw_strengths({StrengthVariability::Distribution::weibull, 0.4, 3},
                   w.assembly.particles);
  distribute(w.assembly, MPI_COMM_WORLD);
  if (o.restart.empty())
    start(w);
  else
    rebuild_lists(w.assembly);
  bool has_flown = false;
  for (int step = static_cast<int>(w.n_steps - n_before) + 1; step <= o.stop; ++step) {
    if (rebuilds && step % 7 == 0) w.assembly.list.invalidate();
    if (rebalances && step % 50 == 0)
      rebalance(w.assembly, 1.0 + (step / 50 + w.assembly.comm.rank()) % 3, true);
    if (w.assembly.cell.is_strain_controlled) compress(w, servo, step);
    w.step();
    has_flown |= !w.assembly.list.extra().empty();
    if (step % 40 == 0) report(w, step);
  }
  if (o.checkpoint.empty()) report_frame(w.assembly, x_0, cell_0);
  std::fflush(stdout);
  if (!o.checkpoint.empty()) {
    save(w, servo, o.checkpoint);
    return;
  }
  const std::size_t broken = w.assembly.comm.global_sum(w.assembly.losses.broken);
  if (name == "debris" && o.restart.empty() && !has_flown)
    throw std::runtime_error("no fragment had an extra reach in the lists");
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
    if (argc > 1 && argv[1] == std::string("sums"))
      // 64 bits hold 8 kN
      for (const double decade : {-3.0, 0.0, 2.0, 6.0})
        for (const bool shared : {false, true})
          add_up(decade, shared, Communicator(MPI_COMM_WORLD));
    else
      run(argc > 1 ? argv[1] : "", o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "mpi_scenes: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
}

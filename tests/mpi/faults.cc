/// A fault of one particle that only its owner detects: all ranks stop together with the
/// message of the owner.
///
/// usage: mpi_faults FAULT; prints the message
///   drift     the particle moves too far in a step
///   force     a bond of the particle has an invalid history
///   overlap   the particle overlaps its neighbour
///   nowhere   its position is not a number
///   input     the last rank alone refuses its input, and the others wait for it
#include "apps/bench/workloads.h"
#include "apps/run/run_guard.h"
#include "dem/assembly/distribute.h"
#include "dem/assembly/overlaps.h"
#include "dem/collective_failure.h"

#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

using namespace mergel;
using namespace mergel::dem;

namespace {

constexpr Index culprit = 1234;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A bonded periodic box under strain control, distributed over the ranks.
apps::WorkingAssembly make()
{
  apps::WorkloadSpec spec;
  spec.workload = apps::Workload::frictional_packing;
  spec.n_particles = 3000;
  apps::WorkingAssembly w = apps::make_workload(spec);
  w.assembly.bonds =
      make_bonds(w.assembly.particles, w.assembly.cell, w.assembly.contacts.pairs);
  w.assembly.contacts = {};
  w.assembly.list.invalidate();
  w.assembly.cell.is_strain_controlled = true;
  distribute(w.assembly, MPI_COMM_WORLD);
  add_forces(w.assembly, 0.0);
  return w;
}

void commit(const std::string& fault, Assembly& assembly)
{
  Particles& p = assembly.particles;
  if (!p.owns(culprit)) return; // the other ranks do not see the fault
  ParticleState& b = p.state[culprit];
  if (fault == "drift")
    b.v.x() = 1e9;
  else if (fault == "nowhere")
    b.x.y() = no_number;
  else if (fault != "force" && fault != "overlap")
    throw std::invalid_argument("unknown fault " + fault);
  for (std::size_t k = 0; k < assembly.bonds.size(); ++k) {
    const Pair& q = assembly.bonds.pairs[k];
    if (q.i != culprit) continue;
    if (fault == "force") assembly.bonds.blocks[k / n_lanes].gap_0[k % n_lanes] = no_number;
    if (fault == "overlap") b.x = p.state[q.j].x + assembly.cell.offset(q.shift);
    break;
  }
}

/// Message of the instability; empty if none is found.
std::string found(apps::WorkingAssembly& w)
{
  try {
    check_overlaps(w.assembly);
    for (int k = 0; k < 2; ++k) w.step();
  } catch (const Unstable& e) {
    return e.what();
  }
  return "";
}

/// True if all ranks have the message of the first one.
bool is_said_by_all(const std::string& words)
{
  char first[512] = {};
  std::snprintf(first, sizeof first, "%s", words.c_str());
  MPI_Bcast(first, sizeof first, MPI_CHAR, 0, MPI_COMM_WORLD);
  int alike = words == first;
  MPI_Allreduce(MPI_IN_PLACE, &alike, 1, MPI_INT, MPI_LAND, MPI_COMM_WORLD);
  return alike != 0;
}

/// Input that one rank alone refuses: the run ends without waiting for the others.
int refuse_alone()
{
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (rank == n_ranks - 1) throw InputError("my input is not yours");
  MPI_Barrier(MPI_COMM_WORLD);
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  if (argc > 1 && std::string(argv[1]) == "input") {
    const int code = apps::run_guarded(refuse_alone, std::chrono::milliseconds(500));
    MPI_Finalize();
    return code;
  }
  int code = 0;
  try {
    apps::WorkingAssembly w = make();
    commit(argc > 1 ? argv[1] : "", w.assembly);
    const std::string words = found(w);
    if (words.empty() || !is_said_by_all(words)) code = 1;
    if (w.assembly.comm.rank() == 0 || code != 0) std::printf("%s\n", words.c_str());
  } catch (const std::exception& e) { // on one rank alone, or of another kind
    std::fprintf(stderr, "mpi_faults: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return code;
}

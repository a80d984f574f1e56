/// One grain of a rock does what it must not, and only its owner sees it: all ranks stop
/// together, in its words.
///
/// usage: mpi_faults FAULT; prints what was said
///   drift     the grain flies off
///   force     a bond of it has lost its history
///   overlap   it lies in its neighbour
///   nowhere   its place is no number
///   input     the last rank alone refuses its input, and the others wait for it
#include "apps/bench/workloads.h"
#include "apps/run/run_guard.h"
#include "dem/assembly/distribute.h"
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

/// A bonded box that is strained; the grain's neighbours are known.
apps::WorkingRock make()
{
  apps::WorkloadSpec spec;
  spec.workload = apps::Workload::frictional_packing;
  spec.n_particles = 3000;
  apps::WorkingRock w = apps::make_workload(spec);
  w.rock.bonds = make_bonds(w.rock.particles, w.rock.cell, w.rock.contacts.pairs);
  w.rock.contacts = {};
  w.rock.list.invalidate();
  w.rock.cell.is_driven = true;
  share_out(w.rock, MPI_COMM_WORLD);
  add_forces(w.rock, 0.0);
  return w;
}

void commit(const std::string& fault, Rock& rock)
{
  Particles& p = rock.particles;
  if (!p.owns(culprit)) return; // nobody else knows
  Body& b = p.body[culprit];
  if (fault == "drift")
    b.v.x() = 1e9;
  else if (fault == "nowhere")
    b.x.y() = no_number;
  else if (fault != "force" && fault != "overlap")
    throw std::invalid_argument("no fault " + fault);
  for (std::size_t k = 0; k < rock.bonds.size(); ++k) {
    const Pair& q = rock.bonds.pairs[k];
    if (q.i != culprit) continue;
    if (fault == "force") rock.bonds.blocks[k / n_lanes].gap_0[k % n_lanes] = no_number;
    if (fault == "overlap") b.x = p.body[q.j].x + rock.cell.offset(q.shift);
    break;
  }
}

/// "" when nothing is found.
std::string found(apps::WorkingRock& w)
{
  try {
    check_overlaps(w.rock);
    for (int k = 0; k < 2; ++k) w.step();
  } catch (const Unstable& e) {
    return e.what();
  }
  return "";
}

/// Whether all ranks say what the first one says.
bool is_said_by_all(const std::string& words)
{
  char first[512] = {};
  std::snprintf(first, sizeof first, "%s", words.c_str());
  MPI_Bcast(first, sizeof first, MPI_CHAR, 0, MPI_COMM_WORLD);
  int alike = words == first;
  MPI_Allreduce(MPI_IN_PLACE, &alike, 1, MPI_INT, MPI_LAND, MPI_COMM_WORLD);
  return alike != 0;
}

/// What only one rank refuses is no end in order.
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
    apps::WorkingRock w = make();
    commit(argc > 1 ? argv[1] : "", w.rock);
    const std::string words = found(w);
    if (words.empty() || !is_said_by_all(words)) code = 1;
    if (w.rock.comm.rank() == 0 || code != 0) std::printf("%s\n", words.c_str());
  } catch (const std::exception& e) { // on one rank alone, or another kind
    std::fprintf(stderr, "mpi_faults: %s\n", e.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return code;
}

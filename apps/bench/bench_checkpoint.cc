#include "apps/bench/bench_checkpoint.h"

#include "dem/assembly/distribute.h"
#include "dem/io/state/assembly_state.h"
#include "dem/io/state/checkpoint.h"
#include "dem/timer.h"

#include <iostream>

namespace mergel::apps {

void measure_checkpoint(const WorkloadSpec& spec, const std::filesystem::path& file)
{
  WorkingAssembly w = make_workload(spec);
  dem::distribute(w.assembly, MPI_COMM_WORLD);
  dem::add_forces(w.assembly, 0.0);
  for (int k = 0; k < 20; ++k) w.step();
  const dem::Communicator& comm = w.assembly.comm;
  const double n = static_cast<double>(w.assembly.particles.size());
  for (int repeat = 0; repeat < 3; ++repeat) {
    comm.global_sum(0); // all ranks start together
    const double start = dem::wall_clock();
    dem::State state(comm.rank());
    dem::save(state, w.assembly);
    const double save = dem::wall_clock();
    dem::write_checkpoint(file, {MERGEL_VERSION, "bench", "workload", "", w.n_steps, 0.0},
                          std::move(state), comm);
    const double written = dem::wall_clock();
    dem::Checkpoint c = dem::read_checkpoint(file);
    const double read = dem::wall_clock();
    double n_pairs = 0.0; // that have a history
    for (const char* pairs : {"bond_pairs", "contact_pairs"})
      n_pairs += static_cast<double>(c.state.arrays().at(pairs).rows());
    dem::load(c.state, w.assembly);
    const double loaded = dem::wall_clock();
    dem::distribute(w.assembly, MPI_COMM_WORLD);
    dem::rebuild_lists(w.assembly);
    const double distributed = dem::wall_clock();
    const auto bytes = static_cast<double>(std::filesystem::file_size(file));
    std::cout << "checkpoint of " << n << " particles and " << n_pairs
              << " pairs: " << 1e-6 * bytes << " MB, " << bytes / n
              << " bytes per particle, " << bytes / (n + n_pairs)
              << " per particle or pair; write " << comm.global_max(written - start)
              << " s (" << comm.global_max(save - start) << " s to collect), read "
              << comm.global_max(loaded - written) << " s ("
              << comm.global_max(read - written)
              << " s from the disk), distribution and lists "
              << comm.global_max(distributed - loaded) << " s\n";
  }
}

} // namespace mergel::apps

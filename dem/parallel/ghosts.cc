#include "dem/parallel/ghosts.h"

#include <algorithm>
#include <numeric>

namespace mergel::dem {

namespace {

constexpr int ghost_tag = 1;

int n_numbers(const std::vector<PackedMotion>& motions)
{
  return static_cast<int>(std::tuple_size_v<PackedMotion> * motions.size());
}

} // namespace

void Ghosts::choose(Particles& p, const std::vector<char>& is_needed,
                    const Partition& partition, const Communicator& comm)
{
  if (comm.is_alone()) return;
  std::vector<char> is_owned(p.size(), 0), is_ghost(p.size(), 0);
  for (Index i = 0; i < p.size(); ++i) {
    is_owned[i] = p.owns(i);
    is_ghost[i] = !p.owns(i) && is_needed[i];
  }
  p.set_ownership(std::move(is_owned), is_ghost);

  // Each rank sends each owner the list of particles that it needs.
  const auto n = static_cast<std::size_t>(comm.n_ranks());
  std::vector<std::vector<Index>> wanted(n);
  for (std::size_t r = 0; r < n; ++r)
    for (const Index i : partition.owned_by(r))
      if (is_ghost[i]) wanted[r].push_back(i);
  std::vector<int> n_wanted(n), n_asked(n), at_wanted(n), at_asked(n);
  std::vector<Index> out;
  for (std::size_t r = 0; r < n; ++r) {
    n_wanted[r] = static_cast<int>(wanted[r].size());
    at_wanted[r] = static_cast<int>(out.size());
    out.insert(out.end(), wanted[r].begin(), wanted[r].end());
  }
  MPI_Alltoall(n_wanted.data(), 1, MPI_INT, n_asked.data(), 1, MPI_INT, comm.mpi());
  std::exclusive_scan(n_asked.begin(), n_asked.end(), at_asked.begin(), 0);
  std::vector<Index> asked(static_cast<std::size_t>(at_asked.back() + n_asked.back()));
  MPI_Alltoallv(out.data(), n_wanted.data(), at_wanted.data(), MPI_UINT32_T, asked.data(),
                n_asked.data(), at_asked.data(), MPI_UINT32_T, comm.mpi());

  neighbours_.clear();
  for (std::size_t r = 0; r < n; ++r) {
    if (n_wanted[r] == 0 && n_asked[r] == 0) continue;
    const auto first = asked.begin() + at_asked[r];
    Neighbour q{static_cast<int>(r), {first, first + n_asked[r]}, wanted[r], {}, {}};
    q.out.resize(q.send.size());
    q.in.resize(q.receive.size());
    neighbours_.push_back(std::move(q));
  }
}

void Ghosts::update(Particles& p, const Communicator& comm)
{
  if (neighbours_.empty()) return;
  std::vector<MPI_Request> requests;
  requests.reserve(2 * neighbours_.size());
  for (Neighbour& q : neighbours_)
    MPI_Irecv(q.in.data(), n_numbers(q.in), MPI_DOUBLE, q.rank, ghost_tag, comm.mpi(),
              &requests.emplace_back());
  for (Neighbour& q : neighbours_) {
    for (std::size_t k = 0; k < q.send.size(); ++k) q.out[k] = pack(p.state[q.send[k]]);
    MPI_Isend(q.out.data(), n_numbers(q.out), MPI_DOUBLE, q.rank, ghost_tag, comm.mpi(),
              &requests.emplace_back());
    ++traffic_.messages;
    traffic_.bytes += sizeof(PackedMotion) * q.out.size();
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (const Neighbour& q : neighbours_)
    for (std::size_t k = 0; k < q.receive.size(); ++k) {
      unpack(q.in[k], p.state[q.receive[k]]);
      p.load[q.receive[k]] = Load{}; // partial sums, which nothing reads
    }
}

} // namespace mergel::dem

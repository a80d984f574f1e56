/// Rows: arrays with an entry for each particle that a rank owns, in ascending order. Frames are
/// computed in rows: no rank holds the fields of all particles but the one that writes them.
#pragma once

#include "dem/parallel/partition.h"

#include <algorithm>

namespace mergel::dem {

/// The row of each owned particle; the number of rows for all others.
inline std::vector<Index> owned_rows(const Particles& p)
{
  std::vector<Index> rows(p.size(), static_cast<Index>(p.n_owned()));
  Index k = 0;
  p.for_owned([&](Index i) { rows[i] = k++; });
  return rows;
}

/// The rows of all ranks by particle on the rank `to`, nothing on the others; collective.
/// @param mine `width` values for each owned particle
template <class Value>
std::vector<Value> gather_rows(const Communicator& comm, const Partition& partition,
                               std::vector<Value> mine, int to, std::size_t width = 1)
{
  if (comm.is_alone()) return mine;
  const std::vector<Value> by_rank = comm.gather_on(to, mine);
  std::vector<Value> by_particle(by_rank.size());
  if (comm.rank() != to) return by_particle;
  auto from = by_rank.begin();
  for (std::size_t r = 0; r < static_cast<std::size_t>(comm.n_ranks()); ++r)
    for (const Index i : partition.owned_by(r)) {
      const auto end = from + static_cast<std::ptrdiff_t>(width);
      std::copy(from, end, by_particle.begin() + static_cast<std::ptrdiff_t>(width * i));
      from = end;
    }
  return by_particle;
}

/// The rows of remote particles, from the ranks that own them; collective.
/// @param rows owned_rows(); @param mine a record for each owned particle
/// @param wanted remote particles, ascending; the result has their order
template <class Record>
std::vector<Record> fetch_rows(const Communicator& comm, const Partition& partition,
                               const std::vector<Index>& rows,
                               const std::vector<Record>& mine,
                               const std::vector<Index>& wanted)
{
  if (comm.is_alone()) return {};
  struct Request {
    Index particle;
    int from;
  };
  const auto n = static_cast<std::size_t>(comm.n_ranks());
  const std::vector<int> owner = partition.owners();
  std::vector<std::vector<Request>> requests(n);
  std::vector<std::vector<std::size_t>> places(n); // of what each rank will send
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto r = static_cast<std::size_t>(owner[wanted[k]]);
    requests[r].push_back({wanted[k], comm.rank()});
    places[r].push_back(k);
  }
  std::vector<std::vector<Record>> answers(n);
  for (const Request& q : comm.exchange(requests))
    answers[static_cast<std::size_t>(q.from)].push_back(mine[rows[q.particle]]);
  const std::vector<Record> received = comm.exchange(answers);
  std::vector<Record> found(wanted.size());
  auto next = received.begin();
  for (const std::vector<std::size_t>& of_rank : places)
    for (const std::size_t k : of_rank) found[k] = *next++;
  return found;
}

} // namespace mergel::dem

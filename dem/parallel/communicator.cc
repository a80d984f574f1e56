#include "dem/parallel/communicator.h"

#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

namespace mergel::dem {

Communicator::Communicator(MPI_Comm comm) : comm_(comm)
{
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &n_ranks_);
}

double Communicator::global_min(double value) const
{
  if (is_alone()) return value;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MIN, comm_);
  ++n_reductions_;
  return value;
}

double Communicator::global_max(double value) const
{
  return -global_min(-value);
}

void Communicator::global_max(std::vector<double>& values) const
{
  if (is_alone()) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE,
                MPI_MAX, comm_);
  ++n_reductions_;
}

std::size_t Communicator::global_sum(std::size_t count) const
{
  if (is_alone()) return count;
  std::uint64_t n = count;
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_UINT64_T, MPI_SUM, comm_);
  ++n_reductions_;
  return n;
}

void Communicator::agree_on(const Fault& fault) const
{
  std::string message = fault.message();
  if (!is_alone()) {
    const auto first = static_cast<int>(global_min(fault.is_set() ? rank_ : n_ranks_));
    if (first == n_ranks_) return;
    std::uint64_t length = message.size();
    MPI_Bcast(&length, 1, MPI_UINT64_T, first, comm_);
    message.resize(length);
    MPI_Bcast(message.data(), static_cast<int>(length), MPI_CHAR, first, comm_);
  }
  if (!message.empty()) throw Unstable(message);
}

namespace {

/// A record as MPI sends it.
class RecordType {
public:
  explicit RecordType(std::size_t size)
  {
    MPI_Type_contiguous(static_cast<int>(size), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~RecordType() { MPI_Type_free(&type_); }
  RecordType(const RecordType&) = delete;
  RecordType& operator=(const RecordType&) = delete;

  MPI_Datatype type() const { return type_; }

private:
  MPI_Datatype type_;
};

/// Where the records of each rank begin, and the number of all.
std::pair<std::vector<int>, std::size_t> positions(const std::vector<int>& counts)
{
  std::vector<int> at(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), at.begin(), 0);
  return {at, static_cast<std::size_t>(at.back() + counts.back())};
}

} // namespace

void Communicator::gather_bytes(const void* mine, std::size_t n, std::size_t size,
                                const std::function<void*(std::size_t)>& allocate) const
{
  std::vector<int> counts(static_cast<std::size_t>(n_ranks_));
  const int own = static_cast<int>(n);
  MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  const auto [at, all] = positions(counts);
  const RecordType record(size);
  MPI_Allgatherv(mine, own, record.type(), allocate(all), counts.data(), at.data(),
                 record.type(), comm_);
}

void Communicator::exchange_bytes(const void* mine, const std::vector<int>& counts,
                                  std::size_t size,
                                  const std::function<void*(std::size_t)>& allocate) const
{
  std::vector<int> received(counts.size());
  MPI_Alltoall(counts.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm_);
  const auto [from, n_sent] = positions(counts);
  const auto [at, n_received] = positions(received);
  const RecordType record(size);
  MPI_Alltoallv(mine, counts.data(), from.data(), record.type(), allocate(n_received),
                received.data(), at.data(), record.type(), comm_);
}

} // namespace mergel::dem

#include "dem/parallel/reduction.h"

#include <algorithm>
#include <cstring>

namespace mergel::dem {

namespace {

void add_in_wide(void* in, void* inout, int* n, MPI_Datatype*)
{
  // By copies, because the buffers of MPI need not be aligned for 128 bits.
  for (std::size_t k = 0; k < static_cast<std::size_t>(*n) * sizeof(ExactWide);
       k += sizeof(ExactWide)) {
    ExactWide a, b;
    std::memcpy(&a, static_cast<const char*>(in) + k, sizeof a);
    std::memcpy(&b, static_cast<char*>(inout) + k, sizeof b);
    b += a;
    std::memcpy(static_cast<char*>(inout) + k, &b, sizeof b);
  }
}

} // namespace

/// The sums that every rank gets, n_common_ 64-bit integers. Returns whether they have room.
bool ExactReduction::write_common(std::int64_t limit, std::int64_t* to) const
{
  bool has_room = true;
  for (const NodalSums* sums : nodal_)
    has_room &= sums->write_narrow({0, sums->size()}, limit, to);
  for (const ExactWide* term : terms_) {
    has_room &= *term<limit&& * term> - limit;
    *to++ = static_cast<std::int64_t>(*term);
  }
  return has_room;
}

void ExactReduction::take_common(const std::int64_t* from)
{
  for (NodalSums* sums : nodal_) from = sums->take_narrow(from);
  for (ExactWide* term : terms_) *term = *from++;
}

/// The sums as 64-bit integers, where all of them have room in these on every rank: nearly
/// always. Half the bytes, and an operation that MPI knows. Returns whether they had.
bool ExactReduction::add_narrow(const Communicator& comm, std::int64_t limit)
{
  std::vector<std::int64_t> values(n_common_ + 1);
  values.back() = !write_common(limit, values.data());
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T,
                MPI_SUM, comm.comm_);
  if (values.back() > 0) return false;
  take_common(values.data());
  return true;
}

/// The same where nodes are shared. Each rank gets from all others their sums at its nodes, and
/// beside them what every rank gets: half of the time of a reduction (MPI_Reduce_scatter).
bool ExactReduction::share_narrow(const Communicator& comm, std::int64_t limit)
{
  const auto n_ranks = static_cast<std::size_t>(comm.n_ranks()),
             rank = static_cast<std::size_t>(comm.rank());
  const auto block =
      [&](std::size_t of) { // sums at the nodes of a rank, the others, a flag
        std::size_t n = n_common_ + 1;
        for (const NodalSums* sums : shared_) {
          const auto [first, end] = sums->nodes_of(of);
          n += 3 * (end - first);
        }
        return n;
      };
  std::vector<int> n_sent(n_ranks, 0), n_received(n_ranks, static_cast<int>(block(rank))),
      to(n_ranks, 0), from(n_ranks, 0);
  n_received[rank] = 0;
  for (std::size_t r = 0; r < n_ranks; ++r) {
    if (r != rank) n_sent[r] = static_cast<int>(block(r));
    if (r == 0) continue;
    to[r] = to[r - 1] + n_sent[r - 1];
    from[r] = from[r - 1] + n_received[r - 1];
  }

  std::vector<std::int64_t> common(n_common_ + 1),
      sent(static_cast<std::size_t>(to.back() + n_sent.back())),
      received(static_cast<std::size_t>(from.back() + n_received.back()));
  bool has_room = write_common(limit, common.data());
  for (const NodalSums* sums : shared_) has_room &= sums->are_narrow(sums->own(), limit);
  for (std::size_t r = 0; r < n_ranks; ++r) {
    if (r == rank) continue;
    std::int64_t* next = sent.data() + to[r];
    for (const NodalSums* sums : shared_)
      has_room &= sums->write_narrow(sums->nodes_of(r), limit, next);
    std::copy(common.begin(), common.end(), next);
  }
  common.back() = !has_room;
  for (std::size_t r = 0; r < n_ranks; ++r)
    if (r != rank) sent[static_cast<std::size_t>(to[r] + n_sent[r] - 1)] = !has_room;
  MPI_Alltoallv(sent.data(), n_sent.data(), to.data(), MPI_INT64_T, received.data(),
                n_received.data(), from.data(), MPI_INT64_T, comm.comm_);

  const auto beside = static_cast<std::ptrdiff_t>(block(rank) - common.size());
  for (std::size_t r = 0; r < n_ranks; ++r) {
    if (r == rank) continue;
    const std::int64_t* const others = received.data() + from[r] + beside;
    for (std::size_t k = 0; k < common.size(); ++k) common[k] += others[k];
  }
  if (common.back() > 0) return false;
  take_common(common.data());
  for (std::size_t r = 0; r < n_ranks; ++r) {
    if (r == rank) continue;
    const std::int64_t* next = received.data() + from[r];
    for (NodalSums* sums : shared_) next = sums->add_narrow(next);
  }
  return true;
}

void ExactReduction::add_wide(MPI_Comm comm)
{
  static const auto wide = [] {
    MPI_Datatype type;
    MPI_Type_contiguous(sizeof(ExactWide), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    return type;
  }();
  static const auto add = [] {
    MPI_Op op;
    MPI_Op_create(add_in_wide, 1, &op);
    return op;
  }();
  std::vector<ExactWide> values;
  const auto append = [&](const ExactWide& raw) { values.push_back(raw); };
  for (const auto* list : {&nodal_, &shared_})
    for (const NodalSums* sums : *list) visit_raw(*sums, append);
  for (const ExactWide* term : terms_) values.push_back(*term);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), wide, add,
                comm);
  auto from = values.begin();
  for (const auto* list : {&nodal_, &shared_})
    for (NodalSums* sums : *list) visit_raw(*sums, [&](ExactWide& raw) { raw = *from++; });
  for (ExactWide* term : terms_) *term = *from++;
}

void ExactReduction::run(const Communicator& comm)
{
  if (comm.is_alone() || is_empty()) return;
  const std::int64_t limit = (std::int64_t{1} << 62) / comm.n_ranks();
  if (!(shared_.empty() ? add_narrow(comm, limit) : share_narrow(comm, limit)))
    add_wide(comm.comm_);
  ++comm.n_reductions_;
}

} // namespace mergel::dem

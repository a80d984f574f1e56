#include "dem/parallel/reduction.h"

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

/// The sums as 64-bit integers, where all of them have room in these on every rank: nearly
/// always. Half the bytes, and an operation that MPI knows. Returns whether they had.
bool ExactReduction::add_narrow(int n_ranks, MPI_Comm comm)
{
  const std::int64_t limit = (std::int64_t{1} << 62) / n_ranks;
  std::vector<std::int64_t> values;
  std::size_t n = terms_.size() + 1;
  for (const NodalSums* sums : nodal_) n += 3 * sums->size();
  values.reserve(n);
  bool has_room = true;
  for (const NodalSums* sums : nodal_) has_room &= sums->append_narrow(values, limit);
  for (const ExactWide* term : terms_) {
    has_room &= *term<limit&& * term> - limit;
    values.push_back(static_cast<std::int64_t>(*term));
  }
  values.resize(n, 0);
  values.back() = !has_room;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(n), MPI_INT64_T, MPI_SUM,
                comm);
  if (values.back() > 0) return false;
  const std::int64_t* from = values.data();
  for (NodalSums* sums : nodal_) from = sums->take_narrow(from);
  for (ExactWide* term : terms_) *term = *from++;
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
  for (const NodalSums* sums : nodal_) visit_raw(*sums, append);
  for (const ExactWide* term : terms_) values.push_back(*term);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), wide, add,
                comm);
  auto from = values.begin();
  for (NodalSums* sums : nodal_) visit_raw(*sums, [&](ExactWide& raw) { raw = *from++; });
  for (ExactWide* term : terms_) *term = *from++;
}

void ExactReduction::run(const Communicator& comm)
{
  if (comm.is_alone() || is_empty()) return;
  if (!add_narrow(comm.n_ranks(), comm.comm_)) add_wide(comm.comm_);
  ++comm.n_reductions_;
}

} // namespace mergel::dem

#include "dem/parallel/reduction.h"

#include <cstring>

namespace mergel::dem {

namespace {

void add_wide(void* in, void* inout, int* n, MPI_Datatype*)
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

/// The sums as 64-bit integers, where all of them have room in these on every rank: nearly
/// always. Half the bytes, and an operation that MPI knows. Returns whether they had.
bool add_narrow(const std::vector<ExactWide*>& terms, int n_ranks, MPI_Comm comm)
{
  const ExactWide limit = (ExactWide{1} << 62) / n_ranks;
  std::vector<std::int64_t> values(terms.size() + 1, 0);
  std::int64_t& n_too_large = values.back();
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const ExactWide term = *terms[k];
    if (term < limit && term > -limit)
      values[k] = static_cast<std::int64_t>(term);
    else
      n_too_large = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T,
                MPI_SUM, comm);
  if (n_too_large > 0) return false;
  for (std::size_t k = 0; k < terms.size(); ++k) *terms[k] = values[k];
  return true;
}

void add_all(const std::vector<ExactWide*>& terms, MPI_Comm comm)
{
  static const auto wide = [] {
    MPI_Datatype type;
    MPI_Type_contiguous(sizeof(ExactWide), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    return type;
  }();
  static const auto add = [] {
    MPI_Op op;
    MPI_Op_create(add_wide, 1, &op);
    return op;
  }();
  std::vector<ExactWide> values;
  values.reserve(terms.size());
  for (const ExactWide* t : terms) values.push_back(*t);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), wide, add,
                comm);
  for (std::size_t k = 0; k < terms.size(); ++k) *terms[k] = values[k];
}

} // namespace

void ExactReduction::run(const Communicator& comm)
{
  if (comm.is_alone() || terms_.empty()) return;
  if (!add_narrow(terms_, comm.n_ranks(), comm.comm_)) add_all(terms_, comm.comm_);
  ++comm.n_reductions_;
}

} // namespace mergel::dem

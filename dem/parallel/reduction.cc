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

} // namespace

void ExactReduction::run(const Communicator& comm)
{
  if (comm.is_alone() || terms_.empty()) return;
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
  values.reserve(terms_.size());
  for (const ExactWide* t : terms_) values.push_back(*t);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), wide, add,
                comm.comm_);
  ++comm.n_reductions_;
  for (std::size_t k = 0; k < terms_.size(); ++k) *terms_[k] = values[k];
}

} // namespace mergel::dem

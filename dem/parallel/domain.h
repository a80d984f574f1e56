/// Which rank owns which grain, and what the ranks tell each other in a step.
///
/// Every rank numbers all grains alike and keeps an entry for each; it moves those that it
/// owns and computes every pair and wall contact that touches them. A pair across a border
/// is computed on both sides from the same numbers, so no force travels back, and each grain
/// adds its pairs in the same order everywhere: no bit depends on the number of ranks.
#pragma once

#include "dem/collective_failure.h"
#include "dem/math/exact_sum.h"
#include "dem/particles/particles.h"

#include <functional>
#include <mpi.h>
#include <vector>

namespace mergel::dem {

/// What a rank has sent since the start.
struct Traffic {
  std::size_t messages = 0, bytes = 0; ///< to other ranks, ghosts only
  std::size_t reductions = 0;          ///< global sums, minima and flags
};

class Domain {
public:
  /// One rank that owns everything; MPI need not be up.
  Domain() = default;
  /// @param comm must outlive the domain
  explicit Domain(MPI_Comm comm);

  int rank() const { return rank_; }
  int n_ranks() const { return n_ranks_; }
  bool is_alone() const { return n_ranks_ == 1; }
  const Traffic& traffic() const { return traffic_; }

  /// Share the grains out anew by recursive coordinate bisection (Berger and Bokhari 1987) of
  /// their positions, by Zoltan. Sets the ownership of `p`; collective.
  /// @param weight load of each owned grain, in the order of for_owned(); empty for 1 each
  /// @pre x is up to date for owned grains
  void partition(Particles& p, const std::vector<double>& weight);

  /// Position, velocity and spin of every grain from its owner to everybody; collective.
  void gather_motion(Particles& p);

  /// Those of `is_needed` that others own become our ghosts; collective.
  void choose_ghosts(Particles& p, const std::vector<char>& is_needed);

  /// Position, velocity and spin of the ghosts from their owners; collective.
  void update_ghosts(Particles& p);

  double least(double value) const;         ///< collective
  double greatest(double value) const;      ///< collective
  std::size_t sum(std::size_t count) const; ///< collective

  /// End the run in order when a rank has met a fault; collective.
  /// @throws Unstable on all ranks, in the words of the lowest that met one
  void agree_on(const Fault& fault) const;

  /// Records of all ranks, in the order of ranks; collective.
  template <class Record>
  std::vector<Record> gather(const std::vector<Record>& mine) const
  {
    if (is_alone()) return mine;
    std::vector<Record> all;
    gather_bytes(mine.data(), mine.size(), sizeof(Record), [&all](std::size_t n) {
      all.resize(n);
      return static_cast<void*>(all.data());
    });
    return all;
  }

private:
  friend class ExactReduction;
  void gather_bytes(const void* mine, std::size_t n, std::size_t size,
                    const std::function<void*(std::size_t)>& room) const;
  void list_owners(const Particles& p);

  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0, n_ranks_ = 1;
  mutable Traffic traffic_;
  std::vector<std::vector<Index>> owned_by_; ///< by rank, ascending
  struct Neighbour {
    int rank;
    std::vector<Index> send, receive; ///< grains, ascending
    std::vector<double> out, in;      ///< nine numbers a grain
  };
  std::vector<Neighbour> neighbours_;
};

/// Exact sums of the ranks, added up by one message: list them, then run().
class ExactReduction {
public:
  bool is_empty() const { return terms_.empty(); }
  template <int exponent>
  void add(ExactSum<exponent>& s)
  {
    terms_.push_back(&s.raw());
  }
  template <class Sum>
  void add(ExactVector<Sum>& v)
  {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  /// Every sum becomes that over all ranks; collective, each rank with the same list.
  void run(const Domain& domain);

private:
  std::vector<ExactWide*> terms_;
};

} // namespace mergel::dem

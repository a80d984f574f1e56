#include "dem/parallel/domain.h"

#include <zoltan.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <numeric>

namespace mergel::dem {

namespace {

constexpr std::size_t n_motion = 9; ///< x, v and omega of a grain
constexpr int ghost_tag = 1;

void pack(const Body& b, double* to)
{
  for (int a = 0; a < 3; ++a) {
    to[a] = b.x[a];
    to[3 + a] = b.v[a];
    to[6 + a] = b.omega[a];
  }
}

void unpack(const double* from, Body& b)
{
  for (int a = 0; a < 3; ++a) {
    b.x[a] = from[a];
    b.v[a] = from[3 + a];
    b.omega[a] = from[6 + a];
  }
}

/// What Zoltan asks for.
struct Objects {
  std::vector<Index> grain;
  std::vector<std::array<double, 3>> x;
  std::vector<double> weight;
};

int count_objects(void* data, int* error)
{
  *error = ZOLTAN_OK;
  return static_cast<int>(static_cast<Objects*>(data)->grain.size());
}

void list_objects(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int,
                  float* weight, int* error)
{
  const auto& o = *static_cast<Objects*>(data);
  for (std::size_t k = 0; k < o.grain.size(); ++k) {
    global[k] = o.grain[k];
    local[k] = static_cast<ZOLTAN_ID_TYPE>(k);
    weight[k] = static_cast<float>(o.weight[k]);
  }
  *error = ZOLTAN_OK;
}

int count_dimensions(void*, int* error)
{
  *error = ZOLTAN_OK;
  return 3;
}

void place_object(void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, double* x,
                  int* error)
{
  const auto& at = static_cast<Objects*>(data)->x[*local];
  std::copy(at.begin(), at.end(), x);
  *error = ZOLTAN_OK;
}

void check(int zoltan_code, const char* what)
{
  if (zoltan_code != ZOLTAN_OK && zoltan_code != ZOLTAN_WARN)
    throw NumericalError(std::string("sharing the grains out failed in ") + what);
}

} // namespace

Domain::Domain(MPI_Comm comm) : comm_(comm)
{
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &n_ranks_);
}

void Domain::partition(Particles& p, const std::vector<double>& weight)
{
  if (is_alone()) return;
  Objects mine;
  p.for_owned([&](Index i) {
    mine.grain.push_back(i);
    const Vec3& x = p.body[i].x;
    mine.x.push_back({x.x(), x.y(), x.z()});
  });
  mine.weight = weight.empty() ? std::vector<double>(mine.grain.size(), 1.0) : weight;

  float version = 0.0F;
  check(Zoltan_Initialize(0, nullptr, &version), "Zoltan_Initialize");
  Zoltan_Struct* zoltan = Zoltan_Create(comm_);
  const auto set = [zoltan](const char* name, const char* value) {
    check(Zoltan_Set_Param(zoltan, name, value), name);
  };
  set("DEBUG_LEVEL", "0"); // first: the others speak
  set("LB_METHOD", "RCB");
  set("OBJ_WEIGHT_DIM", "1");
  set("RETURN_LISTS", "PARTS");
  set("NUM_GID_ENTRIES", "1");
  set("NUM_LID_ENTRIES", "1");
  Zoltan_Set_Num_Obj_Fn(zoltan, count_objects, &mine);
  Zoltan_Set_Obj_List_Fn(zoltan, list_objects, &mine);
  Zoltan_Set_Num_Geom_Fn(zoltan, count_dimensions, &mine);
  Zoltan_Set_Geom_Fn(zoltan, place_object, &mine);
  int changes = 0, n_global = 0, n_local = 0, n_in = 0, n_out = 0;
  ZOLTAN_ID_PTR in_global = nullptr, in_local = nullptr, out_global = nullptr,
                out_local = nullptr;
  int *in_rank = nullptr, *in_part = nullptr, *out_rank = nullptr, *out_part = nullptr;
  check(Zoltan_LB_Partition(zoltan, &changes, &n_global, &n_local, &n_in, &in_global,
                            &in_local, &in_rank, &in_part, &n_out, &out_global, &out_local,
                            &out_rank, &out_part),
        "Zoltan_LB_Partition");
  struct Owner {
    Index grain;
    int rank;
  };
  std::vector<Owner> shared;
  for (int k = 0; k < n_out; ++k) shared.push_back({out_global[k], out_part[k]});
  Zoltan_LB_Free_Part(&in_global, &in_local, &in_rank, &in_part);
  Zoltan_LB_Free_Part(&out_global, &out_local, &out_rank, &out_part);
  Zoltan_Destroy(&zoltan);

  std::vector<char> is_owned(p.size(), 0);
  for (const Owner& o : gather(shared)) is_owned[o.grain] = o.rank == rank_;
  p.set_ownership(std::move(is_owned), std::vector<char>(p.size(), 0));
  list_owners(p);
  if (sum(p.n_owned()) != p.size())
    throw NumericalError("sharing the grains out left some without an owner");
}

void Domain::list_owners(const Particles& p)
{
  std::vector<Index> mine;
  p.for_owned([&](Index i) { mine.push_back(i); });
  std::vector<std::size_t> counts = gather(std::vector<std::size_t>{mine.size()});
  const std::vector<Index> all = gather(mine);
  owned_by_.assign(static_cast<std::size_t>(n_ranks_), {});
  std::size_t first = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    owned_by_[r].assign(all.begin() + static_cast<std::ptrdiff_t>(first),
                        all.begin() + static_cast<std::ptrdiff_t>(first + counts[r]));
    first += counts[r];
  }
  neighbours_.clear();
}

void Domain::gather_motion(Particles& p)
{
  if (is_alone()) return;
  using Motion9 = std::array<double, n_motion>;
  std::vector<Motion9> mine(p.n_owned());
  std::size_t k = 0;
  p.for_owned([&](Index i) { pack(p.body[i], mine[k++].data()); });
  const std::vector<Motion9> all = gather(mine);
  k = 0;
  for (const std::vector<Index>& grains : owned_by_)
    for (const Index i : grains) unpack(all[k++].data(), p.body[i]);
}

void Domain::choose_ghosts(Particles& p, const std::vector<char>& is_needed)
{
  if (is_alone()) return;
  std::vector<char> is_owned(p.size(), 0), is_ghost(p.size(), 0);
  for (Index i = 0; i < p.size(); ++i) {
    is_owned[i] = p.owns(i);
    is_ghost[i] = !p.owns(i) && is_needed[i];
  }
  p.set_ownership(std::move(is_owned), is_ghost);

  // Everybody tells every owner what to send.
  const auto n = static_cast<std::size_t>(n_ranks_);
  std::vector<std::vector<Index>> wanted(n);
  for (std::size_t r = 0; r < n; ++r)
    for (const Index i : owned_by_[r])
      if (is_ghost[i]) wanted[r].push_back(i);
  std::vector<int> n_wanted(n), n_asked(n), at_wanted(n), at_asked(n);
  std::vector<Index> out;
  for (std::size_t r = 0; r < n; ++r) {
    n_wanted[r] = static_cast<int>(wanted[r].size());
    at_wanted[r] = static_cast<int>(out.size());
    out.insert(out.end(), wanted[r].begin(), wanted[r].end());
  }
  MPI_Alltoall(n_wanted.data(), 1, MPI_INT, n_asked.data(), 1, MPI_INT, comm_);
  std::exclusive_scan(n_asked.begin(), n_asked.end(), at_asked.begin(), 0);
  std::vector<Index> asked(static_cast<std::size_t>(at_asked.back() + n_asked.back()));
  MPI_Alltoallv(out.data(), n_wanted.data(), at_wanted.data(), MPI_UINT32_T, asked.data(),
                n_asked.data(), at_asked.data(), MPI_UINT32_T, comm_);

  neighbours_.clear();
  for (std::size_t r = 0; r < n; ++r) {
    if (n_wanted[r] == 0 && n_asked[r] == 0) continue;
    const auto first = asked.begin() + at_asked[r];
    Neighbour q{static_cast<int>(r), {first, first + n_asked[r]}, wanted[r], {}, {}};
    q.out.resize(n_motion * q.send.size());
    q.in.resize(n_motion * q.receive.size());
    neighbours_.push_back(std::move(q));
  }
}

void Domain::update_ghosts(Particles& p)
{
  if (neighbours_.empty()) return;
  std::vector<MPI_Request> requests;
  requests.reserve(2 * neighbours_.size());
  for (Neighbour& q : neighbours_)
    MPI_Irecv(q.in.data(), static_cast<int>(q.in.size()), MPI_DOUBLE, q.rank, ghost_tag,
              comm_, &requests.emplace_back());
  for (Neighbour& q : neighbours_) {
    for (std::size_t k = 0; k < q.send.size(); ++k)
      pack(p.body[q.send[k]], &q.out[n_motion * k]);
    MPI_Isend(q.out.data(), static_cast<int>(q.out.size()), MPI_DOUBLE, q.rank, ghost_tag,
              comm_, &requests.emplace_back());
    ++traffic_.messages;
    traffic_.bytes += sizeof(double) * q.out.size();
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (const Neighbour& q : neighbours_)
    for (std::size_t k = 0; k < q.receive.size(); ++k)
      unpack(&q.in[n_motion * k], p.body[q.receive[k]]);
}

double Domain::least(double value) const
{
  if (is_alone()) return value;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MIN, comm_);
  ++traffic_.reductions;
  return value;
}

double Domain::greatest(double value) const
{
  return -least(-value);
}

std::size_t Domain::sum(std::size_t count) const
{
  if (is_alone()) return count;
  std::uint64_t n = count;
  MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_UINT64_T, MPI_SUM, comm_);
  ++traffic_.reductions;
  return n;
}

void Domain::agree_on(const Fault& fault) const
{
  std::string words = fault.words();
  if (!is_alone()) {
    const auto first = static_cast<int>(least(fault.is_met() ? rank_ : n_ranks_));
    if (first == n_ranks_) return;
    std::uint64_t length = words.size();
    MPI_Bcast(&length, 1, MPI_UINT64_T, first, comm_);
    words.resize(length);
    MPI_Bcast(words.data(), static_cast<int>(length), MPI_CHAR, first, comm_);
  }
  if (!words.empty()) throw Unstable(words);
}

void Domain::gather_bytes(const void* mine, std::size_t n, std::size_t size,
                          const std::function<void*(std::size_t)>& room) const
{
  const auto n_ranks = static_cast<std::size_t>(n_ranks_);
  std::vector<int> counts(n_ranks), at(n_ranks);
  const int own = static_cast<int>(n);
  MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  std::exclusive_scan(counts.begin(), counts.end(), at.begin(), 0);
  MPI_Datatype record;
  MPI_Type_contiguous(static_cast<int>(size), MPI_BYTE, &record);
  MPI_Type_commit(&record);
  MPI_Allgatherv(mine, own, record,
                 room(static_cast<std::size_t>(at.back() + counts.back())), counts.data(),
                 at.data(), record, comm_);
  MPI_Type_free(&record);
}

namespace {

void add_wide(void* in, void* inout, int* n, MPI_Datatype*)
{
  // By copies: the buffers of MPI need not be aligned for 128 bits.
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

void ExactReduction::run(const Domain& domain)
{
  if (domain.is_alone() || terms_.empty()) return;
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
                domain.comm_);
  ++domain.traffic_.reductions;
  for (std::size_t k = 0; k < terms_.size(); ++k) *terms_[k] = values[k];
}

} // namespace mergel::dem

#include "dem/parallel/partition.h"

#include "dem/parallel/packed_motion.h"

#include <zoltan.h>

#include <algorithm>
#include <array>
#include <string>

namespace mergel::dem {

namespace {

/// The owned particles, as the query functions of Zoltan read them.
struct ZoltanObjects {
  std::vector<Index> particle;
  std::vector<std::array<double, 3>> x;
  std::vector<double> weight;
};

int count_objects(void* data, int* error)
{
  *error = ZOLTAN_OK;
  return static_cast<int>(static_cast<ZoltanObjects*>(data)->particle.size());
}

void list_objects(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int,
                  float* weight, int* error)
{
  const auto& o = *static_cast<ZoltanObjects*>(data);
  for (std::size_t k = 0; k < o.particle.size(); ++k) {
    global[k] = o.particle[k];
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
  const auto& at = static_cast<ZoltanObjects*>(data)->x[*local];
  std::copy(at.begin(), at.end(), x);
  *error = ZOLTAN_OK;
}

void check(int zoltan_code, const char* what)
{
  if (zoltan_code != ZOLTAN_OK && zoltan_code != ZOLTAN_WARN)
    throw NumericalError(std::string("distributing the particles failed in ") + what);
}

} // namespace

void Partition::assign(Particles& p, const std::vector<double>& weight,
                       const Communicator& comm)
{
  if (comm.is_alone()) return;
  if (p.size() < bisected_from * static_cast<std::size_t>(comm.n_ranks())) {
    assign_by_index(p, comm);
    return;
  }
  ZoltanObjects mine;
  p.for_owned([&](Index i) {
    mine.particle.push_back(i);
    const Vec3& x = p.state[i].x;
    mine.x.push_back({x.x(), x.y(), x.z()});
  });
  mine.weight = weight.empty() ? std::vector<double>(mine.particle.size(), 1.0) : weight;

  float version = 0.0F;
  check(Zoltan_Initialize(0, nullptr, &version), "Zoltan_Initialize");
  Zoltan_Struct* zoltan = Zoltan_Create(comm.mpi());
  const auto set = [zoltan](const char* name, const char* value) {
    check(Zoltan_Set_Param(zoltan, name, value), name);
  };
  set("DEBUG_LEVEL", "0"); // first, because the others print messages
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
    Index particle;
    int rank;
  };
  std::vector<Owner> shared;
  for (int k = 0; k < n_out; ++k) shared.push_back({out_global[k], out_part[k]});
  Zoltan_LB_Free_Part(&in_global, &in_local, &in_rank, &in_part);
  Zoltan_LB_Free_Part(&out_global, &out_local, &out_rank, &out_part);
  Zoltan_Destroy(&zoltan);

  std::vector<char> is_owned(p.size(), 0);
  for (const Owner& o : comm.gather(shared)) is_owned[o.particle] = o.rank == comm.rank();
  p.set_ownership(std::move(is_owned), std::vector<char>(p.size(), 0));
  list_owners(p, comm);
  if (comm.global_sum(p.n_owned()) != p.size())
    throw NumericalError("distributing the particles left some without an owner");
}

void Partition::assign_by_index(Particles& p, const Communicator& comm)
{
  if (comm.is_alone()) return;
  const auto rank = static_cast<std::size_t>(comm.rank()),
             n = static_cast<std::size_t>(comm.n_ranks());
  std::vector<char> is_owned(p.size(), 0);
  std::fill(is_owned.begin() + static_cast<std::ptrdiff_t>(p.size() * rank / n),
            is_owned.begin() + static_cast<std::ptrdiff_t>(p.size() * (rank + 1) / n), 1);
  p.set_ownership(std::move(is_owned), std::vector<char>(p.size(), 0));
  list_owners(p, comm);
}

void Partition::list_owners(const Particles& p, const Communicator& comm)
{
  std::vector<Index> mine;
  p.for_owned([&](Index i) { mine.push_back(i); });
  std::vector<std::size_t> counts = comm.gather(std::vector<std::size_t>{mine.size()});
  const std::vector<Index> all = comm.gather(mine);
  owned_by_.assign(static_cast<std::size_t>(comm.n_ranks()), {});
  std::size_t first = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    owned_by_[r].assign(all.begin() + static_cast<std::ptrdiff_t>(first),
                        all.begin() + static_cast<std::ptrdiff_t>(first + counts[r]));
    first += counts[r];
  }
}

std::vector<int> Partition::owners() const
{
  std::size_t n = 0;
  for (const std::vector<Index>& particles : owned_by_) n += particles.size();
  std::vector<int> owner(n);
  for (std::size_t r = 0; r < owned_by_.size(); ++r)
    for (const Index i : owned_by_[r]) owner[i] = static_cast<int>(r);
  return owner;
}

void Partition::gather_motion(Particles& p, const Communicator& comm) const
{
  if (comm.is_alone()) return;
  std::vector<PackedMotion> mine(p.n_owned());
  std::size_t k = 0;
  p.for_owned([&](Index i) { mine[k++] = pack(p.state[i]); });
  const std::vector<PackedMotion> all = comm.gather(mine);
  k = 0;
  for (const std::vector<Index>& particles : owned_by_)
    for (const Index i : particles) unpack(all[k++], p.state[i]);
}

} // namespace mergel::dem

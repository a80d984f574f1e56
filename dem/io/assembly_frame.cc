#include "dem/io/assembly_frame.h"

#include "dem/assembly/neighbourhood.h"
#include "dem/continuum/particle_stress.h"
#include "dem/io/continuum_fields.h"
#include "dem/parallel/rows.h"

#include <algorithm>

namespace mergel::dem {

FrameFiles::FrameFiles(AssemblyFrame frame)
    : assembly_(frame.assembly), bonds_on_(std::min(1, assembly_.comm.n_ranks() - 1)),
      contacts_on_(std::min(2, assembly_.comm.n_ranks() - 1)),
      particles_(particle_fields(assembly_, frame.x_0)),
      bonds_(gather_bonds(assembly_, bonds_on_)),
      contacts_(gather_loads(assembly_, frame.branches, contacts_on_))
{
  const Particles& p = assembly_.particles;
  const std::vector<Pair> pairs = held_neighbours(p, assembly_.cell);
  particles_.push_back(
      tensor_field("stress [Pa]", neighbourhood_stresses(assembly_, frame.branches,
                                                         frame.porosity, pairs)));
  std::vector<Mat3> rates = velocity_gradients(p, assembly_.cell, pairs);
  for (Mat3& L : rates) L = (0.5 * (L + L.transpose())).eval();
  particles_.push_back(tensor_field("strain rate [1/s]", rates));
  particles_.push_back({"coordination [-]", 1, coordination(p, frame.branches)});
  for (Field& field : frame.more) particles_.push_back(std::move(field));
  for (Field& field : particles_)
    field.values = gather_rows(assembly_.comm, assembly_.partition, std::move(field.values),
                               0, static_cast<std::size_t>(field.components));
}

void FrameFiles::write(const AssemblyFiles& files) const
{
  const Particles& p = assembly_.particles;
  const int rank = assembly_.comm.rank();
  if (rank == 0) {
    std::vector<Vec3> x;
    for (const ParticleState& b : p.state) x.push_back(b.x);
    write_points(files.particles, x, particles_);
  }
  if (rank == bonds_on_) write_bonds(files.bonds, p, assembly_.cell, bonds_);
  if (rank == contacts_on_) write_contacts(files.contacts, p, contacts_);
}

} // namespace mergel::dem

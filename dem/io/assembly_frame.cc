#include "dem/io/assembly_frame.h"

#include "dem/continuum/particle_stress.h"
#include "dem/io/continuum_fields.h"
#include "dem/parallel/rows.h"

#include <algorithm>

namespace mergel::dem {

namespace {

std::vector<Mat3> strain_rates(const Assembly& assembly)
{
  std::vector<Mat3> D = velocity_gradients(assembly.particles, assembly.cell);
  for (Mat3& L : D) L = (0.5 * (L + L.transpose())).eval();
  return D;
}

} // namespace

FrameFiles::FrameFiles(AssemblyFrame frame)
    : assembly_(frame.assembly), bonds_on_(std::min(1, assembly_.comm.n_ranks() - 1)),
      contacts_on_(std::min(2, assembly_.comm.n_ranks() - 1)),
      particles_(particle_fields(assembly_, frame.x_0)),
      bonds_(gather_bonds(assembly_, bonds_on_)),
      contacts_(gather_loads(assembly_, frame.branches, contacts_on_))
{
  particles_.push_back(tensor_field(
      "stress [Pa]", neighbourhood_stresses(assembly_, frame.branches, frame.porosity)));
  particles_.push_back(tensor_field("strain rate [1/s]", strain_rates(assembly_)));
  particles_.push_back(
      {"coordination [-]", 1, coordination(assembly_.particles, frame.branches)});
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

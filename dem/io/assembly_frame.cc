#include "dem/io/assembly_frame.h"

#include "dem/continuum/particle_stress.h"
#include "dem/io/assembly_fields.h"
#include "dem/io/continuum_fields.h"

#include <algorithm>
#include <iterator>

namespace mergel::dem {

namespace {

std::vector<Mat3> strain_rates(const Assembly& assembly)
{
  std::vector<Vec3> x, v;
  std::vector<double> R;
  for (const ParticleState& b : assembly.particles.state) {
    x.push_back(b.x);
    v.push_back(b.v);
    R.push_back(b.R);
  }
  std::vector<Mat3> D;
  for (const Mat3& L : velocity_gradients(x, v, R, assembly.cell))
    D.push_back(0.5 * (L + L.transpose()));
  return D;
}

} // namespace

void write_frame(const AssemblyFiles& files, const AssemblyFrame& frame)
{
  const Assembly& assembly = frame.assembly;
  const Particles& p = assembly.particles;
  std::vector<Field> fields{
      tensor_field("stress [Pa]", neighbourhood_stresses(p, frame.branches, frame.porosity,
                                                         assembly.cell)),
      tensor_field("strain rate [1/s]", strain_rates(assembly)),
      {"coordination [-]", 1, coordination(p, frame.branches)}};
  std::copy(frame.more.begin(), frame.more.end(), std::back_inserter(fields));
  write_particles(files.particles, assembly, frame.x_0, fields);
  write_bonds(files.bonds, assembly);
  write_contacts(files.contacts, p, frame.branches);
}

} // namespace mergel::dem

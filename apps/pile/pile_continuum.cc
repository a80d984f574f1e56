#include "apps/pile/pile_continuum.h"

#include "dem/io/assembly_fields.h"
#include "dem/io/continuum_fields.h"

#include <cmath>

namespace mergel::apps {

namespace {

std::vector<dem::DeformationFit> fits_since_last(const FrameInput& frame)
{
  return dem::local_deformations(frame.x_last, frame.assembly.particles);
}

dem::ParticleValues values_of(const FrameInput& frame,
                              const std::vector<dem::LoadedBranch>& branches,
                              const std::vector<dem::DeformationFit>& fits)
{
  const dem::Particles& p = frame.assembly.particles;
  dem::ParticleValues v;
  p.for_owned([&](dem::Index i) {
    v.displacement.push_back(p.state[i].x - frame.x_0[i]);
    v.increment.push_back(p.state[i].x - frame.x_last[i]);
  });
  for (const dem::DeformationFit& fit : fits) {
    v.volumetric.push_back(dem::volumetric_strain(fit.F));
    v.shear.push_back(dem::shear_strain(fit.F));
  }
  v.damage = dem::particle_damage(frame.assembly);
  v.coordination = dem::coordination(p, branches);
  return v;
}

dem::SectionSums sums_of(const ContinuumSpec& spec, const FrameInput& frame,
                         const std::vector<dem::LoadedBranch>& branches,
                         const dem::ParticleValues& values)
{
  const double h = spec.averaging_length / (2 * PileContinuum::reach + 1);
  const auto grid = dem::make_section_grid(spec.radius, spec.depth, spec.above, h);
  return {grid, frame.assembly.particles, branches, values,
          &frame.assembly.rigid_walls.front()};
}

} // namespace

PileContinuum::PileContinuum(const ContinuumSpec& spec, const FrameInput& frame)
    : frame_(frame), spec_(spec), branches_(dem::loaded_branches(frame.assembly)),
      fits_(fits_since_last(frame)), values_(values_of(frame, branches_, fits_)),
      sums_(sums_of(spec, frame, branches_, values_))
{
}

std::vector<double> PileContinuum::porosity() const
{
  const dem::SectionGrid& grid = sums_.grid();
  std::vector<double> porosity;
  const dem::Particles& p = frame_.assembly.particles;
  p.for_owned([&](dem::Index i) {
    const dem::Vec3& x = p.state[i].x;
    const std::ptrdiff_t at = grid.cell_at({x.x(), std::abs(x.y()), x.z()});
    double n = 1.0 - dem::smallest_solid; // of debris outside of the grid
    if (at >= 0) {
      const auto columns = static_cast<std::ptrdiff_t>(grid.n_columns());
      const auto window = sums_.window(static_cast<int>(at % columns),
                                       static_cast<int>(at / columns), reach);
      if (dem::SectionSums::is_filled(window))
        n = std::max(0.0, dem::SectionSums::average(window).porosity);
    }
    porosity.push_back(n);
  });
  return porosity;
}

std::vector<dem::Field> PileContinuum::particle_fields() const
{
  dem::Field layer{"layer [-]", 1, {}};
  frame_.assembly.particles.for_owned([&](dem::Index i) {
    layer.values.push_back(std::floor(-frame_.x_0[i].z() / spec_.layer));
  });
  std::vector<dem::Field> fields{
      dem::vector_field("displacement increment [m]", values_.increment)};
  for (dem::Field& field : dem::strain_fields(fits_)) {
    field.name.insert(field.name.find(" ["), " of the increment");
    fields.push_back(std::move(field));
  }
  fields.push_back(std::move(layer));
  return fields;
}

void PileContinuum::write_section(const std::filesystem::path& file) const
{
  dem::write_section(file, sums_, reach);
}

} // namespace mergel::apps

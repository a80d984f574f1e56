#include "dem/io/continuum_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mergel::dem {

namespace {

void append_tensor(std::vector<double>& to, const Mat3& a)
{
  to.insert(to.end(), {a(0, 0), a(1, 1), a(2, 2), a(0, 1), a(1, 2), a(0, 2)});
}

void append_vector(std::vector<double>& to, const Vec3& a)
{
  to.insert(to.end(), {a.x(), a.y(), a.z()});
}

/// The fields of a section, filled point by point.
struct SectionFields {
  Field stress{"stress [Pa]", 6, {}};
  Field p{"p [Pa]", 1, {}}, q{"q [Pa]", 1, {}};
  Field major{"major principal stress [Pa]", 1, {}},
      intermediate{"intermediate principal stress [Pa]", 1, {}},
      minor{"minor principal stress [Pa]", 1, {}};
  Field direction{"major principal direction [-]", 3, {}};
  Field porosity{"porosity [-]", 1, {}}, damage{"damage [-]", 1, {}},
      coordination{"coordination [-]", 1, {}};
  Field displacement{"displacement [m]", 3, {}},
      increment{"displacement increment [m]", 3, {}};
  Field volumetric{"volumetric strain of the increment [-]", 1, {}},
      shear{"shear strain of the increment [-]", 1, {}};

  void add(const SectionAverage& a)
  {
    const PrincipalStress s = a.principal();
    append_tensor(stress.values, a.stress);
    append_vector(direction.values, s.direction);
    append_vector(displacement.values, a.displacement);
    append_vector(increment.values, a.increment);
    p.values.push_back(a.p());
    q.values.push_back(a.q());
    major.values.push_back(s.major);
    intermediate.values.push_back(s.intermediate);
    minor.values.push_back(s.minor);
    porosity.values.push_back(a.porosity);
    damage.values.push_back(a.damage);
    coordination.values.push_back(a.coordination);
    volumetric.values.push_back(a.volumetric);
    shear.values.push_back(a.shear);
  }
  void add_nothing()
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (Field* f : all())
      f->values.insert(f->values.end(), static_cast<std::size_t>(f->components), none);
  }
  std::vector<Field> list()
  {
    std::vector<Field> fields;
    for (Field* f : all()) fields.push_back(std::move(*f));
    return fields;
  }

private:
  std::vector<Field*> all()
  {
    return {&stress,       &p,         &q,          &major,  &intermediate,
            &minor,        &direction, &porosity,   &damage, &coordination,
            &displacement, &increment, &volumetric, &shear};
  }
};

} // namespace

void write_section(const std::filesystem::path& file, const SectionSums& sums, int reach)
{
  const SectionGrid& grid = sums.grid();
  SectionFields fields;
  for (int row = 0; row < grid.n_z; ++row)
    for (int column = 0; column < grid.n_columns(); ++column)
      if (const auto window = sums.filled_window(column, row, reach))
        fields.add(SectionSums::average(*window));
      else
        fields.add_nothing();
  PointGrid points;
  points.origin = {grid.r_middle(0), 0.0, grid.z_middle(0)};
  points.h = grid.h;
  points.n = {grid.n_columns(), 1, grid.n_z};
  write_grid(file, points, fields.list());
}

Field tensor_field(const std::string& name, const std::vector<Mat3>& tensors)
{
  Field field{name, 6, {}};
  for (const Mat3& a : tensors) append_tensor(field.values, a);
  return field;
}

Field vector_field(const std::string& name, const std::vector<Vec3>& vectors)
{
  Field field{name, 3, {}};
  for (const Vec3& a : vectors) append_vector(field.values, a);
  return field;
}

void write_contacts(const std::filesystem::path& file, const Particles& p,
                    const std::vector<LoadedBranch>& branches)
{
  std::vector<Vec3> x;
  for (const ParticleState& b : p.state) x.push_back(b.x);
  std::vector<std::array<Index, 2>> lines;
  Field normal{"normal force [N]", 1, {}}, shear{"shear force [N]", 1, {}};
  for (const LoadedBranch& b : branches) {
    if (b.F == Vec3::Zero()) continue;
    Index end = b.j;
    if (b.end != BranchEnd::particle || b.shift != Shift{}) {
      end = static_cast<Index>(x.size());
      x.push_back(p.state[b.i].x + b.r);
    }
    lines.push_back({b.i, end});
    const double f_n = b.normal_force();
    normal.values.push_back(f_n);
    shear.values.push_back(std::sqrt(std::max(0.0, b.F.squaredNorm() - f_n * f_n)));
  }
  write_lines(file, x, lines, {normal, shear});
}

} // namespace mergel::dem

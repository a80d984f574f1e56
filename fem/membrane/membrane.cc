#include "fem/membrane/membrane.h"

#include "fem/mesh_library.h"
#include "fem/node_lanes.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace mergel::fem {

void MembraneMaterial::check() const
{
  const auto positive = [](const char* what, double value) {
    if (!(value > 0.0 && std::isfinite(value)))
      throw std::invalid_argument(std::string("membrane: ") + what + " = " +
                                  std::to_string(value) + ": must be > 0");
  };
  positive("Young's modulus [Pa]", E);
  positive("thickness [m]", thickness);
  positive("density [kg/m^3]", rho);
}

namespace {

std::size_t uz(int k)
{
  return static_cast<std::size_t>(k);
}

Vector<double> vector(const Vec3& a)
{
  return {a.x(), a.y(), a.z()};
}
Vec3 vec3(const Vector<double>& a)
{
  return {a.x, a.y, a.z};
}

} // namespace

Membrane::Membrane(SurfaceMesh rest, const MembraneMaterial& material, MPI_Comm comm)
    : rest_(std::move(rest)), material_(material), shares_(n_nodes(), comm),
      first_corner_(shares_.first()), end_corner_(shares_.end())
{
  material_.check();
  std::map<std::pair<int, int>, std::size_t> seen;
  for (std::size_t t = 0; t < rest_.triangles.size(); ++t) {
    const SurfaceTriangle& k = rest_.triangles[t];
    elements_.push_back(rest_triangle(rest_.x[uz(k[1])] - rest_.x[uz(k[0])],
                                      rest_.x[uz(k[2])] - rest_.x[uz(k[0])],
                                      material_.thickness));
    for (std::size_t e = 0; e < 3; ++e) {
      const auto edge = std::minmax(k[e], k[(e + 1) % 3]);
      const auto [entry, is_new] = seen.try_emplace({edge.first, edge.second}, t);
      if (!is_new) edges_.push_back({entry->second, t});
    }
  }

  // All triangles of its nodes, ascending: each node adds its triangles in the same order
  // whoever computes it.
  std::size_t lane = n_lanes;
  for (std::size_t t = 0; t < elements_.size(); ++t) {
    const SurfaceTriangle& k = rest_.triangles[t];
    if (std::none_of(k.begin(), k.end(), [&](int a) { return shares_.has(a); })) continue;
    for (const int a : k) {
      first_corner_ = std::min<Eigen::Index>(first_corner_, a);
      end_corner_ = std::max<Eigen::Index>(end_corner_, a + 1);
    }
    if (lane == n_lanes) {
      batches_.emplace_back();
      corners_.emplace_back();
      lane = 0;
    }
    RestTriangle<Lanes>& to = batches_.back();
    to.i11[lane] = elements_[t].i11;
    to.i12[lane] = elements_[t].i12;
    to.i22[lane] = elements_[t].i22;
    to.volume[lane] = elements_[t].volume;
    for (std::size_t c = 0; c < 3; ++c)
      corners_.back()[3 * lane + c] = static_cast<std::uint32_t>(k[c]);
    ++lane;
    ++n_mine_;
  }
  for (; lane < n_lanes && lane > 0;
       ++lane) { // padding: the first triangle of the batch again
    RestTriangle<Lanes>& to = batches_.back();
    to.i11[lane] = to.i11[0];
    to.i12[lane] = to.i12[0];
    to.i22[lane] = to.i22[0];
    to.volume[lane] = to.volume[0];
    for (std::size_t c = 0; c < 3; ++c) corners_.back()[3 * lane + c] = corners_.back()[c];
  }
}

NodalField Membrane::rest_positions() const
{
  NodalField x = NodalField::Zero(4, n_nodes());
  for (Eigen::Index a = 0; a < n_nodes(); ++a)
    x.col(a).head<3>() = rest_.x[static_cast<std::size_t>(a)].array();
  return x;
}

Eigen::ArrayXd Membrane::masses() const
{
  Eigen::ArrayXd m = Eigen::ArrayXd::Zero(n_nodes());
  for (std::size_t t = 0; t < elements_.size(); ++t)
    for (const int k : rest_.triangles[t])
      m[k] += material_.rho * elements_[t].volume / 3.0;
  return m;
}

void Membrane::forces(const NodalField& x, double pressure, NodalField& f) const
{
  f.resize(4, n_nodes());
  f.middleCols(first_corner_, end_corner_ - first_corner_).setZero();
  for (std::size_t k = 0; k < batches_.size(); ++k) {
    const auto& corner = corners_[k];
    Vector<Lanes> a, b;
    for (std::size_t l = 0; l < n_lanes; ++l) {
      const NodeLanes x1 = load(x, corner[3 * l]), to_2 = load(x, corner[3 * l + 1]) - x1,
                      to_3 = load(x, corner[3 * l + 2]) - x1;
      a.x[l] = to_2[0];
      a.y[l] = to_2[1];
      a.z[l] = to_2[2];
      b.x[l] = to_3[0];
      b.y[l] = to_3[1];
      b.z[l] = to_3[2];
    }
    const CornerForces<Lanes> on =
        corner_forces(batches_[k], material_.mu(), material_.compression, pressure, a, b);
    const std::size_t n =
        std::min<std::size_t>(n_lanes, n_mine_ - k * static_cast<std::size_t>(n_lanes));
    for (std::size_t l = 0; l < n; ++l)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto node = corner[3 * l + c];
        const NodeLanes force{on.at[c].x[l], on.at[c].y[l], on.at[c].z[l], 0.0};
        store(f, node, load(f, node) + force);
      }
  }
}

MembraneStrain<double> Membrane::strain(std::size_t t, const NodalField& x) const
{
  const SurfaceTriangle& k = rest_.triangles[t];
  return {elements_[t], vector(at(x, k[1]) - at(x, k[0])),
          vector(at(x, k[2]) - at(x, k[0]))};
}

double Membrane::strain_energy(const NodalField& x) const
{
  double sum = 0.0;
  for (std::size_t t = 0; t < elements_.size(); ++t)
    sum +=
        elements_[t].volume * strain(t, x).stress(material_.mu(), material_.compression).W;
  return sum;
}

MembraneFields Membrane::fields(const NodalField& x) const
{
  MembraneFields all;
  for (std::size_t t = 0; t < elements_.size(); ++t) {
    const auto s = strain(t, x).stretch(material_.compression);
    // Cauchy stress of the incompressible sheet: sigma_i = mu (l_i^2 - 1/(l1 l2)^2).
    const double l1_2 = s.l1 * s.l1, l2_2 = s.l2 * s.l2, mu = material_.mu();
    const double l3_2 = s.is_taut ? 1.0 / (l1_2 * l2_2) : 1.0 / s.l1;
    all.stretch_1.push_back(s.l1);
    all.stretch_2.push_back(s.l2);
    const bool is_slack = !s.is_taut && s.is_slack;
    all.stress_1.push_back(is_slack ? 0.0 : mu * (l1_2 - l3_2));
    all.stress_2.push_back(s.is_taut ? mu * (l2_2 - l3_2) : 0.0);
    all.state.push_back(s.is_taut ? 2.0 : is_slack ? 0.0 : 1.0);
    all.n_slack += is_slack;
    all.n_wrinkled += !s.is_taut && !is_slack;
  }
  return all;
}

MembraneTensions Membrane::tensions(const NodalField& x) const
{
  MembraneTensions sum;
  for (std::size_t t = 0; t < elements_.size(); ++t) {
    const SurfaceTriangle& k = rest_.triangles[t];
    const MembraneStrain<double> e = strain(t, x);
    const MembraneStress<double> s = e.stress(material_.mu(), material_.compression);
    const Vec3 F1 = vec3(e.F1), F2 = vec3(e.F2),
               c = (at(x, k[0]) + at(x, k[1]) + at(x, k[2])) / 3.0;
    const Mat3 tau = s.S11 * F1 * F1.transpose() + s.S22 * F2 * F2.transpose() +
                     s.S12 * (F1 * F2.transpose() + F2 * F1.transpose());
    const Vec3 around = Vec3(-c.y(), c.x(), 0.0).normalized();
    sum.axial += elements_[t].volume * tau(2, 2);
    sum.hoop += elements_[t].volume * around.dot(tau * around);
  }
  return sum;
}

EnclosedVolume Membrane::enclosed(const NodalField& x, const Tube& tube) const
{
  EnclosedVolume all;
  double six = 0.0;
  for (const SurfaceTriangle& k : rest_.triangles)
    six -= at(x, k[0]).dot(at(x, k[1]).cross(at(x, k[2]))); // normals inwards
  for (int end = 0; end < 2; ++end) {
    const int row = end == 0 ? 0 : tube.n_high;
    Vec3 &area = all.area[end], &centre = all.centre[end];
    for (int i = 0; i < tube.n_around; ++i) centre += at(x, tube.node(i, row));
    centre /= tube.n_around;
    for (int i = 0; i < tube.n_around; ++i) {
      const Vec3 a = at(x, tube.node(i, row)), b = at(x, tube.node(i + 1, row));
      const Vec3 cross = end == 0 ? Vec3(b.cross(a)) : Vec3(a.cross(b));
      six += centre.dot(cross);
      const Vec3 from_a = a - centre, from_b = b - centre;
      area += 0.5 * (end == 0 ? Vec3(from_b.cross(from_a)) : Vec3(from_a.cross(from_b)));
    }
  }
  all.V = six / 6.0;
  return all;
}

std::size_t Membrane::n_folds(const NodalField& x) const
{
  const auto area = [&](std::size_t t) {
    const SurfaceTriangle& k = rest_.triangles[t];
    return Vec3((at(x, k[1]) - at(x, k[0])).cross(at(x, k[2]) - at(x, k[0])));
  };
  return static_cast<std::size_t>(
      std::count_if(edges_.begin(), edges_.end(),
                    [&](const auto& e) { return area(e[0]).dot(area(e[1])) < 0.0; }));
}

Eigen::ArrayXd Membrane::stiffness_bound(const NodalField& x) const
{
  Eigen::ArrayXd k = Eigen::ArrayXd::Zero(n_nodes());
  for (std::size_t t = 0; t < elements_.size(); ++t) {
    const RestTriangle<double>& e = elements_[t];
    double bound = 6.0;
    if (material_.compression == Compression::carried) {
      const double l = strain(t, x).stretch(material_.compression).l2;
      bound = 1.0 + 5.0 * std::pow(std::min(l, 1.0), -6.0);
    }
    // Gradients of the shape functions of the corners, in the axes of the plane at rest.
    const Eigen::Vector2d g2(e.i11, e.i12), g3(0.0, e.i22), g1 = -g2 - g3;
    const double size[3] = {g1.norm(), g2.norm(), g3.norm()};
    const double sum = size[0] + size[1] + size[2];
    for (std::size_t c = 0; c < 3; ++c)
      k[rest_.triangles[t][c]] += bound * material_.mu() * e.volume * size[c] * sum;
  }
  return k;
}

Membrane make_membrane(const Tube& tube, const MembraneMaterial& material, MPI_Comm comm)
{
  return Membrane(mesh_library().tube_surface(tube), material, comm);
}

} // namespace mergel::fem

#include "fem/dealii/far_field_mesh.h"

#include "fem/boundary_ids.h"
#include "fem/nodal.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace mergel::fem {
namespace {

using std::numbers::pi;
using Point2 = Eigen::Vector2d;

/// Nodes 0 = s_0 < ... < s_n = 1 of a row of n cells, each `growth` times the size before.
std::vector<double> graded(int n, double growth)
{
  std::vector<double> s(static_cast<std::size_t>(n) + 1, 0.0);
  double cell = 1.0;
  for (std::size_t k = 1; k < s.size(); ++k, cell *= growth) s[k] = s[k - 1] + cell;
  const double length = s.back();
  for (double& t : s) t /= length;
  return s;
}

/// The plan: nodes, quadrilaterals (counter-clockwise), and which of them lie under the DEM
/// region.
struct Plan {
  struct Quad {
    std::array<int, 4> node;
    bool is_under_region;
  };
  std::vector<Point2> x;
  std::vector<Quad> quads;
};

/// Direction of radial line i, mirror symmetric to the last bit.
Point2 direction(int i, int n_around)
{
  if (2 * i > n_around) {
    const Point2 mirrored = direction(n_around - i, n_around);
    return {-mirrored.x(), mirrored.y()};
  }
  if (i == 0) return {1.0, 0.0};
  if (2 * i == n_around) return {0.0, 1.0};
  const double theta = pi * i / n_around;
  return {std::cos(theta), std::sin(theta)};
}

Plan make_plan(const FarFieldGeometry& g, const FarFieldLayers& n)
{
  Plan plan;
  const int m = n.n_around / 4; // the core has 2m x m cells

  // Half width of the core over R_d. Its rim is half way between the rectangle |x|, y <=
  // core and the circle that touches its sides, so that neither the cells at its corners
  // nor those beside them are too flat.
  constexpr double core = 0.6;
  const auto core_node = [&](int i, int j) -> Point2 { // i = -m..m, j = 0..m
    const Point2 square(static_cast<double>(i) / m, static_cast<double>(j) / m);
    const double side = square.cwiseAbs().maxCoeff(); // 0 at the origin, 1 on the rim
    if (side == 0.0) return {0.0, 0.0};
    // Angle of the rim point: each eighth of the circle maps to half a side of the square.
    const double rim = square.y() < std::abs(square.x())
                           ? square.y() / side * pi / 4.0
                           : pi / 2.0 - std::abs(square.x()) / side * pi / 4.0;
    const Point2 on_circle(std::copysign(side * std::cos(rim), square.x()),
                           side * std::sin(rim));
    const double roundness = 0.5 * side;
    Point2 x = core * ((1.0 - roundness) * square + roundness * on_circle);
    if (i == 0) x.x() = 0.0;
    if (j == 0) x.y() = 0.0;
    return g.region_radius * x;
  };
  const auto core_index = [&](int i, int j) { return (i + m) + (2 * m + 1) * j; };
  for (int j = 0; j <= m; ++j)
    for (int i = -m; i <= m; ++i) plan.x.push_back(core_node(i, j));
  for (int j = 0; j < m; ++j)
    for (int i = -m; i < m; ++i)
      plan.quads.push_back({{core_index(i, j), core_index(i + 1, j),
                             core_index(i + 1, j + 1), core_index(i, j + 1)},
                            true});

  // Rings. The innermost line of nodes is the rim of the core, from (+, 0) over (0, +) to
  // (-, 0).
  std::vector<int> inner;
  for (int j = 0; j < m; ++j) inner.push_back(core_index(m, j));
  for (int i = m; i > -m; --i) inner.push_back(core_index(i, m));
  for (int j = m; j >= 0; --j) inner.push_back(core_index(-m, j));
  const std::vector<int> rim = inner;

  const std::vector<double> outside = graded(n.n_radial, g.growth);
  for (int ring = 1; ring <= n.n_ring + n.n_radial; ++ring) {
    std::vector<int> line;
    for (int i = 0; i <= n.n_around; ++i) {
      line.push_back(static_cast<int>(plan.x.size()));
      const Point2 e = direction(i, n.n_around);
      if (ring < n.n_ring) {
        const double s = static_cast<double>(ring) / n.n_ring;
        plan.x.push_back((1.0 - s) * plan.x[static_cast<std::size_t>(rim[i])] +
                         s * g.region_radius * e);
      } else {
        const double s = outside[static_cast<std::size_t>(ring - n.n_ring)];
        plan.x.push_back(((1.0 - s) * g.region_radius + s * g.chamber_radius) * e);
      }
    }
    for (int i = 0; i < n.n_around; ++i)
      plan.quads.push_back(
          {{inner[i], line[i], line[i + 1], inner[i + 1]}, ring <= n.n_ring});
    inner = line;
  }
  return plan;
}

/// The plan and its mirror image behind y = 0, where both have the same nodes.
Plan with_mirror_image(Plan plan)
{
  const std::size_t n = plan.x.size(), n_quads = plan.quads.size();
  std::vector<int> image(n);
  for (std::size_t a = 0; a < n; ++a) {
    const Point2 x = plan.x[a];
    image[a] = static_cast<int>(x.y() == 0.0 ? a : plan.x.size());
    if (x.y() != 0.0) plan.x.emplace_back(x.x(), -x.y());
  }
  for (std::size_t q = 0; q < n_quads; ++q) {
    Plan::Quad mirrored = plan.quads[q];
    std::reverse(mirrored.node.begin(), mirrored.node.end()); // counter-clockwise again
    for (int& a : mirrored.node) a = image[static_cast<std::size_t>(a)];
    plan.quads.push_back(mirrored);
  }
  return plan;
}

/// Heights of the node layers, from z = 0 down to -H_c.
std::vector<double> heights(const FarFieldGeometry& g, const FarFieldLayers& n)
{
  std::vector<double> z;
  for (int k = 0; k <= n.n_upper; ++k) z.push_back(-g.region_height * k / n.n_upper);
  const std::vector<double> below = graded(n.n_lower, g.growth);
  for (std::size_t k = 1; k < below.size(); ++k)
    z.push_back(-(1.0 - below[k]) * g.region_height - below[k] * g.chamber_height);
  return z;
}

void set_boundary_ids(const FarFieldGeometry& g, dealii::Triangulation<3>& mesh)
{
  const double close = coincidence * g.chamber_height;
  using Condition = std::function<bool(const dealii::Point<3>&)>;
  const auto radius = [](const dealii::Point<3>& x) { return std::hypot(x[0], x[1]); };
  const std::array<std::pair<int, Condition>, 6> sides = {{
      {boundary::top, [&](const auto& x) { return std::abs(x[2]) < close; }},
      {boundary::bottom,
       [&](const auto& x) { return std::abs(x[2] + g.chamber_height) < close; }},
      {boundary::symmetry, [&](const auto& x) { return std::abs(x[1]) < close; }},
      {boundary::outer,
       [&](const auto& x) { return radius(x) > g.chamber_radius - close; }},
      {boundary::interface_bottom,
       [&](const auto& x) { return std::abs(x[2] + g.region_height) < close; }},
      {boundary::interface_side,
       [&](const auto& x) { return std::abs(radius(x) - g.region_radius) < close; }},
  }};
  for (const auto& cell : mesh.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      if (!face->at_boundary()) continue;
      const auto side = std::find_if(sides.begin(), sides.end(), [&](const auto& s) {
        for (const unsigned int v : face->vertex_indices())
          if (!s.second(face->vertex(v))) return false;
        return true;
      });
      AssertThrow(side != sides.end(), dealii::ExcInternalError());
      face->set_boundary_id(static_cast<dealii::types::boundary_id>(side->first));
    }
}

} // namespace

void make_far_field_mesh(const FarFieldGeometry& g, const FarFieldLayers& n,
                         dealii::Triangulation<3>& mesh)
{
  Plan plan = make_plan(g, n);
  if (g.extent == Extent::full) plan = with_mirror_image(std::move(plan));
  const std::vector<double> z = heights(g, n);

  // A node of the plan has vertices in all layers; inside r = R_d only below the region.
  const auto n_plan = plan.x.size();
  std::vector<bool> is_above(n_plan, false);
  for (const auto& quad : plan.quads)
    if (!quad.is_under_region)
      for (const int a : quad.node) is_above[static_cast<std::size_t>(a)] = true;

  constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
  std::vector<dealii::Point<3>> vertices;
  std::vector<std::vector<unsigned int>> vertex(z.size(),
                                                std::vector<unsigned int>(n_plan, none));
  for (std::size_t k = 0; k < z.size(); ++k)
    for (std::size_t a = 0; a < n_plan; ++a)
      if (is_above[a] || k >= static_cast<std::size_t>(n.n_upper)) {
        vertex[k][a] = static_cast<unsigned int>(vertices.size());
        vertices.emplace_back(plan.x[a].x(), plan.x[a].y(), z[k]);
      }

  std::vector<dealii::CellData<3>> cells;
  for (std::size_t k = 0; k + 1 < z.size(); ++k)
    for (const auto& quad : plan.quads) {
      if (quad.is_under_region && k < static_cast<std::size_t>(n.n_upper)) continue;
      dealii::CellData<3> cell;
      constexpr std::array<int, 4> lexicographic = {0, 1, 3, 2};
      for (std::size_t c = 0; c < 4; ++c) {
        const auto a = static_cast<std::size_t>(quad.node[lexicographic[c]]);
        cell.vertices[c] = vertex[k + 1][a]; // lower
        cell.vertices[c + 4] = vertex[k][a]; // upper
      }
      cells.push_back(cell);
    }
  mesh.create_triangulation(vertices, cells, dealii::SubCellData());
  set_boundary_ids(g, mesh);
}

} // namespace mergel::fem

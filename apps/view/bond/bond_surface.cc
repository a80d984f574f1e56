#include "apps/view/bond/bond_surface.h"

#include "apps/view/curve.h"
#include "apps/view/label.h"
#include "dem/notation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace mergel::apps {

namespace {

using Loads = std::array<double, 3>; // N [N], V [N], M [N m]

constexpr std::array<double, 4> shown_damage{0.25, 0.5, 0.75, 0.9};
const Stroke intact_surface{ink, 3.0, {}};
const Stroke shrunken_surface{{0.5, 0.5, 0.5}, 2.0, {}};

/// The state of a path when its damage reaches D.
struct Moment {
  double D = 0.0;
  Loads effective{};    ///< the loads over 1 - D
  bool is_yield = true; ///< the bond yields: the effective loads lie on the intact surface

  double load(Load l) const { return (1.0 - D) * effective[l]; }
};

Stroke stroke_of(const BondRun& run)
{
  return distinct_stroke(run.name.number);
}

std::string two_digits(double value)
{
  char text[16];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

Loads effective_loads(const BondRun& run, std::size_t row)
{
  Loads q{};
  const double intact = 1.0 - run.D[row];
  for (const Load l : {normal, shear, bending})
    q[l] = intact > 0.0 ? run.load[l][row] / intact : 0.0; // D = 1: the bond is broken
  return q;
}

/// First yield, as D = 0, then each shown damage that the path reaches; between two steps
/// effective loads and D are taken as linear. Then the end, if the bond has not broken and
/// no damage shown is near; if it has not yielded, the end alone, as D = 0.
std::vector<Moment> moments(const BondRun& run)
{
  const std::size_t n = run.n_rows();
  std::size_t yield = 0;
  while (yield < n && !(run.D[yield] > 0.0)) ++yield;
  if (yield == n) return {{0.0, effective_loads(run, n - 1), false}};

  std::vector<Moment> result{{0.0, effective_loads(run, yield)}};
  for (const double D : shown_damage)
    for (std::size_t row = yield; row < n; ++row) {
      const double before = row > 0 ? run.D[row - 1] : 0.0;
      if (!(before < D && D <= run.D[row])) continue;
      // the step that begins or ends the damage has loads on the surface at one end only
      const bool is_first = row == yield, is_last = !(run.D[row] < 1.0);
      const Loads a = effective_loads(run, is_first ? row : row - 1);
      const Loads b = is_last ? a : effective_loads(run, row);
      const double t = (D - before) / (run.D[row] - before); // before < D <= after
      Moment moment{D, {}};
      for (const Load l : {normal, shear, bending})
        moment.effective[l] = a[l] + t * (b[l] - a[l]);
      result.push_back(moment);
      break;
    }

  constexpr double near = 0.1;
  const double end = run.D.back();
  if (end < 1.0 && end - result.back().D > near)
    result.push_back({end, effective_loads(run, n - 1), false});
  return result;
}

/// A plane of two loads; the panel shows x of this sign, 0 for both.
struct Plane {
  Load x, y, third;
  double side;
};

bool any_bears(const std::vector<BondRun>& runs, Load l)
{
  return std::any_of(runs.begin(), runs.end(),
                     [&](const BondRun& run) { return run.bears(l); });
}

/// Whether the normal load of a run reaches this side, by more than 1 % of the strength.
bool visits(const BondRun& run, double side)
{
  return std::any_of(run.load[normal].begin(), run.load[normal].end(), [&](double N) {
    return side * N > 0.01 * run.strength.of(normal, side);
  });
}

/// The planes of the loads that act; a load that acts alone is shown with N or, if it is N,
/// with M.
std::vector<Plane> planes(const std::vector<BondRun>& runs)
{
  const bool N = any_bears(runs, normal), V = any_bears(runs, shear),
             M = any_bears(runs, bending);
  std::vector<double> sides;
  for (const double side : {-1.0, 1.0})
    if (std::any_of(runs.begin(), runs.end(),
                    [&](const BondRun& run) { return visits(run, side); }))
      sides.push_back(side);
  if (sides.empty()) sides.push_back(1.0);

  std::vector<Plane> result;
  if ((N && M) || !V)
    for (const double side : sides) result.push_back({normal, bending, shear, side});
  if (V && (N || !M))
    for (const double side : sides) result.push_back({normal, shear, bending, side});
  if (V && M) result.push_back({shear, bending, normal, 0.0});
  return result;
}

/// y of the surface f = 0 in loads over their strengths, given x and the third load z; 0
/// beyond the surface.
///
///   f = m + n^2 + v^4/(1 - n^2) - 1
double on_surface(const Plane& plane, double x, double z)
{
  const auto n_v_m = [&](Load l) { return l == plane.x ? x : z; };
  const double rest = 1.0 - n_v_m(normal) * n_v_m(normal);
  if (!(rest > 0.0)) return 0.0;
  if (plane.y == shear)
    return std::pow(std::max(0.0, (rest - n_v_m(bending)) * rest), 0.25);
  return std::max(0.0, rest - std::pow(n_v_m(shear), 4) / rest);
}

/// Largest x of the surface at the third load z, where y = 0.
double reach(const Plane& plane, double z)
{
  const double z2 = plane.third == bending ? z : z * z; // n^2 + m = 1, else n^2 + v^2 = 1
  return std::sqrt(std::max(0.0, 1.0 - z2));
}

/// A section of the surface in the plane, at the third load of this moment, as loads.
struct Section {
  std::vector<double> x, y; ///< over the first quadrant, from y = 0 to x = 0
};

Section section(const Plane& plane, const BondStrengths& strength, const Moment& moment)
{
  const auto ratio = [&](Load l) {
    return std::abs(moment.effective[l]) / strength.of(l, moment.effective[l]);
  };
  const double z = ratio(plane.third), x_end = reach(plane, z);
  const double x_unit = (1.0 - moment.D) * strength.of(plane.x, plane.side);
  const double y_unit = (1.0 - moment.D) * strength.of(plane.y, 1.0);
  constexpr int n = 200;
  Section s;
  for (int k = 0; k <= n; ++k) {
    // evenly in angle: the surface is steep where it meets y = 0
    const double x = x_end * std::cos(0.5 * dem::pi * k / n);
    s.x.push_back(x * x_unit);
    s.y.push_back(k == 0 ? 0.0 : on_surface(plane, x, z) * y_unit);
  }
  return s;
}

/// The part of a path with x on the side of the plane, cut where it crosses x = 0; NaN
/// marks the gaps.
struct Path {
  std::vector<double> x, y;
};

Path path_on(const Plane& plane, const BondRun& run)
{
  const auto &x = run.load[plane.x], &y = run.load[plane.y];
  if (plane.side == 0.0) return {x, y};
  Path path;
  const auto is_inside = [&](std::size_t row) { return plane.side * x[row] >= 0.0; };
  for (std::size_t row = 0; row < x.size(); ++row) {
    if (row > 0 && is_inside(row) != is_inside(row - 1)) {
      // opposite signs, so the divisor is not zero
      const double t = x[row - 1] / (x[row - 1] - x[row]);
      path.x.push_back(0.0);
      path.y.push_back(y[row - 1] + t * (y[row] - y[row - 1]));
    }
    path.x.push_back(is_inside(row) ? x[row] : std::nan(""));
    path.y.push_back(y[row]);
  }
  return path;
}

/// Runs of equal strengths without a third load share their sections.
bool share_sections(const Plane& plane, const std::vector<BondRun>& runs)
{
  return !any_bears(runs, plane.third) &&
         std::all_of(runs.begin(), runs.end(), [&](const BondRun& run) {
           return run.strength == runs.front().strength;
         });
}

/// One panel. Its axes are chosen last, to fit all that it shows.
class Picture {
public:
  Picture(const Plane& plane, const std::vector<BondRun>& runs) : plane_(plane), runs_(runs)
  {
    for (const BondRun& run : runs) moments_.push_back(moments(run));
    is_shared_ = share_sections(plane, runs);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      paths_.push_back(path_on(plane, runs[k]));
      x_ = range(x_, range(paths_[k].x));
      y_ = range(y_, range(paths_[k].y));
    }
    set_quadrants();
    for (std::size_t k = 0; k < runs.size(); ++k) add_sections(k);
    // no path reaches its surface here: the widest section, without third load
    if (sections_.empty()) add_section(0, Moment{});
    x_unit_ = unit(plane.x);
    y_unit_ = unit(plane.y);
  }

  void draw(Page& page, const Box& box) const
  {
    const Panel panel = axes(page, box);
    for (const Drawn& drawn : sections_) draw_section(page, panel, drawn);
    draw_labels(page, panel); // below the paths: a gap must not cut them
    for (std::size_t k = 0; k < runs_.size(); ++k)
      draw_curve(page, panel, in_units(paths_[k].x, x_unit_),
                 in_units(paths_[k].y, y_unit_), stroke_of(runs_[k]));
    for (std::size_t k = 0; k < runs_.size(); ++k)
      for (const Moment& moment : moments_[k])
        if ((moment.D > 0.0 || moment.is_yield) && is_shown(moment))
          draw_mark(page, at(panel, moment.load(plane_.x), moment.load(plane_.y)),
                    Mark::ring, stroke_of(runs_[k]).colour);
  }

private:
  struct Drawn {
    Section section;
    double D;
    Stroke stroke;
  };

  /// Unit that suits the strength: the same in all panels with this load on this side.
  Unit unit(Load l) const
  {
    double strength = 0.0;
    for (const BondRun& run : runs_)
      strength = std::max(strength, run.strength.of(l, plane_.side));
    return convenient_unit(strength, l == bending ? "N m" : "N");
  }

  static std::vector<double> in_units(std::vector<double> values, const Unit& unit)
  {
    for (double& value : values) value /= unit.size;
    return values;
  }

  bool is_shown(const Moment& moment) const
  {
    return plane_.side * moment.effective[plane_.x] >= 0.0;
  }

  /// A surface is drawn where the paths are: below the axis only if one of them goes there.
  void set_quadrants()
  {
    const auto signs = [](const Range& r) {
      const double smallest = 0.01 * std::max(-r.low, r.high);
      std::vector<double> result;
      if (r.high >= smallest) result.push_back(1.0);
      if (-r.low > smallest) result.push_back(-1.0);
      return result;
    };
    x_signs_ = plane_.side == 0.0 ? signs(x_) : std::vector<double>{plane_.side};
    y_signs_ = signs(y_);
  }

  void add_sections(std::size_t k)
  {
    for (const Moment& moment : moments_[k]) {
      const bool is_there = std::any_of(sections_.begin(), sections_.end(),
                                        [&](const Drawn& d) { return d.D == moment.D; });
      // no path of this panel crosses a section at the third load of the other side
      if (is_shared_ ? is_there : !is_shown(moment)) continue;
      add_section(k, moment);
    }
  }

  void add_section(std::size_t k, const Moment& moment)
  {
    Stroke stroke = moment.D > 0.0 ? shrunken_surface : intact_surface;
    if (!is_shared_ && runs_.size() > 1)
      stroke = {stroke_of(runs_[k]).colour, stroke.width, stroke_of(runs_[k]).dash};
    sections_.push_back({section(plane_, runs_[k].strength, moment), moment.D, stroke});
    const Section& s = sections_.back().section;
    for (const double sign : x_signs_) x_ = range(x_, range({sign * s.x.front()}));
    for (const double sign : y_signs_) y_ = range(y_, range({sign * s.y.back()}));
  }

  Panel axes(Page& page, const Box& box) const
  {
    static const std::array<const char*, 3> names{"normal force N, tension + (",
                                                  "shear force V (", "bending moment M ("};
    const auto scaled = [](const Range& r, const Unit& unit) {
      return Range{r.low / unit.size, r.high / unit.size};
    };
    Panel panel;
    panel.box = box;
    panel.x = round_axis(scaled(x_, x_unit_), names[plane_.x] + x_unit_.name + ")");
    panel.y = round_axis(scaled(y_, y_unit_), names[plane_.y] + y_unit_.name + ")");
    draw_axes(page, panel);
    const Stroke zero{{0.7, 0.7, 0.7}, 1.5, {}};
    if (y_signs_.size() > 1)
      page.line({panel.at(panel.x.from, 0.0), panel.at(panel.x.to, 0.0)}, zero);
    if (x_signs_.size() > 1)
      page.line({panel.at(0.0, panel.y.from), panel.at(0.0, panel.y.to)}, zero);
    return panel;
  }

  void draw_section(Page& page, const Panel& panel, const Drawn& drawn) const
  {
    for (const double x_sign : x_signs_)
      for (const double y_sign : y_signs_)
        draw_curve(page, panel, in_units(drawn.section.x, {x_sign * x_unit_.size, ""}),
                   in_units(drawn.section.y, {y_sign * y_unit_.size, ""}), drawn.stroke);
  }

  Pixel at(const Panel& panel, double x, double y) const
  {
    return panel.at(x / x_unit_.size, y / y_unit_.size);
  }

  /// A section in the first quadrant that is shown.
  std::vector<Pixel> arc(const Panel& panel, const Section& s) const
  {
    std::vector<Pixel> points;
    for (std::size_t k = 0; k < s.x.size(); ++k)
      points.push_back(at(panel, x_signs_.front() * s.x[k], y_signs_.front() * s.y[k]));
    return points;
  }

  /// The damage on each shrunken surface; the key names the intact one.
  void draw_labels(Page& page, const Panel& panel) const
  {
    CurveLabels labels(page, panel.box, panel.at(0.0, 0.0));
    for (const Path& path : paths_)
      for (std::size_t row = 0; row < path.x.size(); ++row)
        if (std::isfinite(path.x[row])) labels.avoid(at(panel, path.x[row], path.y[row]));
    std::vector<std::size_t> curves;
    for (const Drawn& drawn : sections_)
      curves.push_back(labels.add_curve(arc(panel, drawn.section)));
    for (std::size_t k = 0; k < sections_.size(); ++k)
      if (sections_[k].D > 0.0) labels.write(curves[k], two_digits(sections_[k].D));
  }

  Plane plane_;
  const std::vector<BondRun>& runs_;
  std::vector<std::vector<Moment>> moments_; ///< of each run
  std::vector<Path> paths_;                  ///< of each run
  bool is_shared_ = false;
  std::vector<Drawn> sections_;
  std::vector<double> x_signs_, y_signs_; ///< of the quadrants shown
  Range x_, y_;                           ///< [N] or [N m]
  Unit x_unit_, y_unit_;
};

std::vector<KeyEntry> key(const std::vector<BondRun>& runs)
{
  std::vector<KeyEntry> entries;
  if (runs.size() == 1)
    entries.push_back({"path of the loads", stroke_of(runs.front())});
  else
    for (std::size_t k = 0; k < runs.size(); ++k)
      entries.push_back({runs[k].name.label, stroke_of(runs[k])});
  entries.push_back({"yield surface of the intact bond", intact_surface});
  entries.push_back({"yield surface at the damage D on it", shrunken_surface});
  const Colour colour = runs.size() == 1 ? stroke_of(runs.front()).colour : ink;
  entries.push_back({"path at first yield and at that D", {colour, 0.0, {}}, Mark::ring});
  if (any_bears(runs, normal) && any_bears(runs, shear) && any_bears(runs, bending))
    entries.push_back({"cut at the third load of each point", {ink, 0.0, {}}});
  return entries;
}

} // namespace

std::size_t n_surface_panels(const std::vector<BondRun>& runs)
{
  return planes(runs).size();
}

void draw_bond_surface(Page& page, const std::vector<BondRun>& runs)
{
  std::vector<Picture> pictures;
  for (const Plane& plane : planes(runs)) pictures.emplace_back(plane, runs);
  const auto entries = key(runs);
  const Grid places = grid(page, pictures.size(), entries);
  for (std::size_t k = 0; k < pictures.size(); ++k) pictures[k].draw(page, places.boxes[k]);
  draw_key(page, places.key, entries);
}

} // namespace mergel::apps

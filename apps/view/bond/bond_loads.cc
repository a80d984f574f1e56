#include "apps/view/bond/bond_loads.h"

#include "apps/view/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace mergel::apps {

namespace {

constexpr std::array<Load, 3> all_loads{normal, shear, bending};
constexpr double thin = 2.0;

Stroke stroke_of(const BondRun& run)
{
  return distinct_stroke(run.name.number);
}

std::vector<double> in_units(std::vector<double> values, const Unit& unit)
{
  for (double& value : values) value /= unit.size;
  return values;
}

double largest(const std::vector<double>& values)
{
  const Range r = range(values);
  return std::max(-r.low, r.high);
}

/// Of bond and contact together, with the sign of the bond [N], [N m]; the contact has no
/// moment.
std::vector<double> total(const BondRun& run, Load l)
{
  std::vector<double> sum = run.load[l];
  for (std::size_t row = 0; row < sum.size(); ++row) {
    if (l == normal) sum[row] -= run.f_n[row];
    if (l == shear) sum[row] += run.f_s[row];
  }
  return sum;
}

/// sum of sqrt(du_n^2 + du_s^2 + (R_b dtheta)^2) [m]: rotation counts as displacement of
/// the rim of the bond.
std::vector<double> path_length(const BondRun& run)
{
  std::vector<double> length(run.n_rows(), 0.0);
  for (std::size_t row = 1; row < length.size(); ++row) {
    const auto moved = [&](Load l) { return run.motion[l][row] - run.motion[l][row - 1]; };
    length[row] = length[row - 1] +
                  std::hypot(moved(normal), moved(shear), run.radius() * moved(bending));
  }
  return length;
}

/// One unit for all forces of the page, one for all lengths: panels can be compared.
struct Units {
  Unit force, moment, length, angle;
  const Unit& of_load(Load l) const { return l == bending ? moment : force; }
  const Unit& of_motion(Load l) const { return l == bending ? angle : length; }
};

Units units(const std::vector<BondRun>& runs)
{
  double force = 0.0, moment = 0.0, length = 0.0, angle = 0.0;
  for (const BondRun& run : runs) {
    force = std::max({force, largest(run.load[normal]), largest(run.load[shear]),
                      largest(total(run, normal)), largest(total(run, shear))});
    moment = std::max(moment, run.strength.moment); // the unit of surface.png too
    length = std::max({length, largest(run.motion[normal]), largest(run.motion[shear])});
    angle = std::max(angle, largest(run.motion[bending]));
  }
  return {convenient_unit(force, "N"), convenient_unit(moment, "N m"),
          convenient_unit(length, "m"), convenient_unit(angle, "rad")};
}

Plot load_plot(Load l, const std::vector<BondRun>& runs, const Units& u)
{
  static const std::array<const char*, 3> motions{"normal displacement, opening + (",
                                                  "shear displacement (", "rotation ("};
  static const std::array<const char*, 3> loads{"normal force N, tension + (",
                                                "shear force V (", "bending moment M ("};
  Plot plot;
  plot.x.title = motions[l] + u.of_motion(l).name + ")";
  plot.y.title = loads[l] + u.of_load(l).name + ")";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto x = in_units(runs[k].motion[l], u.of_motion(l));
    plot.curves.push_back(
        {x, in_units(total(runs[k], l), u.of_load(l)), stroke_of(runs[k])});
    if (l != bending && runs[k].has_contact())
      plot.curves.push_back({x,
                             in_units(runs[k].load[l], u.of_load(l)),
                             {stroke_of(runs[k]).colour, thin, {}}});
  }
  return plot;
}

Plot damage_plot(const std::vector<BondRun>& runs)
{
  double longest = 0.0;
  for (const BondRun& run : runs) longest = std::max(longest, largest(path_length(run)));
  const Unit unit = convenient_unit(longest, "m");
  const auto moves = [&](Load l) {
    return std::any_of(runs.begin(), runs.end(),
                       [&](const BondRun& run) { return run.moves(l); });
  };
  const std::string rotation = moves(bending) ? ", rotation \u00d7 bond radius (" : " (";
  Plot plot;
  plot.x.title = "path length" + rotation + unit.name + ")";
  plot.y.title = "damage D";
  for (std::size_t k = 0; k < runs.size(); ++k)
    plot.curves.push_back(
        {in_units(path_length(runs[k]), unit), runs[k].D, stroke_of(runs[k])});
  return plot;
}

std::vector<KeyEntry> key(const std::vector<BondRun>& runs)
{
  std::vector<KeyEntry> entries;
  if (runs.size() > 1)
    for (std::size_t k = 0; k < runs.size(); ++k)
      entries.push_back({runs[k].name.label, stroke_of(runs[k])});
  const bool has_contact = std::any_of(
      runs.begin(), runs.end(), [](const BondRun& run) { return run.has_contact(); });
  if (!has_contact) return entries;
  if (runs.size() == 1) entries.push_back({"bond and contact", stroke_of(runs.front())});
  const Colour colour = runs.size() == 1 ? stroke_of(runs.front()).colour : ink;
  entries.push_back({"the bond alone", {colour, thin, {}}});
  return entries;
}

} // namespace

void draw_bond_loads(Page& page, const std::vector<BondRun>& runs)
{
  const Units u = units(runs);
  std::vector<Plot> plots;
  for (const Load l : all_loads)
    if (std::any_of(runs.begin(), runs.end(),
                    [&](const BondRun& run) { return run.moves(l); }))
      plots.push_back(load_plot(l, runs, u));
  plots.push_back(damage_plot(runs));

  const auto entries = key(runs);
  const Grid places = grid(page, plots.size(), entries);
  for (std::size_t k = 0; k < plots.size(); ++k) draw_plot(page, places.boxes[k], plots[k]);
  draw_key(page, places.key, entries);
}

} // namespace mergel::apps

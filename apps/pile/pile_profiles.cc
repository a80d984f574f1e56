#include "apps/pile/pile_profiles.h"

#include "apps/pile/pile_continuum.h"
#include "apps/run/restart.h"
#include "dem/io/state/named_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mergel::apps {

namespace {

struct ProfileTable {
  const char *file, *mark; ///< name in the folder, and of its mark in a checkpoint
  std::vector<std::string> columns;
};

const ProfileTable shaft_table{"shaft_profile.csv",
                               "output_shaft_profile",
                               {"time [s]", "depth/D_p [-]", "h/R [-]",
                                "height above the shoulder [m]", "radial stress [Pa]",
                                "shear stress [Pa]", "radial stress by Chalk ICP-18 [Pa]",
                                "q_c of the same travel [Pa]", "damage [-]", "porosity [-]",
                                "void ratio [-]", "p [Pa]", "q [Pa]"}};
const ProfileTable tip_table{"tip_profile.csv",
                             "output_tip_profile",
                             {"time [s]", "depth/D_p [-]", "distance below the tip/D_p [-]",
                              "damage [-]", "porosity [-]", "void ratio [-]",
                              "upward displacement [m]", "vertical stress [Pa]",
                              "radial stress [Pa]", "p [Pa]", "q [Pa]"}};
const ProfileTable radial_table{
    "radial_profile.csv",
    "output_radial_profile",
    {"time [s]", "depth/D_p [-]", "beside the shaft 1 or below the tip 2 [-]", "r/R [-]",
     "damage [-]", "porosity [-]", "void ratio [-]", "outward displacement [m]",
     "upward displacement [m]", "radial stress [Pa]", "hoop stress [Pa]",
     "vertical stress [Pa]", "p [Pa]", "q [Pa]"}};
const ProfileTable path_table{
    "stress_path.csv",
    "output_stress_path",
    {"time [s]", "depth/D_p [-]", "depth of the point/D_p [-]", "r/R [-]",
     "height above the tip/D_p [-]", "damage [-]", "porosity [-]", "void ratio [-]",
     "radial stress [Pa]", "hoop stress [Pa]", "vertical stress [Pa]", "p [Pa]", "q [Pa]",
     "major principal stress to the vertical [degree]"}};
const std::array<const ProfileTable*, 4> tables{&shaft_table, &tip_table, &radial_table,
                                                &path_table};

/// The beginning of the table in a checkpoint that has none.
dem::HistoryMark mark_in(const dem::State& state, const char* name)
{
  if (!state.has(name)) return {};
  const auto& mark = state.get_rows<std::uint64_t>(name, 2);
  return {mark[0], mark[1]};
}

dem::History continued(const ProfileTable& table, const std::filesystem::path& folder,
                       const std::filesystem::path& earlier, const dem::State& state)
{
  if (!state.has(table.mark)) return {folder / table.file, table.columns};
  return {folder / table.file, table.columns, earlier / table.file,
          mark_in(state, table.mark)};
}

std::optional<dem::SectionAverage> rock_in(const dem::SectionSum& sum)
{
  if (!dem::SectionSums::is_filled(sum)) return {};
  return dem::SectionSums::average(sum);
}

RockState state_of(const std::optional<dem::SectionAverage>& rock)
{
  if (!rock) return {};
  const dem::PrincipalStress principal = rock->principal();
  const double angle = std::acos(std::clamp(principal.direction.z(), 0.0, 1.0));
  return {rock->void_ratio(), rock->p(), rock->q(), principal.minor,
          angle * 180.0 / dem::pi};
}

/// By how much the rock between two rings was thicker at the start, over that thickness.
double thinning_between(const std::optional<dem::SectionAverage>& upper,
                        const std::optional<dem::SectionAverage>& lower, double distance)
{
  if (!upper || !lower) return 0.0;
  const double lost = lower->displacement.z() - upper->displacement.z();
  return distance + lost > 0.0 ? lost / (distance + lost) : 0.0;
}

template <class Findings, class Visit>
void for_places(Findings& f, const Visit& visit)
{
  visit("beside the shaft", f.beside_shaft);
  visit("above the shoulder", f.above_shoulder);
  visit("at the shoulder", f.at_shoulder);
  visit("below the tip", f.below_tip);
}

/// Of a finished run that is started again the summary is that of its last frame.
constexpr const char* findings = "output_profile_findings";
template <class Findings>
dem::NumbersOf<Findings> numbers_of(Findings& f)
{
  dem::NumbersOf<Findings> all{
      {"averaging length [m]", &f.averaging_length},
      {"d50 [m]", &f.d_50},
      {"radial stress at h = R [Pa]", &f.radial.a},
      {"exponent of the radial stress [-]", &f.radial.b},
      {"standard error of that exponent [-]", &f.radial.standard_error},
      {"rings of that exponent [-]", &f.rings},
      {"depth of the shallowest of them [m]", &f.shallowest_ring},
      {"exponent by Chalk ICP-18 [-]", &f.icp18_exponent},
      {"annulus [m]", &f.annulus},
      {"thinning below the tip [-]", &f.thinning},
      {"largest tension [Pa]", &f.tension.stress},
      {"largest tension: distance from the axis [m]", &f.tension.r},
      {"largest tension: height above the tip [m]", &f.tension.height}};
  for_places(f, [&](const std::string& place, auto& rock) {
    all.insert(all.end(), {{"void ratio " + place, &rock.void_ratio},
                           {"p " + place, &rock.p},
                           {"q " + place, &rock.q},
                           {"minor principal stress " + place, &rock.minor},
                           {"angle of the major principal stress " + place, &rock.angle}});
  });
  return all;
}

constexpr double farthest = 4.0; // from the axis and below the tip, in diameters
constexpr double damage_of_crushed = 0.5;
constexpr double loose_depth = 2.0; // of the rings that the fit leaves out, in diameters

} // namespace

PileProfiles::PileProfiles(const std::filesystem::path& folder, const PileCase& c)
    : D_(c.diameter), R_(0.5 * c.diameter), tip_height_(c.tip_height()),
      shaft_(folder / shaft_table.file, shaft_table.columns),
      tip_(folder / tip_table.file, tip_table.columns),
      radial_(folder / radial_table.file, radial_table.columns),
      path_(folder / path_table.file, path_table.columns), deepest_(c.travel())
{
}

PileProfiles::PileProfiles(const std::filesystem::path& folder, const PileCase& c,
                           const std::filesystem::path& earlier, const dem::State& state)
    : D_(c.diameter), R_(0.5 * c.diameter), tip_height_(c.tip_height()),
      shaft_(continued(shaft_table, folder, earlier, state)),
      tip_(continued(tip_table, folder, earlier, state)),
      radial_(continued(radial_table, folder, earlier, state)),
      path_(continued(path_table, folder, earlier, state)), deepest_(c.travel())
{
  if (!state.has(findings)) return; // older checkpoints
  dem::load_numbers(state, findings, numbers_of(found_));
  found_.radial.n = static_cast<std::size_t>(std::clamp(found_.rings, 0.0, 1e6));
}

void PileProfiles::save(dem::State& state, const PileProfiles* profiles)
{
  const auto add = [&](const ProfileTable& table, const dem::History* history) {
    const dem::HistoryMark mark = history ? history->mark() : dem::HistoryMark{};
    state.add_common<std::uint64_t>(table.mark, {mark.bytes, mark.sum});
  };
  add(shaft_table, profiles ? &profiles->shaft_ : nullptr);
  add(tip_table, profiles ? &profiles->tip_ : nullptr);
  add(radial_table, profiles ? &profiles->radial_ : nullptr);
  add(path_table, profiles ? &profiles->path_ : nullptr);
  const ProfileFindings found = profiles ? profiles->found_ : ProfileFindings{};
  dem::save_numbers(state, findings, numbers_of(found));
}

std::string PileProfiles::check(const std::filesystem::path& folder,
                                const dem::State& state)
{
  std::string report;
  for (const ProfileTable* table : tables)
    if (state.has(table->mark))
      report += report_on_history(folder / table->file, mark_in(state, table->mark));
  return report;
}

void PileProfiles::require_in_place() const
{
  for (const dem::History* table : {&shaft_, &tip_, &radial_, &path_})
    table->require_in_place();
}

void PileProfiles::add(const ProfileFrame& frame, const dem::SectionSums& sums,
                       const ShaftStress& shaft)
{
  found_ = {};
  found_.averaging_length = frame.averaging_length;
  found_.d_50 = frame.d_50;
  add_shaft(frame, sums, shaft);
  add_tip(frame, sums);
  add_radial(frame, sums);
  add_paths(frame, sums);
  find_states(frame, sums);
}

void PileProfiles::add_paths(const ProfileFrame& frame, const dem::SectionSums& sums)
{
  const double half = 0.5 * frame.averaging_length;
  for (int k = 1; k * D_ <= deepest_; ++k)
    for (const double r : {half, R_ + half, D_ + half}) {
      const double z = -k * D_;
      if (sums.is_in_pile(r, z)) continue;
      const auto rock = rock_in(sums.between(r - half, r + half, z - half, z + half));
      if (!rock) continue;
      path_.add({frame.time, frame.depth / D_, static_cast<double>(k), r / R_,
                 (z - frame.z_tip) / D_, rock->damage, rock->porosity, rock->void_ratio(),
                 -rock->stress(0, 0), -rock->stress(1, 1), -rock->stress(2, 2), rock->p(),
                 rock->q(), state_of(rock).angle});
    }
}

void PileProfiles::find_states(const ProfileFrame& frame, const dem::SectionSums& sums)
{
  const double w = frame.averaging_length, z_tip = frame.z_tip,
               z_shoulder = z_tip + tip_height_;
  const auto rock = [&](double r_from, double r_to, double z_from, double z_to) {
    return rock_in(sums.between(r_from, r_to, z_from, z_to));
  };
  if (frame.depth >= R_) found_.beside_shaft = state_of(rock(R_, R_ + w, z_shoulder, -R_));
  if (frame.depth >= D_ + R_)
    found_.above_shoulder =
        state_of(rock(R_, R_ + D_, z_shoulder + R_, z_shoulder + R_ + D_));
  if (frame.depth >= R_)
    found_.at_shoulder = state_of(rock(R_, R_ + D_, z_shoulder - R_, z_shoulder + R_));
  found_.below_tip = state_of(rock(0.0, R_, z_tip - D_, z_tip));
  found_.thinning = thinning_between(rock(0.0, R_, z_tip - w, z_tip),
                                     rock(0.0, R_, z_tip - D_ - w, z_tip - D_), D_);

  const dem::SectionGrid& grid = sums.grid();
  for (int row = 0; row < grid.n_z; ++row)
    for (int column = 0; column < grid.n_columns(); ++column) {
      const double r = std::abs(grid.r_middle(column)), z = grid.z_middle(row);
      if (z > -D_ || r > farthest * D_) continue;
      const auto window = sums.filled_window(column, row, PileContinuum::reach);
      if (!window) continue;
      if (2.0 * window->largest_R > w) continue; // forces of single particles, no stress
      if (const double tension = -dem::SectionSums::average(*window).principal().minor;
          tension > found_.tension.stress)
        found_.tension = {tension, r, z - z_tip};
    }
}

void PileProfiles::add_shaft(const ProfileFrame& frame, const dem::SectionSums& sums,
                             const ShaftStress& shaft)
{
  const double z_shoulder = frame.z_tip + tip_height_, q_c = shaft.mean_q_c();
  std::vector<double> h_over_R, radial, depth;
  for (const RingStress& ring : shaft.mean()) {
    h_over_R.push_back(ring.h / R_);
    radial.push_back(ring.radial);
    depth.push_back(frame.depth - ring.h);
    const double z = z_shoulder + ring.h, half = 0.5 * shaft.height();
    const auto rock =
        rock_in(sums.between(R_, R_ + frame.averaging_length, z - half, z + half));
    if (!rock) continue; // nothing beside the pile
    shaft_.add({frame.time, frame.depth / D_, h_over_R.back(), ring.h, ring.radial,
                ring.shear, dem::icp18_end_of_driving(q_c, h_over_R.back()), q_c,
                rock->damage, rock->porosity, rock->void_ratio(), rock->p(), rock->q()});
  }
  // Rings lie from the shoulder upwards. Crushed rock near the surface hardly touches the pile.
  const auto n_deep = static_cast<std::size_t>(std::count_if(
      depth.begin(), depth.end(), [&](double d) { return d >= loose_depth * D_; }));
  if (dem::PowerFit{.n = n_deep}.is_there()) {
    h_over_R.resize(n_deep);
    radial.resize(n_deep);
    depth.resize(n_deep);
  }
  found_.radial = dem::fit_power(h_over_R, radial);
  if (!found_.radial.is_there()) found_.radial = {};
  found_.shallowest_ring = found_.radial.is_there() ? depth.back() : 0.0;
  found_.rings = static_cast<double>(found_.radial.n);
  found_.icp18_exponent = dem::icp18_exponent(q_c);
}

void PileProfiles::add_tip(const ProfileFrame& frame, const dem::SectionSums& sums)
{
  const double w = frame.averaging_length;
  for (double below = 0.0; below < farthest * D_; below += w) {
    const auto rock =
        rock_in(sums.between(0.0, R_, frame.z_tip - below - w, frame.z_tip - below));
    if (!rock) continue; // below the floor
    tip_.add({frame.time, frame.depth / D_, (below + 0.5 * w) / D_, rock->damage,
              rock->porosity, rock->void_ratio(), rock->displacement.z(),
              -rock->stress(2, 2), -rock->stress(0, 0), rock->p(), rock->q()});
  }
}

void PileProfiles::add_radial(const ProfileFrame& frame, const dem::SectionSums& sums)
{
  const dem::SectionGrid& grid = sums.grid();
  const double z_shoulder = frame.z_tip + tip_height_;
  const auto add_band = [&](double place, double r_from, double z_from, double z_to) {
    std::vector<std::pair<double, double>> damage; // over r
    for (int column = grid.n_r; column < grid.n_columns(); ++column) {
      const double r = grid.r_middle(column), half = 0.5 * grid.h;
      if (r < r_from || r > farthest * D_) continue;
      const auto rock = rock_in(sums.between(r - half, r + half, z_from, z_to));
      if (!rock) continue;
      damage.emplace_back(r, rock->damage);
      radial_.add({frame.time, frame.depth / D_, place, r / R_, rock->damage,
                   rock->porosity, rock->void_ratio(), rock->displacement.x(),
                   rock->displacement.z(), -rock->stress(0, 0), -rock->stress(1, 1),
                   -rock->stress(2, 2), rock->p(), rock->q()});
    }
    return damage;
  };
  add_band(2.0, 0.0, frame.z_tip - D_, frame.z_tip);
  if (frame.depth < 3.0 * R_) return;
  const auto damage = add_band(1.0, R_, z_shoulder + R_, -R_);
  if (damage.empty()) return;
  found_.annulus = 0.0;
  for (std::size_t k = 0; k < damage.size() && damage[k].second > damage_of_crushed; ++k) {
    double r = damage[k].first;
    if (k + 1 < damage.size() && damage[k + 1].second <= damage_of_crushed)
      r += (damage[k + 1].first - r) * (damage[k].second - damage_of_crushed) /
           (damage[k].second - damage[k + 1].second);
    found_.annulus = std::max(0.0, r - R_);
  }
}

void PileProfiles::summarise(Summary& summary) const
{
  const ProfileFindings& f = found_;
  summary.number("averaging length [m]", f.averaging_length);
  summary.number("d50 beside the pile [m]", f.d_50);
  std::ostream& out = summary.closing;
  out.precision(3);
  if (f.radial.is_there()) {
    summary.number("exponent of the radial stress over h/R [-]", f.radial.b);
    summary.number("standard error of that exponent [-]", f.radial.standard_error);
    summary.count("rings of that exponent [-]", f.radial.n);
    summary.number("depth of the shallowest of them [m]", f.shallowest_ring);
    summary.number("exponent by Chalk ICP-18 [-]", f.icp18_exponent);
    out << "radial stress on the shaft falls with (h/R)^" << f.radial.b << " +- "
        << f.radial.standard_error << " (" << f.radial.n << " rings, the shallowest "
        << f.shallowest_ring / D_ << " D_p deep)\n";
  }
  if (f.annulus >= 0.0) {
    summary.number("annulus of damage above 0.5 [m]", f.annulus);
    summary.number("annulus of damage above 0.5 over D_p [-]", f.annulus / D_);
    summary.number("annulus of damage above 0.5 over d50 [-]", f.annulus / f.d_50);
    out << "beside the shaft the damage is above 0.5 over " << 1e3 * f.annulus << " mm ("
        << f.annulus / D_ << " D_p, " << f.annulus / f.d_50 << " d50)\n";
  }
  for_places(f, [&](const std::string& place, const RockState& rock) {
    if (!rock.is_there()) return;
    summary.number("void ratio " + place + " [-]", rock.void_ratio);
    summary.number("porosity " + place + " [-]", rock.void_ratio / (1.0 + rock.void_ratio));
    summary.number("p " + place + " [Pa]", rock.p);
    summary.number("q " + place + " [Pa]", rock.q);
    summary.number("minor principal stress " + place + " [Pa]", rock.minor);
    summary.number("angle of the major principal stress to the vertical " + place +
                       " [degree]",
                   rock.angle);
    out << place << ": e " << rock.void_ratio << ", p " << 1e-6 * rock.p << " MPa, q "
        << 1e-6 * rock.q << " MPa, major principal stress " << rock.angle
        << " degrees off the vertical\n";
  });
  summary.number("thinning of the diameter below the tip [-]", f.thinning);
  if (f.tension.stress > 0.0) {
    summary.number("largest tension [Pa]", f.tension.stress);
    summary.number("its distance from the axis over D_p [-]", f.tension.r / D_);
    summary.number("its height above the tip over D_p [-]", f.tension.height / D_);
    out << "largest tension " << 1e-6 * f.tension.stress << " MPa, " << f.tension.r / D_
        << " D_p from the axis, " << f.tension.height / D_ << " D_p above the tip\n";
  }
}

} // namespace mergel::apps

/// mergel bond: one bonded pair of particles along any path of u_n, u_s and theta.
#include "apps/case/material_keys.h"
#include "apps/case/units.h"
#include "apps/case/words.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/plan.h"
#include "apps/run/ranks.h"
#include "apps/run/restart.h"
#include "apps/run/results.h"
#include "apps/run/summary.h"
#include "dem/element/controlled_pair.h"
#include "dem/io/atomic_file.h"
#include "dem/io/history.h"
#include "dem/io/table.h"
#include "dem/text.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace mergel::apps {

namespace {

/// Larger motions are taken for a mistake in the units.
constexpr double most_radii = 1e3, most_radians = 1e3;

struct BondCase {
  double radius = unset;     ///< of the first particle [m]
  double radius_ratio = 1.0; ///< of the second particle to the first [-]
  double S = 1.0;            ///< upscaling ratio [-]
  double gap = 0.0;          ///< between the surfaces when bonded [m]
  BondKeys bond;
  ContactKeys contact;
  std::string mode = "path";
  std::filesystem::path path;
  dem::RelativeMotion end_motion{unset, unset, unset}; ///< at the end of a named loading
  int steps_per_stage = 1000;

  double smaller_radius() const { return radius * std::min(1.0, radius_ratio); }
};

/// The named loadings of the paper's Fig. 3: the motions of each, and the sign of u_n.
struct Loading {
  const char* name;
  double normal; ///< 1 tension, -1 compression, 0 none
  bool shear, bending;
};
constexpr Loading loadings[] = {
    {"tension", 1.0, false, false},
    {"compression", -1.0, false, false},
    {"shear", 0.0, true, false},
    {"bending", 0.0, false, true},
    {"tension-shear", 1.0, true, false},
    {"compression-shear", -1.0, true, false},
    {"tension-bending", 1.0, false, true},
    {"compression-bending", -1.0, false, true},
    {"shear-bending", 0.0, true, true},
    {"tension-shear-bending", 1.0, true, true},
    {"compression-shear-bending", -1.0, true, true},
};

template <class Has>
std::vector<std::string> names_with(Has&& has)
{
  std::vector<std::string> names;
  for (const Loading& l : loadings)
    if (has(l)) names.emplace_back(l.name);
  return names;
}

void declare_particles(CaseFile& file, BondCase& c)
{
  file.former_section("Spheres", "Particles");
  const auto section = file.section("Particles");
  file.quantity("radius", c.radius, "m", positive, "Of the first particle.", "mm");
  file.number("radius ratio", c.radius_ratio, between(1e-3, 1e3),
              "Radius of the second particle over that of the first.");
  file.number("upscaling ratio", c.S, positive,
              "S of both particles: softening displacement and activation gap scale with "
              "it, Eq. 8.");
  file.quantity("initial gap", c.gap, "m", non_negative,
                "Gap between the surfaces when they are bonded; not scaled with S.", "mm");
}

void declare_loading(CaseFile& file, BondCase& c)
{
  const auto section = file.section("Loading");
  std::vector<std::string> modes{"path"};
  for (const Loading& l : loadings) modes.emplace_back(l.name);
  file.choice("mode", c.mode, modes,
              "Corner points of a file, or the motions below in proportion (Fig. 3).");
  {
    const auto only = file.only_if("mode", {"path"});
    file.path("path", c.path,
              "CSV file of corner points, without the start at zero; its first line is "
              "u_n [m],u_s [m],theta [rad].",
              Default::none);
  }
  {
    const auto only =
        file.only_if("mode", names_with([](const Loading& l) { return l.normal != 0.0; }));
    file.quantity("normal displacement", c.end_motion.u_n, "m", positive,
                  "At the end; apart in tension, together in compression.", "mm");
  }
  {
    const auto only =
        file.only_if("mode", names_with([](const Loading& l) { return l.shear; }));
    file.quantity("shear displacement", c.end_motion.u_s, "m", positive, "At the end.",
                  "mm");
  }
  {
    const auto only =
        file.only_if("mode", names_with([](const Loading& l) { return l.bending; }));
    file.quantity("rotation", c.end_motion.theta, "rad", positive, "At the end.");
  }
  file.former_name("steps per leg", "steps per stage");
  file.integer("steps per stage", c.steps_per_stage, between(1.0, 1e7),
               "Equal steps between two corners; one line of history.csv each.");
}

void declare(CaseFile& file, BondCase& c)
{
  declare_particles(file, c);
  declare(file, c.bond);
  declare(file, c.contact);
  declare_loading(file, c);
}

/// Message on an invalid corner, or "".
std::string fault(const BondCase& c, const dem::RelativeMotion& at)
{
  const double r = c.smaller_radius();
  if (!std::isfinite(at.u_n) || !std::isfinite(at.u_s) || !std::isfinite(at.theta))
    return "every motion must be a finite number";
  if (c.gap + at.u_n < -0.5 * r)
    return "u_n = " + dem::rounded(at.u_n) +
           " m makes the particles overlap by more than half of the smaller radius: must "
           "be at least " +
           dem::rounded(-0.5 * r - c.gap) + " m";
  if (std::abs(at.u_n) > most_radii * r || std::abs(at.u_s) > most_radii * r)
    return "a displacement exceeds 1000 radii: is its unit m?";
  if (std::abs(at.theta) > most_radians) return "theta exceeds 1000 rad: is its unit rad?";
  return "";
}

/// Corner points of the path, without the start at zero.
std::vector<dem::RelativeMotion> corners(const CaseFile& file, const BondCase& c)
{
  std::vector<dem::RelativeMotion> path;
  if (c.mode != "path") {
    const Loading& l = *std::find_if(std::begin(loadings), std::end(loadings),
                                     [&](const Loading& o) { return c.mode == o.name; });
    const dem::RelativeMotion end{l.normal != 0.0 ? l.normal * c.end_motion.u_n : 0.0,
                                  l.shear ? c.end_motion.u_s : 0.0,
                                  l.bending ? c.end_motion.theta : 0.0};
    if (const std::string wrong = fault(c, end); !wrong.empty())
      file.refuse("Loading",
                  l.normal != 0.0 ? "normal displacement"
                  : l.shear       ? "shear displacement"
                                  : "rotation",
                  wrong);
    return {end};
  }

  dem::Table table;
  try {
    table = dem::read_table(c.path, dem::LastLine::whole);
    const auto u_n = table.column_in("u_n", "m", unit_size),
               u_s = table.column_in("u_s", "m", unit_size),
               theta = table.column_in("theta", "rad", unit_size);
    for (std::size_t k = 0; k < table.n_rows; ++k) {
      path.push_back({u_n[k], u_s[k], theta[k]});
      if (const std::string wrong = fault(c, path.back()); !wrong.empty())
        throw InputError(c.path.string() + ":" + std::to_string(table.lines[k]) + ": " +
                         wrong);
    }
  } catch (const InputError& e) {
    file.refuse("Loading", "path", e.what());
  }
  const dem::RelativeMotion& first = path.front();
  if (first.u_n == 0.0 && first.u_s == 0.0 && first.theta == 0.0) path.erase(path.begin());
  if (path.empty())
    file.refuse("Loading", "path",
                c.path.string() + ": the only corner is the start itself: no motion");
  return path;
}

/// history.csv and the largest values for the summary.
class Record {
public:
  explicit Record(const std::filesystem::path& file) : history_(file, columns) {}

  void add(const dem::ControlledPair& pair)
  {
    const dem::RelativeMotion& u = pair.motion();
    const dem::ControlledPairReading r = pair.read();
    history_.add({u.u_n, u.u_s, u.theta, r.N, r.V, r.M, r.D, r.f_n, r.f, r.u_p.u_n,
                  r.u_p.u_s, r.u_p.theta, r.f_s, pair.work(), r.stored, pair.dissipated()});
    tension = std::max(tension, r.N);
    compression = std::max(compression, -r.N);
    shear = std::max(shear, std::abs(r.V));
    moment = std::max(moment, std::abs(r.M));
    D = r.D;
    const double error = std::abs(pair.work() - r.stored - pair.dissipated());
    energy_scale_ = std::max(energy_scale_, std::max(r.stored, pair.dissipated()));
    energy_error_ = std::max(energy_error_, error);
    ++n_records;
  }
  /// @throws NumericalError when another program has touched the history
  void require_in_place() const { history_.require_in_place(); }

  /// Largest |work - stored - dissipated| over the largest stored or dissipated energy [-].
  double energy_error() const
  {
    return energy_scale_ > 0.0 ? energy_error_ / energy_scale_ : 0.0;
  }

  double tension = 0.0, compression = 0.0, shear = 0.0, moment = 0.0, D = 0.0;
  std::size_t n_records = 0;

private:
  inline static const std::vector<std::string> columns{
      "u_n [m]",         "u_s [m]",         "theta [rad]",
      "N [N]",           "V [N]",           "M [N.m]",
      "D [-]",           "f_n [N]",         "yield function [-]",
      "plastic u_n [m]", "plastic u_s [m]", "plastic theta [rad]",
      "f_s [N]",         "work [J]",        "stored [J]",
      "dissipated [J]"};
  dem::History history_;
  double energy_scale_ = 0.0, energy_error_ = 0.0;
};

void write_summary(const std::filesystem::path& file, const dem::BondLaw& law,
                   const Record& record, const dem::ControlledPair& pair,
                   const Provenance& made)
{
  const dem::SingleStrengths strong = std::visit(
      [&](const auto& bond) { return single_strengths(bond, pair.shape()); }, law);
  Summary s;
  s.text("bond law", std::visit([](const auto& bond) { return bond.name; }, law));
  s.number("tensile strength [N]", strong.tension);
  if (std::isfinite(strong.compression))
    s.number("compressive strength [N]", strong.compression);
  s.number("shear strength [N]", strong.shear);
  s.number("moment strength [N.m]", strong.moment);
  s.number("largest tension [N]", record.tension);
  s.number("largest compression [N]", record.compression);
  s.number("largest shear force [N]", record.shear);
  s.number("largest moment [N.m]", record.moment);
  s.number("damage at the end [-]", record.D);
  s.number("work [J]", pair.work());
  s.number("dissipated [J]", pair.dissipated());
  s.number("energy error [-]", record.energy_error());
  s.count("steps [-]", record.n_records - 1);
  s.json("made by", made.json());
  dem::replace_file(file, s.object());
}

void print_summary(const std::filesystem::path& folder, const Record& record)
{
  std::cout.precision(5);
  std::cout << "largest loads of the bond: tension " << record.tension << " N, compression "
            << record.compression << " N, shear " << record.shear << " N, moment "
            << record.moment << " N m; damage at the end " << record.D
            << (record.D == 1.0 ? ", broken" : "")
            << "\nenergy error: work minus stored and dissipated energy is at most "
            << 100.0 * record.energy_error() << " % of these, in " << record.n_records - 1
            << " steps\nresults: " << printable(folder.string())
            << " (history.csv, summary.json); pictures: mergel-view "
            << in_shell(folder.string()) << "\n";
}

} // namespace

void keys_of_bond(const UseKeys& use)
{
  CaseFile file;
  BondCase c;
  declare(file, c);
  use(file);
}

Plan plan_bond(const JobOptions& options)
{
  CaseFile file;
  BondCase c;
  declare(file, c);
  read_case(file, options, std::nullopt);
  refuse_impossible(file, c.bond, c.contact);
  Plan plan;
  plan.n_particles = 2.0;
  plan.particles_by = "one bonded pair";
  plan.bonds_per_particle = 0.5;
  plan.n_steps =
      static_cast<double>(corners(file, c).size()) * static_cast<double>(c.steps_per_stage);
  plan.steps_by = "corners of the path times `steps per stage`";
  remark_on_materials(plan.unusual, c.bond, c.contact);
  return plan;
}

namespace {

/// The whole job, on one rank: it has a single pair.
void load_bond(const JobOptions& options)
{
  CaseFile file;
  BondCase c;
  declare(file, c);
  read_case(file, options, std::nullopt);
  refuse_impossible(file, c.bond, c.contact);
  const auto path = corners(file, c);
  OutputFolder folder = folder_to_begin_in(options);
  const auto inputs = inputs_of(options, std::nullopt, {c.path});
  const Provenance made = provenance(options);
  begin_folder(folder, inputs, file, made);

  const dem::BondLaw law = c.bond.chosen();
  dem::ControlledPair pair(
      {c.radius, c.radius * c.radius_ratio, c.S, c.gap, {law, c.contact.chosen()}});
  Remarks unusual;
  remark_on_materials(unusual, c.bond, c.contact);
  std::cout << lines_of(unusual);
  Record record(folder.path() / "history.csv");
  record.add(pair);
  for (const dem::RelativeMotion& corner : path) {
    const dem::RelativeMotion from = pair.motion();
    for (int k = 1; k <= c.steps_per_stage; ++k) {
      const double t = static_cast<double>(k) / c.steps_per_stage;
      const auto between = [t](double a, double b) {
        return t < 1.0 ? a + t * (b - a) : b;
      };
      pair.move_to({between(from.u_n, corner.u_n), between(from.u_s, corner.u_s),
                    between(from.theta, corner.theta)});
      record.add(pair);
    }
  }
  write_summary(folder.path() / "summary.json", law, record, pair, made);
  record.require_in_place();
  require_results(folder.path(), "bond");
  print_summary(folder.path(), record);
}

} // namespace

int run_bond(const JobOptions& options)
{
  on_first_rank([&] { load_bond(options); });
  return 0;
}

} // namespace mergel::apps

#include "apps/case/specimen_keys.h"

#include "apps/case/units.h"
#include "dem/io/psd_file.h"
#include "dem/io/seal.h"
#include "dem/text.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

namespace mergel::apps {

namespace {

using Shape = SpecimenKeys::Shape;
using Sizes = SpecimenKeys::Sizes;
using Upscaling = SpecimenKeys::Upscaling;

const std::string half_cylinder = "half cylinder", cylinder = "cylinder",
                  periodic_box = "periodic box";
const std::string uniform_in_number = "uniform in number", power_law = "power law",
                  log_normal = "log-normal", from_table = "table";

void declare_shape(CaseFile& file, SpecimenKeys& k)
{
  file.choice(
      "shape", k.shape,
      std::vector<std::pair<std::string, Shape>>{{half_cylinder, Shape::half_cylinder},
                                                 {cylinder, Shape::cylinder},
                                                 {periodic_box, Shape::periodic_box}},
      "Shape of the DEM region: half of an upright cylinder cut at y = 0, a full cylinder, "
      "or a periodic box.");
  {
    const auto only = file.only_if("shape", {half_cylinder, cylinder});
    file.quantity("diameter", k.diameter, "m", positive, "Diameter of the DEM region.",
                  "mm");
    file.quantity("height", k.height, "m", positive, "Height of the DEM region.", "mm");
  }
  if (!k.is_side_meshed) {
    const auto only = file.only_if("shape", {cylinder});
    file.integer("faces around the side", k.faces, at_least(3.0),
                 "Number of faces of the prism inscribed in the cylinder.");
  }
  {
    const auto only = file.only_if("shape", {periodic_box});
    file.quantity("edge x", k.edges.x(), "m", positive, "Edge of the box.", "mm");
    file.quantity("edge y", k.edges.y(), "m", positive, "Edge of the box.", "mm");
    file.quantity("edge z", k.edges.z(), "m", positive, "Edge of the box.", "mm");
  }
  const auto only = file.only_if("shape", {half_cylinder});
  file.choice("symmetry", k.symmetry,
              std::vector<std::pair<std::string, Symmetry>>{{"mirror", Symmetry::mirror},
                                                            {"wall", Symmetry::wall}},
              "Cut plane: particles bonded to their mirror images, or in contact with them "
              "only.");
}

void declare_sizes(CaseFile& file, SpecimenKeys& k)
{
  file.choice(
      "sizes", k.sizes,
      std::vector<std::pair<std::string, Sizes>>{{uniform_in_number, Sizes::uniform},
                                                 {power_law, Sizes::power},
                                                 {log_normal, Sizes::log_normal},
                                                 {from_table, Sizes::table}},
      "Grading: all diameters equally frequent by number; by mass a power law (Fuller and "
      "Thompson 1907, Talbot and Richart 1923) or log-normal; or a sieve curve.");
  {
    const auto only = file.only_if("sizes", {uniform_in_number, power_law, log_normal});
    file.quantity("smallest diameter", k.d_min, "m", positive,
                  "Smallest particle at S = 1, d00.", "mm");
    file.quantity("largest diameter", k.d_max, "m", positive, "Largest particle at S = 1.",
                  "mm");
  }
  {
    const auto only = file.only_if("sizes", {power_law});
    file.number("exponent", k.exponent, above_to(0.0, 3.0),
                "Of the mass fraction over the diameter; 0.5 is Fuller's curve.");
  }
  {
    const auto only = file.only_if("sizes", {log_normal});
    file.quantity("median diameter", k.d_50, "m", positive,
                  "By mass, at S = 1, before the curve is truncated.", "mm");
    file.number("spread", k.spread, above_to(0.0, 3.0),
                "Standard deviation of the logarithm of the diameter.");
  }
  const auto only = file.only_if("sizes", {from_table});
  file.path("size table", k.table,
            "Sieve curve at S = 1: columns `diameter [mm]`, `passing [%]` by mass.",
            Default::none);
  file.text("size table sum", k.table_sum,
            "Checksum of that file, set in a resolved case: a changed table is refused. "
            "Empty: not checked.");
  file.text(
      "size table points", k.table_points,
      "The curve of that file, diameter [m] and passing [-] of each point, set in a "
      "resolved case: a run that is continued, or whose table is gone, needs no file.");
  file.identified_by("size table sum", {"size table", "size table points"});
}

void declare_upscaling(CaseFile& file, SpecimenKeys& k)
{
  dem::GradedScale& s = k.specimen.scale;
  s = {unset, unset, unset, unset};
  file.choice("upscaling", k.upscaling,
              std::vector<std::pair<std::string, Upscaling>>{
                  {"graded", Upscaling::graded}, {"uniform", Upscaling::uniform}},
              "Ratio S of the particle size to the grain size of the rock: growing with "
              "the distance from the axis, or uniform.");
  {
    const auto only = file.only_if("upscaling", {"uniform"});
    file.number("upscaling ratio", k.S, positive, "S of all particles.");
  }
  const auto only = file.only_if("upscaling", {"graded"});
  file.number("inner upscaling", s.S_inner, positive,
              "Upscaling ratio S up to the inner radius.");
  file.number("outer upscaling", s.S_outer, positive,
              "Upscaling ratio S from the outer radius on; linear between.");
  file.quantity("inner radius", s.r_inner, "m", non_negative,
                "Distance from the axis up to which S is the inner upscaling.", "mm");
  file.quantity("outer radius", s.r_outer, "m", positive,
                "Distance from the axis from which S is the outer upscaling.", "mm");
}

void declare_packing(CaseFile& file, SpecimenKeys& k)
{
  dem::SpecimenSpec& s = k.specimen;
  s.rho = s.porosity = s.coordination = s.g_b = unset;
  file.quantity("grain density", s.rho, "kg/m3", positive,
                "Density of the grains, not of the rock.");
  file.number("porosity", s.porosity, inside(0.0, 1.0),
              "Target porosity of the core, by true sphere volumes.");
  file.choice("packing", s.compaction,
              std::vector<std::pair<std::string, dem::Compaction>>{
                  {"unjammed", dem::Compaction::unjammed},
                  {"confined", dem::Compaction::confined},
                  {"expanded", dem::Compaction::expanded}},
              "unjammed: no far-field contact is loaded; confined: porosity and a "
              "pressure are reached together; expanded: radii grow to the porosity, at any "
              "pressure.");
  {
    const auto only = file.only_if("packing", {"confined"});
    s.pressure = unset;
    file.quantity("target pressure", s.pressure, "Pa", positive,
                  "Mean stress of the unbonded particles at rest; reached within 20 %.",
                  "kPa");
  }
  {
    const auto only = file.only_if("packing", {"expanded"});
    file.number("generation friction", s.friction, non_negative,
                "Friction coefficient between the particles until they come to rest.");
  }
  file.number("coordination", s.coordination, non_negative,
              "Target Z = 2 N_bonds/N; the bond gap may limit it to less. 0: granular, no "
              "particle is bonded to another.");
  file.quantity("bond gap", s.g_b, "m", non_negative,
                "Largest gap that is bonded, g_b at S = 1; scales with S, Eq. 8.", "mm");
  file.not_needed_at_zero("Specimen", "coordination", {"bond gap"});
  file.integer("seed", s.seed, non_negative,
               "Of the random positions and sizes of the particles.");
  file.path("file", k.sample,
            "Specimen file made by mergel sample; empty: the run makes its specimen.");
}

std::string in_mm(double x)
{
  std::ostringstream out;
  out.precision(4);
  out << 1e3 * x << " mm";
  return out.str();
}

/// "0.0001 0, 0.0002 1": diameter [m] and passing [-] of each point.
std::string text_of(const dem::SieveSizes& sizes)
{
  std::string text;
  for (std::size_t k = 0; k < sizes.d.size(); ++k)
    text += (k > 0 ? ", " : "") + dem::shortest(sizes.d[k]) + ' ' +
            dem::shortest(sizes.passing[k]);
  return text;
}

/// The points of text_of(). @throws InputError without place and value
dem::SieveSizes sieve_from(const std::string& text)
{
  dem::SieveSizes sizes;
  std::istringstream points(text);
  for (std::string point; std::getline(points, point, ',');) {
    std::istringstream numbers(point);
    double d = 0.0, passing = 0.0;
    std::string rest;
    const bool is_first = sizes.d.empty();
    require(static_cast<bool>(numbers >> d >> passing) && !(numbers >> rest) &&
                std::isfinite(d) && d > (is_first ? 0.0 : sizes.d.back()) &&
                (is_first ? passing == 0.0 : passing >= sizes.passing.back()),
            "is no sieve curve: diameters must ascend, and passing from 0 to 1. Leave the "
            "key out to read the table");
    sizes.d.push_back(d);
    sizes.passing.push_back(passing);
  }
  require(sizes.d.size() > 1 && sizes.passing.back() == 1.0,
          "is no sieve curve: passing must end at 1. Leave the key out to read the table");
  return sizes;
}

std::string sum_of(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  return dem::hexadecimal(dem::fnv_1a(bytes));
}

/// The curve of a table: from its file or, where a run is continued or the file is gone,
/// from the case. Sets sum and points in the resolved case.
dem::SieveSizes table_of(CaseFile& file, SpecimenKeys& k)
{
  std::error_code error; // a file that cannot be reached counts as gone
  const bool is_gone = !std::filesystem::exists(k.table, error);
  if (file.is_continued() && is_gone && k.table_points.empty()) {
    k.table_sum = file.earlier_value("Specimen", "size table sum");
    k.table_points = file.earlier_value("Specimen", "size table points");
  }
  dem::SieveSizes sizes;
  const bool is_known = !k.table_points.empty() && !k.table_sum.empty() &&
                        !file.is_override("Specimen", "size table") &&
                        (file.is_continued() || is_gone);
  try {
    if (is_known) sizes = sieve_from(k.table_points);
  } catch (const InputError& e) {
    file.refuse("Specimen", "size table points", e.what());
  }
  try {
    if (!is_known) sizes = dem::read_sieve_curve(k.table, unit_size);
  } catch (const InputError& e) {
    file.refuse("Specimen", "size table", e.what());
  }
  if (!is_known) {
    const std::string sum = sum_of(k.table);
    if (!k.table_sum.empty() && k.table_sum != sum)
      file.refuse(
          "Specimen", "size table sum",
          k.table.string() + " has " + sum +
              ": it was changed after this case was resolved. Restore the old table, or "
              "leave this key out to begin a run with the new one");
    k.table_sum = sum;
    k.table_points = text_of(sizes);
  }
  file.resolve("Specimen", "size table sum", k.table_sum);
  file.resolve("Specimen", "size table points", k.table_points);
  return sizes;
}

dem::SizeCurve curve_of(CaseFile& file, SpecimenKeys& k)
{
  switch (k.sizes) {
  case Sizes::uniform:
    return dem::UniformSizes{k.d_min, k.d_max};
  case Sizes::power:
    return dem::PowerSizes{k.d_min, k.d_max, k.exponent};
  case Sizes::log_normal:
    return dem::LogNormalSizes{k.d_min, k.d_max, k.d_50, k.spread};
  case Sizes::table:
    break;
  }
  return table_of(file, k);
}

dem::Region region_of(const SpecimenKeys& k)
{
  switch (k.shape) {
  case Shape::half_cylinder:
    return dem::HalfCylinder{0.5 * k.diameter, k.height, 2};
  case Shape::cylinder:
    return dem::Cylinder{0.5 * k.diameter, k.height, k.faces};
  case Shape::periodic_box:
    break;
  }
  return dem::PeriodicBox{k.edges};
}

/// The key to lower when particles are too large.
const char* ratio_key(const SpecimenKeys& k)
{
  if (k.upscaling == Upscaling::uniform) return "upscaling ratio";
  const dem::GradedScale& s = k.specimen.scale;
  return s.S_inner > s.S_outer ? "inner upscaling" : "outer upscaling";
}

const char* finest_key(const SpecimenKeys& k)
{
  return k.sizes == Sizes::table ? "size table" : "smallest diameter";
}

/// Particles without bonds hold together under a pressure only.
void complete_granular(const CaseFile& file, SpecimenKeys& k)
{
  k.specimen.g_b = 0.0; // the recipe does not depend on it
  if (k.is_side_meshed)
    file.refuse("Specimen", "coordination",
                "the specimen of a pile needs bonds: nothing else holds its particles but "
                "their weight, some pascals. Particles without bonds are for element and "
                "triaxial tests");
  if (k.specimen.compaction == dem::Compaction::unjammed)
    file.refuse("Specimen", "coordination",
                "without bonds the particles hold together only under a pressure: set "
                "`packing = confined` and a `target pressure`, or `packing = expanded`");
  if (k.strengths.is_on())
    file.refuse("Strength variability", "distribution",
                "there are no bonds whose strengths could vary, `Specimen/coordination` is "
                "0: use `none`");
}

} // namespace

void declare(CaseFile& file, SpecimenKeys& k)
{
  {
    const auto section = file.section("Specimen");
    declare_shape(file, k);
    declare_sizes(file, k);
    declare_upscaling(file, k);
    declare_packing(file, k);
  }
  declare(file, k.strengths);
}

void complete(CaseFile& file, SpecimenKeys& k, const dem::ContactLaw& contact)
{
  dem::SpecimenSpec& s = k.specimen;
  s.contact = contact;
  if (k.sizes != Sizes::table && k.d_max < k.d_min)
    file.refuse("Specimen", "largest diameter", "must not be below `smallest diameter`");
  try {
    s.sizes = dem::Grading(curve_of(file, k));
  } catch (const InputError& e) { // the file of a table names itself
    if (k.sizes == Sizes::log_normal) file.refuse("Specimen", "spread", e.what());
    throw;
  }
  if (k.upscaling == Upscaling::uniform)
    s.scale = {k.S, k.S, 0.0, 0.0};
  else if (k.shape == Shape::periodic_box)
    file.refuse("Specimen", "upscaling",
                "a periodic box has no axis: use `upscaling = uniform`");
  else if (s.scale.r_outer <= s.scale.r_inner)
    file.refuse("Specimen", "outer radius", "must be beyond `inner radius`");
  if (k.is_side_meshed && s.compaction != dem::Compaction::unjammed)
    file.refuse("Specimen", "packing",
                "the specimen of a pile comes to rest inside the walls of its run: use "
                "`unjammed`");
  if (k.is_granular()) complete_granular(file, k);
  s.region = region_of(k);

  const double largest = s.sizes.largest() * std::max(s.scale.S_inner, s.scale.S_outer);
  if (dem::smallest_width(s.region) <= dem::width_needed(s))
    file.refuse("Specimen", ratio_key(k),
                "the largest particle, " + in_mm(largest) +
                    ", does not fit the region, which must be wider than " +
                    in_mm(dem::width_needed(s)) +
                    ": lower the ratio or enlarge the region");
  if (dem::max_particles(s) > dem::particles_limit)
    file.refuse("Specimen", finest_key(k),
                "the region may hold more than 2e7 particles: raise the diameters or the "
                "upscaling ratio");
  // Shells of ten times the particle volume: a mistake in the units.
  if (dem::effective_solid_fraction(s) > 10.0 * (1.0 - s.porosity))
    file.refuse("Contact", "activation gap",
                "with it the particles take ten times their own volume: lower it, or raise "
                "`Specimen/" +
                    std::string(finest_key(k)) + "`, " + in_mm(s.sizes.smallest()));
  try {
    s.check();
  } catch (const InputError& e) {
    file.refuse("Specimen", "porosity", e.what());
  }
}

std::vector<std::pair<std::string, std::string>> recipe(const SpecimenKeys& k)
{
  const dem::SpecimenSpec& s = k.specimen;
  const auto text = [](double x) { return dem::shortest(x); };
  const auto length = [](double x) { return dem::shortest(x) + " m"; };
  std::vector<std::pair<std::string, std::string>> r;
  if (k.shape == Shape::periodic_box) {
    r = {{"shape", periodic_box},
         {"edge x", length(k.edges.x())},
         {"edge y", length(k.edges.y())},
         {"edge z", length(k.edges.z())}};
  } else {
    const bool is_half = k.shape == Shape::half_cylinder;
    const int faces = is_half ? std::get<dem::HalfCylinder>(s.region).segments
                              : std::get<dem::Cylinder>(s.region).segments;
    r = {{"shape", is_half ? half_cylinder : cylinder},
         {"diameter", length(k.diameter)},
         {"height", length(k.height)},
         {"faces around the side", std::to_string(faces)}};
  }
  switch (k.sizes) {
  case Sizes::uniform:
    r.emplace_back("sizes", uniform_in_number);
    break;
  case Sizes::power:
    r.emplace_back("sizes", power_law);
    r.emplace_back("exponent", text(k.exponent));
    break;
  case Sizes::log_normal:
    r.emplace_back("sizes", log_normal);
    r.emplace_back("median diameter", length(k.d_50));
    r.emplace_back("spread", text(k.spread));
    break;
  case Sizes::table: { // the curve itself: the file may move or change
    std::string points;
    for (int p = 0; p <= 100; ++p)
      points += (p > 0 ? " " : "") + text(s.sizes.diameter(0.01 * p));
    r.emplace_back("sizes", from_table);
    r.emplace_back("diameters in hundredths by number", points);
    break;
  }
  }
  r.insert(r.end(), {{"smallest diameter", length(s.sizes.smallest())},
                     {"largest diameter", length(s.sizes.largest())},
                     {"grain density", text(s.rho) + " kg/m3"},
                     {"porosity", text(s.porosity)},
                     {"coordination", text(s.coordination)},
                     {"bond gap", length(s.g_b)},
                     {"activation gap", length(dem::activation_gap(s.contact))},
                     {"inner upscaling", text(s.scale.S_inner)},
                     {"outer upscaling", text(s.scale.S_outer)},
                     {"inner radius", length(s.scale.r_inner)},
                     {"outer radius", length(s.scale.r_outer)}});
  if (s.compaction != dem::Compaction::unjammed) {
    const bool is_confined = s.compaction == dem::Compaction::confined;
    r.emplace_back("packing", is_confined ? "confined" : "expanded");
    if (is_confined)
      r.emplace_back("target pressure", text(s.pressure) + " Pa");
    else
      r.emplace_back("generation friction", text(s.friction));
    for (auto& line : recipe(s.contact)) r.push_back(std::move(line));
    r.emplace_back("free rotation", s.free_rotation ? "true" : "false");
  }
  r.emplace_back("seed", std::to_string(s.seed));
  return r;
}

} // namespace mergel::apps

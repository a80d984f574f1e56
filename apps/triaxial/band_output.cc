#include "apps/triaxial/band_output.h"

namespace mergel::apps {

namespace {

constexpr double degree = dem::pi / 180.0;

void append_slab(std::vector<BandColumn>& to, const std::string& prefix,
                 const dem::Slab& slab, const char* of, double d_50)
{
  to.push_back({prefix + "angle", "degree", slab.angle() / degree});
  to.push_back({prefix + "dip direction", "degree", slab.dip_direction() / degree});
  to.push_back({prefix + "first face", "m", slab.from});
  to.push_back({prefix + "last face", "m", slab.to});
  to.push_back({prefix + "thickness/d50", "-", slab.thickness() / d_50});
  to.push_back({prefix + "share of the " + of, "-", slab.share});
  to.push_back({prefix + "even share", "-", slab.even});
}

} // namespace

std::vector<BandColumn> band_columns(const dem::Localisation& found, double d_50)
{
  std::vector<BandColumn> columns;
  append_slab(columns, "", found.band, "tenth", d_50);
  columns.push_back({"share of the tenth in 10 d50", "-", found.of_ten.share});
  columns.push_back({"even share in 10 d50", "-", found.of_ten.even});
  append_slab(columns, "second ", found.second, "rest", d_50);
  return columns;
}

std::vector<NamedLocalisation> localisations(const coupling::BandRecord& r)
{
  return {{"shear strain", r.shear},
          {"increment of shear strain", r.shear_increment},
          {"compaction", r.compaction},
          {"increment of compaction", r.compaction_increment}};
}

std::vector<std::string> band_headings()
{
  std::vector<std::string> headings{
      "time [s]",  "stage [-]",        "part [-]",
      "cycle [-]", "axial strain [-]", "increment of the axial strain [-]"};
  const coupling::BandRecord any;
  for (const auto& [name, found] : localisations(any))
    for (const BandColumn& c : band_columns(found, 1.0))
      headings.push_back(std::string(name) + ": " + c.name + " [" + c.unit + "]");
  return headings;
}

std::vector<double> band_line(const coupling::BandRecord& r, double d_50,
                              const StageLabel& stage)
{
  std::vector<double> line{r.time,
                           static_cast<double>(stage.number),
                           static_cast<double>(stage.part),
                           static_cast<double>(stage.cycle),
                           r.axial_strain,
                           r.increment};
  for (const auto& [name, found] : localisations(r))
    for (const BandColumn& c : band_columns(found, d_50)) line.push_back(c.value);
  return line;
}

} // namespace mergel::apps

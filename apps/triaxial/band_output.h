/// Columns of localisation.csv: the bands of a triaxial test.
#pragma once

#include "apps/element/loading_stages.h"
#include "coupling/triaxial/specimen_bands.h"

#include <string>
#include <vector>

namespace mergel::apps {

/// A number that is read of one localisation.
struct BandColumn {
  std::string name, unit; ///< "angle", "degree"
  double value;           ///< in this unit
};
std::vector<BandColumn> band_columns(const dem::Localisation& found, double d_50);

/// The four localisations of a record, with their names in the file.
struct NamedLocalisation {
  const char* name; ///< "shear strain"
  const dem::Localisation& found;
};
std::vector<NamedLocalisation> localisations(const coupling::BandRecord& record);

/// Headings of localisation.csv, "shear strain: angle [degree]" and so on.
std::vector<std::string> band_headings();
/// One line of it. @param d_50 [m]
std::vector<double> band_line(const coupling::BandRecord& record, double d_50,
                              const StageLabel& stage);

} // namespace mergel::apps

/// The summary of `mergel triaxial`, and what it needs of the records.
#pragma once

#include "apps/run/protocol.h"
#include "apps/triaxial/triaxial_case.h"
#include "coupling/triaxial/specimen_bands.h"
#include "dem/io/state/named_numbers.h"

namespace mergel::apps {

/// What the log and the summary need of a record.
struct TriaxialPoint {
  StagePoint analysed;
  double cell_pressure = 0.0; ///< [Pa]
  dem::SoilState whole;       ///< strains from the start of the test
};
TriaxialPoint point_of(const coupling::TriaxialRecord& r);
void save(dem::State& state, const std::vector<TriaxialPoint>& points);
std::vector<TriaxialPoint> load_points(const dem::State& state);

/// Largest values over all records, and the last ones.
struct TriaxialExtremes {
  double q = 0.0;                 ///< largest |q| [Pa]
  double platen_difference = 0.0; ///< largest difference of the platen stresses over the
      ///< largest q so far, once that is a tenth of the last [-]
  double energy_error = 0.0, inertial_number = 0.0, tilt = 0.0, stretch = 1.0;
  double own_load =
      0.0; ///< of the membrane, over the largest q so far or the cell pressure [-]
  double void_ratio = 0.0, penetration = 0.0,
         volumetric_strain = 0.0; ///< the last ones [-]

  void add(const coupling::TriaxialRecord& r);
};
dem::NumbersOf<TriaxialExtremes> numbers_of(TriaxialExtremes& e);
dem::NumbersOf<const TriaxialExtremes> numbers_of(const TriaxialExtremes& e);

/// Membrane and rate, for the log.
std::string describe(const TriaxialCase& c, const coupling::TriaxialTest& test);

/// Add the results to summary.json, and a line for each stage to the closing text.
void summarise(Summary& summary, const TriaxialCase& c, const coupling::TriaxialTest& test,
               const coupling::CoupledSystem& system,
               const std::vector<dem::Outcome>& outcomes,
               const std::vector<TriaxialPoint>& points,
               const std::vector<coupling::BandRecord>& bands,
               const TriaxialExtremes& extremes, const Work& work);

} // namespace mergel::apps

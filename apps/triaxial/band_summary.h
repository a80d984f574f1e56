/// What the summary of `mergel triaxial` says of bands: the last record of each stage, beside the
/// angles of Coulomb, Roscoe and Arthur.
#pragma once

#include "apps/run/summary.h"
#include "apps/triaxial/triaxial_summary.h"
#include "coupling/triaxial/specimen_bands.h"

#include <optional>
#include <vector>

namespace mergel::apps {

/// Mobilised friction angle without cohesion and dilation angle [rad] at one time of a stage.
struct MobilisedAngles {
  double phi = 0.0, psi = 0.0;
};

/// Those where the friction angle of a stage in triaxial compression is largest. The dilation
/// angle is that of the least-squares line of volumetric over axial strain within 0.2 % of axial
/// strain. None in extension, under tension, of fewer than three records, and where it is largest
/// at the first or the last record: that is no peak, but where somebody has unloaded or ended.
/// @param points of all records
std::optional<MobilisedAngles> angles_at_peak(const std::vector<TriaxialPoint>& points,
                                              std::size_t stage);
/// Those at the end of the stage; the line is over the last `increment` of axial strain.
std::optional<MobilisedAngles> angles_at_end(const std::vector<TriaxialPoint>& points,
                                             std::size_t stage, double increment);

/// Add "localisation" to summary.json, and lines for each stage that has a record to the closing
/// text. @param labels of all stages @param d_50 [m]
void summarise_bands(Summary& summary, const std::vector<coupling::BandRecord>& bands,
                     const std::vector<TriaxialPoint>& points,
                     const std::vector<StageLabel>& labels, double d_50);

} // namespace mergel::apps

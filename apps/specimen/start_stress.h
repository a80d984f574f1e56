/// The stress of a specimen where its test begins: for the log and the summary.
///
/// Bonds begin without load; the contacts of the packing act beside them from the start, so a
/// specimen that was made under pressure begins its test under it (dem/README.md, Specimens).
#pragma once

#include "apps/run/summary.h"
#include "dem/io/state/state_file.h"
#include "dem/notation.h"

#include <string>

namespace mergel::apps {

/// Stresses along x, y, z, compression positive, of a stress tensor, tension positive [Pa]. Of
/// no stress there are no minus signs.
inline dem::Vec3 along_axes(const dem::Mat3& sigma)
{
  return dem::Vec3::Zero() - sigma.diagonal();
}

/// A line for the log, in MPa. @param stress along x, y, z, compression positive [Pa]
/// @param where the part of the specimen that has this stress @param borne_by what bears it
std::string report_on_start(const dem::Vec3& stress, const std::string& where,
                            const std::string& borne_by);
/// That of a specimen as it was made.
inline constexpr const char* borne_by_contacts =
    "by its contacts: bonds begin without load";
/// That of one without bonds.
inline constexpr const char* borne_without_bonds = "by its contacts";

/// Add p, q and the three stresses, "p at the start [Pa]" and so on.
void add_start(Summary& summary, const dem::Vec3& stress);

/// Add the stress to a checkpoint, and read it.
void save_start(dem::State& state, const dem::Vec3& stress);
/// @throws InputError when it is missing: the checkpoint is of an earlier version
dem::Vec3 load_start(const dem::State& state);

} // namespace mergel::apps

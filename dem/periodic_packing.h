/// A small random packing in a periodic cube, for element tests without a specimen file.
#pragma once

#include "dem/packing.h"

namespace mergel::dem {

struct PeriodicPacking {
  Particles particles;
  PeriodicCell cell;
};

/// `n` spheres with diameters uniform in number, S times those of `spec`, at its porosity.
/// Points at random grow, overdamped and without friction, with their far-field shell until
/// no shell is closed by more than 1e-3 of the distance; numbered along x.
/// @throws InputError when the shells do not find room
PeriodicPacking pack_periodic(const SpecimenSpec& spec, double S, std::size_t n);

} // namespace mergel::dem

/// A small chamber of the paper's rock around a DEM region, for the far-field tests.
#pragma once

#include "fem/far_field/far_field.h"

/// 25 x 40 mm around 10 x 12 mm, coarse: a few hundred cells.
inline mergel::fem::FarFieldSpec small_chamber()
{
  mergel::fem::FarFieldSpec s;
  s.chamber_diameter = 25e-3;
  s.chamber_height = 40e-3;
  s.region_diameter = 10e-3;
  s.region_height = 12e-3;
  s.cell_size = 2e-3;
  s.E = 1.1e9;
  s.nu = 0.14;
  s.rho = 1227.0;
  s.K0 = 0.163;
  return s;
}

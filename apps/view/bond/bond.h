/// Results of `mergel bond`, read for drawing.
#pragma once

#include "apps/view/run_name.h"
#include "dem/io/table.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace mergel::apps {

/// The loads of a bond and the motions conjugate to them, by number.
enum Load : std::size_t { normal, shear, bending };

/// Strengths of the intact section under one load alone; all > 0.
struct BondStrengths {
  double tension = 0.0, compression = 0.0, shear_force = 0.0; ///< [N]
  double moment = 0.0;                                        ///< [N m]

  /// Of this load; of the normal load by its sign.
  double of(Load load, double sign) const
  {
    if (load == normal) return sign < 0.0 ? compression : tension;
    return load == shear ? shear_force : moment;
  }
  bool operator==(const BondStrengths&) const = default;
};

/// One run; every column has one value per step.
struct BondRun {
  RunName name;
  bool has_surface = false; ///< the damage bond; of the others only the loads are drawn
  BondStrengths strength;
  std::array<std::vector<double>, 3> motion; ///< u_n [m], u_s [m], theta [rad]
  std::array<std::vector<double>, 3> load;   ///< of the bond: N [N], V [N], M [N m]
  std::vector<double> D;                     ///< [-]
  std::vector<double> f_n;                   ///< of the contact beside it, >= 0 [N]
  std::vector<double> f_s;                   ///< of that contact, signed as V [N]

  std::size_t n_rows() const { return D.size(); }
  bool has_contact() const; ///< the contact had a force
  bool moves(Load load) const;
  bool bears(Load load) const; ///< more than round-off

  /// Radius of the bond [m]: moment strength sigma_t I/R_b = sigma_t A R_b/4.
  double radius() const { return 4.0 * strength.moment / strength.tension; }
};

/// Whether this is the history of a bond, not of a pile.
bool is_bond_history(const dem::Table& history);

/// @throws InputError naming the file and what is missing in it
BondRun read_bond_run(const std::filesystem::path& folder, const dem::Table& history,
                      const RunName& name);

} // namespace mergel::apps

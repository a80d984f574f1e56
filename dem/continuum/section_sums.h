/// Sums over the cells of a section grid, and averages of them: the continuum fields around a
/// pile (dem/README.md, Continuum fields).
///
/// Each rank adds its own particles and branches. The sums are exact (dem/math/exact_sum.h): the
/// same bits in any order, so on any number of ranks.
#pragma once

#include "dem/continuum/loaded_branches.h"
#include "dem/continuum/section_grid.h"

#include <array>
#include <optional>
#include <vector>

namespace mergel::dem {

/// What the owned particles carry into the cells, in their order.
struct ParticleValues {
  std::vector<Vec3> displacement, increment; ///< total, and since the last frame [m]
  std::vector<double> damage;                ///< mean of the bonds [-]
  std::vector<double> coordination;          ///< [-]
  std::vector<double> volumetric, shear;     ///< strain increments since the last frame [-]
};

/// Sums over one cell, or several.
struct SectionSum {
  double volume = 0.0;        ///< outside the pile [m^3]
  double solid = 0.0;         ///< of spheres; overlaps count twice [m^3]
  Mat3 virial = Mat3::Zero(); ///< F (x) r in the axes of the section [J]
  Vec3 displacement = Vec3::Zero(), increment = Vec3::Zero(); ///< times solid volume
  double damage = 0.0, coordination = 0.0, volumetric = 0.0, shear = 0.0; ///< the same
  double largest_R = 0.0; ///< of the spheres that reach in [m]

  SectionSum& operator+=(const SectionSum& b);
};

/// Principal stresses, compression positive, and the direction of the major one.
struct PrincipalStress {
  double major, intermediate, minor; ///< [Pa]
  Vec3 direction;                    ///< unit, z >= 0
};

/// Averages over one window.
struct SectionAverage {
  Mat3 stress =
      Mat3::Zero();      ///< symmetric part, tension positive, axes of the section [Pa]
  double porosity = 1.0; ///< [-]
  Vec3 displacement = Vec3::Zero(), increment = Vec3::Zero(); ///< mean over the solid [m]
  double damage = 0.0, coordination = 0.0, volumetric = 0.0, shear = 0.0; ///< the same

  double p() const { return -stress.trace() / 3.0; } ///< compression positive [Pa]
  double q() const;                                  ///< sqrt(3/2 dev : dev) [Pa], >= 0
  double void_ratio() const
  {
    return porosity / (1.0 - porosity);
  } ///< of a porosity below 1
  PrincipalStress principal() const;
};

/// Share of a window that spheres must fill to count as rock [-]: less is air or the pile.
inline constexpr double smallest_solid = 0.2;

/// The sums over one cell as they are collected. Solid volumes are in units of h^3, and so are the
/// weights of the others. Strains of debris may be large: their terms are below 1e18, of a quantum
/// of 9e-13.
struct ExactSectionSum {
  using Share = ExactSum<50>; ///< quantum 9e-16, terms below 1e15
  using Strain = ExactSum<40>;

  std::array<EnergySum, 9> virial; ///< by columns [J]
  Share solid, damage, coordination;
  ExactVector<Share> displacement, increment; ///< in units of h
  Strain volumetric, shear;
};

class SectionSums {
public:
  /// The share of this rank, of its own particles. Each branch adds F (x) r by its length in the
  /// cells that it crosses. Each sphere adds what of it lies in a cell: 280 points of a cubic
  /// lattice stand for its volume, those behind y = 0 are left out. Not collective.
  /// @param pile where it stands; null: none
  SectionSums(const SectionGrid& grid, const Particles& p,
              const std::vector<LoadedBranch>& branches, const ParticleValues& values,
              const RigidWall* pile);

  /// Add the shares of the other ranks: the whole sums on every rank. Once; collective.
  void add_ranks(const Communicator& comm);

  const SectionGrid& grid() const { return grid_; }
  const SectionSum& cell(int column, int row) const
  {
    return cells_[grid_.index(column, row)];
  }
  /// The cells within `reach` columns and rows of this one.
  SectionSum window(int column, int row, int reach) const;
  /// The cells whose middle lies at r_from <= |r| < r_to and z_from <= z < z_to [m], of both
  /// sides; to the right is outwards on both.
  SectionSum between(double r_from, double r_to, double z_from, double z_to) const;

  /// Whether the point at this distance from the axis, on either side, and height lies in the
  /// pile [m].
  bool is_in_pile(double r, double z) const;
  /// The window around a cell whose middle lies outside the pile, where there is rock in it. A
  /// window around a point of the pile may reach out of it by a sliver: a force over hardly any
  /// volume.
  std::optional<SectionSum> filled_window(int column, int row, int reach) const;
  /// Whether there is rock in the window.
  static bool is_filled(const SectionSum& sum)
  {
    return sum.volume > 0.0 && sum.solid >= smallest_solid * sum.volume;
  }
  /// @pre is_filled()
  static SectionAverage average(const SectionSum& sum);

private:
  void add(const LoadedBranch& b, const Vec3& x);
  /// @param k row of the particle
  void add(const ParticleState& b, std::size_t k, const ParticleValues& values);
  void round_sums();

  SectionGrid grid_;
  std::optional<RigidShape> pile_;
  double z_pile_ = 0.0;                ///< of its lowest point [m]
  std::vector<ExactSectionSum> exact_; ///< by cell; empty once the ranks are added
  std::vector<SectionSum> cells_;
};

} // namespace mergel::dem

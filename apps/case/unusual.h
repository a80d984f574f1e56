/// What a case may be and seldom is: a line each, with the number and the usual bound. Jobs say
/// it when they begin, and mergel check says it without a run.
#pragma once

#include "apps/case/case_file.h"
#include "apps/case/specimen_keys.h"

#include <string>
#include <vector>

namespace mergel::apps {

using Remarks = std::vector<std::string>;

/// Grains of the particles across a specimen or under a pile: fewer are seldom meant [-].
inline constexpr double fewest_across = 8.0;
/// Inertial number of a quasi-static test [-].
inline constexpr double quasi_static = 1e-3;

/// "8.4", with three digits.
std::string three_digits(double x);

/// "D_p/d50 = 2.3; usual is 8 or more": where the number is below the bound.
void expect_at_least(Remarks& remarks, const std::string& name, double value, double bound,
                     const std::string& why);
/// The same where it is above.
void expect_at_most(Remarks& remarks, const std::string& name, double value, double bound,
                    const std::string& why);

/// Median diameter of the particles at the smallest S [m].
double smallest_d_50(const SpecimenKeys& k);

/// Porosity, coordination, particles across the region, grain density.
void remark_on_specimen(Remarks& remarks, const SpecimenKeys& k);

/// The rotation constraint of particles without bonds (dem/README.md, Motion).
void remark_on_granular(Remarks& remarks, const SpecimenKeys& k);

/// Moduli against each other and against the strengths of the bonds.
void remark_on_materials(Remarks& remarks, const BondKeys& bond,
                         const ContactKeys& contact);

/// Strengths against each other, and the softening displacement against the particles.
void remark_on_bonds(Remarks& remarks, const BondKeys& bond, const SpecimenKeys& k);
/// Friction between particles, and the damping of their motion [-].
void remark_on_motion(Remarks& remarks, const ContactKeys& contact, double damping);

/// Refuse moduli and strengths that no rock has: a bond that would stretch by more than its
/// length before it breaks, a contact a million times stiffer or softer than the bonds.
/// @throws InputError naming file, line and key
void refuse_impossible(const CaseFile& file, const BondKeys& bond,
                       const ContactKeys& contact);

/// Refuse a bonded specimen whose contacts keep a pressure in a test where nothing confines it: one
/// that is packed `expanded`, or `confined` at more than half of what the rock bears in tension.
/// @throws InputError naming file, line and key
void refuse_kept_pressure(const CaseFile& file, const SpecimenKeys& k,
                          const BondKeys& bond);

/// Refuse a modulus [Pa] of this key that is a million times off that of the bonds.
/// @throws InputError naming file, line and key
void refuse_other_rock(const CaseFile& file, const std::string& section,
                       const std::string& key, double modulus, const BondKeys& bond);
/// Say that it is more than a thousand times off.
void remark_on_other_rock(Remarks& remarks, const std::string& name, double modulus,
                          const BondKeys& bond);

/// Each remark in a line of its own, after "unusual: ".
std::string lines_of(const Remarks& remarks);

} // namespace mergel::apps

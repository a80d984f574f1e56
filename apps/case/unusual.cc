#include "apps/case/unusual.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mergel::apps {

namespace {

/// Moduli of one rock that are further apart are a mistake in a unit [-].
constexpr double impossible_ratio = 1e6, unusual_ratio = 1e3;
/// Modulus over tensile strength of a bond [-]: rock breaks at strains of 1e-4 to 1e-2.
constexpr double softest_bond = 10.0, stiffest_bond = 1e6;
/// Tensile strength of the rock over that of its bonds, some [-].
constexpr double strength_of_rock = 1.0 / 20.0;
/// Contacts of a packing, bond gap included, that are reached [-].
constexpr double most_coordination = 8.0;
/// Volume fraction, shells included, of packings that hold together [-].
constexpr double loosest_fraction = 0.52;

/// Density of grains, from light ones such as pumice to ores [kg/m^3].
constexpr double lightest_grain = 500.0, heaviest_grain = 10000.0;
constexpr double largest_friction = 2.0;   // between particles [-]
constexpr double strongest_damping = 0.95; // [-]

double tensile_strength(const dem::BondLaw& bond)
{
  return std::visit(
      [](const auto& law) {
        const dem::BondShape<double> shape = bond_shape(law, 1.0, 1.0);
        return single_strengths(law, shape).tension / shape.A;
      },
      bond);
}

double ratio_apart(double a, double b)
{
  return std::max(a / b, b / a); // both > 0
}

std::string in_mpa(double x)
{
  return three_digits(1e-6 * x) + " MPa";
}

const char* modulus_key(const dem::ContactLaw& contact)
{
  return std::holds_alternative<dem::LinearMaterial>(contact) ? "effective modulus"
                                                              : "Young's modulus";
}

} // namespace

std::string three_digits(double x)
{
  std::ostringstream out;
  out.precision(3);
  out << x;
  return out.str();
}

void expect_at_least(Remarks& remarks, const std::string& name, double value, double bound,
                     const std::string& why)
{
  if (value < bound)
    remarks.push_back(name + " = " + three_digits(value) + "; usual is " +
                      three_digits(bound) + " or more: " + why);
}

void expect_at_most(Remarks& remarks, const std::string& name, double value, double bound,
                    const std::string& why)
{
  if (value > bound)
    remarks.push_back(name + " = " + three_digits(value) + "; usual is " +
                      three_digits(bound) + " or less: " + why);
}

double smallest_d_50(const SpecimenKeys& k)
{
  const dem::SpecimenSpec& s = k.specimen;
  return s.sizes.sieve(0.5) * std::min(s.scale.S_inner, s.scale.S_outer);
}

void remark_on_specimen(Remarks& remarks, const SpecimenKeys& k)
{
  const dem::SpecimenSpec& s = k.specimen;
  // The side of a half cylinder has two faces until the mesh around it is made.
  const double width = k.shape == SpecimenKeys::Shape::half_cylinder
                           ? std::min(0.5 * k.diameter, k.height)
                           : dem::smallest_width(s.region);
  expect_at_least(remarks, "width of the region/d50",
                  width / (s.sizes.sieve(0.5) * std::max(s.scale.S_inner, s.scale.S_outer)),
                  fewest_across, "so few particles are no continuum");
  expect_at_most(remarks, "Specimen/coordination", s.coordination, most_coordination,
                 "packings do not reach it");
  expect_at_least(remarks, "volume fraction of the particles with their far-field shells",
                  dem::effective_solid_fraction(s), loosest_fraction,
                  "at this porosity most of them touch nobody, and few are bonded; lower "
                  "`Specimen/porosity` or raise `Contact/activation gap`");
  const std::string density = "Specimen/grain density [kg/m3]";
  expect_at_least(remarks, density, s.rho, lightest_grain, "is a unit wrong?");
  expect_at_most(remarks, density, s.rho, heaviest_grain, "is a unit wrong?");
}

void remark_on_bonds(Remarks& remarks, const BondKeys& bond, const SpecimenKeys& k)
{
  const dem::BondLaw law = bond.chosen();
  const auto* b = std::get_if<dem::DamageBond>(&law);
  if (b == nullptr) return;
  expect_at_most(remarks, "Bond/tensile strength/compressive strength",
                 b->sigma_t / b->sigma_c, 1.0,
                 "cement is stronger in compression; are the two exchanged?");
  expect_at_most(
      remarks, "Bond/softening displacement/radius of the smallest particle",
      b->u_c / (0.5 * k.specimen.sizes.smallest()), 1.0,
      "such a bond is drawn out by more than a grain before it breaks; is a unit "
      "wrong?");
}

void remark_on_motion(Remarks& remarks, const ContactKeys& contact, double damping)
{
  expect_at_most(remarks, "Contact/friction", dem::friction(contact.chosen()),
                 largest_friction, "friction angles of grains are below 63 degrees");
  expect_at_most(remarks, "Motion/damping", damping, strongest_damping,
                 "the particles hardly follow their forces");
}

void remark_on_granular(Remarks& remarks, const SpecimenKeys& k)
{
  if (k.is_granular() && !k.specimen.free_rotation)
    remarks.push_back(
        "Motion/free rotation = false; usual without bonds is true: particles "
        "that do not spin reach friction angles beyond 45 degrees, round "
        "ones that spin some 20");
}

void remark_on_materials(Remarks& remarks, const BondKeys& bond, const ContactKeys& contact)
{
  const dem::BondLaw law = bond.chosen();
  const double E = dem::section(law).E, strength = tensile_strength(law);
  expect_at_least(remarks, "bond modulus/tensile strength", E / strength, softest_bond,
                  "rock breaks at strains of 1e-4 to 1e-2; is a unit wrong?");
  expect_at_most(remarks, "bond modulus/tensile strength", E / strength, stiffest_bond,
                 "rock breaks at strains of 1e-4 to 1e-2; is a unit wrong?");
  remark_on_other_rock(remarks, "contact", dem::modulus(contact.chosen()), bond);
}

void refuse_impossible(const CaseFile& file, const BondKeys& bond,
                       const ContactKeys& contact)
{
  const dem::BondLaw law = bond.chosen();
  const dem::ContactLaw far = contact.chosen();
  const double E = dem::section(law).E, strength = tensile_strength(law);
  // A strength of some moduli is a bond that does not break, and meant so. Of two that are too
  // far apart the one is wrong that no rock has.
  constexpr double softest_rock = 1e6; // [Pa]
  if (strength > impossible_ratio * E && E >= softest_rock)
    file.refuse("Bond", "tensile strength",
                "is more than a million times the modulus of the bonds, " + in_mpa(E) +
                    ". Is the unit right?");
  if (strength > impossible_ratio * E)
    file.refuse("Bond", "effective modulus",
                "is less than a millionth of the tensile strength of the bond, " +
                    in_mpa(strength) +
                    ". Are the units right? mPa is a thousandth of a pascal");
  refuse_other_rock(file, "Contact", modulus_key(far), dem::modulus(far), bond);
}

void refuse_kept_pressure(const CaseFile& file, const SpecimenKeys& k, const BondKeys& bond)
{
  const dem::SpecimenSpec& s = k.specimen;
  const std::string why =
      "the contacts of such a specimen keep their pressure, and nothing "
      "confines it in this test: its bonds would be torn ";
  if (s.compaction == dem::Compaction::expanded)
    file.refuse("Specimen", "packing", why + "at the start. Use `unjammed`");
  const double most = tensile_strength(bond.chosen()) * strength_of_rock / 2.0;
  if (s.compaction == dem::Compaction::confined && s.pressure > most)
    file.refuse(
        "Specimen", "target pressure",
        why + "before it is loaded: must be at most " + in_mpa(most) +
            ", half of what a rock of these bonds bears in tension; or use `packing = "
            "unjammed`");
}

void refuse_other_rock(const CaseFile& file, const std::string& section,
                       const std::string& key, double modulus, const BondKeys& bond)
{
  const double E = dem::section(bond.chosen()).E;
  if (ratio_apart(E, modulus) > impossible_ratio)
    file.refuse(section, key,
                "is more than a million times off the modulus of the bonds, " + in_mpa(E) +
                    ". Are the units right? mPa is a thousandth of a pascal");
}

void remark_on_other_rock(Remarks& remarks, const std::string& name, double modulus,
                          const BondKeys& bond)
{
  expect_at_most(remarks, "moduli of bond and " + name + ", the larger over the smaller",
                 ratio_apart(dem::section(bond.chosen()).E, modulus), unusual_ratio,
                 "is a unit wrong?");
}

std::string lines_of(const Remarks& remarks)
{
  std::string text;
  for (const std::string& remark : remarks) text += "unusual: " + remark + '\n';
  return text;
}

} // namespace mergel::apps

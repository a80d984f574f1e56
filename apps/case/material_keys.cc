#include "apps/case/material_keys.h"

#include "dem/text.h"

namespace mergel::apps {

void declare_law(CaseFile& file, dem::DamageBond& b)
{
  b.sigma_t = b.sigma_c = b.C = b.u_c = b.theta_c = unset;
  file.quantity("tensile strength", b.sigma_t, "Pa", positive, "sigma_t, Eq. 6.", "MPa");
  file.quantity("compressive strength", b.sigma_c, "Pa", positive, "sigma_c, Eq. 6.",
                "MPa");
  file.quantity("shear strength", b.C, "Pa", positive, "C, Eq. 6.", "MPa");
  file.quantity("softening displacement", b.u_c, "m", positive,
                "u_c at S = 1, Eq. 3; scales with S, Eq. 8.", "mm");
  file.quantity("softening rotation", b.theta_c, "rad", positive, "theta_c, Eq. 3.");
  file.choice("bending flow", b.flow,
              std::vector<std::pair<std::string, dem::BendingFlow>>{
                  {"conjugate", dem::BendingFlow::conjugate},
                  {"published", dem::BendingFlow::published}},
              "Plastic rotation: conjugate to M, or as Eq. 7 is printed.");
  file.former_name("broken at damage", "damage at breakage");
  file.number("damage at breakage", b.D_broken, inside(0.0, 1.0),
              "Damage at which a bond breaks.");
  file.choice("twist", b.twist,
              std::vector<std::pair<std::string, dem::Twist>>{
                  {"none", dem::Twist::none}, {"elastic", dem::Twist::elastic}},
              "Whether bonds resist twisting about their normal; the paper's do not.");
}

void declare_law(CaseFile& file, dem::ParallelBond& b)
{
  b.sigma_c = b.tau_c = unset;
  file.quantity("tensile strength", b.sigma_c, "Pa", positive,
                "Of the cement, compared with the largest tension over the section.",
                "MPa");
  file.quantity("shear strength", b.tau_c, "Pa", positive,
                "Of the cement, compared with the largest shear over the section.", "MPa");
}

void declare_law(CaseFile& file, dem::LinearMaterial& contact)
{
  contact.E = contact.kappa = contact.mu = contact.g_a = unset;
  file.quantity("effective modulus", contact.E, "Pa", positive,
                "Modulus of the far-field contact between particles.", "GPa");
  file.number("stiffness ratio", contact.kappa, positive, "Normal to shear stiffness.");
  file.number("friction", contact.mu, non_negative,
              "Friction coefficient between particles.");
  file.quantity("activation gap", contact.g_a, "m", non_negative,
                "Gap below which the contact acts, g_a at S = 1; scales with S, Eq. 8.",
                "mm");
}

void declare_law(CaseFile& file, dem::HertzMaterial& contact)
{
  contact.E = contact.nu = contact.mu = unset;
  file.quantity("Young's modulus", contact.E, "Pa", positive, "E of the grains.", "GPa");
  file.number("Poisson ratio", contact.nu, between(0.0, 0.5).named("nu"),
              "nu of the grains.");
  file.number("friction", contact.mu, non_negative,
              "Friction coefficient between particles.");
}

dem::BondLaw BondKeys::chosen() const
{
  return law.chosen([this](auto& bond) {
    const dem::Twist twist = bond.twist;
    static_cast<dem::BondSection&>(bond) = section;
    bond.twist = twist;
  });
}

void declare(CaseFile& file, BondKeys& b)
{
  const auto section = file.section("Bond");
  declare_choice(
      file, "bond law", b.law,
      "Damage-plasticity bond of the paper, or the elastic-brittle parallel bond "
      "of Potyondy and Cundall (2004).");
  b.section.E = b.section.kappa = unset;
  file.quantity("effective modulus", b.section.E, "Pa", positive,
                "Modulus of the bond, Eq. 4.", "GPa");
  file.number("stiffness ratio", b.section.kappa, positive,
              "Normal to shear stiffness, Eq. 4.");
  file.number("radius ratio", b.section.lambda_b, above_to(0.0, 1.0),
              "Bond radius over the smaller particle radius.");
  declare_laws(file, "bond law", b.law);
  file.not_needed_at_zero("Specimen", "coordination");
}

void declare(CaseFile& file, ContactKeys& contact)
{
  const auto section = file.section("Contact");
  declare_choice(file, "contact law", contact,
                 "Linear far-field contact of the paper, or the contact of elastic spheres "
                 "by Hertz and Mindlin.");
  declare_laws(file, "contact law", contact);
}

dem::ContactLaw wall_contact(const dem::ContactLaw& particles, double E, double mu)
{
  return dem::without_gap(dem::with_friction(dem::with_modulus(particles, E), mu));
}

namespace {

using Recipe = std::vector<std::pair<std::string, std::string>>;

Recipe recipe_of(const dem::LinearMaterial& c)
{
  return {{"contact modulus", dem::shortest(c.E) + " Pa"},
          {"contact stiffness ratio", dem::shortest(c.kappa)},
          {"contact friction", dem::shortest(c.mu)}};
}

Recipe recipe_of(const dem::HertzMaterial& c)
{
  return {{"contact law", dem::HertzMaterial::name},
          {"contact modulus", dem::shortest(c.E) + " Pa"},
          {"contact Poisson ratio", dem::shortest(c.nu)},
          {"contact friction", dem::shortest(c.mu)}};
}

} // namespace

std::vector<std::pair<std::string, std::string>> recipe(const dem::ContactLaw& contact)
{
  return std::visit([](const auto& law) { return recipe_of(law); }, contact);
}

} // namespace mergel::apps

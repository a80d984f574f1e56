#include "apps/case/material_keys.h"

namespace mergel::apps {

namespace {

void declare(CaseFile& file, dem::DamageBond& b)
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

void declare(CaseFile& file, dem::ParallelBond& b)
{
  b.sigma_c = b.tau_c = unset;
  file.quantity("tensile strength", b.sigma_c, "Pa", positive,
                "Of the cement, compared with the largest tension over the section.",
                "MPa");
  file.quantity("shear strength", b.tau_c, "Pa", positive,
                "Of the cement, compared with the largest shear over the section.", "MPa");
}

} // namespace

dem::BondLaw BondKeys::chosen() const
{
  const auto with_section = [&](auto bond) -> dem::BondLaw {
    const dem::Twist twist = bond.twist;
    static_cast<dem::BondSection&>(bond) = section;
    bond.twist = twist;
    return bond;
  };
  return law == Law::damage ? with_section(damage) : with_section(parallel);
}

void declare(CaseFile& file, BondKeys& b)
{
  const auto section = file.section("Bond");
  file.choice(
      "bond law", b.law,
      std::vector<std::pair<std::string, BondKeys::Law>>{
          {dem::DamageBond::name, BondKeys::Law::damage},
          {dem::ParallelBond::name, BondKeys::Law::parallel}},
      "Damage-plasticity bond of the paper, or the elastic-brittle parallel bond of "
      "Potyondy and Cundall (2004).");
  b.section.E = b.section.kappa = unset;
  file.quantity("effective modulus", b.section.E, "Pa", positive,
                "Modulus of the bond, Eq. 4.", "GPa");
  file.number("stiffness ratio", b.section.kappa, positive,
              "Normal to shear stiffness, Eq. 4.");
  file.number("radius ratio", b.section.lambda_b, above_to(0.0, 1.0),
              "Bond radius over the smaller particle radius.");
  {
    const auto only = file.only_if("bond law", {dem::DamageBond::name});
    declare(file, b.damage);
  }
  const auto only = file.only_if("bond law", {dem::ParallelBond::name});
  declare(file, b.parallel);
}

void declare(CaseFile& file, dem::LinearMaterial& contact)
{
  const auto section = file.section("Contact");
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

} // namespace mergel::apps

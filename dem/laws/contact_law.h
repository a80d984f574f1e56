/// The list of contact laws. To add one: a header beside this one, its name in the list
/// below, its keys in apps/case/material_keys.cc, and a test (dem/laws/README.md, Adding a
/// contact law). A missing function is a compile error.
#pragma once

#include "dem/laws/hertz.h"
#include "dem/laws/linear.h"

#include <concepts>
#include <variant>

namespace mergel::dem {

using ContactLaw = std::variant<LinearMaterial, HertzMaterial>;

/// What the force kernels need of a law: the gap at which it begins to act, its stiffness
/// for the time step, its normal force and energy, and one step of a batch of contacts. E is
/// a modulus and mu the friction, in any law.
// clang-format off
template <class Law>
concept IsContactLaw =
    requires(Law law, const ContactSides<Lanes>& many, const ContactSides<double>& sides,
             const Lanes& S, const ContactMotion<Lanes>& by,
             const ContactMotion<double>& by_one, double number)
{
  { Law::name } -> std::convertible_to<const char*>;
  law.check();
  { law.E } -> std::same_as<double&>;
  { law.mu } -> std::same_as<double&>;
  { modulus_at_rigid_wall(law) } -> std::same_as<double>;
  { without_gap(law) } -> std::same_as<Law>;
  { activation_gap(law) } -> std::same_as<double>;
  { contact_stiffness(law, many, S) } -> std::same_as<ContactStiffness<Lanes>>;
  { contact_stiffness(law, sides, number) } -> std::same_as<ContactStiffness<double>>;
  { normal_force(law, sides, number) } -> std::same_as<double>;
  { normal_force(law, many, S) } -> std::same_as<Lanes>;
  { contact_energy(law, sides, number, number) } -> std::same_as<double>;
  { contact_energy(law, many, S, S) } -> std::same_as<Lanes>;
  { contact_step(law, many, S, by) } -> std::same_as<ContactStep<Lanes>>;
  { contact_step(law, sides, number, by_one) } -> std::same_as<ContactStep<double>>;
};
// clang-format on
static_assert(IsContactLaw<LinearMaterial> && IsContactLaw<HertzMaterial>);

/// Gap below which a contact acts, at S = 1 [m]; it scales with S.
inline double activation_gap(const ContactLaw& law)
{
  return std::visit([](const auto& c) { return activation_gap(c); }, law);
}

inline ContactStiffness<double>
contact_stiffness(const ContactLaw& law, const ContactSides<double>& s, double overlap)
{
  return std::visit([&](const auto& c) { return contact_stiffness(c, s, overlap); }, law);
}

inline double normal_force(const ContactLaw& law, const ContactSides<double>& s,
                           double overlap)
{
  return std::visit([&](const auto& c) { return normal_force(c, s, overlap); }, law);
}

inline double contact_energy(const ContactLaw& law, const ContactSides<double>& s,
                             double overlap, double f_s_squared)
{
  return std::visit(
      [&](const auto& c) { return contact_energy(c, s, overlap, f_s_squared); }, law);
}

/// Overlap at which the stiffness of a contact that may close is estimated, over the
/// radius [-]; it matters to laws whose stiffness grows with the overlap.
inline constexpr double estimated_overlap = 0.02;

inline double modulus_at_rigid_wall(const ContactLaw& law)
{
  return std::visit([](const auto& c) { return modulus_at_rigid_wall(c); }, law);
}
inline double friction(const ContactLaw& law)
{
  return std::visit([](const auto& c) { return c.mu; }, law);
}
inline double modulus(const ContactLaw& law)
{
  return std::visit([](const auto& c) { return c.E; }, law);
}

/// The law with another modulus, or another friction.
inline ContactLaw with_modulus(ContactLaw law, double E)
{
  std::visit([&](auto& c) { c.E = E; }, law);
  return law;
}
inline ContactLaw with_friction(ContactLaw law, double mu)
{
  std::visit([&](auto& c) { c.mu = mu; }, law);
  return law;
}
/// The law without an activation gap: surfaces must touch.
inline ContactLaw without_gap(const ContactLaw& law)
{
  return std::visit([](const auto& c) -> ContactLaw { return without_gap(c); }, law);
}

inline void check(const ContactLaw& law)
{
  std::visit([](const auto& c) { c.check(); }, law);
}

} // namespace mergel::dem

// A third contact law compiles where it is handled, and only there (third_law.cmake).
#include "apps/case/law_keys.h"
#include "dem/laws/contact_law.h"

namespace mergel::dem {

/// A linear spring between touching surfaces, without friction.
struct ThirdContact {
  static constexpr const char* name = "third";
  double E = 0.0, mu = 0.0;
  void check() const {}
};
inline ThirdContact without_gap(const ThirdContact& c)
{
  return c;
}
inline double modulus_at_rigid_wall(const ThirdContact& c)
{
  return c.E;
}
inline double activation_gap(const ThirdContact&)
{
  return 0.0;
}
template <class Real>
ContactStiffness<Real> contact_stiffness(const ThirdContact& c, const ContactSides<Real>& s,
                                         const Real&)
{
  return {c.E * s.r, c.E * s.r};
}
template <class Real>
Real normal_force(const ThirdContact& c, const ContactSides<Real>& s, const Real& overlap)
{
  return c.E * s.r * overlap;
}
template <class Real>
Real contact_energy(const ThirdContact& c, const ContactSides<Real>& s, const Real& overlap,
                    const Real&)
{
  return 0.5 * c.E * s.r * overlap * overlap;
}

#ifdef HAS_FUNCTIONS
template <class Real>
ContactStep<Real> contact_step(const ThirdContact& c, const ContactSides<Real>& s,
                               const Real&, const ContactMotion<Real>& by)
{
  return {select(by.gap < Real{}, -(c.E * s.r * by.gap), Real{}), {}, Real{}};
}
#endif
static_assert(IsContactLaw<ThirdContact>);

} // namespace mergel::dem

namespace mergel::apps {

void declare_law(CaseFile& file, dem::LinearMaterial& contact);
void declare_law(CaseFile& file, dem::HertzMaterial& contact);
#ifdef HAS_KEYS
void declare_law(CaseFile& file, dem::ThirdContact& contact);
#endif

void declare_all(CaseFile& file)
{
  LawKeys<std::variant<dem::LinearMaterial, dem::HertzMaterial, dem::ThirdContact>> keys;
  declare_laws(file, "contact law", keys);
}

} // namespace mergel::apps

#include "tests/support/catch.h"
#include "tests/support/dem_scene.h"

using namespace mergel::dem;
using namespace mergel::dem::test;

namespace {

const LinearMaterial law = contact(0.63e9, 2.4, 0.38, 1e-5);
const ContactSides<double> sides = sides_of_pair(1e-4, 1e-4);
const auto k = contact_stiffness(law, sides, 0.0);

ContactStep<double> slide(double gap, double du, const Vec3& f_old)
{
  return contact_step(law, sides, 1.0,
                      {gap, 0.0, Triple<double>{0.0, du, 0.0}, triple(f_old)});
}

} // namespace

TEST_CASE("A contact sticks below mu f_n and slips at it", "[unit][dem]")
{
  CHECK(k.k_n == Approx(0.63e9 * pi * 1e-8 * 0.5e4));
  CHECK(k.k_s == Approx(k.k_n / 2.4));
  const double gap = -2e-6, f_n = k.k_n * 1.2e-5, limit = law.mu * f_n;
  const double du_stick = 0.999 * limit / k.k_s;

  const auto stick = slide(gap, du_stick, Vec3::Zero());
  CHECK(stick.f_n == Approx(f_n).epsilon(1e-14));
  CHECK(stick.f_s.y == Approx(k.k_s * du_stick).epsilon(1e-14));
  CHECK(stick.slip_loss == 0.0);

  const auto slip = slide(gap, 3.0 * limit / k.k_s, Vec3::Zero());
  CHECK(slip.f_s.y == Approx(limit).epsilon(1e-14));
  // trapezoidal work limit/2 * 3 limit/k_s less the stored limit^2/(2 k_s)
  CHECK(slip.slip_loss == Approx(limit * limit / k.k_s).epsilon(1e-12));

  const auto on = slide(gap, limit / k.k_s, {0.0, limit, 0.0}); // already sliding
  CHECK(on.f_s.y == Approx(limit).epsilon(1e-14));
  CHECK(on.slip_loss == Approx(limit * limit / k.k_s).epsilon(1e-12));
}

TEST_CASE("The slipping force keeps the direction of its trial", "[unit][dem]")
{
  const double limit = law.mu * k.k_n * 1.2e-5;
  const auto c = slide(-2e-6, 5.0 * limit / k.k_s, {4.0 * limit, 0.0, 0.0});
  CHECK(std::hypot(c.f_s.x, c.f_s.y) == Approx(limit).epsilon(1e-14));
  CHECK(c.f_s.y / c.f_s.x == Approx(5.0 / 4.0).epsilon(1e-13));
}

TEST_CASE("A contact acts below its activation gap and loses its shear force when it opens",
          "[unit][dem]")
{
  CHECK(slide(law.g_a, 0.0, Vec3::Zero()).f_n == 0.0);
  CHECK(slide(0.999999 * law.g_a, 0.0, Vec3::Zero()).f_n > 0.0);
  CHECK(slide(0.0, 0.0, Vec3::Zero()).f_n == Approx(k.k_n * law.g_a).epsilon(1e-14));
  const Vec3 f_old(0.0, 1e-3, 0.0);
  const auto open = slide(1.1 * law.g_a, 0.0, f_old);
  CHECK(open.f_s.y == 0.0);
  CHECK(open.slip_loss == Approx(0.5 * f_old.squaredNorm() / k.k_s).epsilon(1e-14));
}

TEST_CASE("Contact parameters out of range are refused", "[unit][dem]")
{
  CHECK_NOTHROW(law.check());
  CHECK_THROWS_AS(contact(0.0, 1.0, 0.1, 0.0).check(), mergel::InputError);
  CHECK_THROWS_AS(contact(1.0, 0.0, 0.1, 0.0).check(), mergel::InputError);
  CHECK_THROWS_AS(contact(1.0, 1.0, -0.1, 0.0).check(), mergel::InputError);
  CHECK_THROWS_AS(contact(1.0, 1.0, 0.1, -1e-9).check(), mergel::InputError);
  CHECK_THROWS_AS(contact(std::nan(""), 1.0, 0.1, 0.0).check(), mergel::InputError);
}

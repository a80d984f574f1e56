#include "tests/support/catch.h"

#include "apps/case/material_keys.h"
#include "dem/error.h"

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

dem::ContactLaw contact_of(const std::string& keys)
{
  CaseFile file;
  ContactKeys contact;
  declare(file, contact);
  file.read_text("subsection Contact\n" + keys + "end\n", "case");
  return contact.chosen();
}

} // namespace

TEST_CASE("The contact law is linear unless the case chooses Hertz", "[unit][apps]")
{
  const std::string linear = "set effective modulus = 0.63 GPa\nset stiffness ratio = 2.4\n"
                             "set friction = 0.3\nset activation gap = 0.01 mm\n";
  const auto far = std::get<dem::LinearMaterial>(contact_of(linear));
  CHECK(far.E == 0.63e9);
  CHECK(far.kappa == 2.4);
  CHECK(far.mu == 0.3);
  CHECK(far.g_a == Approx(1e-5).epsilon(1e-14));

  const std::string hertz = "set contact law = hertz\nset Young's modulus = 70 GPa\n"
                            "set Poisson ratio = 0.3\nset friction = 0.4\n";
  const auto spheres = std::get<dem::HertzMaterial>(contact_of(hertz));
  CHECK(spheres.E == 70e9);
  CHECK(spheres.nu == 0.3);
  CHECK(spheres.mu == 0.4);

  // A key of the other law has no effect, and one of the chosen law has no default.
  CHECK_THROWS_WITH(contact_of(hertz + "set activation gap = 0.01 mm\n"),
                    Contains("is a key of `contact law` = linear; here it is hertz"));
  CHECK_THROWS_WITH(contact_of("set contact law = hertz\nset friction = 0.4\n"),
                    Contains("Young's modulus"));
  CHECK_THROWS_WITH(contact_of(linear + "set contact law = hooke\n"), Contains("hooke"));
}

TEST_CASE("A wall contact is the particles' with its own modulus and friction",
          "[unit][apps]")
{
  const auto linear = std::get<dem::LinearMaterial>(
      wall_contact(dem::LinearMaterial{1e9, 2.4, 0.3, 1e-5}, 5e9, 0.1));
  CHECK(linear.E == 5e9);
  CHECK(linear.kappa == 2.4);
  CHECK(linear.mu == 0.1);
  CHECK(linear.g_a == 0.0); // surfaces must touch
  const auto hertz = std::get<dem::HertzMaterial>(
      wall_contact(dem::HertzMaterial{1e9, 0.2, 0.3}, 5e9, 0.1));
  CHECK(hertz.E == 5e9);
  CHECK(hertz.nu == 0.2);
  CHECK(hertz.mu == 0.1);
}

TEST_CASE("The recipe of a specimen under pressure names the contact law", "[unit][apps]")
{
  CHECK(recipe(dem::LinearMaterial{1e9, 2.4, 0.3, 1e-5}) ==
        std::vector<std::pair<std::string, std::string>>{{"contact modulus", "1e+09 Pa"},
                                                         {"contact stiffness ratio", "2.4"},
                                                         {"contact friction", "0.3"}});
  CHECK(recipe(dem::HertzMaterial{1e9, 0.2, 0.3}).front() ==
        std::pair<std::string, std::string>{"contact law", "hertz"});
}

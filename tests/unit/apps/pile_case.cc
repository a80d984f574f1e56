#include "apps/pile/pile_case.h"
#include "apps/coupled/system_of_case.h"
#include "tests/support/catch.h"
#include "tests/support/repository.h"
#include "tests/support/shipped_case.h"
#include "tests/support/temporary_folder.h"

#include <fstream>
#include <iterator>

using namespace mergel;
using namespace mergel::apps;

namespace {

const std::filesystem::path cases = mergel::test::repository() / "apps/cases";

PileCase read_case(const char* name, const std::vector<std::string>& set = {})
{
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read(cases / name, set);
  complete(file, c);
  return c;
}

std::string refusal(const std::vector<std::string>& set)
{
  try {
    read_case("pile_small.prm", set);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

} // namespace

TEST_CASE("both cases of the pile have the paper's rock, Table 1", "[unit][apps]")
{
  for (const char* name : {"pile_small.prm", "pile_paper.prm"}) {
    const PileCase c = read_case(name);
    const auto& b = std::get<dem::DamageBond>(c.assembly.material.bond);
    const double d00 = 0.066e-3;
    CHECK(b.E == 22.5e9);
    CHECK(b.kappa == 2.4);
    CHECK(b.sigma_t == 36e6);
    CHECK(b.sigma_c == 198e6);
    CHECK(b.C == 40.5e6);
    CHECK(b.u_c == Approx(0.061 * d00).epsilon(1e-12));
    CHECK(b.theta_c == 0.04);
    CHECK(b.flow == dem::BendingFlow::published);
    const auto& far = std::get<dem::LinearMaterial>(c.assembly.material.contact);
    CHECK(far.g_a == Approx(0.15 * d00).epsilon(1e-12));
    CHECK(c.assembly.specimen.g_b == Approx(0.4 * d00).epsilon(1e-12));
    CHECK(far.E == 0.63e9);
    CHECK(far.mu == 0.3);
  }
}

TEST_CASE("pile_paper is Table 4: sizes, 9 particles per diameter, 195,000 particles",
          "[unit][apps]")
{
  PileCase c = read_case("pile_paper.prm");
  CHECK(c.assembly.far_field.chamber_diameter == 50e-3);
  CHECK(c.assembly.far_field.chamber_height == 100e-3);
  CHECK(c.assembly.diameter == 20e-3);
  CHECK(c.assembly.height == 40e-3);
  CHECK(c.diameter == 1.4e-3);
  CHECK(c.final_depth == 6.0 * c.diameter);
  CHECK(c.velocity == 1.35);
  // D_p/d50 = 9 along the pile: the mean diameter by number is 0.0999 mm at S = 1.
  const double d50 = c.assembly.specimen.sizes.diameter(0.5);
  CHECK(c.diameter / (c.assembly.specimen.scale.at(0.0) * d50) ==
        Approx(9.0).epsilon(0.05));
  // The number of particles follows from volume, porosity and S(r): 195,000 in the paper.
  double n = 0.0;
  const double dr = 1e-6;
  for (double r = 0.5 * dr; r < 0.5 * c.assembly.diameter; r += dr)
    n +=
        dem::pi * r * dr * c.assembly.height / std::pow(c.assembly.specimen.scale.at(r), 3);
  const double v_1 = dem::pi / 6.0 * std::pow(0.1035e-3, 3);
  CHECK(n * (1.0 - 0.52) / v_1 == Approx(195e3).epsilon(0.03));
}

TEST_CASE("keys that contradict each other are named with a remedy", "[unit][apps]")
{
  CHECK(refusal({"Pile/diameter=20 mm"}) ==
        "--set Pile/diameter = 20 mm: the pile is wider than the DEM region: must be below "
        "`Specimen/diameter`, 10 mm; bonds break up to some two diameters from the axis");
  CHECK(refusal({"Specimen/diameter=30 mm"})
            .find("--set Specimen/diameter = 30 mm: the DEM region does not fit the far "
                  "field") == 0);
  CHECK(
      refusal({"Pile/final depth=11 mm"}).find("--set Pile/final depth = 11 mm: the tip") ==
      0);
  CHECK(refusal({"Specimen/porosity=0.2"})
            .find("--set Specimen/porosity = 0.2: must be at least 0.479") == 0);
  CHECK(refusal({"Specimen/largest diameter=0.01 mm"}) != "");
}

TEST_CASE(
    "a flat pile has no cone: its shaft begins at the tip, and a cone angle is refused",
    "[unit][apps]")
{
  // The shipped case has a cone angle, which a flat pile cannot have.
  CHECK(refusal({"Pile/tip=flat"}).find("cone angle") != std::string::npos);

  std::ifstream in(cases / "pile_small.prm");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto line = text.find("set cone angle");
  text.erase(line, text.find('\n', line) - line);
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read_text(text, (cases / "pile_small.prm").string(), {"Pile/tip=flat"});
  complete(file, c);
  CHECK(c.tip == PileCase::Tip::flat);
  CHECK(c.tip_height() == 0.0);
  CHECK(c.travel() == c.final_depth);
}

namespace {

PileCase read_text_of(const std::string& text)
{
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read_text(text, "case");
  complete(file, c);
  return c;
}

} // namespace

TEST_CASE("moduli, friction and lengths that a pile case leaves out follow from its rock",
          "[unit][apps]")
{
  const std::string text = mergel::test::without(
      "pile_small.prm", {"contact modulus", "interface modulus", "interface friction",
                         "collar height", "K0", "record every"});
  const PileCase c = read_text_of(text);
  CHECK(dem::modulus(c.contact) == 1.26e9); // 2 x 0.63 GPa, that of the paper
  CHECK(dem::modulus(c.assembly.interface) == 0.63e9);
  CHECK(dem::friction(c.assembly.interface) == 0.3);
  CHECK(c.assembly.collar_height == 2e-3);
  CHECK(c.assembly.far_field.K0 == 0.14 / (1.0 - 0.14));
  CHECK(c.record_every == Approx(0.014e-3).epsilon(1e-15));

  // of another rock
  std::string other = text;
  for (const auto& [old, fresh] :
       {std::pair{"set effective modulus = 0.63 GPa", "set effective modulus = 2 GPa"},
        {"set friction          = 0.3", "set friction = 0.5"},
        {"= 0.14\n", "= 0.25\n"}})
    other.replace(other.find(old), std::string(old).size(), fresh);
  const PileCase stiff = read_text_of(other);
  CHECK(dem::modulus(stiff.contact) == 4e9);
  CHECK(dem::modulus(stiff.assembly.interface) == 2e9);
  CHECK(dem::friction(stiff.assembly.interface) == 0.5);
  CHECK(stiff.assembly.far_field.K0 == 1.0 / 3.0);
}

TEST_CASE("the far field takes E and nu from the results of an element test, unless given",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  const std::filesystem::path test = folder.path;
  // The first stage has no Poisson's ratio.
  std::ofstream(test / "summary.json")
      << "{\n  \"stages\": [\n    {\n      \"stage\": \"tension\",\n"
         "      \"Young's modulus [Pa]\": 2e9\n    },\n    {\n"
         "      \"stage\": \"compression\",\n      \"Young's modulus [Pa]\": 1.05e9,\n"
         "      \"Poisson's ratio [-]\": 0.2\n    }\n  ],\n"
         "  \"time step [s]\": 1e-7\n}\n";
  const std::string text =
      mergel::test::without("pile_small.prm", {"Young's modulus", "Poisson ratio", "K0"});
  const std::string from =
      "subsection Far field\n set elasticity from = " + test.string() + "\nend\n";
  const PileCase c = read_text_of(text + from);
  CHECK(c.assembly.far_field.E == 1.05e9);
  CHECK(c.assembly.far_field.nu == 0.2);
  CHECK(c.assembly.far_field.K0 == 0.2 / (1.0 - 0.2));
  const std::string matched = report_on_impedance(c.assembly);
  CHECK(matched.find("ratio 1\n") != std::string::npos);
  CHECK(matched.find("warning") == std::string::npos);

  // With another E beside it the impedances differ: sqrt(1.05/2.1).
  const PileCase other = read_text_of(text + from +
                                      "subsection Far field\n set Young's modulus = 2.1 "
                                      "GPa\n set Poisson ratio = 0.2\nend\n");
  CHECK(other.assembly.far_field.E == 2.1e9);
  const std::string unmatched = report_on_impedance(other.assembly);
  CHECK(unmatched.find("ratio 0.707\n") != std::string::npos);
  CHECK(unmatched.find("warning: rock and far field differ") != std::string::npos);

  // A folder without a measured E is refused, one that is gone where the case lacks numbers.
  const auto refused = [&](const std::string& what) -> std::string {
    try {
      read_text_of(text + what);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  using mergel::match::Contains;
  CHECK_THAT(refused(""), Contains("Far field/Young's modulus: must be given, or "
                                   "`elasticity from` names the results folder"));
  std::ofstream(test / "resolved.prm") << "subsection Platens\nend\n";
  CHECK_THAT(refused(from), Contains("is a run of mergel triaxial. Name the results"));
  std::ofstream(test / "resolved.prm")
      << "subsection Specimen\nend\nsubsection Loading\nend\n";
  CHECK(read_text_of(text + from).assembly.far_field.E == 1.05e9);
  std::filesystem::remove(test / "summary.json");
  CHECK_THAT(refused(from),
             Contains("Far field/elasticity from = ") && Contains("has no summary.json"));
  std::ofstream(test / "summary.json") << "{\n  \"stages\": []\n}\n";
  CHECK_THAT(refused(from), Contains("has no stage with Young's modulus"));
}

TEST_CASE(
    "surcharge and side pressure reach the far field; each is refused where it is void",
    "[unit][apps]")
{
  const PileCase c = read_case("pile_small.prm", {"Far field/surcharge=200 kPa",
                                                  "Far field/outer boundary=pressure",
                                                  "Far field/side pressure=0.1 MPa"});
  CHECK(c.assembly.surcharge == Approx(2e5));
  CHECK(c.assembly.far_field.surcharge == c.assembly.surcharge);
  CHECK(c.assembly.far_field.side_pressure == Approx(1e5));
  CHECK(read_case("pile_small.prm").assembly.far_field.surcharge == 0.0);

  using mergel::match::Contains;
  CHECK_THAT(refusal({"Far field/outer boundary=pressure"}),
             Contains("Far field/side pressure: must be given"));
  CHECK_THAT(refusal({"Far field/side pressure=1 MPa"}),
             Contains("Far field/side pressure"));
  CHECK_THAT(refusal({"Far field/surcharge=-1 kPa"}),
             Contains("Far field/surcharge = -1 kPa"));
  CHECK_THAT(refusal({"Far field/surcharge=1"}), Contains("has no unit"));
}

TEST_CASE("held walls need no modulus and carry no stress", "[unit][apps]")
{
  const std::string text =
      mergel::test::without("pile_small.prm", {"Young's modulus", "Poisson ratio", "K0"});
  const PileCase c = read_text_of(text + "subsection Far field\n set model = rigid\nend\n");
  CHECK(c.assembly.far_field.gravity == 0.0);
  CHECK(c.assembly.gravity == Approx(9.81).epsilon(1e-3)); // of the particles
}

/// Several tests read together: what is read off each, which belong together, which make a
/// line.
#include "apps/compare/test_columns.h"
#include "apps/compare/tests_table.h"
#include "apps/laboratory/test_series.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <boost/property_tree/json_parser.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

struct Record {
  int stage;
  double strain, strain_of_stage, p, q, e;
  int part = 0; // 1 unloading, 2 reloading
};

/// The history of an element test.
dem::Table history(const std::vector<Record>& records)
{
  dem::Table t;
  t.file = "history.csv";
  t.n_rows = records.size();
  const auto column = [&](const char* name, const char* unit, auto&& of) {
    dem::TableColumn c{name, unit, {}};
    for (const Record& r : records) c.values.push_back(of(r));
    t.columns.push_back(std::move(c));
  };
  column("stage", "-", [](const Record& r) { return double(r.stage); });
  column("part", "-", [](const Record& r) { return double(r.part); });
  column("axial strain", "-", [](const Record& r) { return r.strain; });
  column("axial strain of the stage", "-",
         [](const Record& r) { return r.strain_of_stage; });
  column("p", "Pa", [](const Record& r) { return r.p; });
  column("q", "Pa", [](const Record& r) { return r.q; });
  column("void ratio", "-", [](const Record& r) { return r.e; });
  t.lines.resize(records.size());
  return t;
}

/// Consolidated to sigma_3, then sheared along q(strain) to 20 %; the void ratio falls from
/// 1.1 by e_rate times the strain.
template <class Q>
std::vector<Record> sheared(double sigma_3, Q&& q_of, double e_rate)
{
  constexpr double start = 1e-3; // strain of the consolidation
  std::vector<Record> records{{1, 0.0, 0.0, 0.0, 0.0, 1.1},
                              {1, start, start, sigma_3, 0.0, 1.1}};
  for (int k = 0; k <= 200; ++k) {
    const double e = 1e-3 * k, q = q_of(e);
    records.push_back(
        {2, 1.0 - (1.0 - start) * (1.0 - e), e, sigma_3 + q / 3.0, q, 1.1 - e_rate * e});
  }
  return records;
}

/// To `peak` at 0.4 %, down to `end` at 2 %, constant from there.
auto softening(double peak, double end)
{
  return [=](double e) {
    if (e <= 4e-3) return peak * e / 4e-3;
    return e >= 0.02 ? end : peak + (end - peak) * (e - 4e-3) / 0.016;
  };
}

TestCase test_case(const std::string& seed = "1", const std::string& p = "1")
{
  return test_case_of(
      "subsection Specimen\n  set seed = " + seed + "\n  set file = /made/with/seed_" +
          seed + "/sample.h5\nend\nsubsection Loading\n  set stage 1 = isotropic to p = " +
          p + " MPa\n  set stage 2 = triaxial to axial strain = 20 %\nend\n",
      "resolved.prm");
}

/// A softening test at this pressure [MPa] on the Coulomb line of c = 1 MPa, phi = 30 degrees
/// (N = 3) at the peak, and of c = 0 and N = 3.5 at the end.
TestReading test_at(double sigma_3, const std::string& seed = "1", double more = 0.0)
{
  const double peak = 2e6 * std::sqrt(3.0) + 2.0 * sigma_3 * 1e6, end = 2.5 * sigma_3 * 1e6;
  std::ostringstream p;
  p << sigma_3;
  TestReading r =
      reading_of(history(sheared(sigma_3 * 1e6, softening(peak + more, end), 0.2)),
                 test_case(seed, p.str()), {});
  r.label = p.str() + "_" + seed;
  return r;
}

} // namespace

TEST_CASE("Peak, minimum and end are those of the sheared stage, strains from its start",
          "[unit][apps]")
{
  RunFindings found;
  found.stages[2].add("Young's modulus [Pa]", 1.1e9);
  found.stages[2].add("strain at yield [-]", 3e-3);
  const TestReading r =
      reading_of(history(sheared(1e6, softening(4e6, 2e6), 0.2)), test_case(), found);
  CHECK(r.kind == TestKind::triaxial);
  CHECK(r.stage == 2);
  CHECK(r.confinement == Approx(1e6));
  CHECK(r.E == 1.1e9);
  CHECK(std::isnan(r.nu));
  REQUIRE(r.yield);
  CHECK(r.yield->q == Approx(3e6));
  CHECK(r.yield->p == Approx(2e6));
  REQUIRE(r.peak);
  CHECK(r.peak->q == Approx(4e6));
  CHECK(r.peak->strain == Approx(4e-3));
  CHECK(r.minimum->q == Approx(2e6));
  CHECK(r.peak->circle().sigma_3 == Approx(1e6));
  CHECK(r.peak->circle().sigma_1 == Approx(5e6));
  CHECK(r.end.q == Approx(2e6));
  CHECK(r.end.strain == Approx(0.19)); // mean over the last tenth
  CHECK(r.end.e == Approx(1.1 - 0.2 * 0.19));
  CHECK(r.end_strain == Approx(0.2));
  // de = -0.2 d(strain), over 1 + e at 17 %
  CHECK(r.volume_rate == Approx(0.2 / (2.1 - 0.2 * 0.17)).epsilon(1e-2));
  CHECK(r.not_critical.empty());
}

TEST_CASE("A test that hardens has a largest q and no peak", "[unit][apps]")
{
  const auto hardening = [](double e) {
    return 5e6 * (e < 0.1 ? e / 0.1 : 1.0 - 0.9 * (e - 0.1));
  };
  const TestReading r = reading_of(history(sheared(4e6, hardening, 0.2)), test_case(), {});
  CHECK_FALSE(r.peak); // falls by no tenth: 5 MPa to 4.55
  CHECK(r.largest->q == Approx(5e6));
  CHECK_FALSE(r.is_finished);
  CHECK_FALSE(r.yield);
}

TEST_CASE("The end is no critical state where q/p still changes, or the test is short",
          "[unit][apps]")
{
  const auto rising = [](double e) { return 1e6 + 50e6 * e; };
  const TestReading changes =
      reading_of(history(sheared(4e6, rising, 0.0)), test_case(), {});
  CHECK_THAT(changes.not_critical, Contains("q/p changes by 5.6 %"));

  std::vector<Record> records = sheared(1e6, softening(4e6, 2e6), 0.0);
  records.resize(2 + 51);
  CHECK_THAT(reading_of(history(records), test_case(), {}).not_critical,
             Contains("ends at 5 % of axial strain"));

  const TestReading free =
      reading_of(history(sheared(0.0, softening(4e6, 0.1e6), 0.0)), test_case(), {});
  CHECK(free.kind == TestKind::unconfined);
  CHECK(free.not_critical == "unconfined");
}

TEST_CASE("Loops of unloading are left out of a reading, and unload-reload is one stage",
          "[unit][apps]")
{
  const TestCase c =
      test_case_of("subsection Loading\n  set stage 1 = triaxial to axial strain = 1 %\n"
                   "  set stage 2 = unload-reload to q = 0 MPa\n  set stage 3 = resume to "
                   "axial strain = 2 %\n"
                   "  set stage 4 =\nend\n",
                   "resolved.prm");
  CHECK(c.stages.size() == 3);
  CHECK(test_case_of("subsection Loading\n  set stage 1 = triaxial to axial strain = 1 %\n"
                     "  set stage 2 = unload-reload to q = 0 MPa, 3 times\nend\n",
                     "resolved.prm")
            .stages.size() == 2);
  dem::Table table = history({{1, 0, 0, 1e6, 0, 1},
                              {1, 0.01, 0.01, 2e6, 3e6, 1},
                              {2, 0.008, 0.008, 1e6, 0, 1, 1}, // not a fall of q
                              {2, 0.01, 0.01, 2e6, 3e6, 1, 2},
                              {3, 0.02, 0.02, 3e6, 6e6, 1}});
  const TestReading r = reading_of(table, c, {});
  CHECK(r.curve.size() == 3);
  CHECK_FALSE(r.peak);
  CHECK(r.end_strain == Approx(0.02));

  // Reloading rejoins a third lower: that is no peak of q either.
  const TestReading lower = reading_of(history({{1, 0, 0, 1e6, 0, 1},
                                                {1, 0.01, 0.01, 2e6, 3e6, 1},
                                                {2, 0.008, 0.008, 1e6, 0, 1, 1},
                                                {2, 0.01, 0.01, 1.67e6, 2e6, 1, 2},
                                                {3, 0.011, 0.011, 1.8e6, 2.4e6, 1},
                                                {3, 0.02, 0.02, 3e6, 6e6, 1}}),
                                       c, {});
  CHECK(lower.loops == std::vector<std::size_t>{2});
  CHECK_FALSE(lower.peak);
  CHECK(lower.largest->q == Approx(6e6));

  // Ten cycles, each of which goes on a little beyond the one before, at less stress.
  std::vector<Record> records{{1, 0, 0, 1e6, 0, 1}, {1, 0.01, 0.01, 2e6, 3e6, 1}};
  for (int k = 1; k <= 10; ++k) {
    const double strain = 0.01 + 1e-4 * k, q = 3e6 - 0.1e6 * k;
    records.push_back({2, 0.008, 0.008, 1e6, 0, 1, 1});
    records.push_back({2, strain, strain, 1e6 + q / 3.0, q, 1, 2});
  }
  records.push_back({3, 0.0115, 0.0115, 1.8e6, 2.4e6, 1});
  records.push_back({3, 0.02, 0.02, 3e6, 6e6, 1});
  const TestReading cycles = reading_of(history(records), c, {});
  CHECK(cycles.loops == std::vector<std::size_t>{2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  CHECK_FALSE(cycles.peak);
  CHECK(cycles.largest->q == Approx(6e6));

  // Written when a loop counted as two stages.
  table.columns.erase(table.columns.begin() + 1);
  CHECK_THROWS_WITH(reading_of(table, c, {}),
                    Contains("history.csv: has no column 'part [-]'"));
  // Written before the loop began: the numbers are those of the case.
  dem::Table begun = history({{1, 0, 0, 1e6, 0, 1}, {1, 0.01, 0.01, 2e6, 3e6, 1}});
  begun.columns.erase(begun.columns.begin() + 1);
  CHECK(reading_of(begun, c, {}).stage == 1);
}

TEST_CASE("An oedometer is read with its modulus, its yield in axial stress and its K0",
          "[unit][apps]")
{
  const TestCase c = test_case_of(
      "subsection Loading\n  set stage 1 = isotropic to p = 1 MPa\n  set stage 2 = "
      "oedometer to axial strain = 5 %\n  set stage 3 = isotropic to p = 9 MPa\nend\n",
      "resolved.prm");
  // Lateral stress 0.25 of the axial one, which is 1 GPa times the strain up to 4 MPa.
  std::vector<Record> records{{1, 0, 0, 0, 0, 1}, {1, 0.001, 0.001, 1e6, 0, 1}};
  for (int k = 0; k <= 50; ++k) {
    const double strain = 1e-3 * k, axial = strain < 4e-3 ? 1e9 * strain : 4e6;
    records.push_back({2, strain, strain, 0.5 * axial, 0.75 * axial, 1.0 - strain});
  }
  RunFindings found;
  found.stages[2].add("constrained modulus [Pa]", 1e9);
  found.stages[2].add("oedometric yield [Pa]", 3.5e6);
  const TestReading r = reading_of(history(records), c, found);
  CHECK(name_of(r.kind) == "oedometer");
  CHECK(r.stage == 2); // not the isotropic one behind it
  CHECK_FALSE(r.peak);
  CHECK(r.not_critical == "not sheared");
  REQUIRE(r.yield);
  CHECK(r.yield->p == Approx(1.75e6));
  CHECK(r.yield->strain == Approx(3.5e-3));
  const auto value = [&](const std::string& name) {
    const auto& columns = test_columns();
    return std::find_if(columns.begin(), columns.end(),
                        [&](const TestColumn& column) { return column.name == name; })
        ->of(r);
  };
  CHECK(value("constrained modulus") == Approx(1e9));
  CHECK(value("axial stress at yield") == Approx(3.5e6));
  CHECK(value("lateral over axial stress at the end") == Approx(0.25));
}

TEST_CASE("A history without the stages of its case is refused", "[unit][apps]")
{
  CHECK_THROWS_WITH(reading_of(history({{0, 0, 0, 1, 0, 1}}), test_case(), {}),
                    "history.csv: holds no stage of its resolved.prm.");
  CHECK_THROWS_WITH(reading_of(history({{1, 0, 0, 1, 0, 1}}), test_case(), {}),
                    Contains("fewer than two records"));
  dem::Table pile;
  pile.file = "history.csv";
  CHECK_THROWS_WITH(reading_of(pile, test_case(), {}), Contains("of no element, triaxial"));
}

TEST_CASE("Runs are one group if and only if their cases differ by seed and specimen file",
          "[unit][apps]")
{
  const RunGroups groups =
      group_by_seed({test_at(1, "1"), test_at(2, "1"), test_at(1, "2"), test_at(1, "3")});
  CHECK(groups.members == std::vector<std::vector<std::size_t>>{{0, 2, 3}, {1}});
  CHECK(groups.notes.empty());

  // Earlier versions wrote the keys that were not given.
  TestReading earlier = test_at(1, "2");
  earlier.test_case =
      test_case_of("subsection Analysis\n  set critical state values =\nend\n"
                   "subsection Specimen\n  set seed = 2\n  set file =\nend\n"
                   "subsection Loading\n  set stage 1 = isotropic to p = 1 MPa\n"
                   "  set stage 2 = triaxial to axial strain = 20 %\n"
                   "  set stage 3 =\n  set stage 12 =\nend\n",
                   "resolved.prm");
  CHECK(group_by_seed({test_at(1, "1"), earlier}).members ==
        std::vector<std::vector<std::size_t>>{{0, 1}});

  const RunGroups twice =
      group_by_seed({test_at(1, "1"), test_at(1, "2"), test_at(1, "1")});
  CHECK(twice.members == std::vector<std::vector<std::size_t>>{{0, 1}, {2}});
  REQUIRE(twice.notes.size() == 1);
  CHECK_THAT(twice.notes[0], Contains("no further realisation"));
}

TEST_CASE("The mean of a group has the standard error s/sqrt(n) of the values there are",
          "[unit][apps]")
{
  const Mean m = mean_with_error({1.0, no_value, 2.0, 6.0});
  CHECK(m.n == 3);
  CHECK(m.mean == 3.0);
  CHECK(m.error == Approx(std::sqrt((4.0 + 1.0 + 9.0) / 2.0 / 3.0)));
  CHECK(std::isnan(mean_with_error({1.0}).error));
  CHECK(std::isnan(mean_with_error({no_value}).mean));
}

TEST_CASE("Lines through exact tests are those that the tests were made from",
          "[unit][apps]")
{
  TestSeries s({test_at(0.5), test_at(1), test_at(2)});
  REQUIRE(s.peak.line);
  CHECK(s.peak.line->c == Approx(1e6).epsilon(1e-6));
  CHECK(s.peak.line->phi == Approx(dem::pi / 6.0).epsilon(1e-6));
  REQUIRE(s.critical.line);
  CHECK(s.critical.line->c == Approx(0.0).margin(1.0));
  CHECK(std::sin(s.critical.line->phi) == Approx(2.5 / 4.5));
  REQUIRE(s.critical_states.ratio);
  CHECK(s.critical_states.ratio->M == Approx(2.5 / (1.0 + 2.5 / 3.0)));

  std::vector<TestReading> on_line = s.tests;
  for (TestReading& t : on_line) t.end.e = 1.3 - 0.0114 * std::pow(t.end.p / 101325.0, 0.7);
  const CriticalFit fit = critical_states_of(on_line);
  REQUIRE(fit.line);
  CHECK(fit.line->intercept == Approx(1.3));
  CHECK(fit.line->slope == Approx(-0.0114));
  CHECK(fit.line->R2 == Approx(1.0));
}

TEST_CASE("A line that would mean nothing is refused with its reason", "[unit][apps]")
{
  const TestSeries one({test_at(1, "1"), test_at(1, "2")});
  CHECK_FALSE(one.peak.line);
  CHECK(one.peak.of.why_not == "peaks of q at 1 confining pressure; two are needed");
  CHECK(one.critical_states.of.why_not ==
        "critical states at 1 confining pressure; three are needed");

  TestReading hardens = test_at(3);
  hardens.peak.reset();
  const TestSeries two({test_at(1), test_at(2), hardens});
  CHECK(two.peak.line);
  CHECK(two.peak.of.left_out ==
        std::vector<std::string>{"3_1: q falls from no peak by a tenth"});
  CHECK(two.critical.line);
  CHECK(two.critical_states.line);
}

TEST_CASE("Two tests have no R2, and a volume that still changes is a caution",
          "[unit][apps]")
{
  const TestSeries three({test_at(0.5), test_at(1), test_at(2)}),
      two({test_at(1), test_at(2)});
  CHECK(three.peak.R2().value_or(0.0) == Approx(1.0));
  REQUIRE(two.peak.line);
  CHECK_FALSE(two.peak.R2());
  CHECK_THAT(json_of(three, "{}"), Contains("R2 [-]"));
  CHECK_THAT(json_of(two, "{}"), !Contains("R2 [-]"));

  std::vector<TestReading> dilate = three.tests;
  for (TestReading& t : dilate) t.volume_rate = 0.02;
  CHECK(critical_strength(dilate).caution().empty());
  dilate[1].volume_rate = -0.9;
  const StrengthFit fit = critical_strength(dilate);
  CHECK(fit.volume_rate == -0.9);
  CHECK_THAT(fit.caution(), Contains("still changes by -0.9 of the axial strain"));
  CHECK(peak_strength(dilate).caution().empty());

  TestSeries all = three;
  all.critical = fit;
  std::ostringstream text;
  print(text, all);
  CHECK_THAT(text.str(), Contains("\n  caution: the volume still changes"));
  CHECK_THAT(json_of(all, "{}"), Contains("\"caution\": "));
}

TEST_CASE("tests.csv has a cell for each heading, tests.json is JSON, both with the means",
          "[unit][apps]")
{
  TestSeries s({test_at(1, "1"), test_at(1, "2", 0.3e6), test_at(2)});
  s.tests[2].label = "a, \"b\"";
  std::istringstream csv(csv_of(s));
  std::string heading, line, last;
  std::getline(csv, heading);
  const auto n_commas = std::count(heading.begin(), heading.end(), ',');
  CHECK_THAT(heading, Contains("test,kind,group,realisations,confining pressure [Pa]"));
  int n = 0;
  while (std::getline(csv, line)) {
    const bool is_quoted = line.starts_with("\"a, \"\"b\"\"\",");
    CHECK(std::count(line.begin(), line.end(), ',') == n_commas + (is_quoted ? 1 : 0));
    ++n;
    last = line;
  }
  CHECK(n == 5); // three tests, a mean and its standard error
  CHECK_THAT(last, mergel::match::StartsWith("standard error,triaxial,1,2,"));

  std::istringstream json(json_of(s, "{}"));
  boost::property_tree::ptree tree;
  REQUIRE_NOTHROW(boost::property_tree::read_json(json, tree));
  CHECK(tree.get_child("tests").size() == 3);
  CHECK(tree.get_child("tests").back().second.get<std::string>("test") == "a, \"b\"");
  const auto& group = tree.get_child("tests that differ only by seed").front().second;
  const double peak = 2e6 * std::sqrt(3.0) + 2e6;
  CHECK(group.get_child("q at the peak [Pa]").get<double>("mean") == Approx(peak + 0.15e6));
  CHECK(group.get_child("q at the peak [Pa]").get<double>("standard error") ==
        Approx(0.15e6)); // half the difference of two values
  CHECK(tree.get_child("Coulomb line at the peak").count("c [Pa]") == 1);
  CHECK(tree.get_child("critical state line").get<std::string>("none") ==
        "critical states at 2 confining pressures; three are needed");
}

TEST_CASE("A summary gives its numbers by stage, and one that is no JSON is refused",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  CHECK_FALSE(read_findings(folder.path));
  std::ofstream(folder.path / "summary.json")
      << "{\"stages\": [{\"stage\": \"isotropic\"}, {\"UCS [Pa]\": 4e6, \"nu.x [-]\": "
         "0.2}], "
         "\"p at the end [Pa]\": 1.5e6, \"name\": \"x\"}";
  const auto found = read_findings(folder.path);
  REQUIRE(found);
  CHECK(found->whole.at("p at the end [Pa]") == 1.5e6);
  CHECK(std::isnan(found->whole.at("name")));
  REQUIRE(found->stages.size() == 2);
  CHECK(found->stages.at(2).at("UCS [Pa]") == 4e6);
  CHECK(found->stages.at(2).at("nu.x [-]") == 0.2);
  std::ofstream(folder.path / "summary.json") << "{\"a\": ";
  CHECK_THROWS_WITH(read_findings(folder.path), Contains("summary.json"));
}

TEST_CASE(
    "A stage of the case has the findings of its number, however many cycles are before",
    "[unit][apps]")
{
  const TemporaryFolder folder;
  std::string stages;
  double value = 0.0; // 1 for the first
  for (const char* number :
       {"1", "2a of cycle 1", "2b of cycle 1", "2a of cycle 2", "2b of cycle 2", "3"})
    stages += (stages.empty() ? "" : ", ") + std::string("{\"number\": \"") + number +
              "\", \"E [Pa]\": " + std::to_string(value += 1.0) + "}";
  std::ofstream(folder.path / "summary.json") << "{\"stages\": [" << stages << "]}";
  const auto found = read_findings(folder.path);
  REQUIRE(found);
  REQUIRE(found->stages.size() == 3);
  CHECK(found->stages.at(1).at("E [Pa]") == 1.0);
  CHECK(found->stages.at(2).at("E [Pa]") == 2.0); // its first unloading
  CHECK(found->stages.at(3).at("E [Pa]") == 6.0);
}

/// Several tests as JSON.
#include "apps/case/words.h"
#include "apps/compare/test_columns.h"
#include "apps/compare/tests_table.h"
#include "apps/run/summary.h"
#include "dem/text.h"

#include <cmath>

namespace mergel::apps {

namespace {

constexpr double degree = dem::pi / 180.0;

/// An object within the outer one; a member without a value is left out.
class Members {
public:
  explicit Members(int depth) : indent_(static_cast<std::size_t>(2 * depth), ' ') {}

  void json(const std::string& name, const std::string& value)
  {
    text_ += (text_.empty() ? "" : ",\n") + indent_ + "  " + in_json(name) + ": " + value;
  }
  void number(const std::string& name, double value)
  {
    if (std::isfinite(value)) json(name, dem::shortest(value));
  }
  void text(const std::string& name, const std::string& value)
  {
    json(name, in_json(value));
  }
  std::string object() const { return "{\n" + text_ + "\n" + indent_ + "}"; }

private:
  std::string indent_, text_;
};

/// @param depth of the array
std::string array(const std::vector<std::string>& values, int depth)
{
  if (values.empty()) return "[]";
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  return "[\n" + indent + "  " + joined(values, ",\n" + indent + "  ") + "\n" + indent +
         "]";
}

std::string labels(const TestSeries& s, const std::vector<std::size_t>& tests)
{
  std::vector<std::string> names;
  for (const std::size_t k : tests) names.push_back(in_json(s.tests[k].label));
  return "[" + joined(names, ", ") + "]";
}

std::string test(const TestReading& t)
{
  Members m(2);
  m.text("test", t.label);
  m.text("folder", t.folder.string());
  m.text("kind", name_of(t.kind));
  if (t.stage > 0) m.number("stage", static_cast<double>(t.stage));
  for (const TestColumn& column : test_columns()) m.number(column.heading(), column.of(t));
  if (t.not_critical.empty())
    m.json("critical state", "true");
  else
    m.text("no critical state", t.not_critical);
  return m.object();
}

std::string group(const TestSeries& s, const std::vector<std::size_t>& tests)
{
  Members m(2);
  m.json("tests", labels(s, tests));
  for (const TestColumn& column : test_columns()) {
    const Mean mean = mean_with_error(values_of(column, s.tests, tests));
    if (mean.n == 0) continue;
    Members of(3);
    of.number("mean", mean.mean);
    of.number("standard error", mean.error);
    of.number("n", static_cast<double>(mean.n));
    m.json(column.heading(), of.object());
  }
  return m.object();
}

/// The tests of a line, those left out and why, or why there is no line.
void add(Members& m, const TestSeries& s, const Selection& of)
{
  m.json("tests", labels(s, of.tests));
  std::vector<std::string> left_out;
  for (const std::string& why : of.left_out) left_out.push_back(in_json(why));
  m.json("left out", array(left_out, 2));
  if (!of.why_not.empty()) m.text("none", of.why_not);
}

std::string strength(const TestSeries& s, const StrengthFit& fit)
{
  Members m(1);
  add(m, s, fit.of);
  if (fit.line) {
    m.text("definition",
           "least squares of sigma_1 = b + N sigma_3; sin phi = (N - 1)/(N + 1), "
           "c = b/(2 sqrt(N))");
    m.number("c [Pa]", fit.line->c);
    m.number("standard error of c [Pa]", fit.line->c_error);
    m.number("phi [degree]", fit.line->phi / degree);
    m.number("standard error of phi [degree]", fit.line->phi_error / degree);
    if (const auto R2 = fit.R2()) m.number("R2 [-]", *R2);
    if (!fit.caution().empty()) m.text("caution", fit.caution());
  }
  return m.object();
}

std::string critical(const TestSeries& s)
{
  const CriticalFit& fit = s.critical_states;
  Members m(1);
  add(m, s, fit.of);
  if (fit.line) {
    m.text("definition",
           "least squares of e = Gamma - lambda (p/p_a)^0.7, p_a = 101325 Pa; "
           "of q = M p");
    m.number("Gamma [-]", fit.line->intercept);
    m.number("standard error of Gamma [-]", std::sqrt(fit.line->intercept_variance));
    m.number("lambda [-]", -fit.line->slope);
    m.number("standard error of lambda [-]", std::sqrt(fit.line->slope_variance));
    m.number("R2 [-]", fit.line->R2);
    m.number("M [-]", fit.ratio->M);
    m.number("standard error of M [-]", fit.ratio->M_error);
    m.number("smallest volumetric over axial strain rate [-]", fit.volume_rates[0]);
    m.number("largest volumetric over axial strain rate [-]", fit.volume_rates[1]);
  }
  return m.object();
}

} // namespace

std::string json_of(const TestSeries& s, const std::string& made_by)
{
  std::vector<std::string> tests, groups, notes;
  for (const TestReading& t : s.tests) tests.push_back(test(t));
  for (const auto& members : s.groups.members)
    if (members.size() > 1) groups.push_back(group(s, members));
  for (const std::string& note : s.groups.notes) notes.push_back(in_json(note));
  Summary all;
  all.json("tests", array(tests, 1));
  all.json("tests that differ only by seed", array(groups, 1));
  all.json("notes", array(notes, 1));
  all.json("Coulomb line at the peak", strength(s, s.peak));
  all.json("Coulomb line in the critical state", strength(s, s.critical));
  all.json("critical state line", critical(s));
  all.json("made by", made_by); // last: the files are known by their first words
  return all.object();
}

} // namespace mergel::apps

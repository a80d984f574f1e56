#include "apps/view/bond/bond.h"

#include "apps/view/round_off.h"
#include "dem/error.h"
#include "dem/io/readable.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

/// The flat summary.json of a run: a value by its name.
class Summary {
public:
  explicit Summary(fs::path file) : file_(std::move(file))
  {
    require(dem::is_readable(file_),
            file_.string() + ": does not exist. Copy the whole results folder, or let the "
                             "run end first.");
    std::ifstream in(file_);
    text_.assign(std::istreambuf_iterator<char>(in), {});
  }

  double positive(const std::string& name) const
  {
    const std::string value = after(name);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    require(end != value.c_str() && number > 0.0 && std::isfinite(number),
            file_.string() + ": '" + name + "' must be a positive number. " + remedy);
    return number;
  }

  std::string word(const std::string& name) const
  {
    const std::string value = after(name);
    const std::size_t end = value.find('"', 1);
    require(value.front() == '"' && end != std::string::npos,
            file_.string() + ": '" + name + "' must be a word in quotes. " + remedy);
    return value.substr(1, end - 1);
  }

private:
  static constexpr const char* remedy = "Was it written by 'mergel bond'?";

  /// The text after `"name":`, from its first character.
  std::string after(const std::string& name) const
  {
    const std::size_t at = text_.find('"' + name + '"');
    const std::size_t colon =
        at == std::string::npos ? at : text_.find(':', at + name.size() + 2);
    const std::size_t value =
        colon == std::string::npos ? colon : text_.find_first_not_of(" \t\r\n", colon + 1);
    require(value != std::string::npos,
            file_.string() + ": '" + name + "' is missing. " + remedy);
    return text_.substr(value);
  }

  fs::path file_;
  std::string text_;
};

bool exceeds(const std::vector<double>& values, double limit)
{
  return std::any_of(values.begin(), values.end(),
                     [&](double value) { return std::abs(value) > limit; });
}

} // namespace

bool BondRun::has_contact() const
{
  return exceeds(f_n, 0.0);
}

bool BondRun::moves(Load l) const
{
  return exceeds(motion[l], 0.0);
}

bool BondRun::bears(Load l) const
{
  return exceeds(load[l], round_off * strength.of(l, 1.0));
}

bool is_bond_history(const dem::Table& history)
{
  return history.has("u_n") && history.has("N") && history.has("D");
}

BondRun read_bond_run(const fs::path& folder, const dem::Table& history,
                      const RunName& name)
{
  BondRun run;
  run.name = name;
  run.motion = {history.column("u_n", "m"), history.column("u_s", "m"),
                history.column("theta", "rad")};
  run.load = {history.column("N", "N"), history.column("V", "N"),
              history.column("M", "N.m")};
  run.D = history.column("D", "-");
  run.f_n = history.column("f_n", "N");
  run.f_s = history.column("f_s", "N");

  const Summary summary(folder / "summary.json");
  run.has_surface = summary.word("bond law") == "damage";
  run.strength.tension = summary.positive("tensile strength [N]");
  run.strength.shear_force = summary.positive("shear strength [N]");
  run.strength.moment = summary.positive("moment strength [N.m]");
  if (run.has_surface)
    run.strength.compression = summary.positive("compressive strength [N]");
  return run;
}

} // namespace mergel::apps

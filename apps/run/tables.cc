#include "apps/run/tables.h"

#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/io/vtk.h"
#include "dem/text.h"

#include <algorithm>
#include <fstream>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

/// Both are printed as the shortest text that reads back to the same bits.
constexpr double round_off = 1e-9;

constexpr const char *first_of_bond = "u_n [m]", *first_of_others = "time [s]";

/// Time of the last file in any series of a folder [s]; 0 without one.
double last_frame(const fs::path& folder)
{
  double last = 0.0;
  std::error_code error; // a folder that cannot be listed has no series
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".pvd") continue;
    try {
      for (const dem::SeriesEntry& file : dem::read_series(entry.path()))
        last = std::max(last, file.time);
    } catch (const InputError&) { // missing_results() names it
    }
  }
  return last;
}

} // namespace

std::vector<std::string> tables_of(const std::string& job)
{
  if (job.empty() || job == "sample") return {};
  std::vector<std::string> tables{"history.csv"};
  if (job == "triaxial") tables.push_back("localisation.csv");
  if (job == "pile")
    tables.insert(tables.end(), {"shaft_profile.csv", "tip_profile.csv",
                                 "radial_profile.csv", "stress_path.csv"});
  return tables;
}

bool has_line(const fs::path& table)
{
  std::ifstream in(table);
  std::string line;
  return std::getline(in, line) && !in.eof();
}

std::string lost_heading(const fs::path& table, const std::string& job)
{
  if (dem::reading_error(table)) return "";
  std::ifstream in(table);
  std::string line;
  while (std::getline(in, line) && line.starts_with('#')) line.clear();
  const auto begins = [&](const char* column) { return line.starts_with(column); };
  const bool is_heading = (job == "bond" || job.empty() ? begins(first_of_bond) : false) ||
                          (job != "bond" ? begins(first_of_others) : false);
  if (is_heading && !in.eof()) return "";
  return is_heading ? "is cut in its heading"
                    : std::string("does not begin with its heading (") +
                          (job == "bond" ? first_of_bond : first_of_others) +
                          ", ...): its first lines are lost";
}

bool begins_at_checkpoint(const dem::Table& history)
{
  return std::any_of(
      history.remarks.begin(), history.remarks.end(),
      [](const std::string& remark) { return remark.starts_with("begins behind "); });
}

bool begins_at_checkpoint(const fs::path& history)
{
  std::ifstream in(history);
  std::string line;
  return std::getline(in, line) && line.starts_with("# begins behind ");
}

std::string lost_start(const dem::Table& history)
{
  if (history.n_rows == 0 || begins_at_checkpoint(history)) return "";
  const std::vector<dem::TableColumn>& c = history.columns;
  const auto tell = [&](double at) {
    return "begins late, at " + c[0].name + " " + dem::shortest(at) + " " + c[0].unit +
           ": its first records are lost";
  };
  const double first = c[0].values[0];
  if (c[0].name == "u_n") { // a pair starts at rest
    const bool is_start =
        std::all_of(c.begin(), c.begin() + std::min<std::ptrdiff_t>(3, std::ssize(c)),
                    [](const dem::TableColumn& motion) { return motion.values[0] == 0.0; });
    return is_start ? "" : tell(first);
  }
  if (c[0].name != "time") return "";
  // The first record is that of the start. A pile settles before it, and has its first one when it
  // has come from the surface as far as from the first to the second.
  const auto tip = std::find_if(c.begin(), c.end(), [](const dem::TableColumn& one) {
    return one.name == "tip depth";
  });
  const bool is_pile = tip != c.end();
  if (history.n_rows < (is_pile ? 3 : 2))
    return ""; // the last one comes at the end of the run
  const std::vector<double>& from = is_pile ? tip->values : c[0].values;
  if (from[0] <= (is_pile ? 1.5 : 0.5) * (from[1] - from[0])) return "";
  return tell(first);
}

std::string lost_end(const dem::Table& table, const fs::path& folder)
{
  if (table.n_rows == 0) return "is cut: it holds no record";
  if (table.is_last_line_cut) return "is cut: its last line is not whole";
  const dem::TableColumn& time = table.columns.front();
  if (time.name != "time") return "";
  const double frame = last_frame(folder);
  if (time.values.back() >= (1.0 - round_off) * frame) return "";
  return "is cut: it ends at time " + dem::shortest(time.values.back()) +
         " s, before the last fields at " + dem::shortest(frame) + " s";
}

} // namespace mergel::apps

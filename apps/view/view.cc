/// mergel-view: pictures of runs. Of a pile run: load.png, damage.png, displacement.png, those of
/// its continuum fields (stress.png, porosity.png, layers.png, principal.png, chains.png) and of
/// its profiles (shaft.png, profiles.png, paths.png);
/// of bond runs: loads.png and surface.png; of element runs: element.png or isotropic.png;
/// of triaxial runs: triaxial.png or isotropic.png, and of one specimen.png and
/// localisation.png; of Brazilian runs: brazilian.png, and of one disc.png; of several element
/// or triaxial runs besides: mohr.png, critical_state.png and yield.png; of any: curve.png and
/// compare.png.

#include "apps/view/bond/bond.h"
#include "apps/view/bond/draw_bonds.h"
#include "apps/view/brazilian.h"
#include "apps/view/element.h"
#include "apps/view/laboratory/draw_compare.h"
#include "apps/view/laboratory/draw_laboratory.h"
#include "apps/view/laboratory/draw_tests.h"
#include "apps/view/options.h"
#include "apps/view/pile/chart.h"
#include "apps/view/pile/draw_pile.h"
#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/io/standard_output.h"
#include "dem/io/table.h"

#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <X11/Xlib.h>

using namespace mergel;
using namespace mergel::apps;
namespace fs = std::filesystem;

namespace {

/// Checks for a display, because VTK aborts without one and without a message of ours. The
/// connection stays open, because Xvfb restarts when its last client leaves and then
/// refuses VTK.
class DisplayConnection {
public:
  DisplayConnection() = default;
  DisplayConnection(const DisplayConnection&) = delete;
  DisplayConnection& operator=(const DisplayConnection&) = delete;
  ~DisplayConnection()
  {
    if (display_ != nullptr) XCloseDisplay(display_);
  }
  bool is_open() const { return display_ != nullptr; }

private:
  Display* display_ = XOpenDisplay(nullptr);
};

dem::Table history_of(const fs::path& folder)
{
  dem::require_folder(folder);
  dem::Table history = dem::read_table(folder / "history.csv");
  if (history.is_last_line_cut)
    std::cerr
        << "mergel-view: " << history.file.string()
        << ": the last line is not complete (is the run still active?) and is left out.\n";
  add_head_force(history);
  return history;
}

enum class Job { pile, bond, element, triaxial, brazilian };

Job job_of(const dem::Table& history)
{
  if (is_bond_history(history)) return Job::bond;
  if (is_triaxial_history(history)) return Job::triaxial;
  if (is_brazilian_history(history)) return Job::brazilian;
  return is_element_history(history) ? Job::element : Job::pile;
}

std::string described(Job job)
{
  switch (job) {
  case Job::pile:
    return "a pile run";
  case Job::bond:
    return "a bond run";
  case Job::triaxial:
    return "a triaxial run";
  case Job::brazilian:
    return "a Brazilian run";
  case Job::element:
    break;
  }
  return "an element run";
}

/// Element and triaxial runs are drawn over each other: the volumetric strain of a cylinder
/// is that of its middle third.
void unite_cells_and_cylinders(std::vector<dem::Table>& histories)
{
  const auto count = [&](Job job) {
    return std::count_if(histories.begin(), histories.end(),
                         [&](const dem::Table& h) { return job_of(h) == job; });
  };
  if (count(Job::element) == 0 || count(Job::triaxial) == 0) return;
  for (dem::Table& history : histories)
    for (dem::TableColumn& column : history.columns)
      if (column.name == volume_of_middle) column.name = volume_of_cell;
}

void draw(const Options& options)
{
  std::vector<dem::Table> histories;
  for (const std::string& folder : options.folders) histories.push_back(history_of(folder));
  unite_cells_and_cylinders(histories);
  const auto& folders = options.folders;
  const Job job = job_of(histories.front());
  for (std::size_t k = 1; k < histories.size(); ++k) {
    const Job other = job_of(histories[k]);
    require(job == other, folders.front() + " holds " + described(job) + " and " +
                              folders[k] + " " + described(other) +
                              ": they have no picture in common. Draw them one by one.");
  }
  const bool has_stages = job == Job::element || job == Job::triaxial;
  const Stages stages = options.stage.empty() ? Stages{} : stages_of(options.stage);
  require(stages.is_all() || has_stages,
          "--stage " + options.stage + ": is for element and triaxial runs; " +
              folders.front() + " holds " + described(job) + ". Leave it out.");
  require(!options.is_mean || has_stages, "--mean: is for element and triaxial runs; " +
                                              folders.front() + " holds " + described(job) +
                                              ". Leave it out.");
  if (!options.compare.empty()) {
    require(options.curves.empty() && options.points.empty(),
            "--compare " + options.compare.front() +
                ": chooses its panels by the headings of the file; leave out --curve and "
                "--points.");
    draw_compare(options, histories);
    if (job == Job::pile && histories.size() == 1)
      draw_pile_load(options, histories.front());
    return;
  }
  if (!options.curves.empty()) {
    draw_curves(options, stages, histories);
    return;
  }
  require(options.points.empty() || has_stages || job == Job::brazilian,
          "--points " + (options.points.empty() ? "" : options.points.front()) +
              ": is for element, triaxial and Brazilian runs and for --curve; " +
              folders.front() + " holds " + described(job) + ". Leave it out.");
  if (job == Job::element) {
    draw_stages(options, stages, histories, "element.png");
    draw_laboratory(options);
  } else if (job == Job::triaxial) {
    draw_triaxial(options, stages, histories);
    draw_laboratory(options);
  } else if (job == Job::brazilian) {
    draw_brazilian(options, histories);
  } else if (job == Job::bond) {
    draw_bonds(options, histories);
  } else {
    require(histories.size() == 1,
            std::to_string(histories.size()) +
                " folders of pile runs: only bond, element, triaxial and Brazilian runs, "
                "and the curves of --curve, are drawn together. Draw them one by one.");
    draw_pile(options, histories.front());
  }
}

} // namespace

int main(int argc, char** argv)
{
  dem::hold_standard_descriptors();
  std::signal(SIGPIPE, SIG_IGN); // all pictures are made, read or not what is printed
  try {
    int code = 0;
    const std::optional<Options> options = read_options(argc, argv, code);
    if (!options) return code;
    const DisplayConnection display;
    if (!display.is_open()) {
      std::cerr
          << "mergel-view: no display to draw with. Run 'xvfb-run -a mergel-view ...'.\n";
      return 2;
    }
    draw(*options);
    return 0;
  } catch (const InputError& error) {
    std::cerr << "mergel-view: " << error.what() << '\n';
    return 1;
  } catch (const std::exception& error) {
    std::cerr << "mergel-view: " << error.what() << '\n';
    return 2;
  }
}

#include "apps/view/bond/draw_bonds.h"

#include "apps/view/bond/bond.h"
#include "apps/view/bond/bond_loads.h"
#include "apps/view/bond/bond_surface.h"
#include "apps/view/output.h"

#include <algorithm>
#include <iostream>
#include <iterator>

namespace mergel::apps {

namespace fs = std::filesystem;

void draw_bonds(const Options& options, const std::vector<dem::Table>& histories)
{
  const std::vector<RunName> names = run_names(options);
  std::vector<BondRun> runs, with_surface;
  for (std::size_t k = 0; k < histories.size(); ++k)
    runs.push_back(read_bond_run(options.folders[k], histories[k], names[k]));
  const fs::path output = picture_folder(options);

  Page loads(options.size.width, options.size.height);
  draw_bond_loads(loads, runs);
  save(loads, output / "loads.png");

  std::copy_if(runs.begin(), runs.end(), std::back_inserter(with_surface),
               [](const BondRun& run) { return run.has_surface; });
  if (with_surface.empty()) {
    std::cout << "no surface.png: only the damage bond has a yield surface to draw\n";
    return;
  }
  // two panels in a row, 600 pixels for each row unless --size says otherwise
  const int n_rows = (static_cast<int>(n_surface_panels(with_surface)) + 1) / 2;
  const int height =
      options.has_size ? options.size.height : std::max(options.size.height, 600 * n_rows);
  Page surface(options.size.width, height);
  draw_bond_surface(surface, with_surface);
  save(surface, output / "surface.png");
}

} // namespace mergel::apps

#include "dem/io/psd_file.h"

#include "dem/error.h"
#include "dem/io/table.h"
#include "dem/text.h"

#include <cmath>

namespace mergel::dem {

SieveSizes read_sieve_curve(const std::filesystem::path& file, const UnitSize& size)
{
  const Table table = read_table(file, LastLine::whole);
  const std::vector<double> d = table.column_in("diameter", "mm", size);
  const std::vector<double> passing = table.column_in("passing", "%", size);
  SieveSizes sizes;
  for (std::size_t row = 0; row < table.n_rows; ++row) {
    const std::string where = file.string() + ":" + std::to_string(table.lines[row]) + ": ";
    require(std::isfinite(d[row]) && d[row] > 0.0,
            where + "diameter = " + shortest(d[row]) + " mm: must be positive.");
    require(passing[row] >= 0.0 && passing[row] <= 100.0,
            where + "passing = " + shortest(passing[row]) + " %: must lie in 0 to 100.");
    if (row > 0) {
      require(d[row] > d[row - 1], where + "diameter = " + shortest(d[row]) +
                                       " mm: must be above the line before, " +
                                       shortest(d[row - 1]) +
                                       " mm. Sort the sieves from fine to coarse.");
      require(passing[row] >= passing[row - 1],
              where + "passing = " + shortest(passing[row]) +
                  " %: must not be below the line before, " + shortest(passing[row - 1]) +
                  " %. Give what passes each sieve, not what it retains.");
    }
    sizes.d.push_back(1e-3 * d[row]);
    sizes.passing.push_back(0.01 * passing[row]);
  }
  const auto line = [&](std::size_t row) {
    return file.string() + ":" + std::to_string(table.lines[row]) + ": ";
  };
  const std::size_t last = table.n_rows - 1;
  require(passing[0] == 0.0, line(0) + "passing = " + shortest(passing[0]) +
                                 " %: must be 0 at the smallest diameter.");
  require(passing[last] == 100.0, line(last) + "passing = " + shortest(passing[last]) +
                                      " %: must be 100 at the largest diameter.");
  return sizes;
}

} // namespace mergel::dem

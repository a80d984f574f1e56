// Tables of numbers: history.csv of a run, and the path of `mergel bond`.
#include "tests/fuzz/reader.h"

#include "dem/error.h"
#include "dem/io/table.h"

#include <cmath>

namespace mergel::fuzz {

namespace {

void check(const dem::Table& table)
{
  promise(table.n_rows > 0 && !table.columns.empty(), "a table without a record");
  promise(table.lines.size() == table.n_rows, "a record without its line");
  for (std::size_t k = 1; k < table.n_rows; ++k)
    promise(table.lines[k] > table.lines[k - 1], "lines out of order");
  for (const dem::TableColumn& c : table.columns) {
    promise(c.values.size() == table.n_rows, "columns of several lengths");
    promise(!c.name.empty(), "a column without a name");
    promise(&table.column(c.name, c.unit) == &c.values, "two columns of one name");
  }
  const std::vector<double>&x = table.columns.front().values,
        &y = table.columns.back().values;
  dem::interpolate(x, y, x.front());
  promise(dem::moving_mean(x, y, 0.1).size() == table.n_rows, "a mean for each record");
}

} // namespace

const Reader table_reader{
    "table", false, [](const std::string& bytes, const std::filesystem::path& file) {
      write_bytes(file, bytes);
      bool is_accepted = false;
      for (const dem::LastLine last : {dem::LastLine::whole, dem::LastLine::may_be_cut}) {
        try {
          check(dem::read_table(file, last));
          is_accepted = true;
        } catch (const InputError&) {
        }
      }
      return is_accepted;
    }};

} // namespace mergel::fuzz

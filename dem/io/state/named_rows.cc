#include "dem/io/state/named_rows.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace mergel::dem {

void save_columns(State& state, const std::string& array,
                  const std::vector<std::string>& names)
{
  std::string lines;
  for (const std::string& name : names) {
    if (name.empty() || name.find('\n') != std::string::npos)
      throw std::logic_error(array + " has a column without a name of one line");
    lines += name + '\n';
  }
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
    throw std::logic_error(array + " has two columns of one name");
  state.add_text(array + "_names", lines);
}

std::vector<std::size_t> find_columns(const State& state, const std::string& array,
                                      const std::vector<std::string>& names)
{
  std::vector<std::string> there;
  const std::string lines = state.text(array + "_names");
  for (std::size_t from = 0; from < lines.size();) {
    const std::size_t to = std::min(lines.find('\n', from), lines.size());
    there.push_back(lines.substr(from, to - from));
    from = to + 1;
  }
  std::vector<std::size_t> columns;
  for (const std::string& name : names) {
    const auto at = std::find(there.begin(), there.end(), name);
    if (at == there.end()) State::refuse(array, "has no column `" + name + "`");
    columns.push_back(static_cast<std::size_t>(at - there.begin()));
  }
  for (auto at = there.begin(); at != there.end(); ++at) {
    if (std::find(names.begin(), names.end(), *at) == names.end())
      State::refuse(array,
                    "has the column `" + *at + "`, which this program does not know");
    if (std::find(there.begin(), at, *at) != at)
      State::refuse(array, "has the column `" + *at + "` twice");
  }
  return columns;
}

} // namespace mergel::dem

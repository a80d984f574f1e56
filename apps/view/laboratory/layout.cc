#include "apps/view/laboratory/layout.h"

#include <array>
#include <utility>

namespace mergel::apps {

Layout captioned_panels(const Page& page, std::size_t n_rows, std::size_t n_columns,
                        const std::vector<KeyEntry>& entries)
{
  const double u = page.unit();
  const double left = 145.0 * u, right = 40.0 * u, bottom = 105.0 * u, top = 60.0 * u;
  Layout result;
  result.key = {left, 0.0, page.width() - right, page.height() - 15.0 * u};
  const double used = key_height(page, entries, result.key.width()) + 15.0 * u;
  const double width = page.width() / static_cast<double>(n_columns);
  const double height = (page.height() - used) / static_cast<double>(n_rows);
  for (std::size_t row = 0; row < n_rows; ++row)
    for (std::size_t column = 0; column < n_columns; ++column) {
      const double x = width * static_cast<double>(column);
      const double y = height * static_cast<double>(n_rows - 1 - row);
      result.boxes.push_back({x + left, y + bottom, x + width - right, y + height - top});
    }
  return result;
}

void write_caption(Page& page, const Box& box, const std::string& words)
{
  page.text({box.left, box.top + 14.0 * page.unit()}, typeset(words),
            {0.9, Across::left, Up::foot});
}

std::string typeset(std::string words)
{
  constexpr std::array<std::pair<const char*, const char*>, 4> signs{
      {{"+-", "\u00b1"},
       {"phi =", "friction angle"},
       {" -", " \u2212"},
       {"R2", "R\u00b2"}}};
  for (const auto& [plain, sign] : signs)
    for (std::size_t at = words.find(plain); at != std::string::npos;
         at = words.find(plain, at + 1))
      words.replace(at, std::string(plain).size(), sign);
  return words;
}

std::vector<std::string> group_names(const TestSeries& series)
{
  std::vector<std::string> names;
  for (const auto& group : series.groups.members) {
    const TestReading& first = series.tests[group.front()];
    names.push_back(group.size() == 1 ? first.label
                                      : condition_of(first) + ", " +
                                            std::to_string(group.size()) + " realisations");
  }
  return names;
}

std::vector<std::size_t> group_of_each(const TestSeries& series)
{
  std::vector<std::size_t> groups(series.tests.size());
  for (std::size_t g = 0; g < series.groups.members.size(); ++g)
    for (const std::size_t k : series.groups.members[g]) groups[k] = g;
  return groups;
}

} // namespace mergel::apps

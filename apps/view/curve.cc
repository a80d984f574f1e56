#include "apps/view/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mergel::apps {

namespace {

constexpr double key_row = 42.0;    // units from row to row
constexpr double key_line = 80.0;   // length of the line of an entry
constexpr double key_letter = 14.0; // mean width of a letter at key_text
constexpr double key_gap = 30.0;    // between columns
constexpr double key_text = 0.9;    // size of its words
constexpr double mark_across = 15.0;

/// Width of a column of the key, and how many columns and rows there are.
struct KeyPlan {
  double column;
  std::size_t n_columns, n_rows;
};

KeyPlan plan(const Page& page, const std::vector<KeyEntry>& entries, double width)
{
  std::size_t longest = 1;
  for (const KeyEntry& e : entries) longest = std::max(longest, e.words.size());
  const double column =
      (key_line + 20.0 + key_letter * static_cast<double>(longest) + key_gap) * page.unit();
  const std::size_t n = std::max<std::size_t>(entries.size(), 1);
  const auto fit = static_cast<std::size_t>(std::max(1.0, std::floor(width / column)));
  const std::size_t n_columns = std::min(fit, n);
  return {column, n_columns, (n + n_columns - 1) / n_columns};
}

constexpr std::size_t n_outlines = 5, n_marks = 2 * n_outlines;

/// One of the five outlines, filled, of about the area of a disc of this diameter.
void draw_shape(Page& page, const Pixel& at, Mark outline, const Colour& colour,
                double units_across)
{
  const double r = 0.5 * units_across * page.unit();
  const double s = 0.9 * r, d = 1.25 * r, foot = 0.75 * r, head = 1.45 * r, wide = 1.25 * r;
  switch (outline) {
  case Mark::square:
    page.fill(Box{at.x - s, at.y - s, at.x + s, at.y + s}, colour);
    break;
  case Mark::triangle:
    page.fill({{at.x - wide, at.y - foot}, {at.x + wide, at.y - foot}, {at.x, at.y + head}},
              colour);
    break;
  case Mark::diamond:
    page.fill({{at.x - d, at.y}, {at.x, at.y - d}, {at.x + d, at.y}, {at.x, at.y + d}},
              colour);
    break;
  case Mark::nabla:
    page.fill({{at.x - wide, at.y + foot}, {at.x, at.y - head}, {at.x + wide, at.y + foot}},
              colour);
    break;
  default:
    page.dot(at, colour, units_across);
  }
}

} // namespace

Range range(const std::vector<double>& values)
{
  Range result;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
  }
  return result;
}

Range range(const Range& a, const Range& b)
{
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

Axis round_axis(const Range& r, const std::string& title)
{
  const double high = r.high > r.low ? r.high : r.low + 1.0;
  const auto ticks = round_ticks(r.low, high, 5);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : high - r.low;
  // 2 % of a step: a value that ends on a tick needs no further one
  return {step * std::floor(r.low / step + 0.02), step * std::ceil(high / step - 0.02),
          title};
}

Unit convenient_unit(double largest, const std::string& base)
{
  constexpr std::array<std::pair<double, const char*>, 7> prefixes{{{1e6, "M"},
                                                                    {1e3, "k"},
                                                                    {1.0, ""},
                                                                    {1e-3, "m"},
                                                                    {1e-6, "\u00b5"},
                                                                    {1e-9, "n"},
                                                                    {1e-12, "p"}}};
  if (!(largest > 0.0)) return {1.0, base};
  for (const auto& [size, prefix] : prefixes)
    if (largest >= 0.5 * size) return {size, prefix + base};
  return {prefixes.back().first, prefixes.back().second + base};
}

void draw_curve(Page& page, const Panel& panel, const std::vector<double>& x,
                const std::vector<double>& y, const Stroke& stroke)
{
  std::vector<Pixel> points;
  const auto draw = [&] {
    if (points.size() > 1) page.line(points, stroke);
    points.clear();
  };
  for (std::size_t row = 0; row < x.size(); ++row)
    if (std::isfinite(x[row]) && std::isfinite(y[row]))
      points.push_back(panel.at(x[row], y[row]));
    else
      draw();
  draw();
}

Stroke distinct_stroke(std::size_t k)
{
  static const std::array<Colour, 8> colours{{{0.05, 0.28, 0.55},
                                              {0.86, 0.37, 0.05},
                                              {0.00, 0.60, 0.45},
                                              {0.50, 0.14, 0.50},
                                              {0.88, 0.62, 0.05},
                                              {0.25, 0.25, 0.25},
                                              {0.34, 0.71, 0.91},
                                              {0.80, 0.47, 0.65}}};
  static const std::array<std::vector<double>, 5> dashes{
      {{}, {24.0, 12.0}, {9.0, 9.0}, {26.0, 8.0, 7.0, 8.0}, {44.0, 14.0}}};
  return {colours[k % colours.size()], k == 0 ? 6.0 : 4.5, dashes[k % dashes.size()]};
}

double key_height(const Page& page, const std::vector<KeyEntry>& entries, double width)
{
  if (entries.empty()) return 0.0;
  return static_cast<double>(plan(page, entries, width).n_rows) * key_row * page.unit();
}

void draw_key(Page& page, const Box& box, const std::vector<KeyEntry>& entries)
{
  const double u = page.unit();
  const KeyPlan p = plan(page, entries, box.width());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto row = static_cast<double>(k % p.n_rows);
    const auto column = static_cast<double>(k / p.n_rows);
    const Pixel at{box.left + column * p.column, box.top - (row + 0.5) * key_row * u};
    if (entries[k].stroke.width > 0.0)
      page.line({at, {at.x + key_line * u, at.y}}, entries[k].stroke);
    if (entries[k].mark != Mark::none)
      draw_mark(page, {at.x + 0.5 * key_line * u, at.y}, entries[k].mark,
                entries[k].stroke.colour);
    page.text({at.x + (key_line + 20.0) * u, at.y}, entries[k].words,
              {key_text, Across::left});
  }
}

Mark distinct_mark(std::size_t k)
{
  return static_cast<Mark>(static_cast<std::size_t>(Mark::ring) + k % n_marks);
}

void draw_mark(Page& page, const Pixel& at, Mark mark, const Colour& colour)
{
  if (mark == Mark::none) return;
  const auto k = static_cast<std::size_t>(mark) - static_cast<std::size_t>(Mark::ring);
  const auto shape =
      static_cast<Mark>(k % n_outlines + static_cast<std::size_t>(Mark::ring));
  draw_shape(page, at, shape, colour, mark_across);
  if (k < n_outlines) draw_shape(page, at, shape, {1.0, 1.0, 1.0}, 0.55 * mark_across);
}

Grid grid(const Page& page, std::size_t n_panels, const std::vector<KeyEntry>& entries)
{
  const double u = page.unit();
  const double left = 145.0 * u, right = 40.0 * u, bottom = 105.0 * u, top = 35.0 * u;
  const std::size_t n_columns = n_panels == 1 ? 1 : 2;
  const std::size_t n_rows = (n_panels + n_columns - 1) / n_columns;
  const double width = page.width() / static_cast<double>(n_columns);
  const auto row_height = [&](double strip) {
    return (page.height() - strip) / static_cast<double>(n_rows);
  };
  const double place_width = width - left - right;
  const bool has_place =
      n_panels < n_rows * n_columns &&
      plan(page, entries, place_width).column - key_gap * u <= place_width &&
      key_height(page, entries, place_width) <= row_height(0.0) - bottom - top;

  Grid result;
  result.key = {left, 0.0, page.width() - right, page.height() - 15.0 * u};
  const double height =
      row_height(has_place ? 0.0 : key_height(page, entries, result.key.width()));
  const auto box = [&](std::size_t k) {
    const double x = width * static_cast<double>(k % n_columns);
    const double y = height * static_cast<double>(n_rows - 1 - k / n_columns);
    return Box{x + left, y + bottom, x + width - right, y + height - top};
  };
  for (std::size_t k = 0; k < n_panels; ++k) result.boxes.push_back(box(k));
  if (has_place) result.key = box(n_panels);
  return result;
}

} // namespace mergel::apps

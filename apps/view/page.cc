#include "apps/view/page.h"

#include "apps/view/resolution.h"
#include "apps/view/round_off.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/picture_of_view.h"
#include "dem/notation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkImageShrink3D.h>
#include <vtkPNGWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace mergel::apps {

namespace {

constexpr int oversampling = 2;
constexpr double dots_per_inch = 300.0; // 1600 pixels are 13.5 cm
constexpr double text_units = 27.0;     // height of ordinary text
constexpr double tick_units = 8.0;      // length of a tick
constexpr double frame_units = 1.8;     // width of frames and ticks
constexpr double number_units = 15.0;   // from the frame to the numbers
constexpr double title_units = 95.0;    // from the frame to the middle of the title of y
constexpr double number_size = 0.9;     // of numbers, relative to ordinary text

/// Filled convex polygons of one colour.
class Shapes {
public:
  void add(const std::vector<Pixel>& corners)
  {
    cells_->InsertNextCell(static_cast<int>(corners.size()));
    for (const Pixel& p : corners)
      cells_->InsertCellPoint(
          points_->InsertNextPoint(oversampling * p.x, oversampling * p.y, 0.0));
  }

  void show(vtkRenderer* overlay, const Colour& colour)
  {
    vtkNew<vtkPolyData> data;
    data->SetPoints(points_);
    data->SetPolys(cells_);
    vtkNew<vtkPolyDataMapper2D> mapper; // its coordinates are pixels of the window
    mapper->SetInputData(data);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
    overlay->AddActor2D(actor);
  }

private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
};

std::vector<Pixel> circle(const Pixel& centre, double radius, int n_sides)
{
  std::vector<Pixel> corners;
  for (int side = 0; side < n_sides; ++side) {
    const double angle = 2.0 * dem::pi * side / n_sides;
    corners.push_back(
        {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return corners;
}

/// Bars and round joints: lines of the graphics library have gaps where they bend.
void add_line(Shapes& shapes, const std::vector<Pixel>& points, double half)
{
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Pixel a = points[k], b = points[k + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0.0)) continue;
    const double nx = -half * (b.y - a.y) / length, ny = half * (b.x - a.x) / length;
    shapes.add({{a.x + nx, a.y + ny},
                {a.x - nx, a.y - ny},
                {b.x - nx, b.y - ny},
                {b.x + nx, b.y + ny}});
    if (k + 2 < points.size()) shapes.add(circle(b, half, 12));
  }
}

/// The drawn pieces of a dashed line; lengths of the pattern in `unit` pixels, > 0.
std::vector<std::vector<Pixel>> dashes(const std::vector<Pixel>& points,
                                       const std::vector<double>& pattern, double unit)
{
  if (points.empty()) return {};
  std::vector<std::vector<Pixel>> pieces{{points.front()}};
  std::size_t part = 0; // of the pattern; the even ones are drawn
  double rest = pattern.front() * unit;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Pixel a = points[k], b = points[k + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    for (double along = 0.0; along < length;) {
      const double step = std::min(rest, length - along);
      along += step;
      rest -= step;
      const Pixel here{a.x + (b.x - a.x) * along / length,
                       a.y + (b.y - a.y) * along / length};
      if (part % 2 == 0) pieces.back().push_back(here);
      if (rest > 0.0) continue;
      part = (part + 1) % pattern.size();
      rest = pattern[part] * unit;
      if (part % 2 == 0) pieces.push_back({here});
    }
  }
  return pieces;
}

} // namespace

Page::Page(int width, int height)
    : width_(width), height_(height), unit_(std::min(width / 1600.0, height / 1200.0))
{
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetSize(oversampling * width, oversampling * height);
  window_->SetNumberOfLayers(2);
  paper_->SetBackground(1.0, 1.0, 1.0);
  window_->AddRenderer(paper_);
  overlay_->SetLayer(1);
  window_->AddRenderer(overlay_);
}

vtkRenderer* Page::scene(const Box& box)
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->SetViewport(box.left / width_, box.bottom / height_, box.right / width_,
                        box.top / height_);
  window_->AddRenderer(renderer);
  return renderer; // the window keeps it alive
}

void Page::line(const std::vector<Pixel>& points, const Stroke& stroke)
{
  Shapes shapes;
  const double half = 0.5 * stroke.width * unit_;
  if (stroke.dash.empty())
    add_line(shapes, points, half);
  else
    for (const auto& piece : dashes(points, stroke.dash, unit_))
      add_line(shapes, piece, half);
  shapes.show(overlay_, stroke.colour);
}

void Page::line(const std::vector<Pixel>& points, const Colour& colour, double units_wide)
{
  line(points, Stroke{colour, units_wide, {}});
}

void Page::dot(const Pixel& centre, const Colour& colour, double units_across)
{
  Shapes shapes;
  shapes.add(circle(centre, 0.5 * units_across * unit_, 32));
  shapes.show(overlay_, colour);
}

void Page::fill(const Box& box, const Colour& colour)
{
  fill({{box.left, box.bottom},
        {box.right, box.bottom},
        {box.right, box.top},
        {box.left, box.top}},
       colour);
}

void Page::fill(const std::vector<Pixel>& corners, const Colour& colour)
{
  Shapes shapes;
  shapes.add(corners);
  shapes.show(overlay_, colour);
}

void Page::text(const Pixel& at, const std::string& words, const TextStyle& style)
{
  vtkNew<vtkTextActor> actor;
  actor->SetInput(words.c_str());
  vtkTextProperty* look = actor->GetTextProperty();
  look->SetFontFamilyToArial();
  look->SetFontSize(
      static_cast<int>(std::lround(oversampling * unit_ * text_units * style.size)));
  look->SetColor(ink[0], ink[1], ink[2]);
  look->SetBold(style.is_bold ? 1 : 0);
  look->SetOrientation(style.is_vertical ? 90.0 : 0.0);
  look->SetJustification(style.across == Across::left     ? VTK_TEXT_LEFT
                         : style.across == Across::middle ? VTK_TEXT_CENTERED
                                                          : VTK_TEXT_RIGHT);
  look->SetVerticalJustification(style.up == Up::foot     ? VTK_TEXT_BOTTOM
                                 : style.up == Up::middle ? VTK_TEXT_CENTERED
                                                          : VTK_TEXT_TOP);
  actor->SetPosition(oversampling * at.x, oversampling * at.y);
  overlay_->AddActor2D(actor);
}

void Page::save(const std::filesystem::path& png)
{
  window_->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window_);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(image->GetOutputPort());
  average->SetShrinkFactors(oversampling, oversampling, 1);
  average->MeanOn();

  // In memory: VTK takes a forbidden folder for a full disk.
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(average->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->AddText("Software", dem::software_of_pictures);
  writer->Write();
  vtkUnsignedCharArray* result = writer->GetResult();
  if (result == nullptr || result->GetNumberOfValues() == 0)
    throw NumericalError(png.string() + ": VTK makes no picture of its drawing.");
  const std::string bytes(reinterpret_cast<const char*>(result->GetPointer(0)),
                          static_cast<std::size_t>(result->GetNumberOfValues()));
  dem::replace_file(png, with_resolution(bytes, dots_per_inch));
}

double Axis::at(double start, double length, double value) const
{
  if (is_logarithmic) return start + length * std::log(value / from) / std::log(to / from);
  return start + length * (value - from) / (to - from);
}

Pixel Panel::at(double x_value, double y_value) const
{
  return {x.at(box.left, box.width(), x_value), y.at(box.bottom, box.height(), y_value)};
}

std::vector<double> round_ticks(double from, double to, int n)
{
  const double low = std::min(from, to), high = std::max(from, to);
  if (!(high > low)) return {low};
  const double rough = (high - low) / std::max(n, 1);
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * decade;
  for (const double round : {5.0, 2.0, 1.0})
    if (round * decade >= rough * (1.0 - round_off)) step = round * decade;

  std::vector<double> ticks;
  const double slack = 1e-6; // of a step, so that round-off does not lose the last tick
  for (double k = std::ceil(low / step - slack); k <= high / step + slack; ++k)
    ticks.push_back(k * step);
  return ticks;
}

std::vector<double> decade_ticks(double from, double to)
{
  std::vector<double> ticks;
  for (double k = std::floor(std::log10(from)); k <= std::ceil(std::log10(to)); ++k)
    for (double digit = 1.0; digit < 9.5; ++digit) {
      const double tick = digit * std::pow(10.0, k);
      if (tick >= from * (1.0 - round_off) && tick <= to * (1.0 + round_off))
        ticks.push_back(tick);
    }
  return ticks;
}

bool has_number(double tick, const Axis& axis)
{
  const bool is_wide = axis.to > 100.0 * axis.from * (1.0 + round_off);
  const double digit =
      std::round(tick / std::pow(10.0, std::floor(std::log10(tick) + round_off)));
  return digit == 1.0 || (!is_wide && (digit == 2.0 || digit == 5.0));
}

namespace {

/// Width of a number over the height of its text [-], by the widths of Arial.
double width_of_number(const std::string& text)
{
  double width = 0.0;
  for (const char c : text) {
    if (c >= '0' && c <= '9')
      width += 0.556;
    else if (c == '.')
      width += 0.278;
    else if (static_cast<unsigned char>(c) < 0x80 || static_cast<unsigned char>(c) >= 0xC0)
      width += 0.584; // e, + and -, and a true minus sign by its first byte
  }
  return width;
}

/// Size of the numbers left of a panel: long ones are smaller, so that they end before the title.
double size_of_y_numbers(const std::vector<std::string>& numbers)
{
  constexpr double room = title_units - number_units - 0.75 * text_units;
  double widest = 0.0;
  for (const std::string& number : numbers)
    widest = std::max(widest, width_of_number(number));
  return widest > 0.0 ? std::min(number_size, room / (widest * text_units)) : number_size;
}

} // namespace

std::string tick_text(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", std::abs(value));
  const std::string minus = "\u2212";
  return (value < 0.0 ? minus : std::string()) + text;
}

void draw_axes(Page& page, const Panel& panel)
{
  const double u = page.unit();
  const Box& box = panel.box;
  const auto grid = [](double value, const Axis& axis) {
    const bool is_minor = axis.is_logarithmic && !has_number(value, axis);
    return is_minor ? Colour{0.93, 0.93, 0.93} : Colour{0.87, 0.87, 0.87};
  };
  const auto n_ticks = [&](double length, double spacing) {
    return static_cast<int>(length / (spacing * u));
  };
  const double outward = panel.is_x_on_top ? 1.0 : -1.0;
  const double x_side = panel.is_x_on_top ? box.top : box.bottom;

  const auto ticks = [](const Axis& axis, int n) {
    return axis.is_logarithmic ? decade_ticks(axis.from, axis.to)
                               : round_ticks(axis.from, axis.to, n);
  };
  const auto number = [](double value, const Axis& axis) {
    return !axis.is_logarithmic || has_number(value, axis) ? tick_text(value)
                                                           : std::string();
  };
  const auto x_ticks = ticks(panel.x, n_ticks(box.width(), 85.0));
  const auto y_ticks = ticks(panel.y, n_ticks(box.height(), 80.0));
  if (panel.has_grid) {
    for (const double value : x_ticks) {
      const double x = panel.at(value, panel.y.from).x;
      page.line({{x, box.bottom}, {x, box.top}}, grid(value, panel.x), frame_units);
    }
    for (const double value : y_ticks) {
      const double y = panel.at(panel.x.from, value).y;
      page.line({{box.left, y}, {box.right, y}}, grid(value, panel.y), frame_units);
    }
  }

  for (const double value : x_ticks) {
    const double x = panel.at(value, panel.y.from).x;
    page.line({{x, x_side}, {x, x_side + outward * tick_units * u}}, ink, frame_units);
    page.text({x, x_side + outward * number_units * u}, number(value, panel.x),
              {number_size, Across::middle, panel.is_x_on_top ? Up::foot : Up::head});
  }
  std::vector<std::string> y_numbers;
  for (const double value : y_ticks) y_numbers.push_back(number(value, panel.y));
  const double y_size = size_of_y_numbers(y_numbers);
  for (std::size_t k = 0; k < y_ticks.size(); ++k) {
    const double y = panel.at(panel.x.from, y_ticks[k]).y;
    page.line({{box.left - tick_units * u, y}, {box.left, y}}, ink, frame_units);
    if (panel.has_y_numbers)
      page.text({box.left - number_units * u, y}, y_numbers[k], {y_size, Across::right});
  }

  page.line({{box.left, box.bottom},
             {box.right, box.bottom},
             {box.right, box.top},
             {box.left, box.top},
             {box.left, box.bottom}},
            ink, frame_units);

  page.text({0.5 * (box.left + box.right), x_side + outward * 52.0 * u}, panel.x.title,
            {1.0, Across::middle, panel.is_x_on_top ? Up::foot : Up::head});
  TextStyle upwards;
  upwards.is_vertical = true;
  page.text({box.left - title_units * u, 0.5 * (box.bottom + box.top)}, panel.y.title,
            upwards);
}

} // namespace mergel::apps

/// A white page drawn off screen: 3-D scenes in boxes, and lines, fills, text and axes
/// above them.
///
/// Positions are pixels of the finished picture, x to the right and y upwards from its
/// lower left corner. The page is drawn at twice its size and averaged, which smooths every
/// edge.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace mergel::apps {

struct Pixel {
  double x = 0.0, y = 0.0;
};

struct Box {
  double left = 0.0, bottom = 0.0, right = 0.0, top = 0.0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

using Colour = std::array<double, 3>; ///< red, green, blue, 0 to 1
inline constexpr Colour ink{0.13, 0.13, 0.13};

/// How a line is drawn; lengths in units of the page.
struct Stroke {
  Colour colour = ink;
  double width = 4.0;
  std::vector<double> dash; ///< drawn, left out, drawn, ... along the line; empty: unbroken
};

/// Which part of the text its position names.
enum class Across { left, middle, right };
enum class Up { foot, middle, head };
struct TextStyle {
  double size = 1.0; ///< relative to the ordinary text of the page
  Across across = Across::middle;
  Up up = Up::middle;
  bool is_vertical = false; ///< reads upwards
  bool is_bold = false;
};

class Page {
public:
  /// @param width, height size of the finished picture, pixels
  Page(int width, int height);

  double width() const { return width_; }
  double height() const { return height_; }
  /// The length by which lines, text and margins are measured: 1 pixel at 1600 x 1200.
  double unit() const { return unit_; }

  /// A white scene in this box, below lines and text.
  vtkRenderer* scene(const Box& box);

  void line(const std::vector<Pixel>& points, const Stroke& stroke);
  void line(const std::vector<Pixel>& points, const Colour& colour, double units_wide);
  void dot(const Pixel& centre, const Colour& colour, double units_across);
  void fill(const Box& box, const Colour& colour);
  void fill(const std::vector<Pixel>& corners, const Colour& colour); ///< convex
  void text(const Pixel& at, const std::string& words, const TextStyle& style = {});

  /// Draw everything and write a .png (under a temporary name, then renamed).
  /// @throws NumericalError when the file cannot be written
  void save(const std::filesystem::path& png);

private:
  double width_, height_, unit_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> paper_, overlay_;
};

/// One axis of a panel; `from` may be above `to` (a depth that grows downwards). A
/// logarithmic one has 0 < from < to.
struct Axis {
  double from = 0.0; ///< at the left or lower end
  double to = 1.0;   ///< at the right or upper end
  std::string title; ///< with its unit; empty: the axis shows ticks only
  bool is_logarithmic = false;

  /// Where a value lies on a line of this start and length.
  double at(double start, double length, double value) const;
};

struct Panel {
  Box box;
  Axis x, y;
  bool is_x_on_top = false;
  bool has_grid = false;
  bool has_y_numbers = true;
  Pixel at(double x_value, double y_value) const;
};

/// Round numbers (1, 2, 5 times a power of ten apart) in [from, to], about `n` of them.
std::vector<double> round_ticks(double from, double to, int n);

/// Every 1 to 9 times a power of ten in [from, to], 0 < from < to.
std::vector<double> decade_ticks(double from, double to);

/// Whether a tick of a logarithmic axis gets a number: 1, 2 and 5 times a power of ten;
/// over more than two decades the powers of ten alone.
bool has_number(double tick, const Axis& axis);

/// "12", "0.5", with a true minus sign.
std::string tick_text(double value);

/// Grid, frame, ticks, numbers and titles of a panel. Draw the curves after it.
void draw_axes(Page& page, const Panel& panel);

} // namespace mergel::apps

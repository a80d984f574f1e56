#include "apps/pile/pile_surface.h"

#include "apps/case/units.h"
#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/io/seal.h"
#include "dem/io/stl_file.h"
#include "dem/text.h"

#include <cmath>
#include <sstream>

namespace mergel::apps {

namespace {

/// Three numbers. @throws InputError when there are more or fewer
template <class Number>
std::array<Number, 3> three_of(const std::string& text)
{
  std::istringstream in(text);
  std::array<Number, 3> a{};
  std::string rest;
  require(static_cast<bool>(in >> a[0] >> a[1] >> a[2]) && !(in >> rest),
          "is no surface: \"" + text.substr(0, 40) +
              "\". Leave the key out to read the file");
  return a;
}

/// Call for each part of a text between commas.
template <class Visit>
void for_parts(const std::string& text, Visit&& visit)
{
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) visit(part);
}

dem::ClosedSurface surface_in(const std::string& bytes, const PileSurface& s)
{
  const auto triangles = dem::stl_from(bytes, s.file.string());
  require(
      triangles.size() <= most_triangles,
      "has " + std::to_string(triangles.size()) + " triangles, at most " +
          std::to_string(most_triangles) +
          " are allowed. Export it with a coarser tolerance: a tenth of the radius of a "
          "particle is fine enough");
  return dem::join_corners(triangles);
}

/// Its axis must be z, and its middle must be near it.
void require_axis(const dem::Polyhedron& polyhedron)
{
  const dem::Vec3 centre = dem::centre_of_volume(polyhedron.closed_surface());
  const double off = std::hypot(centre.x(), centre.y());
  require(off <= 0.25 * polyhedron.R(),
          "is off its axis: the centre of its volume is at x = " +
              dem::rounded(1e3 * centre.x()) +
              " mm, y = " + dem::rounded(1e3 * centre.y()) +
              " mm. The axis z of the file is the axis of the pile, upwards: move it");
}

} // namespace

std::string text_of(const dem::ClosedSurface& surface)
{
  std::string text;
  for (const dem::Vec3& x : surface.x)
    text += (text.empty() ? "" : ", ") + dem::shortest(x.x()) + ' ' + dem::shortest(x.y()) +
            ' ' + dem::shortest(x.z());
  const char* before = "; ";
  for (const dem::Triangle& t : surface.triangles) {
    text += before + std::to_string(t[0]) + ' ' + std::to_string(t[1]) + ' ' +
            std::to_string(t[2]);
    before = ", ";
  }
  return text;
}

dem::ClosedSurface surface_from(const std::string& text)
{
  const auto middle = text.find(';');
  require(middle != std::string::npos,
          "is no surface: it has no \";\". Leave the key out to read the file");
  dem::ClosedSurface surface;
  for_parts(text.substr(0, middle), [&](const std::string& part) {
    const auto x = three_of<double>(part);
    surface.x.emplace_back(x[0], x[1], x[2]);
  });
  std::vector<std::array<dem::Vec3, 3>> corners;
  for_parts(text.substr(middle + 1), [&](const std::string& part) {
    const auto t = three_of<int>(part);
    for (const int k : t)
      require(k >= 0 && dem::uz(k) < surface.x.size(),
              "is no surface: it has no point " + std::to_string(k) +
                  ". Leave the key out to read the file");
    corners.push_back(
        {surface.x[dem::uz(t[0])], surface.x[dem::uz(t[1])], surface.x[dem::uz(t[2])]});
  });
  return dem::join_corners(corners); // without what no triangle has
}

void declare(CaseFile& file, PileSurface& s)
{
  const auto only = file.only_if("tip", {"surface"});
  file.path(
      "surface", s.file,
      "STL file, ASCII or binary, of a closed surface: the pile. Its axis z is the axis "
      "of the pile, and its lowest point starts at the surface of the rock.",
      Default::none);
  file.text("surface unit", s.unit, "Unit of length of that file: mm, m, inch.");
  file.text(
      "surface sum", s.sum,
      "Checksum of that file, set in a resolved case: a changed file is refused. Leave "
      "it out to begin with the file as it is.");
  file.text("surface content", s.content,
            "Points and triangles of that file, set in a resolved case: a run that is "
            "continued, or whose file is gone, needs no file.");
  file.identified_by("surface sum", {"surface", "surface content"});
  file.derived("tip height", s.tip_height, "m", non_negative,
               "where the section first has its largest area",
               "Height above the lowest point up to which forces are those of the tip.",
               "mm");
}

namespace {

/// What f returns; an InputError of it refuses the key.
template <class F>
auto or_refuse(const CaseFile& file, const std::string& key, F&& f)
{
  try {
    return f();
  } catch (const InputError& e) {
    file.refuse("Pile", key, e.what());
  }
}

/// From the case. A value that would fill pages is not repeated in the message.
dem::ClosedSurface known_surface(const CaseFile& file, const PileSurface& s)
{
  try {
    return surface_from(s.content);
  } catch (const InputError& e) {
    throw InputError(file.where("Pile", "surface content") + ": " + e.what());
  }
}

/// From the file. Sets sum and content.
dem::ClosedSurface new_surface(const CaseFile& file, PileSurface& s)
{
  const std::string bytes = or_refuse(file, "surface", [&] {
    dem::require_readable(s.file);
    return dem::bytes_of(s.file);
  });
  const std::string sum = dem::hexadecimal(dem::fnv_1a(bytes));
  if (!s.sum.empty() && s.sum != sum)
    file.refuse("Pile", "surface sum",
                s.file.string() + " has " + sum +
                    ": it was changed after this case was resolved. Restore the old file, "
                    "or leave this key out to begin a run with the new one");
  dem::ClosedSurface surface =
      or_refuse(file, "surface", [&] { return surface_in(bytes, s); });
  s.sum = sum;
  s.content = text_of(surface);
  return surface;
}

} // namespace

void complete_surface(CaseFile& file, PileSurface& s)
{
  const double unit =
      or_refuse(file, "surface unit", [&] { return unit_size(s.unit, "m"); });
  std::error_code error; // a file that cannot be reached counts as gone
  const bool is_gone = !std::filesystem::exists(s.file, error);
  if (file.is_continued() && is_gone && s.content.empty()) {
    s.sum = file.earlier_value("Pile", "surface sum");
    s.content = file.earlier_value("Pile", "surface content");
  }
  const bool is_known = !s.content.empty() && !s.sum.empty() &&
                        !file.is_override("Pile", "surface") &&
                        (file.is_continued() || is_gone);
  dem::ClosedSurface surface = is_known ? known_surface(file, s) : new_surface(file, s);
  for (dem::Vec3& x : surface.x) x *= unit;
  s.polyhedron = or_refuse(file, "surface", [&] {
    dem::Polyhedron polyhedron = dem::make_polyhedron(std::move(surface));
    require_axis(polyhedron);
    return polyhedron;
  });
  file.resolve("Pile", "surface sum", s.sum);
  file.resolve("Pile", "surface content", s.content);
  file.derive("Pile", "tip height", s.polyhedron->tip_height);
  if (s.tip_height >= s.polyhedron->length)
    file.refuse("Pile", "tip height",
                "the pile is " + dem::rounded(1e3 * s.polyhedron->length) +
                    " mm long: must be below its length");
  s.polyhedron->tip_height = s.tip_height;
}

std::string report(const PileSurface& s)
{
  std::ostringstream out;
  out.precision(4);
  out << "pile: " << s.polyhedron->surface.topology.triangles.size() << " triangles, "
      << 1e3 * s.polyhedron->length
      << " mm long; the circle of its largest section has D_p = " << 2e3 * s.polyhedron->R()
      << " mm, the tip is " << 1e3 * s.polyhedron->tip_height << " mm high\n";
  return out.str();
}

} // namespace mergel::apps

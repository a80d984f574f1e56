#include "apps/view/localisation.h"

#include "apps/view/particles.h"
#include "apps/view/round_off.h"
#include "apps/view/specimen.h"
#include "dem/assembly/localisation.h"
#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

namespace mergel::apps {

namespace {

constexpr double degrees_per_radian = 57.29577951308232;
constexpr double mm_per_m = 1e3;
constexpr double highest = 4.0; ///< strain over its mean at the dark end of the colours
constexpr const char* array_of_ratio = "strain over its mean";

/// The line of localisation.csv at one time, for one of its strains.
class Bands {
public:
  Bands(const dem::Table& table, std::size_t row, std::string strain)
      : table_(table), row_(row), strain_(std::move(strain))
  {
    found_.band = slab("", "share of the tenth");
    found_.second = slab("second ", "second share of the rest");
  }
  const dem::Localisation& found() const { return found_; } ///< lengths in mm
  double thickness() const { return at("thickness/d50", "-"); }

private:
  double at(const std::string& name, const char* unit) const
  {
    return table_.column(strain_ + ": " + name, unit)[row_];
  }
  dem::Slab slab(const std::string& prefix, const std::string& share) const
  {
    const double angle = at(prefix + "angle", "degree") / degrees_per_radian,
                 azimuth = at(prefix + "dip direction", "degree") / degrees_per_radian;
    return {{std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
             std::cos(angle)},
            mm_per_m * at(prefix + "first face", "m"),
            mm_per_m * at(prefix + "last face", "m"),
            at(share, "-"),
            at(prefix + "even share", "-")};
  }

  const dem::Table& table_;
  std::size_t row_;
  std::string strain_;
  dem::Localisation found_;
};

/// Turned about the axis by -azimuth: what lies in this direction is to the right.
vtkSmartPointer<vtkPolyData> turned(vtkPolyData* data, double azimuth)
{
  vtkNew<vtkTransform> turn;
  turn->RotateZ(-degrees_per_radian * azimuth);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(data);
  filter->SetTransform(turn);
  filter->Update();
  vtkSmartPointer<vtkPolyData> result = filter->GetOutput();
  return result;
}

/// Add the ratio of an array to its mean; returns the mean.
double add_ratio(vtkPolyData* particles, const std::string& name)
{
  vtkDataArray* strain = particles->GetPointData()->GetArray(name.c_str());
  require(strain != nullptr, "the particles have no array '" + name +
                                 "'. Was the run made by this version of mergel?");
  const vtkIdType n = strain->GetNumberOfTuples();
  double mean = 0.0;
  for (vtkIdType k = 0; k < n; ++k) mean += strain->GetTuple1(k) / static_cast<double>(n);
  vtkNew<vtkDoubleArray> ratio;
  ratio->SetName(array_of_ratio);
  for (vtkIdType k = 0; k < n; ++k)
    ratio->InsertNextValue(mean > 0.0 ? strain->GetTuple1(k) / mean : 0.0);
  particles->GetPointData()->AddArray(ratio);
  return mean;
}

/// The trace of the plane normal.x = c in the section, within the panel.
void draw_trace(Page& page, const Panel& panel, const dem::Vec3& normal, double azimuth,
                double c, const Stroke& stroke)
{
  const double n_x = normal.x() * std::cos(azimuth) + normal.y() * std::sin(azimuth),
               n_z = normal.z();
  const double square = n_x * n_x + n_z * n_z;
  if (square < 1e-6) return; // the section is parallel to the plane
  const double x = c * n_x / square, z = c * n_z / square; // nearest to the origin
  double from = -1e6, to = 1e6;                            // along (-n_z, n_x)
  const auto clip = [&](double at, double slope, double low, double high) {
    if (std::abs(slope) < 1e-12) {
      if (at < low || at > high) to = from;
      return;
    }
    const double a = (low - at) / slope, b = (high - at) / slope;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  };
  clip(x, -n_z, panel.x.from, panel.x.to);
  clip(z, n_x, panel.y.from, panel.y.to);
  if (!(from < to)) return;
  page.line(
      {panel.at(x - from * n_z, z + from * n_x), panel.at(x - to * n_z, z + to * n_x)},
      stroke);
}

AssemblyPicture ratio_picture()
{
  AssemblyPicture picture = damage_picture();
  picture.array = array_of_ratio;
  picture.high = highest;
  picture.legend = "shear strain\nover its mean";
  return picture;
}

template <class... Values>
std::string text_of(const char* format, Values... values)
{
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// Of the slab: angle, thickness, shares.
std::string words(const Bands& bands)
{
  const dem::Slab& slab = bands.found().band;
  return text_of("slab at %.0f degrees, %.1f d50 thick, with\n"
                 "%.0f %% of the most sheared tenth (even: %.0f %%)",
                 degrees_per_radian * slab.angle(), bands.thickness(), 100.0 * slab.share,
                 100.0 * slab.even);
}

} // namespace

std::optional<std::size_t> bands_at(double time, const dem::Table& localisation)
{
  const std::vector<double>& t = localisation.column("time", "s");
  for (std::size_t k = 0; k < t.size(); ++k)
    if (std::abs(t[k] - time) <= round_off * std::abs(time)) return k;
  return {};
}

void draw_localisation(Page& page, const SpecimenFrame& frame,
                       const dem::Table& localisation, std::size_t row)
{
  const AssemblyPicture picture = ratio_picture();
  const auto table = lookup_table(picture);
  const double u = page.unit();
  const PlatenFace upper = platen_face(frame.platens, true),
                   lower = platen_face(frame.platens, false);
  const Bounds inside = bounds(frame.membrane ? frame.membrane : frame.particles);
  const double height = std::max(upper.z_0, upper.z_1) - std::min(lower.z_0, lower.z_1);
  const double thickness = thickness_of_platens * height;
  const double across = std::max(inside[1] - inside[0], inside[3] - inside[2]);
  Window window{0.0, 0.5 * (inside[4] + inside[5]), 1.15 * across,
                height + 3.0 * thickness};

  const double left = 130.0 * u, gap = 90.0 * u, legend = 250.0 * u;
  const double top = page.height() - 190.0 * u, bottom = 115.0 * u;
  const double room = 0.5 * (page.width() - legend - left - gap);
  const double px_per_mm = std::min((top - bottom) / window.height, room / window.width);
  const double width = window.width * px_per_mm, z_from = top - window.height * px_per_mm;
  const double step = std::max(width, 430.0 * u) + gap; // room for the words above

  const auto draw = [&](double x, const std::string& title, const std::string& strain,
                        const std::string& array, const std::string& z_title) {
    const Bands bands(localisation, row, strain);
    const dem::Slab &slab = bands.found().band, &second = bands.found().second;
    const double azimuth = slab.dip_direction();
    const auto particles = turned(frame.particles, azimuth);
    const double mean = add_ratio(particles, array);
    const Box box{x, z_from, x + width, top};
    vtkRenderer* scene = page.scene(box);
    scene->AddActor(spheres(drawn(particles, picture.array, Cut::open), table));
    look_along_y(scene, window);
    Panel panel;
    panel.box = box;
    panel.x = {window.left(), window.right(), "along the dip (mm)"};
    panel.y = {window.bottom(), window.top(), z_title};
    const auto platens = turned(frame.platens, azimuth);
    draw_platen(page, panel, platen_face(platens, true), thickness);
    draw_platen(page, panel, platen_face(platens, false), -thickness);
    for (const double c : {slab.from, slab.to})
      draw_trace(page, panel, slab.normal, azimuth, c, {ink, 5.0, {}});
    if (bands.found().has_second())
      for (const double c : {second.from, second.to})
        draw_trace(page, panel, second.normal, azimuth, c, {ink, 3.5, {18.0, 12.0}});
    draw_axes(page, panel);
    page.text({x, top + 18.0 * u},
              title + text_of(", mean %.3g %%\n", 100.0 * mean) + words(bands),
              {0.85, Across::left, Up::foot});
  };
  const double increment = localisation.column("increment of the axial strain", "-")[row];
  draw(left, "shear strain", "shear strain", "shear strain [-]", "z (mm)");
  draw(left + step, text_of("in the last %.2g %% of axial strain", 100.0 * increment),
       "increment of shear strain", "shear strain of the increment [-]", "");
  const double bar = left + step + width + 45.0 * u, bar_height = top - z_from;
  draw_legend(page,
              {bar, z_from + 0.25 * bar_height, bar + 40.0 * u, z_from + 0.75 * bar_height},
              picture, table);
  page.text({left, page.height() - 22.0 * u},
            text_of("axial strain %.3g %%     time %.4g ms",
                    100.0 * localisation.column("axial strain", "-")[row],
                    1e3 * frame.time),
            {1.0, Across::left, Up::head});
}

} // namespace mergel::apps

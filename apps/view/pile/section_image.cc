#include "apps/view/pile/section_image.h"

#include "apps/view/round_off.h"
#include "dem/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

namespace mergel::apps {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double y_of_face = 1e-3;    // mm; behind the plane y = 0
constexpr double just_before = -5e-3; // mm

} // namespace

SectionValues::SectionValues(vtkImageData* fields, const std::string& array, int components,
                             const std::function<double(const double*)>& value)
{
  vtkDataArray* data = fields->GetPointData()->GetArray(array.c_str());
  require(data != nullptr && data->GetNumberOfComponents() == components,
          "the continuum fields have no point array '" + array + "' with " +
              std::to_string(components) +
              " component(s). Was the run made by this version of mergel?");
  const int* n = fields->GetDimensions();
  n_x_ = n[0];
  n_z_ = n[2];
  h_ = fields->GetSpacing()[0];
  x_0_ = fields->GetOrigin()[0];
  z_0_ = fields->GetOrigin()[2];
  std::vector<double> tuple(static_cast<std::size_t>(components));
  for (vtkIdType k = 0; k < data->GetNumberOfTuples(); ++k) {
    data->GetTuple(k, tuple.data());
    values_.push_back(value(tuple.data()));
  }
}

double SectionValues::at(int column, int row) const
{
  if (column < 0 || column >= n_x_ || row < 0 || row >= n_z_) return none;
  return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(n_x_) +
                 static_cast<std::size_t>(column)];
}

double SectionValues::between(double column, double row) const
{
  if (!std::isfinite(
          at(static_cast<int>(std::lround(column)), static_cast<int>(std::lround(row)))))
    return none;
  const double left = std::floor(column), low = std::floor(row);
  double sum = 0.0, weights = 0.0;
  for (const double c : {left, left + 1.0})
    for (const double r : {low, low + 1.0}) {
      const double value = at(static_cast<int>(c), static_cast<int>(r));
      const double weight = (1.0 - std::abs(column - c)) * (1.0 - std::abs(row - r));
      if (!std::isfinite(value)) continue;
      sum += weight * value;
      weights += weight;
    }
  return weights > 0.0 ? sum / weights : none;
}

double SectionValues::quantile(double share, const Window& window) const
{
  std::vector<double> sorted;
  for (int row = 0; row < n_z_; ++row)
    for (int column = 0; column < n_x_; ++column)
      if (std::isfinite(at(column, row)) && x(column) > window.left() &&
          x(column) < window.right() && z(row) > window.bottom() && z(row) < window.top())
        sorted.push_back(at(column, row));
  if (sorted.empty()) return 0.0;
  const auto k =
      static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + k, sorted.end());
  return sorted[static_cast<std::size_t>(k)];
}

std::function<double(const double*)> component(int k, double factor)
{
  return [k, factor](const double* tuple) { return factor * tuple[k]; };
}

vtkSmartPointer<vtkActor> face_of(const SectionValues& values, vtkLookupTable* table,
                                  const Window& window)
{
  constexpr int n = 4; // facets along an edge of a cell
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> facets;
  vtkNew<vtkDoubleArray> shown;
  const double half = 0.5 * values.h() / n;
  for (int k = 0; k < n * values.n_z(); ++k)
    for (int c = 0; c < n * values.n_x(); ++c) {
      const double column = (c + 0.5) / n - 0.5, row = (k + 0.5) / n - 0.5;
      const double x = values.x(column), z = values.z(row);
      if (x < window.left() || x > window.right() || z < window.bottom() ||
          z > window.top())
        continue;
      const double value = values.between(column, row);
      if (!std::isfinite(value)) continue;
      facets->InsertNextCell(4);
      for (const auto& corner : {std::pair{-half, -half}, std::pair{half, -half},
                                 std::pair{half, half}, std::pair{-half, half}})
        facets->InsertCellPoint(
            points->InsertNextPoint(x + corner.first, y_of_face, z + corner.second));
      shown->InsertNextValue(value);
    }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(facets);
  data->GetCellData()->SetScalars(shown);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUseCellData();
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> bars(const std::vector<Bar>& list, Before before)
{
  // Particles and pile are seen along y from before: their widths are those of the picture.
  double y = just_before;
  if (before == Before::particles)
    for (const Bar& b : list) y = std::min({y, -std::abs(b.x_0), -std::abs(b.x_1)});
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> facets;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const Bar& b : list) {
    const double length = std::hypot(b.x_1 - b.x_0, b.z_1 - b.z_0);
    if (!(length > 0.0)) continue;
    const double nx = -0.5 * b.width * (b.z_1 - b.z_0) / length,
                 nz = 0.5 * b.width * (b.x_1 - b.x_0) / length;
    facets->InsertNextCell(4);
    for (const auto& corner :
         {std::pair{b.x_0 + nx, b.z_0 + nz}, std::pair{b.x_0 - nx, b.z_0 - nz},
          std::pair{b.x_1 - nx, b.z_1 - nz}, std::pair{b.x_1 + nx, b.z_1 + nz}})
      facets->InsertCellPoint(points->InsertNextPoint(corner.first, y, corner.second));
    for (const double part : b.colour)
      colours->InsertNextValue(static_cast<unsigned char>(std::lround(255.0 * part)));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(facets);
  data->GetCellData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUseCellData();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

double round_above(double value)
{
  if (!(value > 0.0)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double round : {1.0, 2.0, 5.0})
    if (round * decade >= value * (1.0 - round_off)) return round * decade;
  return 10.0 * decade;
}

} // namespace mergel::apps

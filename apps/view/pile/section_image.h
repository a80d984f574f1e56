/// Continuum fields of a pile run, drawn as sections along the axis of the pile.
#pragma once

#include "apps/view/particles.h"

#include <functional>
#include <string>
#include <vector>

#include <vtkImageData.h>

namespace mergel::apps {

/// A field on the points of a section, as one number a point.
class SectionValues {
public:
  /// @param value of a tuple of the array
  /// @throws InputError when there is no such array, or it has another number of components
  SectionValues(vtkImageData* fields, const std::string& array, int components,
                const std::function<double(const double*)>& value);

  int n_x() const { return n_x_; }
  int n_z() const { return n_z_; }
  double h() const { return h_; }                              ///< of the points [mm]
  double x(double column) const { return x_0_ + h_ * column; } ///< [mm]
  double z(double row) const { return z_0_ + h_ * row; }       ///< [mm]
  double at(int column, int row) const; ///< NaN where there is no rock
  /// Between the points, of those around that have a value; NaN where the nearest has none.
  double between(double column, double row) const;
  /// The value that this share of the points in a window do not exceed; 0 without any.
  double quantile(double share, const Window& window) const;

private:
  int n_x_ = 0, n_z_ = 0;
  double h_ = 0.0, x_0_ = 0.0, z_0_ = 0.0;
  std::vector<double> values_;
};

/// One component of an array.
std::function<double(const double*)> component(int k, double factor = 1.0);

/// The part of the field in a window as a coloured face in the plane y = 0, four by four facets a
/// point.
vtkSmartPointer<vtkActor> face_of(const SectionValues& values, vtkLookupTable* table,
                                  const Window& window);

/// A bar in the plane of the section.
struct Bar {
  double x_0, z_0, x_1, z_1, width; ///< ends and width [mm]
  Colour colour;
};
/// Where bars stand.
enum class Before {
  face,     ///< before a face, but behind the pile
  particles ///< before all
};
vtkSmartPointer<vtkActor> bars(const std::vector<Bar>& list, Before before);

/// The 1, 2 or 5 times a power of ten that is next above, or 1 for what is not above 0.
double round_above(double value);

} // namespace mergel::apps

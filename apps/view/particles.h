/// Particles in a scene that is seen along y: coloured by an array, whole or cut open.
#pragma once

#include "apps/view/page.h"

#include <array>
#include <string>
#include <vector>

#include <vtkActor.h>
#include <vtkLookupTable.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace mergel::apps {

inline constexpr Colour steel{0.52, 0.56, 0.61};

/// Colours of the assembly, and the texts of the picture.
struct AssemblyPicture {
  std::string array;                  ///< point array of the particles, one component
  double low = 0.0, high = 1.0;       ///< values at the ends of the colours
  bool is_logarithmic = false;        ///< then 0 < low < high, powers of ten
  std::vector<Colour> colours;        ///< from low to high, blended in CIELAB
  bool is_far_field_coloured = false; ///< the far field has that array too
  std::string legend;                 ///< title of the colour bar, with its unit
  std::string caption;                ///< above the picture
};

/// Light beige to dark red, lightness decreasing evenly.
std::vector<Colour> damage_colours();

/// Damage of the bonds of each particle; no caption yet.
AssemblyPicture damage_picture();

/// Light to dark blue, lightness decreasing evenly.
std::vector<Colour> displacement_colours();

/// xmin, xmax, ymin, ymax, zmin, zmax [mm]
using Bounds = std::array<double, 6>;

Bounds bounds(vtkDataSet* data);

/// A rectangle of the plane y = 0 that a scene shows [mm].
struct Window {
  double x_middle, z_middle, width, height;
  double left() const { return x_middle - 0.5 * width; }
  double right() const { return x_middle + 0.5 * width; }
  double bottom() const { return z_middle - 0.5 * height; }
  double top() const { return z_middle + 0.5 * height; }
};

/// The colours of a picture, from low to high.
vtkSmartPointer<vtkLookupTable> lookup_table(const AssemblyPicture& picture);

/// Which particles are drawn.
enum class Cut {
  whole,
  open ///< the half y >= 0; those of a full model in front of the cut are left out
};

/// The particles with point arrays "radius" and, as scalars, `array`.
vtkSmartPointer<vtkPolyData> drawn(vtkPolyData* particles, const std::string& array,
                                   Cut cut);

vtkSmartPointer<vtkActor> spheres(vtkPolyData* drawn, vtkLookupTable* table);

void look_along_y(vtkRenderer* scene, const Window& window);

/// The colour bar, its title above it.
void draw_legend(Page& page, const Box& bar, const AssemblyPicture& picture,
                 vtkLookupTable* table);

} // namespace mergel::apps

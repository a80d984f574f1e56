/// Results of `mergel pile`, `mergel triaxial` and `mergel brazilian` at one instant, read for
/// drawing.
#pragma once

#include <filesystem>

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace mergel::apps {

/// One frame. Lengths (positions, radii, displacements) are in mm, as the axes are;
/// graphics cards need numbers near 1.
struct ResultFrame {
  std::size_t number = 0; ///< position in particles.pvd, from 0
  double time = 0.0;      ///< [s]
  vtkSmartPointer<vtkPolyData>
      particles;                     ///< point arrays "radius" [mm], "damage" [-], "id"
  vtkSmartPointer<vtkPolyData> pile; ///< its surface; half (y >= 0) or whole
  vtkSmartPointer<vtkUnstructuredGrid> far_field; ///< point array "displacement" (3) [mm]
};

/// Read frame `number` of a results folder; a negative number counts from the end (-1: the
/// last). Pile and far field are those of the same time.
/// @throws InputError naming the file: missing, damaged, without an array, without that
/// frame
ResultFrame read_frame(const std::filesystem::path& folder, int number);

/// The continuum fields of a pile run at one frame, in mm too; `section` is null where the run
/// wrote none.
struct ContinuumFrame {
  vtkSmartPointer<vtkImageData> section; ///< lengths of the arrays are in m, as in the file
  vtkSmartPointer<vtkPolyData> contacts; ///< cell array "normal force [N]"
};

/// @param time of a frame [s]
/// @throws InputError as above
ContinuumFrame read_continuum(const std::filesystem::path& folder, double time);

/// One frame of a triaxial test, in mm too.
struct SpecimenFrame {
  double time = 0.0;                      ///< [s]
  vtkSmartPointer<vtkPolyData> particles; ///< as above
  vtkSmartPointer<vtkPolyData> platens;   ///< both
  vtkSmartPointer<vtkPolyData> membrane;  ///< null without one
};

/// @throws InputError as above
SpecimenFrame read_specimen(const std::filesystem::path& folder, int number);

/// One frame of a Brazilian test, in mm too.
struct DiscFrame {
  double time = 0.0;                      ///< [s]
  vtkSmartPointer<vtkPolyData> particles; ///< as above
  vtkSmartPointer<vtkPolyData> plates;    ///< both
  /// Point arrays "radius", "mode" and "normal"; null before the first.
  vtkSmartPointer<vtkPolyData> breaks;
};

/// @throws InputError as above
DiscFrame read_disc(const std::filesystem::path& folder, int number);

} // namespace mergel::apps

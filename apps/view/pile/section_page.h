/// Pages with sections along the axis of the pile, two panels in a row, all of one window.
#pragma once

#include "apps/view/options.h"
#include "apps/view/pile/section_image.h"
#include "apps/view/results.h"

#include <optional>

namespace mergel::apps {

/// The part of a section that the pictures of fields show: up to four diameters from the axis
/// and three and a half below the tip [mm].
Window window_around(vtkPolyData* pile, const SectionValues& any);

/// One panel: a face, bars before it, particles; each may be missing.
struct SectionPanel {
  std::string title;
  std::vector<vtkSmartPointer<vtkActor>> actors;
  std::optional<AssemblyPicture> picture; ///< its colour bar
  Window window;
};

/// The size of a page of so many panels, where the user gave none.
PictureSize size_of(const Options& options, std::size_t n_panels);

/// @param caption above the panels
void draw_sections(Page& page, vtkPolyData* pile, const std::vector<SectionPanel>& panels,
                   const std::string& caption);

} // namespace mergel::apps

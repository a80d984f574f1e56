/// The assembly cut open along the axis of the pile: particles, pile, a section of the far
/// field.
#pragma once

#include "apps/view/particles.h"
#include "apps/view/results.h"

namespace mergel::apps {

/// Draws the half y >= 0 as seen along +y, the full pile, axes in mm; with a close-up of
/// the tip beside it if the DEM region is slender enough to leave room.
void draw_assembly(Page& page, const ResultFrame& frame, const AssemblyPicture& picture);

/// The full pile: a half one gets its mirror image.
vtkSmartPointer<vtkActor> pile_actor(vtkPolyData* surface);

} // namespace mergel::apps

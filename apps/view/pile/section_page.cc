#include "apps/view/pile/section_page.h"

#include "apps/view/pile/scene.h"

#include <algorithm>

namespace mergel::apps {

namespace {

constexpr double beside = 4.0, below = 3.5, above = 0.6; // in diameters
constexpr std::size_t in_a_row = 2;

} // namespace

Window window_around(vtkPolyData* pile, const SectionValues& any)
{
  const Bounds b = bounds(pile);
  const double D = b[1] - b[0];
  const double half =
      std::min(beside * D, any.x(any.n_x() - 1) + 0.5 * any.h()); // of the region
  const double bottom = std::max(b[4] - below * D, any.z(0) - 0.5 * any.h());
  const double top = above * D;
  return {0.0, 0.5 * (bottom + top), 2.0 * half, top - bottom};
}

PictureSize size_of(const Options& options, std::size_t n_panels)
{
  if (options.has_size) return options.size;
  return {2400, n_panels > in_a_row ? 2000 : 1200};
}

void draw_sections(Page& page, vtkPolyData* pile, const std::vector<SectionPanel>& panels,
                   const std::string& caption)
{
  const double u = page.unit();
  const double left = 130.0 * u, legend = 190.0 * u, foot = 110.0 * u, head = 60.0 * u;
  const std::size_t n_rows = (panels.size() + in_a_row - 1) / in_a_row;
  const double width = page.width() / static_cast<double>(in_a_row);
  const double height = (page.height() - 60.0 * u) / static_cast<double>(n_rows);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const SectionPanel& shown = panels[k];
    const Window& window = shown.window;
    const double x = width * static_cast<double>(k % in_a_row) + left;
    const double top =
        page.height() - 60.0 * u - height * static_cast<double>(k / in_a_row) - head;
    const double scale = std::min((width - left - legend) / window.width,
                                  (height - head - foot) / window.height);
    Panel panel;
    panel.box = {x, top - scale * window.height, x + scale * window.width, top};
    panel.x = {window.left(), window.right(), "x (mm)"};
    panel.y = {window.bottom(), window.top(), k % in_a_row == 0 ? "z (mm)" : ""};
    vtkRenderer* scene = page.scene(panel.box);
    for (const auto& actor : shown.actors) scene->AddActor(actor);
    scene->AddActor(pile_actor(pile));
    look_along_y(scene, window);
    draw_axes(page, panel);
    page.text({panel.box.left, panel.box.top + 14.0 * u}, shown.title,
              {1.0, Across::left, Up::foot});
    if (!shown.picture) continue;
    const double bar = panel.box.right + 40.0 * u, tall = panel.box.height();
    draw_legend(
        page,
        {bar, panel.box.bottom + 0.2 * tall, bar + 36.0 * u, panel.box.bottom + 0.8 * tall},
        *shown.picture, lookup_table(*shown.picture));
  }
  page.text({left, page.height() - 18.0 * u}, caption, {1.0, Across::left, Up::head});
}

} // namespace mergel::apps

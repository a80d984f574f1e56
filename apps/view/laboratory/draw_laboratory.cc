#include "apps/view/laboratory/draw_laboratory.h"

#include "apps/laboratory/test_series.h"
#include "apps/view/laboratory/critical_state.h"
#include "apps/view/laboratory/mohr.h"
#include "apps/view/laboratory/yield.h"
#include "apps/view/output.h"
#include "dem/error.h"

#include <iostream>
#include <optional>

namespace mergel::apps {

namespace {

/// One panel is half as high as two.
Page page_for(const Options& options, std::size_t n_panels)
{
  const int height = options.has_size ? options.size.height : n_panels == 1 ? 1000 : 1500;
  return {options.size.width, height};
}

std::optional<TestSeries> series_of(const Options& options)
{
  std::vector<std::string> labels;
  for (const RunName& name : run_names(options)) labels.push_back(name.label);
  try {
    return read_series_of_tests(options.folders, labels);
  } catch (const InputError& error) {
    std::cout << "no mohr.png, critical_state.png and yield.png: " << error.what() << '\n';
    return std::nullopt;
  }
}

void say_left_out(const std::string& picture, const Selection& of)
{
  for (const std::string& test : of.left_out)
    std::cout << picture << " without " << test << '\n';
}

} // namespace

void draw_laboratory(const Options& options)
{
  if (options.folders.size() < 2) return;
  const std::optional<TestSeries> series = series_of(options);
  if (!series) return;
  for (const std::string& note : series->groups.notes) std::cout << note << '\n';
  const auto output = picture_folder(options);

  const std::size_t n = n_mohr_panels(*series);
  if (n > 0) {
    Page page = page_for(options, n);
    draw_mohr(page, *series);
    save(page, output / "mohr.png");
  }
  for (const auto& [fit, what] :
       {std::pair{&series->peak, "mohr.png at the peak"},
        std::pair{&series->critical, "mohr.png in the critical state"}}) {
    if (!fit->of.why_not.empty())
      std::cout << "no " << what << ": " << fit->of.why_not << '\n';
    say_left_out(what, fit->of);
  }

  const CriticalFit& critical = series->critical_states;
  if (critical.line) {
    Page page = page_for(options, 2);
    draw_critical_states(page, *series);
    save(page, output / "critical_state.png");
  } else {
    std::cout << "no critical_state.png: " << critical.of.why_not << '\n';
  }

  if (const std::string lacks = lacks_of_yield(*series); lacks.empty()) {
    Page page = page_for(options, 1);
    draw_yield(page, *series);
    save(page, output / "yield.png");
  } else {
    std::cout << "no yield.png: " << lacks << '\n';
  }
}

} // namespace mergel::apps

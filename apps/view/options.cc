#include "apps/view/options.h"

#include "dem/error.h"
#include "dem/io/standard_output.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <string_view>

namespace mergel::apps {

namespace {

PictureSize parse_size(const std::string& text)
{
  PictureSize size;
  char rest = 0;
  const bool is_read =
      std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) == 2;
  const auto fits = [](int n) { return 200 <= n && n <= 8000; };
  require(is_read && fits(size.width) && fits(size.height),
          "--size " + text +
              ": must be WIDTHxHEIGHT with 200 to 8000 pixels each, such as 1600x1200.");
  return size;
}

} // namespace

namespace {

/// @throws InputError with the present name of an option that was renamed
void refuse_former_names(int argc, char** argv)
{
  for (int k = 1; k < argc; ++k) {
    const std::string_view word = argv[k];
    require(word != "--leg" && !word.starts_with("--leg="),
            "--leg is now --stage, with the numbers of the case. See mergel-view --help.");
  }
}

} // namespace

std::optional<Options> read_options(int argc, char** argv, int& code)
{
  refuse_former_names(argc, argv);
  Options options;
  std::string size_text = "1600x1200";
  CLI::App app(
      "Draw runs. A pile run: damage.png, displacement.png and load.png. Bond runs, "
      "one or several: loads.png and surface.png. Element runs, one or "
      "several: element.png (q and volumetric strain over axial strain, q and void ratio "
      "over p) or, where |q| stays below 1 % of p, isotropic.png (p over volumetric "
      "strain, void ratio over log p). Triaxial runs: the same as triaxial.png, with the "
      "volumetric strain of the middle third, and of one run "
      "specimen.png (particles through the membrane, and cut open) and localisation.png "
      "(shear strain across the slab in which it is localised). Brazilian runs: "
      "brazilian.png (2P/(pi D t) and broken bonds over diametral strain), and of one run "
      "disc.png (particles by damage, and breaks by mode). Several element or "
      "triaxial runs besides: mohr.png (circles and Coulomb line at the peak and in the "
      "critical state), critical_state.png and yield.png, where they mean something. Any "
      "runs, with --curve: curve.png, with --compare: compare.png.",
      "mergel-view");
  app.add_option(
         "DIR", options.folders,
         "Results folder written by 'mergel pile', 'mergel bond', 'mergel element', "
         "'mergel triaxial' or 'mergel brazilian'; several of one job, and 'element' and "
         "'triaxial' runs, "
         "are drawn over each other (pile: with --curve)")
      ->required();
  app.add_option("--output", options.output,
                 "Folder for the pictures (default: DIR; required with several)");
  app.add_option(
         "--label", options.labels,
         "Name of a run in the key, once for each DIR in their order (default: the names "
         "of the folders)")
      ->allow_extra_args(false);
  app.add_option(
         "--curve", options.curves,
         "Draw curve.png instead: any column of history.csv over any other, \"X:Y\", such "
         "as \"axial strain:q\" or \"log p [kPa]:void ratio\"; A/B is the ratio of two "
         "columns (q/p), [unit] any that fits; repeat for more panels")
      ->allow_extra_args(false);
  app.add_option("--stage", options.stage,
                 "Of element and triaxial runs draw only from this stage on (2), or these "
                 "stages (2-3), as the case numbers them; of an unload-reload 3a is the "
                 "unloading, 3b the reloading, \"3b of cycle 2\" that of one cycle; "
                 "axial and volumetric strain then count from its start (of a stage that "
                 "resumes: from that "
                 "of the stage resumed)");
  app.add_option(
         "--points", options.points,
         "Points to lay over curves: a CSV file of two columns named as the axes of a "
         "panel, such as \"p [MPa],q [MPa]\", and above them, if wanted, \"# name in the "
         "key\"; repeatable")
      ->allow_extra_args(false);
  app.add_flag(
      "--mean", options.is_mean,
      "Of element and triaxial runs that differ only by seed draw the mean, with a "
      "band of one standard error over the axial strain");
  app.add_option(
         "--compare", options.compare,
         "Draw compare.png instead: a CSV file of measured curves over those of the runs; "
         "its headings name columns of history.csv and their units, such as "
         "\"axial strain [%],q [MPa]\" or \"depth [mm],q_c [MPa]\", and each gets a panel; "
         "repeatable")
      ->allow_extra_args(false);
  const auto* frame = app.add_option("--frame", options.frame,
                                     "Frame of a pile, triaxial or Brazilian run to draw, "
                                     "from 0; negative: from the end (default: "
                                     "the last)");
  const auto* size =
      app.add_option(
             "--size", size_text,
             "Size of the pictures in pixels (surface.png of five panels: 1600x1800)")
          ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    code = app.exit(error) == 0 ? 0 : 1; // 0: --help was asked for
    if (code == 0) dem::require_printed();
    return std::nullopt;
  }
  options.has_frame = frame->count() > 0;
  options.has_size = size->count() > 0;
  options.size = parse_size(size_text);
  return options;
}

} // namespace mergel::apps

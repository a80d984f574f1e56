#include "apps/view/output.h"

#include "apps/laboratory/test_reading.h"
#include "dem/error.h"

#include <iostream>
#include <system_error>

namespace mergel::apps {

namespace fs = std::filesystem;

fs::path picture_folder(const Options& options)
{
  if (options.output.empty()) return options.folders.front();
  std::error_code error;
  fs::create_directories(options.output, error);
  require(fs::is_directory(options.output),
          "--output " + options.output.string() + ": cannot be made a folder" +
              (error ? " (" + error.message() + ")" : "") + ". Choose another.");
  return options.output;
}

void save(const Options& options, Page& page, const fs::path& png)
{
  std::error_code error;
  require(options.output.empty() || !fs::exists(fs::symlink_status(png, error)) ||
              is_picture_of_view(png),
          png.string() +
              ": exists, and this version of mergel-view has not made it. Move it "
              "away, or choose another folder with --output.");
  page.save(png);
  std::cout << png.string() << '\n';
}

std::vector<RunName> run_names(const Options& options)
{
  const auto& folders = options.folders;
  require(!options.has_frame,
          "--frame " + std::to_string(options.frame) +
              ": is for damage.png and displacement.png of a pile run, for specimen.png "
              "and localisation.png of one triaxial run and for disc.png of one Brazilian "
              "run; curves have no frames. Leave it out.");
  require(options.labels.empty() || options.labels.size() == folders.size(),
          "--label: given " + std::to_string(options.labels.size()) + " times for " +
              std::to_string(folders.size()) +
              " folder(s): must be given once for each, in their order, or not at all.");
  require(folders.size() == 1 || !options.output.empty(),
          "--output: must be given with several folders, to say where their common "
          "pictures go.");
  const auto labels = options.labels.empty() ? folder_labels(folders) : options.labels;
  std::vector<RunName> names;
  for (std::size_t k = 0; k < folders.size(); ++k) names.push_back({k, labels[k]});
  return names;
}

} // namespace mergel::apps

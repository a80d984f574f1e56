#include "apps/view/output.h"

#include "apps/laboratory/test_reading.h"
#include "dem/error.h"
#include "dem/io/picture_of_view.h"
#include "dem/io/readable.h"

#include <cerrno>
#include <iostream>
#include <system_error>

#include <unistd.h>

namespace mergel::apps {

namespace fs = std::filesystem;

fs::path picture_folder(const Options& options)
{
  const bool is_asked = !options.output.empty();
  const fs::path folder = is_asked ? options.output : fs::path(options.folders.front());
  std::error_code error, ignored;
  if (is_asked) fs::create_directories(folder, error);
  require(fs::is_directory(folder, ignored),
          "--output " + folder.string() + ": cannot be made a folder" +
              (error ? " (" + error.message() + ")" : "") + ". Choose another.");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError((is_asked ? "--output " : "") + folder.string() +
                     ": cannot be written: " + std::generic_category().message(errno) +
                     ". Choose another folder with --output.");
  return folder;
}

void save(Page& page, const fs::path& png)
{
  std::error_code error;
  const bool is_earlier = fs::exists(fs::symlink_status(png, error));
  if (const auto unread = is_earlier ? dem::reading_error(png) : std::error_code())
    throw InputError(
        png.string() + ": exists, and mergel-view cannot read whether it has made it: " +
        unread.message() + ". Move it away, or choose another folder with --output.");
  require(!is_earlier || dem::is_picture_of_view(png),
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

#include "fem/mesh_library.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace mergel::fem {
namespace {

const std::string file_name = "libmergel_dealii.so";

/// Where it may be, by the place of the program. Not by a run path: who looks for it there is the
/// caller of dlopen, and that is another library where a sanitizer stands between.
std::vector<std::filesystem::path> places()
{
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  return {folder / file_name,
          (folder / MERGEL_LIBRARY_FOLDER / file_name).lexically_normal()};
}

MeshLibrary load()
{
  const auto candidates = places();
  for (const auto& path : candidates) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) continue;
    void* library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (!library)
      throw std::runtime_error(
          path.string() + ": cannot be loaded: " + dlerror() +
          ". Are the libraries of deal.II those that it was built with?");
    using Entry = MeshLibrary (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(library, "mergel_mesh_library"));
    const bool is_ours = entry && entry().build == std::string(MERGEL_BUILD);
    if (!is_ours)
      throw std::runtime_error(path.string() + ": is of " +
                               (entry ? std::string(entry().build) : "another program") +
                               ", the program is of " + MERGEL_BUILD +
                               ". Build or install both together.");
    return entry();
  }
  throw std::runtime_error(
      "the finite-element library of the program is missing: there is no " +
      candidates.front().string() + " and no " + candidates.back().string() +
      ". Copy or install it together with the program.");
}

} // namespace

const MeshLibrary& mesh_library()
{
  static const MeshLibrary library = load();
  return library;
}

} // namespace mergel::fem

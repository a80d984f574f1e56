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

/// Where it may be, by the place of the program. dlopen would search the run path of the library
/// that calls it, which under a sanitizer is the sanitizer's.
std::vector<std::filesystem::path> places()
{
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error)
    throw std::runtime_error("/proc/self/exe: cannot be read (" + error.message() +
                             "): the program does not find its own folder.");
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
          "the finite-element library cannot be loaded: " + std::string(dlerror()) +
          ". Are the libraries of deal.II those that it was built with?");
    // Its name first: nothing else of another build may be called.
    const auto build = reinterpret_cast<const char* (*)()>(dlsym(library, "mergel_build"));
    const auto functions =
        reinterpret_cast<MeshLibrary (*)()>(dlsym(library, "mergel_mesh_library"));
    const std::string its_build = build && functions ? build() : "no build of mergel";
    if (its_build != MERGEL_BUILD)
      throw std::runtime_error(path.string() + ": is of " + its_build +
                               ", the program is of " + MERGEL_BUILD +
                               ". Build or install both together.");
    return functions();
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

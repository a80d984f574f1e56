/// Where the files lie that mergel ships.
#pragma once

#include <filesystem>

namespace mergel::test {

/// The folder of the repository; __FILE__ may be relative to a folder that is not known.
std::filesystem::path repository();

} // namespace mergel::test

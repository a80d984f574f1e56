/// What distinguishes a run from the others of a picture.
#pragma once

#include <cstddef>
#include <string>

namespace mergel::apps {

struct RunName {
  std::size_t number = 0; ///< of its stroke
  std::string label;      ///< in the key
};

} // namespace mergel::apps

/// Numbers as text.
#pragma once

#include <string>

namespace mergel::dem {

/// The shortest decimal text that reads back to the same bits.
std::string shortest(double value);

} // namespace mergel::dem

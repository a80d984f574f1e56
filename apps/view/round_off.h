/// What counts as equal when numbers are drawn.
#pragma once

namespace mergel::apps {

/// Relative difference below which two numbers on a picture are the same [-].
inline constexpr double round_off = 1e-9;

} // namespace mergel::apps

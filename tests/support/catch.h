/// The names of Catch2 that the tests use, the same for version 2 (Debian 12) and 3 (Debian 13).
#pragma once
#if __has_include(<catch2/catch_test_macros.hpp>) // version 3
#include <string>

#include <catch2/catch_approx.hpp>
#include <catch2/catch_session.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/generators/catch_generators_range.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

using Catch::Approx;

namespace mergel::match {
inline auto Contains(const std::string& text)
{
  return Catch::Matchers::ContainsSubstring(text);
}
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
} // namespace mergel::match
#else
#include <catch2/catch.hpp>

namespace mergel::match {
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
} // namespace mergel::match
#endif

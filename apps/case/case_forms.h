/// The keys of a case in other forms than help: JSON for programs, and a case to fill in.
#pragma once

#include "apps/case/case_file.h"

#include <string>

namespace mergel::apps {

/// Every key as JSON, an array of objects: section, key, unit (null without one), default (a
/// string, or null), rule (null, or by what the default follows), required, range, meaning,
/// condition (null for a key that always exists), not needed (null for never).
std::string keys_as_json(const CaseFile& file);

/// What stands for the value of a key without a default in template_of(); no key takes it.
inline constexpr std::string_view to_be_given = "REQUIRED";

/// A complete case with every key and its meaning: defaults as they are, keys that must be given
/// with the value REQUIRED. Keys that have no effect with these choices, and those whose default
/// follows from others, are remarks. With the required values filled in it can be run.
/// @param first_lines remarks for its head, without '#'
std::string template_of(const CaseFile& file, const std::string& first_lines);

} // namespace mergel::apps

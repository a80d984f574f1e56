/// The stages of an element or triaxial test, picked from its history.
#pragma once

#include "dem/io/table.h"

#include <array>
#include <string>
#include <vector>

namespace mergel::apps {

/// The strains of a history that count from the start of the test, the axial one first.
inline constexpr std::array<const char*, 5> counted_strains{
    "axial strain", "volumetric strain", "axial strain of the middle third",
    "lateral strain of the middle third", "volumetric strain of the middle third"};
inline constexpr const char* volume_of_cell = counted_strains[1];
inline constexpr const char* volume_of_middle = counted_strains.back();

/// Whether this is the history of an element test, not of a pile, bond or triaxial test.
bool is_element_history(const dem::Table& history);

/// Whether this is the history of a triaxial test.
bool is_triaxial_history(const dem::Table& history);

/// Part of the unload-reload at each record, 1 unloading, 2 reloading; 0 elsewhere, and in a
/// history without such a column.
std::vector<double> parts_of(const dem::Table& history);

/// Which stages are drawn, counted from 1 as in the case.
struct Stages {
  int first = 0; ///< 0: all, with the strains of the whole test
  int last = 0;  ///< 0: to the end of the test
  /// Of an unload-reload: 1 from (or up to) its unloading, 2 its reloading; 0 the whole stage.
  int first_part = 0, last_part = 0;
  /// Of one that is repeated: in which cycle, from 1; 0 from the first such part, up to the last.
  int first_cycle = 0, last_cycle = 0;
  bool is_all() const { return first == 0; }
};

/// "3", or "3a" and "3b" for the parts of an unload-reload; "3a of cycle 2".
/// @param part, cycle 0: none
std::string name_of_stage(int number, int part, int cycle = 0);

/// "2": from stage 2 on; "2-3": stages 2 and 3; "3a", "3b", "2-3a": the same with parts;
/// "3b of cycle 2", "3 of cycle 2-3 of cycle 4": with cycles.
/// @throws InputError naming the text
Stages stages_of(const std::string& text);

/// The records of these stages. "axial strain" and "volumetric strain", and strains "of the
/// middle third", count from where the strain of the first of them counts; the approach to
/// the stress of that stage is left out. "... of the stage" stay as they are.
/// @throws InputError naming the file when it holds no such stage, or no such part
dem::Table from_stages(const dem::Table& history, const Stages& stages);

} // namespace mergel::apps

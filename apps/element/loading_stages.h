/// The loading stages of an element test as written in a case file, one per key:
///
///     set stage 1 = isotropic to p = 1 MPa
///     set stage 2 = triaxial to axial strain = 2 %
///     set stage 3 = unload-reload to q = 0.2 MPa
///     set stage 4 = resume to axial strain = 15 %
///     set stage 5 = unload-reload to q = 0.2 MPa, 10 times
///     set stage 6 = axes x = fixed, y = 1 MPa, z = strain-controlled to axial strain = 2 %
#pragma once

#include "apps/case/case_file.h"
#include "dem/element/stress_path.h"

#include <map>
#include <string>
#include <vector>

namespace mergel::apps {

/// The forms that a stage may have, for help and messages.
extern const char* const forms_of_stage;

/// Stages of one key: one, or two for each cycle of unload-reload.
/// @throws InputError with the error and the expected form; it does not repeat the text
std::vector<dem::LoadingStage> read_stages(const std::string& text);

/// Texts of the stages by their numbers in the case, from 1.
using StageTexts = std::map<std::size_t, std::string>;

/// "stage 1" for number 1.
std::string key_of_stage(std::size_t number);

/// Declare the stages in the open section `Loading`, as many as a case gives.
void declare_stages(CaseFile& file, StageTexts& texts);
/// The stages of these texts. @throws InputError naming file, line and key
std::vector<dem::LoadingStage> stages_of(const CaseFile& file, const StageTexts& texts);

/// Refuse a stage that particles without bonds cannot follow: where an axis bears no pressure
/// they fall apart. @pre stages_of() has read these texts
/// @throws InputError naming file, line and key
void check_granular_stages(const CaseFile& file, const StageTexts& texts);

/// A loading stage as the case has it. `unload-reload` is one stage of the case and two of the
/// test, its parts.
struct StageLabel {
  std::size_t number = 1; ///< of its key, from 1
  int part = 0;           ///< 0 the whole of it, 1 its unloading, 2 its reloading
  std::size_t cycle = 0;  ///< of an unload-reload, from 1; else 0
  std::string text;       ///< as the case says it, "unload-reload to q = 1 MPa, unloading"
  bool is_repeated = false; ///< an unload-reload of several cycles

  std::string name() const; ///< "3"; "3a" and "3b" for the parts; "3a of cycle 2"
};

/// One for each loading stage of these texts, in their order. @pre stages_of() has read them
std::vector<StageLabel> labels_of(const StageTexts& texts);

/// What is wrong with a stage that has just begun: its word is `unload`, `unload-reload` or
/// `reload`, and its target lies on the other side of the present state. A sentence with stage,
/// quantity, value and remedy; empty where nothing is wrong, and for all other words.
/// @param labels up to this stage, the last one
/// @param before the stage before it, as it ended
/// @param now    the stage as dem::begin_stage() has made it
std::string wrong_direction(const std::vector<StageLabel>& labels,
                            const dem::ActiveStage& before, const dem::ActiveStage& now);

/// Whether a test in which `n_begun` stages of `earlier` were begun may go on with `now`: these
/// are the same with the same numbers, and so is the reloading where only the unloading of a
/// stage was begun. A loop may be repeated more or less often, down to the cycles begun.
/// @pre stages_of() has read these texts
bool may_go_on(const StageTexts& earlier, const StageTexts& now, std::size_t n_begun);

} // namespace mergel::apps

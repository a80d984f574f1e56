/// What a restart may change of the loading stages of a pile.
#pragma once

#include "apps/pile/pile_case.h"
#include "apps/run/restart.h"

namespace mergel::apps {

/// Refuse a change of what is done or under way in the checkpoint: a stage, or a key on which
/// it depends. A final depth may change as long as the pile does not slow down for it, and
/// grow at the end of a run.
/// @throws InputError naming file, line and key
void check_changed_stages(const CaseFile& file, const Restart& restart, const PileCase& c);

/// A length [m] in millimetres, with six digits.
std::string mm_text(double x);

} // namespace mergel::apps

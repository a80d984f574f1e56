/// The summary of `mergel brazilian`.
#pragma once

#include "apps/brazilian/brazilian_case.h"
#include "apps/run/protocol.h"

namespace mergel::apps {

/// Breaks that tell where failure began.
inline constexpr std::size_t first_breaks = 20;

std::string sentence_of(coupling::BrazilianOutcome outcome);

/// Disc and rate, for the log.
std::string describe(const BrazilianCase& c, const coupling::BrazilianTest& test);

/// Add the results to summary.json and to the closing text.
void summarise(Summary& summary, const BrazilianCase& c,
               const coupling::BrazilianTest& test, const coupling::CoupledSystem& system,
               const Work& work);

} // namespace mergel::apps

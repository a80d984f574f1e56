/// What a run tells of its time step: the step itself, scaled masses, the alarm of the energy
/// error.
#pragma once

#include "apps/run/summary.h"
#include "dem/assembly/energy_balance.h"
#include "dem/assembly/mass_scaling.h"
#include "dem/assembly/timestep.h"

#include <string>

namespace mergel::apps {

/// Lines for the log: what the mass scaling did, what rules the step, and a warning of one
/// beyond the stable step.
std::string report(const dem::StepSpec& step, const dem::StableStep& stable, double dt,
                   const dem::Particles& p);

/// A line on the record that raised the alarm of the energy error.
std::string alarm_text(const dem::EnergyAlarm& alarm);

/// Add step, stable step and what rules it.
void add_step(Summary& summary, const dem::StableStep& stable, double dt);

/// Add what the mass scaling did, if there was one.
void add_mass_scaling(Summary& summary, const dem::Particles& p);

/// Add the record that raised the alarm, if one did.
void add_alarm(Summary& summary, const dem::EnergyAlarm& alarm);

} // namespace mergel::apps
